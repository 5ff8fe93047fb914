//! The weights with which a position enters the three stages of the cascade: w1, w̄2, w̄3 of (39)-(43), sampled.
//!
//! Writing z⁻¹ = (1 - Δ)/p with Δ = 1 - p z⁻¹ in `z⁻²(g[n+1] y) - 2 z⁻¹(g[n] y) + g[n-1] y` gives
//!
//! b1 = (c²/(T²p²)) G,   b2 = -(2c/(T²p²)) h₊ [(1-ρ²) e + c h],
//! b3 = (1/(T²p²)) { [α²(1+ρ)/ρ] e [ρ e - h] + 2c [(1-ρ²)/ρ] h e + c² g₋ },
//!
//! with c = 1 - p, G = g[n+1], g₋ = g[n-1]. No bracket cancels, so f32 suffices at any rate. All three take c²/(T²p²) from
//! one rounded constant: once the window is open they are in the proportion 1 : -2 : 1 exactly, and a position that stays
//! leaves nothing in ẑ2.

use super::cascade::Stage;
use crate::error::ConfigError;
use crate::tuning::{Decay, Tuning, checked_period};
use crate::window::{Window, WindowDesign};

/// Both sides of the identity are carried about 2^20 times larger than in physical units. This keeps the squares of the
/// first windowed samples (g is of the order of (qT)²) in the normal range of f32 and costs nothing: the factor sits in
/// constants. Which factor between 2^20 and 2^21 is free, and chosen so that the constants suffer least from rounding.
const SCALE: f64 = 1_048_576.0;
const SCALE_CHOICES: u32 = 512;

/// Added to the input of every stage that has one, in scaled units: a cascade left without input settles here, instead of
/// decaying through the subnormal numbers. All three stages of the position chain need it: the inputs that a constant
/// position gives them cancel. It is 1e-26 of the physical unit.
pub(crate) const KEEP_NORMAL: f32 = 1e-20;

/// Added to the stages themselves now and then, where it is not added to the inputs. With 32 steps in between and the fastest
/// decay, e^-32, what is left is normal; with the slowest the stages settle at 1e-17.
pub(crate) const KEEP_NORMAL_AT_FOLD: f32 = 1e-23;

/// Constants of an identifier: a tuning at the period at which it is stepped.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct IdentifierDesign {
    pub(crate) window: WindowDesign,
    /// c = 1 - e^(-λT)
    pub(crate) c: f32,
    /// The factor by which both sides are larger than in physical units.
    pub(crate) scale: f32,
    rho: f32,
    b1: f32,
    b2_start: f32,
    b3_start: f32,
    b3_mixed: f32,
    slope: f32,
}

impl IdentifierDesign {
    /// Constants for `tuning` at `period`, in s.
    ///
    /// # Errors
    /// Names `lambda`, `q` or `period` where λT or qT is not within 1e-6..=1 or the period not within 1e-6..=1e3 s.
    pub fn new(tuning: Tuning, period: f64) -> Result<Self, ConfigError> {
        let decay = tuning.decay(checked_period("period", period)?, "lambda", "q")?;
        Ok(Self::from_decay(&decay))
    }

    pub(crate) fn from_decay(decay: &Decay) -> Self {
        let constants = constants(decay);
        let loss = |scale: f64| constants.iter().map(|x| rounding(scale * x)).fold(0.0, libm::fmax);
        let mut best = (loss(SCALE), SCALE);
        for choice in 1..SCALE_CHOICES {
            // Exact in f32.
            let scale = SCALE * (1.0 + f64::from(choice) / f64::from(SCALE_CHOICES));
            let loss = loss(scale);
            if loss < best.0 {
                best = (loss, scale);
            }
        }
        Self::at_scale(decay, best.1)
    }

    pub(crate) fn at_scale(decay: &Decay, scale: f64) -> Self {
        let [b1, b2_start, b3_start, b3_mixed] = constants(decay).map(|x| (scale * x) as f32);
        Self {
            window: WindowDesign::new(decay),
            c: decay.c as f32,
            scale: scale as f32,
            rho: decay.rho as f32,
            b1,
            b2_start,
            b3_start,
            b3_mixed,
            slope: (scale * decay.c / (decay.p * decay.period * decay.period)) as f32,
        }
    }

    /// Moves the window of the weights to the next step.
    pub fn step(&self, window: &mut Window) {
        window.step(&self.window);
    }

    pub(crate) const fn stage(&self) -> Stage {
        Stage { c: self.c }
    }

    /// The square of the scale: by how much sums of products are larger than in physical units.
    pub(crate) const fn scale2(&self) -> f32 {
        self.scale * self.scale
    }
}

/// The constants of b1, and of the parts of b2 and b3 that fade with the window; in physical units.
fn constants(decay: &Decay) -> [f64; 4] {
    let Decay { period, c, p, alpha, rho } = *decay;
    let base = 1.0 / (period * p * (period * p));
    let one_minus_rho2 = alpha * (1.0 + rho);
    [
        base * c * c,
        -2.0 * base * c * one_minus_rho2,
        base * alpha * alpha * (1.0 + rho) / rho,
        2.0 * base * c * one_minus_rho2 / rho,
    ]
}

/// What rounding to f32 takes from `x`, relative to it.
fn rounding(x: f64) -> f64 {
    libm::fabs(f64::from(x as f32) / x - 1.0)
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
    /// g\[n-1\], the weight of S in the input cascade; scaled.
    pub(crate) g: f32,
    /// c p g\[n\]/(T²p²), the weight of y\[n\] - y\[n-1\] in the identity filtered once ([`super::FreeState`]).
    pub(crate) slope: f32,
}

impl Coefficients {
    /// The weights at the window's sample. Cost: 23 operations, no division.
    pub fn at(window: &Window, design: &IdentifierDesign) -> Self {
        let w = window.neighbours(&design.window);
        Self {
            b1: design.b1 * w.g_after,
            b2: w.h_next * (design.b2_start * w.e - 2.0 * design.b1 * w.h),
            b3: design.b3_start * (w.e * (design.rho * w.e - w.h))
                + design.b3_mixed * (w.h * w.e)
                + design.b1 * w.g_before,
            g: design.scale * w.g_before,
            slope: design.slope * (w.h * w.h_next),
        }
    }
}
