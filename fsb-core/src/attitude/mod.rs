//! From a measured attitude to what a rotational axis can take as its position (design, section 10).
//!
//! | file | what |
//! |---|---|
//! | `body_angles` | angles about the body's axes, by summing up the turns between measurements |

mod body_angles;

pub use body_angles::{AttitudeError, BodyAngles};
