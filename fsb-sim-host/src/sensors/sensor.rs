//! The pipeline from truth to measurement.

use std::collections::VecDeque;

use super::config::{SensorConfig, Ticks};
use super::faults::{Draws, Faults};
use super::quantity::Quantity;
use crate::hexarotor::ParameterError;
use crate::hexarotor::vector::{scaled, sum};

/// What arrives at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement<Q> {
    /// The value with all its errors.
    pub value: Q,
    /// The tick, from 0, it was nominally taken at: what a time stamp would say.
    pub tick: u64,
    /// How many ticks ago that was: 0 without latency.
    pub age: u64,
    /// When it was truly taken [s from the first tick]: `tick` times the period less the sampling jitter.
    pub taken_at: f64,
    /// Whether it is an outlier; for statistics, no sensor tells.
    pub outlier: bool,
}

/// A sample on its way.
#[derive(Clone, Copy, Debug)]
struct Underway<Q> {
    due: u64,
    measurement: Measurement<Q>,
}

/// A sensor of a quantity. The same configuration, seed and truth give the same measurements on every machine.
#[derive(Clone, Debug)]
pub struct Sensor<Q> {
    config: SensorConfig,
    period: f64,
    ticks: Ticks,
    faults: Faults,
    /// The tick to come.
    tick: u64,
    /// Truths of the last ticks, the latest first.
    history: VecDeque<Q>,
    /// In order of their ticks.
    underway: VecDeque<Underway<Q>>,
}

impl<Q: Quantity> Sensor<Q> {
    /// For ticks of `period` [s].
    ///
    /// # Errors
    /// Names the first parameter that cannot be right.
    pub fn new(config: &SensorConfig, period: f64, seed: u64) -> Result<Self, ParameterError> {
        let ticks = config.ticks(period)?;
        Ok(Self {
            config: config.clone(),
            period,
            ticks,
            faults: Faults::new(seed),
            tick: 0,
            history: VecDeque::with_capacity(ticks.history + 2),
            underway: VecDeque::new(),
        })
    }

    /// Once per control tick: the truth now, to the measurement that arrives now, if any. Of several that arrive at one tick
    /// the latest is given, and the others are lost.
    pub fn tick(&mut self, truth: &Q) -> Option<Measurement<Q>> {
        let now = self.tick;
        self.tick += 1;
        self.history.truncate(self.ticks.history);
        self.history.push_front(*truth);
        if now.is_multiple_of(self.ticks.every) {
            let draws = self.faults.draw();
            if !self.lost(now, &draws) {
                let sample = self.sample(truth, now, &draws);
                self.underway.push_back(sample);
            }
        }
        let last = self.underway.iter().rposition(|sample| sample.due <= now)?;
        let measurement = self.underway.drain(..=last).next_back()?.measurement;
        Some(Measurement { age: now - measurement.tick, ..measurement })
    }

    fn lost(&self, now: u64, draws: &Draws) -> bool {
        // Room for the rounding of the product.
        let t = now as f64 * self.period;
        let room = 1e-6 * self.period;
        let in_gap = self.config.gaps.iter().any(|[start, end]| (start - room..end - room).contains(&t));
        in_gap || draws.dropout < self.config.dropout
    }

    fn sample(&self, truth: &Q, now: u64, draws: &Draws) -> Underway<Q> {
        let config = &self.config;
        let oldest = self.history.len() - 1;
        let back = (draws.sampling * config.sampling_jitter / self.period).min(oldest as f64);
        let mut value = if back > 0.0 { self.truth_before(back) } else { *truth };
        let outlier = draws.outlier < config.outlier;
        let mut error = scaled(config.noise_sd, draws.noise);
        if outlier {
            error = sum(error, scaled(config.outlier_size, draws.direction));
        }
        if error != [0.0; 3] {
            value = value.displaced(error);
        }
        if config.resolution > 0.0 {
            value = value.quantised(config.resolution);
        }
        let delay = (config.latency + draws.latency * config.latency_jitter) / self.period;
        let taken_at = (now as f64 - back) * self.period;
        let measurement = Measurement { value, tick: now, age: 0, taken_at, outlier };
        Underway { due: now + delay.round() as u64, measurement }
    }

    /// The truth `back` ticks ago, on the straight way between two ticks: off by at most T²/8 of the acceleration, 4 µm at
    /// 30 m/s² and 1 kHz.
    fn truth_before(&self, back: f64) -> Q {
        let later = back.floor() as usize;
        let earlier = (later + 1).min(self.history.len() - 1);
        self.history[later].towards(&self.history[earlier], back - later as f64)
    }
}
