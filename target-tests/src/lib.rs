//! What the programs of this package share.
//!
//! | file | what |
//! |---|---|
//! | `six` | the six-axis estimator, and its calls as functions of their own |
//! | `vehicle` | the vehicle's estimator and the regression with drag, configured |
//! | `scenario`, `rigid_body`, `drag` | inputs for them, the same bits on every machine |
//! | `random` | their noise |
//! | `parity` | a flight over all of them, told as hashes of every output bit |
//! | `cost`, `stack` | mean and worst of a count; the stack that a call uses |
//! | `whole_loop`, `peripherals` | the control loop of `fsb-firmware`, with motors that do nothing |
//! | `board` | the emulated machine: instruction counter, fault handler |
#![no_std]

#[cfg(all(target_os = "none", feature = "emulator"))]
pub mod board;
#[cfg(all(target_os = "none", feature = "emulator"))]
pub mod cost;
pub mod drag;
pub mod parity;
pub mod peripherals;
pub mod random;
pub mod rigid_body;
pub mod scenario;
pub mod six;
#[cfg(all(target_os = "none", feature = "emulator"))]
pub mod stack;
pub mod vehicle;
pub mod whole_loop;
