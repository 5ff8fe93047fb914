//! The free observer: position and velocity out of the identifier's own states (design, section 6).
//!
//! The identity filtered twice and filtered once are (46) and (48). Solved for the estimates they read, for any k,
//!
//! b1 ŷ = k x5 + c u2 - x2,      (slope) (ŷ\[n\] - ŷ\[n-1\]) = k x6 + c u3 - x3 - b2 ŷ/2,
//!
//! so one set of states serves every k, retroactively: when k̂ becomes valid the position and velocity it implies are
//! known at once, without the error that an observer on a wrong k would still have to forget.

use super::block::{BlockDesign, BlockMeans};
use super::cascade::Cascade;
use super::coefficients::Coefficients;
use super::unit::UnitChain;
use crate::moments::InputMoments;

/// Position and velocity at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeState {
    /// Position relative to the identifier's origin, in the unit of the measurement.
    pub position: f32,
    /// T v̂, what the velocity makes of a sampling period.
    pub t_velocity: f32,
}

/// k and c of (15), as such and as the acceleration over a sampling period: k T², c T².
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hypothesis {
    pub k: f32,
    pub c: f32,
    pub k_t2: f32,
    pub c_t2: f32,
}

/// A block just completed, as the identifier left it.
#[derive(Clone, Copy)]
pub(crate) struct Completed<'a> {
    pub cascade: &'a Cascade,
    pub unit: &'a UnitChain,
    pub at: &'a Coefficients,
    pub block: &'a BlockMeans,
    /// The interval that ended with the block's last sample.
    pub moments: InputMoments,
}

impl FreeState {
    /// The state at the last sample of a block of `length` samples that has just gone through the cascade.
    ///
    /// Valid from the third block on; not finite before the second one, where the window is still zero.
    /// Cost: about 35 operations, 2 of them divisions; meant for the moment when k becomes valid, not for every tick.
    pub(crate) fn at_block_end(block: &Completed<'_>, design: &BlockDesign, length: u32, by: &Hypothesis) -> Self {
        let Completed { cascade, unit, at, .. } = *block;
        let mean = (by.k * cascade.x5.value() + by.c * unit.u2.value() - cascade.x2.value()) / at.b1;
        let step =
            (by.k * cascade.x6.value() + by.c * unit.u3.value() - cascade.x3.value() - 0.5 * at.b2 * mean) / at.slope;
        // The means of two blocks differ by M w + k (A[-1] + s[0]), w being T v at the first sample of the earlier one; the
        // velocity at the first sample of the later one is M (w + k V[-1]).
        let past = block.block.past(length, block.moments);
        let w =
            (step - by.k_t2 * (past.past + past.s) - by.c_t2 * (design.unit_past + design.unit_s)) * design.per_length;
        let first = mean - design.centre * w - by.k_t2 * past.s - by.c_t2 * design.unit_s;
        let t = design.span;
        Self {
            position: first + t * w + by.k_t2 * past.phi + by.c_t2 * (0.5 * t * t),
            t_velocity: w + by.k_t2 * past.psi + by.c_t2 * t,
        }
    }
}
