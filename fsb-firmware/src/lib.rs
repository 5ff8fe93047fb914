//! The control loop of a flight controller around `fsb-core`: position and attitude in, six motor commands out.
//!
//! A tick takes the sample of the six axes, identifies 1/m and 1/Ix, 1/Iy, 1/Iz and estimates the velocities, computes the
//! certainty-equivalence control (11), (13) with them, turns the force into the body frame, and allocates the wrench to
//! six motors. What the estimator is told is what the motors deliver, saturation and duty steps included.
//!
//! | file | what |
//! |---|---|
//! | `control_loop` | one tick, and the pacing |
//! | `config` | plain data |
//! | `sample` | what comes in, and what went out |
//! | `axes` | six axes: two estimators behind gates, six controllers |
//! | `allocation` | wrench to thrusts and back |
//! | `hexarotor` | that matrix for passively tilted rotors |
//! | `watch` | which axes are measured and have a state, and what of that is told |
//! | `attitude` | the rotation matrix |
//! | `bearing` | the attitude that turns forces, and for how long it may |
//! | `events` | what happened, with its tick |
//!
//! No allocation, no panic and no transcendental in a tick; `attitude_from_angles` (feature `micromath`) is outside of it.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

// The plant is that of the firmware, which is another crate.
#[cfg(test)]
extern crate self as fsb_firmware;

mod allocation;
mod attitude;
mod axes;
mod bearing;
mod config;
mod control_loop;
mod events;
mod hexarotor;
mod sample;
mod watch;

pub use allocation::{Allocation, AllocationError};
#[cfg(feature = "micromath")]
pub use attitude::attitude_from_angles;
pub use attitude::attitude_from_quaternion;
pub use config::{LoopConfig, LoopConfigError};
pub use control_loop::{ControlLoop, LoopError};
pub use events::{Event, Events, StampedEvent};
pub use hexarotor::TiltedHexarotor;
pub use sample::{Attitude, Report, Sample};
