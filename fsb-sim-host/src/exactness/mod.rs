//! How exact the f32 core is: noise-free flights of exact plants, on every way of sampling that there is.
//!
//! The plants are held against gravity 3 m away from the origin and swing by a metre or two; positions and forces reach the
//! core rounded to f32, which is all the noise there is. λ = 2, q = 1, observer λ = 10, q = 5.
//!
//! | file | what |
//! |---|---|
//! | `case` | the ways of sampling |
//! | `deviation` | largest and rms error |
//! | `flight` | one case flown |

// Units stand in brackets; they are no links.
#![allow(rustdoc::broken_intra_doc_links)]

mod case;
mod deviation;
mod flight;

pub use case::{CASES, Case};
pub use deviation::Deviation;
pub use flight::{Exactness, fly};

/// Length of each flight [s].
pub const SECONDS: f64 = 10.0;
/// Errors of k, of the position, and of a velocity predicted with the true k count from here on [s].
pub const FROM: f64 = 0.1;
/// Errors of a velocity predicted with the identified k count from here on [s]: before, the same few rounded positions
/// cannot tell both k and the velocity that well.
pub const SETTLED: f64 = 0.5;

/// Largest error of k̂ over k from [`FROM`] on.
pub const K_LIMIT: f64 = 5e-6;
/// The same from 1 s on.
pub const K_LIMIT_LATE: f64 = 1e-6;
/// Largest error of a position [m].
pub const POSITION_LIMIT: f64 = 5e-7;
/// Largest error of a velocity [m/s].
pub const VELOCITY_LIMIT: f64 = 2e-6;
