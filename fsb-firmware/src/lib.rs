//! The control loop of a flight controller around `fsb-core`: position and attitude in, six motor commands out.
//!
//! A tick takes the sample of the six axes, identifies 1/m and 1/Ix, 1/Iy, 1/Iz and estimates the velocities, computes the
//! certainty-equivalence control (11), (13) with them, turns the force into the body frame, and allocates the wrench to
//! six motors. What the estimator is told is what the motors deliver, saturation and duty steps included.
//!
//! # What comes from a receiver that is dead, stuck or wrong
//!
//! Both estimators are behind gates ([`fsb_core::guard`]), and what is not known is not flown on. Times are those of
//! [`LoopConfig::new`]; events name the axis, and are told once an outage.
//!
//! | what comes | what the loop does | events |
//! |---|---|---|
//! | nothing, up to 1 s (angles: 0.5 s) | flies on what is predicted | [`MeasurementRejected`](Event::MeasurementRejected) `Missing` after 20 ms, [`MeasuredAgain`](Event::MeasuredAgain) after a second with nothing wrong |
//! | nothing for longer | the configured fallback input on the axis; the others are flown. Where a whole group was away, the windows begin anew with the next sample, parameters held | [`StateLost`](Event::StateLost) `Stale`, [`ParameterHeld`](Event::ParameterHeld); then [`StateUsable`](Event::StateUsable) |
//! | nothing from the start | the fallback from the first tick on. Three axes of a group begin together: one that has never come keeps back two | [`StateLost`](Event::StateLost) `NotMeasured` after the same time |
//! | NaN, infinities, beyond the limit, outliers | not used, predicted | [`MeasurementRejected`](Event::MeasurementRejected) with the reason, at once |
//! | the same bits for 50 ms | as if nothing came, from then on, and through every restart and reset, until two differ | [`MeasurementRejected`](Event::MeasurementRejected) `Frozen` |
//! | a jump that stays | after ten that agree positions are what they are now: the vehicle flies to where it shall be by them | [`Jumped`](Event::Jumped) |
//! | a velocity that changes at once | after ten on a straight line it is followed | [`Pushed`](Event::Pushed) |
//! | an attitude that is no rotation, or whose angles were not believed | the last good one turns the forces, up to 0.5 s | [`AttitudeRejected`](Event::AttitudeRejected) |
//! | no attitude for longer | no force can be pointed: the fallback's along the body's axes; the mass is not learned | [`AttitudeLost`](Event::AttitudeLost); then [`AttitudeUsable`](Event::AttitudeUsable) |
//! | samples between two instants | not used; where it goes on, as if nothing came, and then begins anew in step | [`SampleEarly`](Event::SampleEarly) |
//!
//! The fallback is no rescue: it carries the configured weight and turns nothing, so that a vehicle that is heavier sinks, and one that
//! has lost its attitude as well falls over in the end. What to do then (land, cut the motors, hand over) is for whoever reads the events.
//! On its way back the vehicle asks for more than its motors have: they give the torque first ([`Allocation::bounded`]).
//!
//! # Files
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
