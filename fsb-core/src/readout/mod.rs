//! Reading k out of ẑ2 - c ẑu = k ẑ0: the quotient, how sure it is, and whether it may be used (design, section 5).
//!
//! | file | what |
//! |---|---|
//! | `ratio` | least squares and the paper's absolute ratio (44), with infinite or fading memory |
//! | `covariance` | how white measurement noise reaches the quotient |
//! | `noise_level` | the variance of the measurement noise, learned from the data |
//! | `parameter` | k with its variance, and the rule by which it becomes valid |
//! | `status` | whether it may be used, and why not |

mod covariance;
mod noise_level;
mod parameter;
mod ratio;
mod status;
#[cfg(test)]
mod tests;

pub(crate) use covariance::CovarianceDesign;
pub use covariance::{NoiseCross, NoiseShape};
pub use noise_level::NoiseLevel;
pub(crate) use noise_level::innovation_step_gain;
pub(crate) use parameter::{CheckedRule, CoarseStep, ParameterState};
pub use parameter::{Parameter, ParameterRule};
pub(crate) use ratio::weight;
pub use ratio::{Memory, Ratio, Readout};
pub use status::ParameterStatus;
