//! The replay beside what else one could do with the same data, and what the model leaves.
//!
//! | file | what |
//! |---|---|
//! | `noise` | the measurement noise of a log |
//! | `kalman` | a two-state Kalman filter, tuned to the log |
//! | `whiteness` | whether what is left is noise |
//! | `velocity` | velocities side by side |

pub mod kalman;
pub mod noise;
pub mod velocity;
pub mod whiteness;
