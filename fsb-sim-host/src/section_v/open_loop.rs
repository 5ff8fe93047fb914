//! Efficiency and coverage: the paper's trajectory with the force given, so that k̂ does not act on its own data.
//!
//! The force is that of the core's noise-free closed loop of Section V. Each run adds its own noise to the true positions
//! and reads k̂ with its standard deviation at fixed times.

use fsb_core::estimator::EstimatorConfig;
use fsb_core::readout::ParameterRule;
use fsb_core::{ConfigError, Estimator, EstimatorDesign};
use rayon::prelude::*;

use super::CorePilot;
use super::flight::record;
use super::noise::{Noise, seed_of_run};
use super::scenario::{K, Scenario};
use crate::statistics::{AxisInformation, Coverage, Summary};

/// Times [s] at which k̂ is read.
pub const TIMES: [f64; 5] = [0.5, 1.0, 2.0, 5.0, 10.0];

/// k̂ at one time over all runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// [s]
    pub t: f64,
    /// k̂ - k of the runs that handed out a k̂ [1/kg].
    pub error: Summary,
    /// Root mean square of the reported standard deviation [1/kg].
    pub reported_sd: f64,
    /// The Cramér-Rao bound of the standard deviation [1/kg].
    pub bound: f64,
    /// How often 2 reported sd held the truth.
    pub coverage: Coverage,
}

impl Row {
    /// Standard deviation over its bound, 1 being the best possible.
    pub fn ratio(&self) -> f64 {
        self.error.sd / self.bound
    }
}

/// A flight as the runs need it.
struct Recording {
    positions: Vec<[f64; 2]>,
    forces: Vec<[f32; 2]>,
    bounds: [f64; TIMES.len()],
}

/// The settings of an open-loop run: those of Section V, but k̂ is handed out from the start whatever its standard deviation.
pub fn open_loop_config(scenario: &Scenario) -> EstimatorConfig<2, 1> {
    let anything = ParameterRule { max_relative_sd: 1e6, ..ParameterRule::default() };
    EstimatorConfig { parameter_settle: 0.0, rule: [anything], ..scenario.core_config() }
}

fn tick_of(scenario: &Scenario, t: f64) -> u64 {
    (t * scenario.rate).round() as u64
}

fn noise_free(scenario: &Scenario) -> Result<Recording, ConfigError> {
    let quiet = Scenario { sigma: 0.0, duration: TIMES[TIMES.len() - 1], ..*scenario };
    let moments = record(&quiet, quiet.seed, &mut CorePilot::new(&quiet)?, 1);
    let start = quiet.initial_state();
    let mut axes = [AxisInformation::default(); 2];
    let mut bounds = [f64::INFINITY; TIMES.len()];
    for moment in &moments {
        for ((axis, truth), (position, velocity)) in axes.iter_mut().zip(moment.truth).zip(start) {
            axis.add(moment.t, (truth.position - position - velocity * moment.t) / K);
        }
        for (bound, _) in bounds.iter_mut().zip(TIMES).filter(|(_, t)| tick_of(&quiet, *t) == moment.tick) {
            *bound = AxisInformation::k_sd(scenario.sigma, &axes);
        }
    }
    Ok(Recording {
        positions: moments.iter().map(|m| m.truth.map(|axis| axis.position)).collect(),
        forces: moments.iter().map(|m| m.forces.map(|force| force as f32)).collect(),
        bounds,
    })
}

/// (k̂, sd) at [`TIMES`] of one run.
fn run(
    scenario: &Scenario,
    design: &EstimatorDesign<2, 1>,
    flight: &Recording,
    seed: u64,
) -> [Option<(f64, f64)>; TIMES.len()] {
    let mut estimator = Estimator::with_design(*design);
    let mut noise = Noise::new(scenario.sigma, seed);
    let ticks = TIMES.map(|t| tick_of(scenario, t));
    let mut read = [None; TIMES.len()];
    for (tick, (position, force)) in (0..).zip(flight.positions.iter().zip(&flight.forces)) {
        let [dx, dy] = noise.next_pair();
        // Cannot be out of step: one input follows each measurement.
        let _ = estimator.measure(&[Some((position[0] + dx) as f32), Some((position[1] + dy) as f32)]);
        for (read, _) in read.iter_mut().zip(ticks).filter(|(_, at)| *at == tick) {
            *read = estimator.parameters()[0].map(|k| (f64::from(k.value), f64::from(k.sd())));
        }
        estimator.apply(force);
    }
    read
}

/// `runs` runs of 10 s with seeds `scenario.seed`, `scenario.seed` + 1, … on all cores, with the settings `config` (see
/// [`open_loop_config`]); `done` is called after each. One row for each of [`TIMES`].
///
/// # Errors
/// What the core refuses.
pub fn open_loop(
    scenario: &Scenario,
    config: &EstimatorConfig<2, 1>,
    runs: u64,
    done: impl Fn() + Sync,
) -> Result<Vec<Row>, ConfigError> {
    let flight = noise_free(scenario)?;
    let design = EstimatorDesign::new(config)?;
    let read: Vec<_> = (0..runs)
        .into_par_iter()
        .map(|index| {
            let read = run(scenario, &design, &flight, seed_of_run(scenario.seed, index));
            done();
            read
        })
        .collect();
    let row = |i: usize| {
        let mut coverage = Coverage::default();
        let given: Vec<(f64, f64)> = read.iter().filter_map(|read| read[i]).collect();
        for read in &read {
            coverage.add(read[i].map(|(k, sd)| (k - K).abs() <= 2.0 * sd));
        }
        let errors: Vec<f64> = given.iter().map(|(k, _)| k - K).collect();
        let mean_square = given.iter().map(|(_, sd)| sd * sd).sum::<f64>() / given.len() as f64;
        Row {
            t: TIMES[i],
            error: Summary::of(&errors),
            reported_sd: mean_square.sqrt(),
            bound: flight.bounds[i],
            coverage,
        }
    };
    Ok((0..TIMES.len()).map(row).collect())
}
