//! Section V as data.

use fsb_core::estimator::EstimatorConfig;
use fsb_core::readout::ParameterRule;
use fsb_core::tuning::Tuning;
use fsb_core::{ConfigError, EstimatorDesign};
use thiserror::Error;

use super::trajectory::reference;
use crate::paper_form::PaperConfig;

/// k of the plant [1/kg].
pub const K: f64 = 2.0;
/// k0, the controller's and the observer's until ε of the parameter [1/kg].
pub const K0: f64 = 1.0;
/// K_P of (70)-(71) [1/s²].
pub const KP: f64 = 6.0;
/// K_D of (70)-(71) [1/s].
pub const KD: f64 = 5.0;
/// ε of the parameter [s].
pub const EPSILON_PARAMETER: f64 = 1.0;
/// ε of the observer [s].
pub const EPSILON_OBSERVER: f64 = 0.1;
/// From here on [s] errors count in an rms.
pub const RMS_FROM: f64 = 2.0;
/// A k̂ or a k0 outside this range [1/kg] is not divided by: a factor of 20 to either side of the true one.
pub const K_RANGE: (f64, f64) = (0.1, 40.0);

/// A parameter that cannot be right; `name` is the command line's, without the dashes.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("--{name} {value}: {needs}")]
pub struct ScenarioError {
    /// Which one.
    pub name: &'static str,
    /// What was given.
    pub value: f64,
    /// What is wanted.
    pub needs: String,
}

/// Where the flight starts. What is `None` is that of the reference; at rest means a velocity of zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// x(0), y(0) [m]; by default on the reference, (0, 1).
    pub position: [Option<f64>; 2],
    /// x'(0), y'(0) [m/s]; by default zero.
    pub velocity: [Option<f64>; 2],
}

/// What Section V leaves open, and what may be varied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scenario {
    /// Ticks a second [Hz]: measurement, estimation and control.
    pub rate: f64,
    /// Standard deviation of the position noise [m].
    pub sigma: f64,
    /// Length of the flight t_f [s].
    pub duration: f64,
    /// λ of identifier and observer [1/s].
    pub lambda: f64,
    /// q of identifier and observer [1/s].
    pub q: f64,
    /// Seed of the noise of the first run.
    pub seed: u64,
    /// Where the flight starts.
    pub start: Start,
}

impl Default for Scenario {
    /// Section V: 0.5 m of noise, 10 s, λ = 2, q = λ/2; at 10 kHz, from rest on the reference.
    fn default() -> Self {
        Self { rate: 10_000.0, sigma: 0.5, duration: 10.0, lambda: 2.0, q: 1.0, seed: 1, start: Start::default() }
    }
}

impl Scenario {
    /// Most ticks in a flight.
    const MOST_TICKS: f64 = 1e8;

    /// T [s].
    pub fn period(&self) -> f64 {
        1.0 / self.rate
    }

    /// Ticks after the first one; the last lies at t_f.
    pub fn ticks(&self) -> u64 {
        (self.duration * self.rate).round() as u64
    }

    /// Position [m] and velocity [m/s] of both axes at t = 0.
    pub fn initial_state(&self) -> [(f64, f64); 2] {
        let on = reference(0.0);
        [0, 1].map(|i| (self.start.position[i].unwrap_or(on[i].position), self.start.velocity[i].unwrap_or(0.0)))
    }

    /// M, samples to a block of the identifier: the largest divisor of the ticks in ε of the parameter that spans at most a
    /// two-hundredth of the filter's time constant. At λ = 2 that is up to 2.5 ms: 1 sample up to 400 Hz, 2 at 1 kHz, 25 at
    /// 10 kHz. It costs no accuracy (1 and 25 give the same spread of k) and takes half the time; as a divisor, a
    /// block ends at ε itself, so k̂ is there when the paper has it.
    pub fn block(&self) -> u32 {
        let longest = (0.005 / (self.lambda.max(self.q) * self.period())).clamp(1.0, 4096.0) as u64;
        let ticks = (EPSILON_PARAMETER * self.rate).ceil() as u64;
        (1..=longest).rev().find(|m| ticks.is_multiple_of(*m)).unwrap_or(1) as u32
    }

    /// The f32 estimator of Section V. Parameter rule: what the read-out gives is used from ε on, as in the paper, as long
    /// as it lies in [`K_RANGE`] and its standard deviation is below its value.
    pub fn core_config(&self) -> EstimatorConfig<2, 1> {
        let tuning = Tuning { lambda: self.lambda, q: self.q };
        EstimatorConfig {
            block: self.block(),
            identifier: tuning,
            observer: tuning,
            nominal: [Some(K0)],
            rule: [ParameterRule { min: K_RANGE.0, max: K_RANGE.1, max_relative_sd: 1.0 }],
            parameter_settle: EPSILON_PARAMETER,
            state_settle: EPSILON_OBSERVER,
            ..EstimatorConfig::new(self.period())
        }
    }

    /// The paper's estimator of Section V.
    pub fn paper_config(&self) -> PaperConfig {
        PaperConfig {
            lambda: self.lambda,
            q: self.q,
            epsilon_observer: EPSILON_OBSERVER,
            epsilon_parameter: EPSILON_PARAMETER,
            k0: K0,
            period: self.period(),
            ..PaperConfig::default()
        }
    }

    /// Checks every parameter.
    ///
    /// # Errors
    /// Names the first that cannot be right.
    pub fn check(&self) -> Result<(), ScenarioError> {
        let fail = |name, value, needs: &str| Err(ScenarioError { name, value, needs: needs.to_owned() });
        let positive = [("rate", self.rate), ("duration", self.duration), ("lambda", self.lambda), ("q", self.q)];
        for (name, value) in positive {
            if !(value.is_finite() && value > 0.0) {
                return fail(name, value, "must be a positive finite number");
            }
        }
        if !(1.0..=1e6).contains(&self.rate) {
            return fail("rate", self.rate, "must be between 1 and 1e6 Hz");
        }
        if !(0.0..=1e4).contains(&self.sigma) {
            return fail("sigma", self.sigma, "must be between 0 and 1e4 m");
        }
        if self.ticks() < 1 || self.duration * self.rate > Self::MOST_TICKS {
            return fail("duration", self.duration, "times the rate must be between 1 and 1e8 ticks");
        }
        let [x, y] = self.start.position;
        let [vx, vy] = self.start.velocity;
        for (name, value) in [("start-x", x), ("start-y", y), ("start-vx", vx), ("start-vy", vy)] {
            if let Some(value) = value
                && !(-1e4..=1e4).contains(&value)
            {
                return fail(name, value, "must be a finite number of magnitude up to 1e4");
            }
        }
        EstimatorDesign::new(&self.core_config()).map(|_| ()).map_err(|error| self.named(error))
    }

    /// An error of the core's in the command line's words.
    fn named(&self, error: ConfigError) -> ScenarioError {
        let name = error.parameter();
        let (name, value) = if name.ends_with(".q") {
            ("q", self.q)
        } else if name.ends_with(".lambda") {
            ("lambda", self.lambda)
        } else {
            ("rate", self.rate)
        };
        ScenarioError { name, value, needs: format!("{error} (period {} s)", self.period()) }
    }
}

#[cfg(test)]
mod tests {
    use super::{Scenario, Start};

    #[test]
    fn blocks_end_at_epsilon() {
        for (rate, block) in [(50.0, 1), (400.0, 1), (1000.0, 2), (2000.0, 5), (10_000.0, 25), (10_007.0, 1)] {
            assert_eq!(Scenario { rate, ..Scenario::default() }.block(), block, "{rate} Hz");
        }
    }

    #[test]
    fn refusals_name_the_parameter() {
        let good = Scenario::default();
        assert_eq!(good.check(), Ok(()));
        let with_start = |start| Scenario { start, ..good };
        let cases = [
            (Scenario { rate: 0.0, ..good }, "rate"),
            (Scenario { rate: f64::NAN, ..good }, "rate"),
            (Scenario { rate: 2e6, ..good }, "rate"),
            (Scenario { sigma: -0.5, ..good }, "sigma"),
            (Scenario { sigma: f64::INFINITY, ..good }, "sigma"),
            (Scenario { duration: -1.0, ..good }, "duration"),
            (Scenario { duration: 1e-6, ..good }, "duration"),
            (Scenario { duration: 1e6, ..good }, "duration"),
            (Scenario { lambda: -2.0, ..good }, "lambda"),
            (Scenario { lambda: 2e4, ..good }, "lambda"),
            (Scenario { q: 0.0, ..good }, "q"),
            (Scenario { q: 2e4, ..good }, "q"),
            (Scenario { q: 1e-7, ..good }, "q"),
            (with_start(Start { position: [None, Some(f64::NAN)], velocity: [None; 2] }), "start-y"),
            (with_start(Start { position: [None; 2], velocity: [Some(1e9), None] }), "start-vx"),
        ];
        for (scenario, name) in cases {
            assert_eq!(scenario.check().unwrap_err().name, name, "{scenario:?}");
        }
    }
}
