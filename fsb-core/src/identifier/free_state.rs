//! The free observer: position and velocity out of the identifier's own states (design, section 6).
//!
//! The identity filtered twice and filtered once are (46) and (48). Solved for the estimates they read, for any k,
//!
//! b1 ŷ = k x5 + c u2 - x2,      (slope) (ŷ[n] - ŷ[n-1]) = k x6 + c u3 - x3 - b2 ŷ/2,
//!
//! so one set of states serves every k, retroactively: when k̂ becomes valid the position and velocity it implies are
//! known at once, without the error that an observer on a wrong k would still have to forget.

use super::block::{BlockDesign, BlockMeans};
use super::cascade::Cascade;
use super::coefficients::Coefficients;
use super::unit::UnitChain;
use crate::observer::Model;

/// Position [relative to the identifier's origin] and velocity at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeState {
    /// Position, in the units of the measurement.
    pub position: f32,
    /// Velocity, in the units of the measurement per second.
    pub velocity: f32,
}

impl FreeState {
    /// The state at the last sample of the block that `cascade` has just taken in, under `model`.
    ///
    /// Valid from the third block on. The result is not finite before the second one, where the window is still zero.
    /// Cost: about 35 operations, 2 of them divisions; meant for the moment when k becomes valid, not for every tick.
    pub fn at_block_end(
        cascade: &Cascade,
        unit: &UnitChain,
        at: &Coefficients,
        block: &BlockMeans,
        design: &BlockDesign,
        model: &Model,
    ) -> Self {
        let Model { k, drift: c } = *model;
        let mean = (k * cascade.x5.value() + c * unit.u2.value() - cascade.x2.value()) / at.b1;
        let step = (k * cascade.x6.value() + c * unit.u3.value() - cascade.x3.value() - 0.5 * at.b2 * mean) / at.slope;
        // Mean over the block → state at its first sample: the blocks' means differ by M T v + k (A[-1] + s[0]).
        let s = block.mean_phi();
        let before = (step - k * (block.a1 + s) - c * design.unit_step) * design.per_duration;
        let velocity = before + k * block.v1 + c * design.duration;
        let position = mean - design.centre * velocity - k * s - c * design.unit_s;
        // First sample → last sample.
        let t = design.span;
        Self {
            position: position + t * velocity + k * block.response.j2 + c * (0.5 * t * t),
            velocity: velocity + k * block.response.j1 + c * t,
        }
    }
}
