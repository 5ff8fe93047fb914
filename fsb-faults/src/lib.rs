#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod config;
mod draws;
mod injector;

pub use config::{FaultConfig, FaultError};
pub use injector::Injector;
