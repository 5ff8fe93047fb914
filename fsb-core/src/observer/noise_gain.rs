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
    const STEPS: f64 = 96.0;

    /// At sample `n` of an observer with `tuning` at `period` (s), every sample measured.
    ///
    /// Exact up to n = 96. Beyond, the last 8/λ are gone through in 96 steps with means of the samples in place of the
    /// samples, which is good to 4 % (of a variance). With q > λ it is the first 8/q, and then the last 24/λ of the time since
    /// in 288 steps: what an open window leaves of the first samples decays with λ alone; good to 8 %. Uses an exponential:
    /// for reports, not for the tick.
    pub fn at_sample(n: u32, tuning: Tuning, period: f64) -> Self {
        let n = f64::from(n);
        let within = |rate: f64| libm::fmin(n, libm::fmax(8.0 / (rate * period), Self::STEPS));
        if tuning.q <= tuning.lambda || n <= Self::STEPS {
            return Self::gone_through(None, n, within(tuning.lambda), Self::STEPS, tuning, period);
        }
        let open = within(tuning.q);
        let opened = Self::gone_through(None, open, open, Self::STEPS, tuning, period);
        let since = libm::fmin(n - open, 3.0 * within(tuning.lambda));
        Self::gone_through(Some(opened), n, since, 3.0 * Self::STEPS, tuning, period)
    }

    /// At sample `n`, `from` what it was so many `samples` before, in so many `steps` at most.
    #[inline(never)]
    fn gone_through(from: Option<Self>, n: f64, samples: f64, steps: f64, tuning: Tuning, period: f64) -> Self {
        let mean = libm::fmax(samples / steps, 1.0);
        let step = mean * period;
        // A window that opens within a step is as good as open.
        let q = libm::fmin(tuning.q, 1.0 / step);
        let design = ObserverDesign::from_decay(&Tuning { q, ..tuning }.decay(Wide::new(step)));
        let begin = (n - samples) * period;
        // Begins at the first sample, or so long ago that it does not matter where.
        let mut window = if begin <= step && from.is_none() { Window::START } else { Window::after(tuning.q * begin) };
        let mut gain = from.map_or(Self::FIRST, |gain| gain.of_means(mean as f32));
        for _ in 0..libm::round(samples / mean) as u32 {
            window.step(&design.window);
            gain.correct(&Gains::at(&window, &design));
        }
        gain.of_means((period / step) as f32)
    }

    /// The same in terms of means over so many samples: of their variance, and of the time from one to the next.
    fn of_means(self, samples: f32) -> Self {
        Self { yy: self.yy * samples, yv: self.yv * samples * samples, vv: self.vv * samples * samples * samples }
    }
}
