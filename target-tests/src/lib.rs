//! What the programs of this package share.
//!
//! | file | what |
//! |---|---|
//! | `six` | the six-axis estimator, and its calls as functions of their own |
//! | `scenario` | inputs, the same bits on every machine |
//! | `parity` | a flight over all of them, told as hashes of every output bit |
//! | `whole_loop`, `peripherals` | the control loop of `fsb-firmware`, with motors that do nothing |
//! | `board` | the emulated machine: instruction counter, fault handler |
#![no_std]

#[cfg(all(target_os = "none", feature = "emulator"))]
pub mod board;
pub mod parity;
pub mod peripherals;
pub mod scenario;
pub mod six;
pub mod whole_loop;
