//! How much white measurement noise reaches the observer's estimates.
//!
//! The covariance of the estimation error under unit noise, k being right, obeys P ← (I - L H) P⁻ (I - L H)ᵀ + L Lᵀ,
//! P⁻ = F P Fᵀ; it depends on the tuning alone, so one serves every axis. Steady state:
//! var ŷ = (1-p)(1+4p+5p²)/(1+p)³ σ²,   var v̂ = 2(1-p)³/(1+p)³ σ²/T².

use super::gains::{Gains, ObserverDesign};

/// Covariance of (ŷ, T v̂) for measurement noise of variance one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NoiseGain {
    yy: f32,
    yv: f32,
    vv: f32,
}

impl NoiseGain {
    /// After the first measurement: ŷ = y.
    pub const FIRST: Self = Self { yy: 1.0, yv: 0.0, vv: 0.0 };

    /// Over one period, corrected with the gains of the new sample. Cost: 17 operations.
    #[inline(always)]
    pub fn correct(&mut self, gains: &Gains) {
        self.predict();
        let (m, l1, l2) = (gains.m1, 1.0 - gains.m1, gains.t_l2);
        let (yy, yv) = (self.yy, self.yv);
        self.vv = self.vv - 2.0 * l2 * yv + l2 * l2 * (yy + 1.0);
        self.yv = m * (yv - l2 * yy) + l1 * l2;
        self.yy = m * m * yy + l1 * l1;
    }

    /// Over one period without a measurement.
    #[inline(always)]
    pub fn predict(&mut self) {
        self.yy += 2.0 * self.yv + self.vv;
        self.yv += self.vv;
    }

    /// Variance of ŷ over the variance of the measurement noise.
    pub const fn position(&self) -> f32 {
        self.yy
    }

    /// Variance of v̂ over the variance of the measurement noise [1/s²].
    pub fn velocity(&self, design: &ObserverDesign) -> f32 {
        self.vv / (design.period * design.period)
    }
}
