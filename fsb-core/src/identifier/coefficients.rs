//! The weights with which a position enters the three stages of the cascade: w1, w̄2, w̄3 of (39)-(43), sampled.
//!
//! Writing z⁻¹ = (1 - Δ)/p with Δ = 1 - p z⁻¹ in `z⁻²(g[n+1] y) - 2 z⁻¹(g[n] y) + g[n-1] y` gives
//!
//! b1 = (c²/(T²p²)) G,   b2 = -(2c/(T²p²)) h₊ [(1-ρ²) e + c h],
//! b3 = (1/(T²p²)) { [α²(1+ρ)/ρ] e [(1+ρ) e - 1] + 2c [(1-ρ²)/ρ] h e + c² g₋ },
//!
//! with c = 1 - p, G = g[n+1], g₋ = g[n-1]. No bracket cancels, so f32 suffices at any rate.

use crate::error::ConfigError;
use crate::tuning::{Decay, Tuning, checked_period};
use crate::window::{Window, WindowDesign};

/// Both sides of the identity are carried 2^20 times larger than in physical units. This keeps the squares of the first
/// windowed samples (g is of the order of (qT)²) in the normal range of f32 and costs nothing: the factor sits in constants.
pub const SCALE: f32 = 1_048_576.0;

/// Added to the input of each cascade, in scaled units: a cascade left without input settles here, instead of decaying
/// through the subnormal numbers. It is 1e-26 of the physical unit.
pub(crate) const KEEP_NORMAL: f32 = 1e-20;

/// Constants of an identifier: a tuning at the period at which it is stepped.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct IdentifierDesign {
    pub(crate) window: WindowDesign,
    /// c = 1 - e^(-λT)
    pub(crate) c: f32,
    /// scale/T²
    pub(crate) per_period2: f32,
    one_minus_rho2: f32,
    one_plus_rho: f32,
    b1: f32,
    b2: f32,
    b3_start: f32,
    b3_mixed: f32,
    slope: f32,
}

impl IdentifierDesign {
    /// Constants for `tuning` at `period` [s], in scaled units ([`SCALE`]).
    ///
    /// # Errors
    /// Names `lambda`, `q` or `period` where λT or qT is not within 1e-6..=1 or the period not within 1e-6..=1e3 s.
    pub fn new(tuning: Tuning, period: f64) -> Result<Self, ConfigError> {
        let decay = tuning.decay(checked_period("period", period)?, "lambda", "q")?;
        Ok(Self::from_decay(&decay, f64::from(SCALE)))
    }

    pub(crate) fn from_decay(decay: &Decay, scale: f64) -> Self {
        let Decay { period, c, p, alpha, rho } = *decay;
        let per_period2 = scale / (period * period);
        let base = per_period2 / (p * p);
        let one_minus_rho2 = alpha * (1.0 + rho);
        Self {
            window: WindowDesign::new(decay),
            c: c as f32,
            per_period2: per_period2 as f32,
            one_minus_rho2: one_minus_rho2 as f32,
            one_plus_rho: (1.0 + rho) as f32,
            b1: (base * c * c) as f32,
            b2: (-2.0 * base * c) as f32,
            b3_start: (base * alpha * alpha * (1.0 + rho) / rho) as f32,
            b3_mixed: (2.0 * base * c * one_minus_rho2 / rho) as f32,
            slope: (base * c * p) as f32,
        }
    }
}

/// The weights at one sample, shared by every axis with the same tuning.
#[derive(Clone, Copy, Debug, Default)]
pub struct Coefficients {
    /// Weight of y in the last stage; w1 of (39).
    pub(crate) b1: f32,
    /// Weight of y in the middle stage; w̄2 of (40).
    pub(crate) b2: f32,
    /// Weight of y in the first stage; w̄3 of (41).
    pub(crate) b3: f32,
    /// g[n-1], the weight of S in the input cascade.
    pub(crate) g: f32,
    /// c p g[n]/(T²p²), the weight of y[n] - y[n-1] in the identity filtered once ([`super::FreeState`]).
    pub(crate) slope: f32,
}

impl Coefficients {
    /// The weights at the window's sample. Cost: 22 operations, no division.
    pub fn at(window: &Window, design: &IdentifierDesign) -> Self {
        let w = window.neighbours(&design.window);
        Self {
            b1: design.b1 * w.g_after,
            b2: design.b2 * (w.h_next * (design.one_minus_rho2 * w.e + design.c * w.h)),
            b3: design.b3_start * (w.e * (design.one_plus_rho * w.e - 1.0))
                + design.b3_mixed * (w.h * w.e)
                + design.b1 * w.g_before,
            g: w.g_before,
            slope: design.slope * (w.h * w.h_next),
        }
    }
}
