//! The estimator: N axes that share their tunings, and P parameters read out of them.
//!
//! `P = 1` pools all axes into one parameter (1/m from x, y and z); `P = N` gives each axis its own (1/Ix, 1/Iy, 1/Iz).
//!
//! | file | what |
//! |---|---|
//! | `config` | plain data |
//! | `design` | the same, validated and turned into constants |
//! | `axis` | the state of one axis and its step |
//! | `shared` | the state that depends on time alone: windows, gains, covariance |
//! | `output` | what is handed out |

mod axis;
mod config;
mod design;
mod output;
mod shared;
mod step;

pub use config::EstimatorConfig;
pub use design::EstimatorDesign;
pub use output::{AxisDiagnostics, AxisState, Counters, OutOfStep, StateStatus};
pub use step::Estimator;
