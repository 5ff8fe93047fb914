//! From a measured attitude to what a rotational axis can take as its position (design, section 10).
//!
//! | file | what |
//! |---|---|
//! | `body_angles` | angles about the body's axes, by summing up the turns between measurements |
//! | `euler` | the rotation matrix of Euler angles, with the features `euler` or `micromath` |
//! | `rotation` | rotation matrices |

mod body_angles;
#[cfg(any(feature = "euler", feature = "micromath"))]
pub mod euler;
pub(crate) mod rotation;
#[cfg(test)]
mod tests;

pub use body_angles::{AttitudeError, BodyAngles};
