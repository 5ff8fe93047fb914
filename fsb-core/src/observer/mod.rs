//! The observer: the paper's section 4.1 in sampled time (design, section 6), as a predictor-corrector.
//!
//! | file | what |
//! |---|---|
//! | `gains` | the gains that carry the window, shared by every axis with the same tuning |
//! | `axis` | one axis: innovation form, predict and correct |
//! | `noise_gain` | how much measurement noise reaches the estimates |

mod axis;
mod gains;
mod noise_gain;
#[cfg(test)]
mod tests;

pub use axis::{Model, Observer};
pub use gains::{Gains, ObserverDesign};
pub use noise_gain::NoiseGain;
