//! The vehicle of the paper's section II in six degrees of freedom: mass, moments of inertia, position, velocity, attitude and
//! body rates from sampled positions and attitudes and from what the actuators were told, at any attitude (design, section 10).
//!
//! ```text
//! m x'' = R F - m g e3        I ω' = τ - ω × I ω        R' = R S(ω)
//! ```
//!
//! World frame with z up; F and τ along the body's axes; R turns body into world coordinates. One call per control period:
//!
//! ```
//! use fsb_core::vehicle::{Attitude, Expected, Measured, VehicleConfig, VehicleEstimator, Wrench};
//!
//! let mut config = VehicleConfig::new(0.01);
//! config.mass = Expected::about(2.0);
//! config.inertia = [0.02, 0.02, 0.04].map(Expected::about);
//! let mut vehicle = VehicleEstimator::<1>::new(&config)?;
//! let mut wrench = Wrench::default();
//! for _ in 0..100 {
//!     let measured = Measured { position: Some([0.0, 0.0, 1.0]), attitude: Some(Attitude::Quaternion([1.0, 0.0, 0.0, 0.0])) };
//!     vehicle.update(&measured, &wrench);
//!     let state = vehicle.state(); // now: compute the control
//!     assert!(state.position.is_none_or(|[x, ..]| x.abs() < 1e-6));
//!     wrench = Wrench { force: [0.0, 0.0, 2.5 * 9.81], torque: [0.0; 3] };
//! }
//! let mass = vehicle.mass().map(|m| m.value);
//! assert!(mass.is_some_and(|m| (m - 2.5).abs() < 1e-4));
//! # Ok::<(), fsb_core::ConfigError>(())
//! ```
//!
//! | file | what |
//! |---|---|
//! | `config`, `design` | plain data, and it turned into that of the two estimators |
//! | `measured` | what an update takes |
//! | `output` | what is handed out |
//! | `estimator` | the update |
//! | `readings` | parameters and counters handed out |
//! | `state` | the state now: predicted over what measurements are late |
//! | `actuators` | first-order lag; moments of the force turned into the world frame |
//! | `gyroscopic` | ω × I ω as an input |
//! | `retroactive` | the same with moments of inertia that were not known at the time |
//! | `change`, `statistic` | whether a parameter has changed, by the innovations |
//! | `residual` | the same by what is left in the identifier's band |
//! | `doubt` | what a change that was told leaves open |
//! | `reinitialise` | parameters identified anew |
//! | `replaced` | forces and torques that were rejected |
//! | `delay` | inputs waiting for a measurement that comes late |
//! | `told` | learning or not, periods lost, a start anew |
//! | `step` | measurements between two measurement instants |
//! | `stored` | what a snapshot holds |
//! | `triple` | three numbers, one for each axis of a group |
//! | `unwind` | body angles from a later origin |

mod actuators;
mod change;
mod config;
mod delay;
mod design;
mod doubt;
mod estimator;
mod gyroscopic;
mod long_mean;
mod measured;
mod output;
mod readings;
mod reinitialise;
mod replaced;
mod residual;
mod retroactive;
mod state;
mod statistic;
mod step;
mod stored;
#[cfg(test)]
mod tests;
mod told;
mod triple;
mod unwind;

pub use config::{ChangeRule, Expected, GroupConfig, VehicleConfig};
pub use estimator::VehicleEstimator;
pub use measured::{Attitude, Measured, Wrench};
pub use output::{Events, Group, Identified, VehicleCounters, VehicleModel, VehicleState};
