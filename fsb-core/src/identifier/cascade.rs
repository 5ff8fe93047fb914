//! The six states of (38), one axis.

use super::coefficients::{Coefficients, IdentifierDesign, KEEP_NORMAL_AT_FOLD};
use crate::accumulator::Accumulator;

/// x1..x3 (position) and x4..x6 (input) of (38): two chains of three unit-gain low-pass stages `x += c (u - x)`.
///
/// Units: those of y'' for ẑ2 and those of f for ẑ0, times the design's scale.
/// Numerics: every stage is an accumulator, or it would stall up to ulp/(2c) from its input.
/// Cost: 33 operations a step, 22 more to fold.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cascade {
    pub(crate) x1: Accumulator,
    pub(crate) x2: Accumulator,
    pub(crate) x3: Accumulator,
    pub(crate) x4: Accumulator,
    pub(crate) x5: Accumulator,
    pub(crate) x6: Accumulator,
}

/// What a stage needs of an [`IdentifierDesign`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stage {
    /// c = 1 - e^(-λT)
    pub c: f32,
}

impl Cascade {
    /// One step with the position `y` (relative to any fixed origin) and the input term `s` = S/T² of the identity.
    /// Every 32 steps or sooner [`fold`](Self::fold) is due.
    #[inline(always)]
    pub fn step(&mut self, y: f32, s: f32, design: &IdentifierDesign, at: &Coefficients) {
        self.step_at(y, s, &design.stage(), at);
    }

    #[inline(always)]
    pub(crate) fn step_at(&mut self, y: f32, s: f32, stage: &Stage, at: &Coefficients) {
        let c = stage.c;
        self.x3.add(c * (at.b3 * y - self.x3.value()));
        self.x2.add(c * (at.b2 * y + self.x3.value() - self.x2.value()));
        self.x1.add(c * (at.b1 * y + self.x2.value() - self.x1.value()));
        self.x6.add(c * (at.g * s - self.x6.value()));
        self.x5.add(c * (self.x6.value() - self.x5.value()));
        self.x4.add(c * (self.x5.value() - self.x4.value()));
    }

    /// [`step`](Self::step) and [`fold`](Self::fold) in one. Every 32 steps or sooner [`keep_normal`](Self::keep_normal) is due.
    #[inline(always)]
    pub fn step_folded(&mut self, y: f32, s: f32, design: &IdentifierDesign, at: &Coefficients) {
        let c = design.c;
        self.x3.add_folded(c * (at.b3 * y - self.x3.total()));
        self.x2.add_folded(c * (at.b2 * y + self.x3.total() - self.x2.total()));
        self.x1.add_folded(c * (at.b1 * y + self.x2.total() - self.x1.total()));
        self.x6.add_folded(c * (at.g * s - self.x6.total()));
        self.x5.add_folded(c * (self.x6.total() - self.x5.total()));
        self.x4.add_folded(c * (self.x5.total() - self.x4.total()));
    }

    /// Moves collected steps into totals, and keeps them normal.
    #[inline(always)]
    pub fn fold(&mut self) {
        self.keep_normal();
        self.x1.fold();
        self.x2.fold();
        self.x3.fold();
        self.x4.fold();
        self.x5.fold();
        self.x6.fold();
    }

    /// Keeps stages that are left without input from ending among the subnormal numbers; [`fold`](Self::fold) does so as well.
    /// Cost: 4 operations.
    #[inline(always)]
    pub fn keep_normal(&mut self) {
        for stage in [&mut self.x1, &mut self.x2, &mut self.x3, &mut self.x6] {
            stage.add(KEEP_NORMAL_AT_FOLD);
        }
    }

    /// ẑ2, the windowed and filtered acceleration, scaled; a known drift is still in it.
    pub const fn z2(&self) -> f32 {
        self.x1.value()
    }

    /// ẑ0, the windowed and filtered input, scaled.
    pub const fn z0(&self) -> f32 {
        self.x4.value()
    }
}
