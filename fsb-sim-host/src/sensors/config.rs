//! The faults of one sensor as data. The default has none: every tick, exact, at once.

use serde::{Deserialize, Serialize};

use crate::hexarotor::ParameterError;
use crate::hexarotor::error::check;

/// One sensor. "Unit" is the metre for a position and the radian for an attitude.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SensorConfig {
    /// Samples a second [Hz], a whole part of the tick rate; every tick if absent. The first sample is that of the first tick.
    pub rate: Option<f64>,
    /// Standard deviation of the Gaussian noise on each component [unit]; for an attitude, of a rotation about each body axis.
    pub noise_sd: f64,
    /// Values are rounded to whole multiples of this [unit]; 0: not at all. For an attitude, its Euler angles are.
    pub resolution: f64,
    /// From the sampling instant to the tick at which the measurement is there [s]; rounded to whole ticks.
    pub latency: f64,
    /// Added to the latency, uniform from 0 to this, anew for each sample [s]. A sample overtaken by a later one is lost.
    pub latency_jitter: f64,
    /// How much before its nominal tick a sample is really taken, uniform from 0 to this [s]; at most a sampling period.
    pub sampling_jitter: f64,
    /// Probability that a sample is lost, independently of the others.
    pub dropout: f64,
    /// Times [start, end) [s] in which no sample is taken.
    pub gaps: Vec<[f64; 2]>,
    /// Probability that a sample is an outlier.
    pub outlier: f64,
    /// How far an outlier is off, in a direction uniform on the sphere [unit]; for an attitude, by a rotation.
    pub outlier_size: f64,
}

/// A checked configuration in ticks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ticks {
    /// Ticks from sample to sample.
    pub every: u64,
    /// Ticks back that a sampling instant may lie.
    pub history: usize,
}

impl SensorConfig {
    /// Longest latency, jitter included [s].
    pub const MOST_LATENCY: f64 = 60.0;

    /// Checks every parameter, for ticks of `period` [s].
    ///
    /// # Errors
    /// Names the first that cannot be right.
    pub fn check(&self, period: f64) -> Result<(), ParameterError> {
        self.ticks(period).map(|_| ())
    }

    pub(super) fn ticks(&self, period: f64) -> Result<Ticks, ParameterError> {
        check("period", period, 1e-6..=10.0, "must be from 1e-6 to 10 s")?;
        let every = match self.rate {
            None => 1,
            Some(rate) => {
                let ticks = 1.0 / (rate * period);
                if !((0.999..=1e9).contains(&ticks) && (ticks / ticks.round() - 1.0).abs() < 1e-6) {
                    return Err(ParameterError::new("rate", rate, "must be the tick rate or a whole part of it"));
                }
                ticks.round() as u64
            }
        };
        check("noise_sd", self.noise_sd, 0.0..=1e4, "must be from 0 to 10000")?;
        check("resolution", self.resolution, 0.0..=1e4, "must be from 0 to 10000")?;
        check("latency", self.latency, 0.0..=Self::MOST_LATENCY, "must be from 0 to 60 s")?;
        let jitter = 0.0..=Self::MOST_LATENCY - self.latency;
        check("latency_jitter", self.latency_jitter, jitter, "must be at least 0 and with the latency at most 60 s")?;
        let sampling = every as f64 * period * (1.0 + 1e-9);
        check("sampling_jitter", self.sampling_jitter, 0.0..=sampling, "must be from 0 to the sampling period")?;
        check("dropout", self.dropout, 0.0..=1.0, "must be from 0 to 1")?;
        check("outlier", self.outlier, 0.0..=1.0, "must be from 0 to 1")?;
        check("outlier_size", self.outlier_size, 0.0..=1e4, "must be from 0 to 10000")?;
        if !self.gaps.iter().all(|[start, end]| start < end && start.is_finite()) {
            return Err(ParameterError::new("gaps", &self.gaps, "must each be a start [s] and a later end [s]"));
        }
        let history = (self.sampling_jitter / period).ceil();
        // Kept as a list of truths; a slow sensor with much jitter on fast ticks would take much memory.
        check("sampling_jitter", history, 0.0..=1e6, "must be at most a million ticks")?;
        Ok(Ticks { every, history: history as usize })
    }
}
