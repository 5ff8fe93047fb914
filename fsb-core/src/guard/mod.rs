//! Never fooled by a measurement: an estimator behind a gate.
//!
//! [`Guarded`] has the calls of [`Estimator`](crate::Estimator). Before a measurement reaches it, each axis is asked
//! whether it can be true:
//!
//! * finite and within its physical limit,
//! * no repetition of a sensor that has frozen,
//! * probable: the innovation's step d = r\[n\] - r\[n-1\], in which what a wrong model adds to both cancels, within
//!   d² <= s² V (1 + λTn)² + (floor + A₀ + A₁ m + A₂ n² + 3λT |r\[n-1\]| + 2S + min(A₂ h², 2S))²,
//!
//! V being the mean of d² learned so far, n the measurements not used before, m those of them that did not come at all,
//! A₀ = a T/(eλ) what an acceleration a that the model does not know can add to an innovation from one sample to the next,
//! A₁ = 2a T/λ and A₂ = a T²/2 what it can in a gap, the velocity having been off by 2a/λ when it began, and the next term what
//! an innovation on its way back to zero changes by. S and h are zero for a sensor that never sends a value again. For one that does, a
//! receiver that is slower than the loop or a position that is rounded, h is for how many measurements the value stood still, and S
//! about the largest of the last steps to a value that came again as well: it steps, and does not jump.
//!
//! What is not taken is counted by reason and predicted instead. Improbable measurements in a row that agree with each other
//! are a jump of the sensor's origin: positions are moved by it, and as the plant is translation invariant, velocity and
//! identification go on as if nothing had happened, but for the noise σ of the measurements: the jump is known to 1.6 σ,
//! which stays in the origin and puts the velocity off by 0.6 λσ a time 1/λ later (rms). As many that leave what is predicted
//! on a straight line, four at least, are a push: the velocity has changed at once, which no input explains. The state is put
//! on the line, and the identifier's window begins anew ([`Verdict::Pushed`]). A state that holds what is no number, which
//! only a memory changed from outside can bring about, is counted and begun anew. The estimator itself pays nothing for the
//! gate.
//!
//! | file | what |
//! |---|---|
//! | `config` | plain data, and the same validated |
//! | `course` | measurements that leave what is predicted on a straight line |
//! | `gate` | one axis: its noise level, and whether a measurement can be true |
//! | `guarded` | an estimator behind the gates |
//! | `held` | values that come again |
//! | `stored` | what a snapshot holds |
//! | `verdict` | what became of a measurement |

mod config;
mod course;
mod gate;
mod guarded;
mod held;
mod stored;
#[cfg(test)]
mod tests;
mod verdict;

pub use config::{GuardConfig, GuardDesign};
pub use guarded::Guarded;
pub use verdict::{Rejections, Verdict};
