//! The observer by algebraic derivatives (ADB), (66)-(67), the paper's object of comparison.
//!
//! x1' = 2 y - k t² f - c t²,    x2' = x1 - 4 t y;    ŷ = -x2/t²,    ŷ' = 2 ŷ/t - x1/t²
//!
//! Not BIBO stable: on a constant y the states grow as t and t², on a constant f as t³ and t⁴, (68)-(69).

use super::estimator::{ConfigError, positive};
use super::rk4::{ThroughStep, rk4};

/// One axis. States start at zero, at t = 0.
#[derive(Clone, Copy, Debug)]
pub struct AdbObserver {
    k: f64,
    drift: f64,
    t: f64,
    states: [f64; 2],
}

impl AdbObserver {
    /// `k` is the parameter to start with, `drift` is c [m/s²].
    pub const fn new(k: f64, drift: f64) -> Self {
        Self { k, drift, t: 0.0, states: [0.0; 2] }
    }

    /// Uses `k` from the next step on.
    pub const fn set_k(&mut self, k: f64) {
        self.k = k;
    }

    /// Integrates from `t` to `t + dt` [s], y and f given at the start, middle and end.
    pub fn step(&mut self, t: f64, dt: f64, y: &ThroughStep, f: &ThroughStep) {
        let (k, drift) = (self.k, self.drift);
        self.states = rk4(&self.states, dt, |i, x| {
            let at = t + dt * i as f64 / 2.0;
            [2.0 * y[i] - at * at * (k * f[i] + drift), x[0] - 4.0 * at * y[i]]
        });
        self.t = t + dt;
    }

    /// x1 [m s], x2 [m s²]: the states of (66), as in Fig. 9.
    pub const fn states(&self) -> [f64; 2] {
        self.states
    }

    /// (67): ŷ = -x2/t² [m]. `None` at t = 0.
    pub fn position(&self) -> Option<f64> {
        (self.t > 0.0).then(|| -self.states[1] / (self.t * self.t))
    }

    /// (67): ŷ' = 2 ŷ/t - x1/t² [m/s]. `None` at t = 0.
    pub fn velocity(&self) -> Option<f64> {
        self.position().map(|position| 2.0 * position / self.t - self.states[0] / (self.t * self.t))
    }
}

/// How an [`AdbEstimator`] runs on sampled data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdbConfig {
    /// T [s], positive.
    pub period: f64,
    /// Runge-Kutta steps per period, at least 1.
    pub substeps: u32,
    /// No estimate before this time [s].
    pub epsilon: f64,
    /// The parameter to start with.
    pub k0: f64,
    /// c [m/s²].
    pub drift: f64,
}

/// The ADB observer on samples: y is the chord of its samples, f is held.
#[derive(Clone, Copy, Debug)]
pub struct AdbEstimator {
    config: AdbConfig,
    observer: AdbObserver,
    samples: u64,
    y_before: f64,
}

impl AdbEstimator {
    /// At rest before the first sample, which is t = 0.
    ///
    /// # Errors
    /// Names `period`, `substeps` or `epsilon` when it is not positive.
    pub fn new(config: AdbConfig) -> Result<Self, ConfigError> {
        positive("period", config.period)?;
        positive("substeps", f64::from(config.substeps))?;
        positive("epsilon", config.epsilon)?;
        let observer = AdbObserver::new(config.k0, config.drift);
        Ok(Self { config, observer, samples: 0, y_before: 0.0 })
    }

    /// Uses `k` from the next sample on.
    pub const fn set_k(&mut self, k: f64) {
        self.observer.set_k(k);
    }

    /// Takes the sample `y` [m]; `f_held_before` [N] acted since the sample before (ignored with the first).
    pub fn update(&mut self, y: f64, f_held_before: f64) {
        if self.samples > 0 {
            let start = (self.samples - 1) as f64 * self.config.period;
            let parts = f64::from(self.config.substeps);
            let dt = self.config.period / parts;
            for part in 0..self.config.substeps {
                let chord = chord(self.y_before, y, f64::from(part) / parts, 1.0 / parts);
                self.observer.step(start + f64::from(part) * dt, dt, &chord, &[f_held_before; 3]);
            }
        }
        self.y_before = y;
        self.samples += 1;
    }

    /// x1, x2 of (66).
    pub const fn states(&self) -> [f64; 2] {
        self.observer.states()
    }

    /// ŷ [m], `None` before ε.
    pub fn position(&self) -> Option<f64> {
        self.is_on().then(|| self.observer.position()).flatten()
    }

    /// ŷ' [m/s], `None` before ε.
    pub fn velocity(&self) -> Option<f64> {
        self.is_on().then(|| self.observer.velocity()).flatten()
    }

    fn is_on(&self) -> bool {
        reached(self.samples, self.config.period, self.config.epsilon)
    }
}

/// The chord from `from` to `to` at the parts `start`, `start + length/2` and `start + length` of the period.
pub(super) fn chord(from: f64, to: f64, start: f64, length: f64) -> ThroughStep {
    [0.0, 0.5, 1.0].map(|part| from + (to - from) * (start + part * length))
}

/// Whether the newest of `samples` samples lies at or after `epsilon`, rounding of n T apart.
pub(super) fn reached(samples: u64, period: f64, epsilon: f64) -> bool {
    samples > 0 && (samples - 1) as f64 * period >= epsilon - 1e-6 * period
}

#[cfg(test)]
mod tests {
    use super::{AdbConfig, AdbEstimator, AdbObserver};

    /// Exact on an analytic motion, gravity included.
    #[test]
    fn is_exact_on_an_analytic_motion() {
        let (k, drift, dt) = (2.0, -9.81, 1e-3);
        let mut observer = AdbObserver::new(k, drift);
        for n in 0..3000 {
            let t = f64::from(n) * dt;
            let at = [t, t + dt / 2.0, t + dt];
            let y = at.map(|t| 3.0 - 1.5 * t + (2.0 * t).sin());
            let f = at.map(|t| (-4.0 * (2.0 * t).sin() - drift) / k);
            observer.step(t, dt, &y, &f);
        }
        assert!((observer.position().unwrap() - (3.0 - 4.5 + 6f64.sin())).abs() < 1e-6);
        assert!((observer.velocity().unwrap() - (-1.5 + 2.0 * 6f64.cos())).abs() < 1e-6);
    }

    /// On samples of free fall: the chord of a parabola is off by T²/8 g at most.
    #[test]
    fn runs_on_samples_and_waits_for_epsilon() {
        let config = AdbConfig { period: 1e-3, substeps: 1, epsilon: 0.1, k0: 1.0, drift: -9.81 };
        let mut estimator = AdbEstimator::new(config).unwrap();
        for n in 0..=500 {
            let t = f64::from(n) * 1e-3;
            estimator.update(4.0 - 9.81 / 2.0 * t * t, 0.0);
            assert_eq!(estimator.position().is_some(), n >= 100, "sample {n}");
        }
        assert!((estimator.position().unwrap() - (4.0 - 9.81 / 8.0)).abs() < 1e-5);
        assert!((estimator.velocity().unwrap() + 9.81 / 2.0).abs() < 1e-4);
    }
}
