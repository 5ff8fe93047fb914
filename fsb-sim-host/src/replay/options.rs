//! What can be set, and the core's configuration that follows.

use super::error::ReplayError;
use fsb_core::readout::{Memory, ParameterRule, Readout};
use fsb_core::regression::Identify;
use fsb_core::{EstimatorConfig, Tuning};

/// How a log is replayed. Plain data; [`super::run`] judges it together with the period of the log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReplayOptions {
    /// λ and q of the identifier \[1/s\], (17) and (28). λT and qT within 1e-6..=1, T being the time step of the log.
    pub identifier: Tuning,
    /// λ and q of the observer \[1/s\], within the same range.
    pub observer: Tuning,
    /// g \[m/s²\]: z points up and falls with -g. Finite, magnitude up to 1e6.
    pub gravity: f64,
    /// How k is read out.
    pub readout: Readout,
    /// How long the read-out remembers.
    pub memory: Memory,
    /// What is identified beside k on x, y and z, with k shared by them; `None`: k alone, read out as above.
    pub identify: Option<Identify>,
}

impl Default for ReplayOptions {
    /// λ = 2, q = 1 for the identifier, λ = 10, q = 5 for the observer, g = 9.81, least squares with infinite memory.
    fn default() -> Self {
        Self {
            identifier: Tuning::from_lambda(2.0),
            observer: Tuning::from_lambda(10.0),
            gravity: 9.81,
            readout: Readout::LeastSquares,
            memory: Memory::Infinite,
            identify: None,
        }
    }
}

/// The core rejects positions and inputs beyond this \[m, rad, N or N m\].
pub(super) const LIMIT: f64 = 1e6;

/// The least λ times the identifier's period that a replay uses: below it samples are averaged into blocks.
const FINEST_STEP: f64 = 2e-3;

impl ReplayOptions {
    /// When k̂ counts as valid: positive, 1e-6..=1e9, and sd(k̂)/k̂ at most 5 % (10 % once valid).
    ///
    /// There is no ε on top. The variance of k̂ needs some 0.75/λ, which is one already; on
    /// recorded flights the pooled k̂ that this lets through first is no worse than the one of half a second later.
    pub fn rule() -> ParameterRule {
        ParameterRule { min: 1e-6, max: 1e9, max_relative_sd: 0.05 }
    }

    /// Samples per block of the identifier at the time step `period` \[s\]: as many as keep max(λ, q) times the block near
    /// 2e-3, where f32 is at its best (1 up to 1 kHz at λ = 2).
    pub fn block(&self, period: f64) -> u32 {
        let fastest = self.identifier.lambda.max(self.identifier.q) * period;
        // What is not a number or not positive is refused by the core, under its own name.
        if fastest > 0.0 { (FINEST_STEP / fastest).round().clamp(1.0, 65_535.0) as u32 } else { 1 }
    }

    /// The longest step \[s\] of what the log, of the time step `period` \[s\], is read out with: a block of samples, and a row of the
    /// regression, which comes every 0.1/λ or 0.1/q, the shorter one.
    pub(super) fn step(&self, period: f64) -> f64 {
        let fastest = self.identifier.lambda.max(self.identifier.q) * period;
        let row = if self.identify.is_some() { (0.1 / fastest).floor() } else { 1.0 };
        f64::from(self.block(period)).max(row) * period
    }

    /// The core's configuration for axes with the drifts `drift` in a log of the time step `period` \[s\].
    pub(super) fn config<const N: usize, const P: usize>(&self, period: f64, drift: [f64; N]) -> EstimatorConfig<N, P> {
        EstimatorConfig {
            block: self.block(period),
            identifier: self.identifier,
            observer: self.observer,
            readout: self.readout,
            memory: self.memory,
            drift,
            rule: [Self::rule(); P],
            position_limit: LIMIT,
            input_limit: LIMIT,
            ..EstimatorConfig::new(period)
        }
    }

    /// Gravity is a parameter even where no vertical axis uses it.
    pub(super) fn check_gravity(&self) -> Result<(), ReplayError> {
        if self.gravity.is_finite() { Ok(()) } else { Err(ReplayError::Gravity(self.gravity)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_keep_the_identifier_near_its_best_step() {
        let options = ReplayOptions::default();
        for (rate, block) in [(50.0, 1), (1e3, 1), (8e3, 8), (1e5, 100)] {
            assert_eq!(options.block(1.0 / rate), block, "{rate} Hz");
        }
        let slow = ReplayOptions { identifier: Tuning { lambda: 0.02, q: 0.1 }, ..options };
        assert_eq!(slow.block(1e-3), 20, "the faster of the two rates counts");
        for lambda in [f64::NAN, -1.0, 0.0] {
            assert_eq!(ReplayOptions { identifier: Tuning { lambda, q: lambda }, ..options }.block(0.01), 1);
        }
    }

    #[test]
    fn the_defaults_are_those_of_the_help() {
        let options = ReplayOptions::default();
        assert_eq!(options.identifier, Tuning { lambda: 2.0, q: 1.0 });
        assert_eq!(options.observer, Tuning { lambda: 10.0, q: 5.0 });
        assert_eq!(options.gravity, 9.81);
    }
}
