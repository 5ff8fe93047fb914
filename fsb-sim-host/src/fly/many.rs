//! Many flights on consecutive seeds.

use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde::Serialize;

use super::error::Refused;
use super::record::{Flight, Keep, ParameterEnd, record};
use super::scenario::Scenario;
use crate::section_v::noise::seed_of_run;

/// What is kept of one of many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunEnd {
    /// Its seed: `--seed` of the flight alone.
    pub seed: u64,
    /// When it diverged [s].
    pub diverged: Option<f64>,
    /// The parameters at the end.
    pub parameters: [ParameterEnd; 4],
    /// Rms distance from the reference [m] and angle [rad], see [`super::record::Tracking`].
    pub tracking: [f64; 2],
    /// Rms velocity error [m/s].
    pub velocity: f64,
}

impl RunEnd {
    fn of(seed: u64, flight: &Flight) -> Self {
        Self {
            seed,
            diverged: flight.diverged,
            parameters: flight.parameters,
            tracking: [flight.tracking.position_rms, flight.tracking.attitude_rms],
            velocity: flight.state.velocity_rms,
        }
    }

    /// Error of parameter `index` at the end in percent, where there is an estimate.
    pub fn error(&self, index: usize) -> Option<f64> {
        let ParameterEnd { real, estimated, .. } = self.parameters[index];
        estimated.map(|estimated| 100.0 * (estimated / real - 1.0))
    }
}

/// All flights.
#[derive(Clone, Debug)]
pub struct Flights {
    /// The first in full.
    pub first: Flight,
    /// All of them, the first included.
    pub runs: Vec<RunEnd>,
    /// Seconds flown by all, over the seconds of one core that took, the yardstick's flight included where it was flown.
    pub real_time_factor: f64,
    /// Flights finished in a second of wall time.
    pub flights_per_second: f64,
}

/// How a number is spread over the flights.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Flights that have it.
    pub flights: usize,
    /// Median.
    pub median: f64,
    /// 5 % are below.
    pub p05: f64,
    /// 5 % are above.
    pub p95: f64,
    /// Least.
    pub min: f64,
    /// Most.
    pub max: f64,
}

impl Spread {
    /// Of the values there are; `None` of none.
    pub fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let last = values.len().checked_sub(1)?;
        let at = |share: f64| values[(share * last as f64).round() as usize];
        Some(Self { flights: values.len(), median: at(0.5), p05: at(0.05), p95: at(0.95), min: at(0.0), max: at(1.0) })
    }
}

impl Flights {
    /// How many diverged.
    pub fn diverged(&self) -> usize {
        self.runs.iter().filter(|run| run.diverged.is_some()).count()
    }

    /// Spread of the errors of parameter `index` at the end [%].
    pub fn errors(&self, index: usize) -> Option<Spread> {
        Spread::of(self.runs.iter().filter_map(|run| run.error(index)))
    }
}

/// Flies `runs` flights with seeds `seed`, `seed` + 1, … on all cores; `done` is called after each. The result does not
/// depend on how they are spread over the cores, but for the two speeds.
///
/// # Errors
/// [`Refused`] where a draw of the scenario cannot be flown.
pub fn fly_many(scenario: &Scenario, seed: u64, runs: u64, done: impl Fn() + Sync) -> Result<Flights, Refused> {
    let start = Instant::now();
    let timed = |run: u64, keep: Keep| {
        let (seed, begin) = (seed_of_run(seed, run), Instant::now());
        let flight = record(scenario, seed, keep)?;
        let taken = begin.elapsed();
        done();
        Ok((RunEnd::of(seed, &flight), flight, taken))
    };
    let (first_run, first, first_taken) = timed(0, Keep::All)?;
    let others: Result<Vec<(RunEnd, f64, Duration)>, Refused> = (1..runs)
        .into_par_iter()
        .map(|run| timed(run, Keep::Numbers).map(|(end, flight, taken)| (end, flight.flown, taken)))
        .collect();
    let others = others?;
    // The first flight flies the yardstick too and keeps everything; the others tell the speed, where there are any.
    let (flown, taken) = if others.is_empty() {
        (first.flown, first_taken)
    } else {
        (others.iter().map(|other| other.1).sum(), others.iter().map(|other| other.2).sum())
    };
    let runs = std::iter::once(first_run).chain(others.iter().map(|other| other.0)).collect::<Vec<_>>();
    let flights_per_second = runs.len() as f64 / start.elapsed().as_secs_f64();
    Ok(Flights { first, runs, real_time_factor: flown / taken.as_secs_f64(), flights_per_second })
}
