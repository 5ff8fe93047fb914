//! ẑv, the windowed and filtered velocity: three stages driven by g₋ (y\[n\] - y\[n-2\])/(2T), without differencing y.
//!
//! Over the two intervals of the identity, with the triangular weight of its second difference, the drag contributes
//! D (∫ y over the later interval - ∫ y over the earlier one); by the trapezoidal rule that is D T² (y\[n\] - y\[n-2\])/(2T).
//! The rule errs by T²/12 y''': the square of (frequency · T)/3.5, 1e-3 of D for 5 rad/s at 50 Hz, which is in the standard deviations
//! of D and k (`reduced`).
//!
//! Writing z⁻¹ = (1 - Δ)/p with Δ = 1 - p z⁻¹ and F = c/Δ for a stage, c = 1 - p,
//!
//! ẑv = F³\[bv3 y\] + F²\[bv2 y\] + F\[bv1 y\],
//! bv1 = -c² G/(2Tp²),   bv2 = 2c G/(2Tp²),   bv3 = -(bv1 + bv2) - (G - g₋)/(2T),
//! G - g₋ = α e \[(1+ρ) h₊ + ((1+ρ)/ρ) h\].
//!
//! No bracket cancels. Once the window is open the last term of bv3 is zero, and the three products with y are made to add
//! up to zero to the last bit: a position that stays leaves nothing in ẑv.

use crate::accumulator::Accumulator;
use crate::error::ConfigError;
use crate::identifier::{IdentifierDesign, KEEP_NORMAL};
use crate::tuning::{Decay, Tuning};
use crate::wide::Wide;
use crate::window::{Window, WindowDesign};

/// Constants of ẑv for a tuning at a period.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VelocityDesign {
    window: WindowDesign,
    /// c = 1 - e^(-λT)
    c: f32,
    bv1: f32,
    bv2: f32,
    opening_next: f32,
    opening: f32,
    scale: f32,
}

impl VelocityDesign {
    /// Constants for `tuning` at `period` (s), to go with an identifier of the same.
    ///
    /// # Errors
    /// As [`IdentifierDesign::new`].
    pub fn new(tuning: Tuning, period: f64) -> Result<Self, ConfigError> {
        let decay = tuning.named(period, &["lambda", "q"])?;
        Ok(Self::from_decay(&decay, f64::from(IdentifierDesign::from_decay(&decay).scale)))
    }

    /// The factor by which ẑv is larger than in physical units; the identifier's.
    pub const fn scale(&self) -> f32 {
        self.scale
    }

    pub(crate) fn from_decay(decay: &Decay, scale: f64) -> Self {
        let [period, c, p, alpha, rho] = [decay.period, decay.c, decay.p, decay.alpha, decay.rho].map(Wide::get);
        let base = scale / (2.0 * period);
        let opening = base * alpha * (1.0 + rho);
        Self {
            window: WindowDesign::new(decay),
            c: c as f32,
            bv1: (-base * c * c / (p * p)) as f32,
            bv2: (2.0 * base * c / (p * p)) as f32,
            opening_next: opening as f32,
            opening: (opening / rho) as f32,
            scale: scale as f32,
        }
    }
}

/// The weights at one sample, shared by every axis with the same tuning.
#[derive(Clone, Copy, Debug, Default)]
pub struct VelocityWeights {
    /// Weight of y in the last stage.
    pub(crate) bv1: f32,
    /// Weight of y in the middle stage.
    pub(crate) bv2: f32,
    /// (G - g₋)/(2T): the weight of y in the first stage is -(bv1 + bv2) less this.
    opening: f32,
}

impl VelocityWeights {
    /// The weights at the window's sample. Cost: 17 operations, no division.
    pub fn at(window: &Window, design: &VelocityDesign) -> Self {
        let w = window.neighbours(&design.window);
        Self {
            bv1: design.bv1 * w.g_after,
            bv2: design.bv2 * w.g_after,
            opening: w.e * (design.opening_next * w.h_next + design.opening * w.h),
        }
    }
}

/// The three stages of one axis.
///
/// Units: m/s or rad/s times the identifier's scale. Numerics: accumulators, as in the other cascades. Cost: 23 operations a
/// step, 9 more to fold.
#[derive(Clone, Copy, Debug, Default)]
pub struct VelocityCascade {
    v1: Accumulator,
    pub(crate) v2: Accumulator,
    pub(crate) v3: Accumulator,
}

impl VelocityCascade {
    /// One step with the position `y` relative to any fixed origin. Every 32 steps or sooner [`fold`](Self::fold) is due.
    #[inline(always)]
    pub fn step(&mut self, y: f32, design: &VelocityDesign, at: &VelocityWeights) {
        let middle = at.bv2 * y;
        let first = middle + at.bv1 * y;
        // bv1 y on the grid of the sum, |bv1| being at most half of bv2: the difference is exact.
        let last = first - middle;
        let c = design.c;
        self.v3.add(c * (KEEP_NORMAL - first - at.opening * y - self.v3.value()));
        self.v2.add(c * (middle + self.v3.value() + KEEP_NORMAL - self.v2.value()));
        self.v1.add(c * (last + self.v2.value() + KEEP_NORMAL - self.v1.value()));
    }

    /// Moves collected steps into totals.
    #[inline(always)]
    pub fn fold(&mut self) {
        self.v1.fold();
        self.v2.fold();
        self.v3.fold();
    }

    /// ẑv, scaled.
    pub const fn zv(&self) -> f32 {
        self.v1.value()
    }
}
