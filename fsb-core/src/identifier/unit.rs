//! ẑu: the cascade's response to an input of one, for the part of ẑ2 that a known drift explains.

use super::coefficients::{Coefficients, IdentifierDesign};
use crate::compensated::CompensatedSum;

/// Three stages driven by g[n-1]. Shared by all axes of a tuning; only needed where some axis has a drift.
#[derive(Clone, Copy, Debug, Default)]
pub struct UnitChain {
    pub(crate) u1: CompensatedSum,
    pub(crate) u2: CompensatedSum,
    pub(crate) u3: CompensatedSum,
}

impl UnitChain {
    /// One step. Cost: 19 operations.
    #[inline(always)]
    pub fn step(&mut self, design: &IdentifierDesign, at: &Coefficients) {
        let c = design.c;
        self.u3.add(c * (at.g * design.scale - self.u3.value()));
        self.u2.add(c * (self.u3.value() - self.u2.value()));
        self.u1.add(c * (self.u2.value() - self.u1.value()));
    }

    /// ẑu, scaled.
    pub const fn zu(&self) -> f32 {
        self.u1.value()
    }
}
