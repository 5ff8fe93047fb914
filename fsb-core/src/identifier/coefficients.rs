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
use crate::tuning::{Decay, Tuning};
use crate::wide::Wide;
use crate::window::{Window, WindowDesign};
use core::hint::black_box;

/// Both sides of the identity are carried about 2^20 times larger than in physical units. This keeps the squares of the
/// first windowed samples (g is of the order of (qT)²) in the normal range of f32 and costs nothing: the factor sits in
/// constants. Which factor between 2^20 and 2^21 is free, and chosen so that the constants suffer least from rounding.
const SCALE: Wide = Wide::new(1_048_576.0);
/// From one choice to the next, relative to the smallest; exact in f32.
const SCALE_STEP: Wide = Wide::new(1.0 / 512.0);

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
    pub(crate) const BLANK: Self = Self {
        window: WindowDesign::BLANK,
        c: 0.0,
        scale: 0.0,
        rho: 0.0,
        b1: 0.0,
        b2_start: 0.0,
        b3_start: 0.0,
        b3_mixed: 0.0,
        slope: 0.0,
    };

    /// Constants for `tuning` at `period`, in s.
    ///
    /// # Errors
    /// Names `lambda`, `q` or `period` where λT or qT is not within 1e-6..=1 or the period not within 1e-6..=1e3 s.
    pub fn new(tuning: Tuning, period: f64) -> Result<Self, ConfigError> {
        Ok(Self::from_decay(&tuning.named(period, &["lambda", "q"])?))
    }

    #[inline(never)]
    pub(crate) fn from_decay(decay: &Decay) -> Self {
        let Constants { weights, .. } = constants(decay, SCALE);
        let (mut least, mut best) = (f32::INFINITY, Wide::ONE);
        let mut factor = Wide::ONE;
        while factor.bits() < 2_f64.to_bits() {
            let loss = loss(&weights, factor);
            if loss < least {
                (least, best) = (loss, factor);
            }
            factor = factor + SCALE_STEP;
        }
        Self::at_scale(decay, SCALE * best)
    }

    #[inline(never)]
    pub(crate) fn at_scale(decay: &Decay, scale: Wide) -> Self {
        let Constants { weights: [b1, half_b2, b3_start, half_b3], slope } = constants(decay, scale);
        Self {
            window: WindowDesign::new(decay),
            c: decay.c.rounded(),
            scale: scale.rounded(),
            rho: decay.rho.rounded(),
            b1: b1.rounded(),
            b2_start: -2.0 * half_b2.rounded(),
            b3_start: b3_start.rounded(),
            b3_mixed: 2.0 * half_b3.rounded(),
            slope: slope.rounded(),
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

/// `scale` times the constants of b1, and of the parts of b2 and b3 that fade with the window, without their factors of two;
/// and of the slope.
struct Constants {
    weights: [Wide; 4],
    slope: Wide,
}

#[inline(never)]
fn constants(decay: &Decay, scale: Wide) -> Constants {
    let Decay { period, c, p, alpha, rho, mixed } = *decay;
    let tp = period * p;
    let base = scale.over(tp * tp);
    let base_c = base * c;
    let half_b3 = base_c * mixed;
    Constants { weights: [base_c * c, half_b3 * rho, base * alpha * mixed, half_b3], slope: base_c * p }
}

/// The most that rounding to f32 takes from one of the positive `weights` times `factor`, over itself: of its 53 bits the last
/// 29; in units of 2^-32.
#[inline(never)]
fn loss(weights: &[Wide; 4], factor: Wide) -> f32 {
    let mut most = 0.0;
    // The compiler is not to write this out four times.
    for weight in black_box(weights.as_slice()) {
        let bits = (factor * *weight).bits();
        let last = (bits << 3) as i32;
        let first = (bits >> 32) as u32 & 0x000f_ffff | 0x0010_0000;
        let lost = last.unsigned_abs() as f32 / first as f32;
        most = if lost > most { lost } else { most };
    }
    most
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
