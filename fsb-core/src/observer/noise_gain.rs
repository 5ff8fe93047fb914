//! How much white measurement noise reaches the observer's estimates.
//!
//! The covariance of the estimation error under unit noise, k being right, obeys P ← (I - L H) P⁻ (I - L H)ᵀ + L Lᵀ,
//! P⁻ = F P Fᵀ; it depends on the tuning alone, so one serves every axis. Steady state:
//! var ŷ = (1-p)(1+4p+5p²)/(1+p)³ σ²,   var v̂ = 2(1-p)³/(1+p)³ σ²/T².

use super::gains::{Gains, ObserverDesign};
use crate::tuning::Tuning;
use crate::wide::Wide;
use crate::window::Window;

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
    pub fn correct(&mut self, gains: &Gains) {
        self.predict();
        let (m, l1, l2) = (gains.m1, 1.0 - gains.m1, gains.t_l2);
        let (yy, yv) = (self.yy, self.yv);
        self.vv = self.vv - 2.0 * l2 * yv + l2 * l2 * (yy + 1.0);
        self.yv = m * (yv - l2 * yy) + l1 * l2;
        self.yy = m * m * yy + l1 * l1;
    }

    /// Over one period without a measurement.
    pub fn predict(&mut self) {
        self.yy += 2.0 * self.yv + self.vv;
        self.yv += self.vv;
    }

    /// Variance of ŷ over the variance of the measurement noise.
    pub const fn position(&self) -> f32 {
        self.yy
    }

    /// The same `missed` periods later, nothing having been measured since.
    pub fn position_after(&self, missed: u16) -> f32 {
        let n = f32::from(missed);
        self.yy + n * (2.0 * self.yv + n * self.vv)
    }

    /// Variance of v̂ over the variance of the measurement noise, in 1/s².
    pub fn velocity(&self, design: &ObserverDesign) -> f32 {
        self.vv * (design.per_period * design.per_period)
    }

    /// Steps of [`at_sample`](Self::at_sample).
    const STEPS: u32 = 96;

    /// At sample `n` of an observer with `tuning` at `period` (s), every sample measured.
    ///
    /// Exact up to n = 96. Beyond, the last 8/λ are gone through in 96 steps with means of the samples in place of the
    /// samples, which is good to 3 % (of a variance). Uses an exponential: for reports, not for the tick.
    pub fn at_sample(n: u32, tuning: Tuning, period: f64) -> Self {
        let samples = if n <= Self::STEPS {
            1.0
        } else {
            libm::fmin(f64::from(n) / f64::from(Self::STEPS), 8.0 / (tuning.lambda * period * f64::from(Self::STEPS)))
        };
        let step = libm::fmax(samples, 1.0) * period;
        let design = ObserverDesign::from_decay(&tuning.decay(Wide::new(step)));
        let steps = n.min(Self::STEPS);
        let begin = f64::from(n) * period - f64::from(steps) * step;
        // Begins at the first sample, or so long ago that it does not matter where.
        let mut window = if begin <= step { Window::START } else { Window::after(tuning.q * begin) };
        let mut gain = Self::FIRST;
        for _ in 0..steps {
            window.step(&design.window);
            gain.correct(&Gains::at(&window, &design));
        }
        let per_mean = (period / step) as f32;
        Self { yy: gain.yy * per_mean, yv: gain.yv * per_mean * per_mean, vv: gain.vv * per_mean * per_mean * per_mean }
    }
}
