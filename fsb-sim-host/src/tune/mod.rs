//! λ, q and ε from what a user knows and wants: the noise of the sensor, its rate, and how good a velocity and k are to be.
//!
//! The formulas, and where they come from, stand in `docs/tuning.md`.
//!
//! | file | what |
//! |---|---|
//! | `observer` | noise, bandwidth and delay of the observer at a λ, and the λ that gives them |
//! | `opening` | how the velocity's noise falls after the first measurement |
//! | `identifier` | how the standard deviation of k falls |
//! | `proposal` | what is proposed |
//! | `from_log` | noise and rate of a log |
//! | `page` | the trade-offs drawn |

pub mod from_log;
pub mod identifier;
pub mod observer;
pub mod opening;
pub mod page;
pub mod proposal;

pub use proposal::{Proposal, TuneError, Wish, propose};

/// A position sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Standard deviation of a measurement \[m or rad\].
    pub noise_sd: f64,
    /// T, from one measurement to the next \[s\].
    pub period: f64,
}

impl Sensor {
    /// λ that the core accepts \[1/s\].
    pub fn lambdas(&self) -> (f64, f64) {
        (1e-6 / self.period, 1.0 / self.period)
    }
}
