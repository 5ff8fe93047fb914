//! The identifier: the paper's section 3.2 in sampled time (design, sections 2-4 and 11).
//!
//! Model (15) with a known drift c: `y'' = k f(t) + c`. Over the samples, exactly,
//!
//! `y[n] - 2 y[n-1] + y[n-2] = k S[n] + c T²`.
//!
//! Windowed by g[n-1] and filtered three times by `λ/(s + λ)` both sides stay equal, and because g vanishes where the
//! initial conditions enter, no trace of y(0) and y'(0) is left:
//!
//! `ẑ2 - c ẑu = k ẑ0`.
//!
//! | file | what |
//! |---|---|
//! | `coefficients` | the input weights b1, b2, b3 of (39)-(43) at sample n |
//! | `cascade` | the six states (38) of one axis |
//! | `unit` | the response ẑu to a unit input, for the known drift |
//! | `block` | the same identity for means over M samples |
//! | `gap` | how long gaps in the measurements may be |
//! | `free_state` | position and velocity out of the identifier's own states |

mod block;
mod cascade;
mod coefficients;
mod free_state;
mod gap;
#[cfg(test)]
mod tests;
mod unit;

pub use block::{BlockDesign, BlockMean, BlockMeans};
pub use cascade::Cascade;
pub(crate) use cascade::Stage;
pub(crate) use coefficients::KEEP_NORMAL;
pub use coefficients::{Coefficients, IdentifierDesign};
pub use free_state::FreeState;
pub(crate) use free_state::{Completed, Hypothesis};
pub(crate) use gap::longest_gap;
pub use unit::UnitChain;
