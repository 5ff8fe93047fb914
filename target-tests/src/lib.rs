//! What the programs of this package share.
//!
//! | file | what |
//! |---|---|
//! | `six` | the six-axis estimator, and its calls as functions of their own |
//! | `scenario` | inputs, the same bits on every machine |
//! | `parity` | a flight over all of them, told as hashes of every output bit |
//! | `board` | the emulated machine: instruction counter, fault handler |
#![no_std]

#[cfg(target_os = "none")]
pub mod board;
pub mod parity;
pub mod scenario;
pub mod six;
