//! ẑu: the cascade's response to an input of one, for the part of ẑ2 that a known drift explains.

use super::coefficients::{Coefficients, IdentifierDesign};
use crate::accumulator::Accumulator;

/// Three stages driven by g[n-1]. Shared by all axes of a tuning; only needed where some axis has a drift.
#[derive(Clone, Copy, Debug, Default)]
pub struct UnitChain {
    pub(crate) u1: Accumulator,
    pub(crate) u2: Accumulator,
    pub(crate) u3: Accumulator,
}

impl UnitChain {
    /// One step. Cost: 19 operations.
    #[inline(always)]
    pub fn step(&mut self, design: &IdentifierDesign, at: &Coefficients) {
        let c = design.c;
        self.u3.add_folded(c * (at.g - self.u3.value()));
        self.u2.add_folded(c * (self.u3.value() - self.u2.value()));
        self.u1.add_folded(c * (self.u2.value() - self.u1.value()));
    }

    /// ẑu, scaled.
    pub const fn zu(&self) -> f32 {
        self.u1.value()
    }
}
