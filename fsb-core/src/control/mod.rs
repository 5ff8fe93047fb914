//! The certainty-equivalence controller of the paper's section 2.2: (11), (13), (70)-(71).
//!
//! | file | what |
//! |---|---|
//! | `tracking` | one axis: the input that gives the closed loop (12) |
//! | `body_force` | (11): the world-frame force of three axes turned into the body frame |
//! | `vehicle` | all six axes at any attitude: the wrench of a fully actuated vehicle |

mod body_force;
mod tracking;
mod vehicle;

pub use body_force::to_body;
pub use tracking::{ControlError, Reference, TrackingConfig, TrackingController};
pub use vehicle::{Gains, Motion, VehicleControlConfig, VehicleController, VehicleReference};
