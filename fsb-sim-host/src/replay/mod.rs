//! Replay of a recorded flight through the f32 core.
//!
//! An axis log is taken as it is. Two files of different rates (`pair`) and a ULog (`ulog`) become a `flight` first, each thing
//! at its own time stamps, and from there an axis log whose inputs have exact moments.
//!
//! The translational axes present (x, y, z) are pooled into one parameter, 1/m, with gravity as the known drift of z; each
//! rotational axis present (roll, pitch, yaw) has its own, 1/I. Row n of the log is one call of
//! [`measure`](fsb_core::Estimator::measure) with the positions, then one of [`apply`](fsb_core::Estimator::apply) with the
//! input, which the log gives as its mean over [t_n, t_(n+1)): the input moment J1 is exact, J2 as good as a held input is.
//! Positions and inputs are rounded to f32 as they are, as a flight controller would see them.
//!
//! | file | what |
//! |---|---|
//! | `log` | the axis log and its reader |
//! | `layout` | in which characters a file is written, and what stands between its fields |
//! | `lines` | the line of a file that a row begins on |
//! | `flight` | positions, attitudes and inputs at time stamps of their own, brought to the core |
//! | `pair` | two CSV files as a flight |
//! | `ulog` | a ULog file as a flight |
//! | `recording` | any of them, ready for the core |
//! | `lag`, `fit` | the time offset of the input, by a regression in f64 |
//! | `convention` | whether positions, attitude and force speak of the same directions |
//! | `options` | what can be set, and the core's configuration that follows |
//! | `feed` | a group of axes through one estimator, sample by sample |
//! | `identified`, `informed` | the same with drag and disturbance, on the way and with what the whole flight tells |
//! | `result` | the whole replay, and what came out |
//! | `summary` | the same as one JSON object |
//! | `overview` | the same as a table |
//! | `estimates` | the same sample by sample, as CSV |
//! | `figures`, `figures_left`, `page` | the same to look at |
//! | `compare` | beside what else one could do with the same data |
//! | `error` | why a replay was refused |

pub mod compare;
mod convention;
pub mod error;
pub mod estimates;
mod feed;
mod figures;
mod figures_left;
pub mod fit;
pub mod flight;
pub mod identified;
mod informed;
pub mod lag;
mod layout;
mod lines;
pub mod log;
pub mod options;
pub mod overview;
pub mod page;
pub mod pair;
pub mod recording;
pub mod result;
pub mod summary;
pub mod ulog;

pub use error::ReplayError;
pub use feed::{AxisTrace, ParameterTrace, Watch};
pub use identified::Identified;
pub use log::AxisLog;
pub use options::ReplayOptions;
pub use recording::Recording;
pub use result::{AxisResult, ReplayResult, passes, run, run_watched};
