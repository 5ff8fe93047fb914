#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod accumulator;
pub mod attitude;
mod checks;
pub mod control;
pub mod error;
pub mod estimator;
pub mod guard;
pub mod identifier;
pub mod moments;
pub mod observer;
pub mod readout;
pub mod regression;
pub mod snapshot;
pub mod tuning;
pub mod vehicle;
mod wide;
pub mod window;

pub use error::ConfigError;
pub use estimator::{Estimator, EstimatorConfig, EstimatorDesign};
pub use tuning::Tuning;
