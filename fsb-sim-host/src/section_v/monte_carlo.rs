//! Many flights on consecutive seeds, the core and the paper's form each in its own loop on the same noise.

use rayon::prelude::*;
use thiserror::Error;

use super::flight::{Moment, fly};
use super::noise::seed_of_run;
use super::pilot::Pilot;
use super::scenario::{K, RMS_FROM, Scenario};
use super::{CorePilot, PaperPilot};
use crate::statistics::{Coverage, Squares, Summary};

/// Times [s] at which the reported 2 sd of k is held against the truth.
pub const COVERAGE_TIMES: [f64; 4] = [1.0, 2.0, 5.0, 10.0];

/// An estimator refused the scenario.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PilotError {
    /// The f32 core.
    #[error(transparent)]
    Core(#[from] fsb_core::ConfigError),
    /// The paper's form.
    #[error(transparent)]
    Paper(#[from] crate::paper_form::ConfigError),
}

/// What one loop did in all runs. NaN stands for what there was nothing to make of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopStatistics {
    /// k̂ - k at t_f over the runs [1/kg].
    pub k_error: Summary,
    /// Errors at t_f over the runs: x, y [m], x', y' [m/s].
    pub state_error: [Summary; 4],
    /// Rms of the distance of the estimated position from the true one in the plane, 2 s to t_f, all runs [m].
    pub position_rms: f64,
    /// Rms of the velocity error, of the vector likewise [m/s].
    pub velocity_rms: f64,
    /// How often the reported 2 sd of k held the truth, at [`COVERAGE_TIMES`]. Empty of runs where the flight was shorter,
    /// of estimates where the form reports no standard deviation.
    pub coverage: [Coverage; COVERAGE_TIMES.len()],
}

/// Both loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MonteCarlo {
    /// How many runs.
    pub runs: u64,
    /// The f32 core.
    pub core: LoopStatistics,
    /// The paper's form in f64.
    pub paper_form: LoopStatistics,
}

/// What is kept of one run.
#[derive(Clone, Debug)]
struct Run {
    k_error: f64,
    state_error: [f64; 4],
    position: Squares,
    velocity: Squares,
    held: [Option<bool>; COVERAGE_TIMES.len()],
}

impl Run {
    fn fly(scenario: &Scenario, seed: u64, pilot: &mut impl Pilot) -> Self {
        let check = COVERAGE_TIMES.map(|t| (t * scenario.rate).round() as u64);
        let last = scenario.ticks();
        let mut run = Self {
            k_error: f64::NAN,
            state_error: [f64::NAN; 4],
            position: Squares::default(),
            velocity: Squares::default(),
            held: [None; COVERAGE_TIMES.len()],
        };
        fly(scenario, seed, pilot, |moment, _| {
            run.count(moment);
            for (held, _) in run.held.iter_mut().zip(check).filter(|(_, tick)| *tick == moment.tick) {
                *held = moment.belief.k.zip(moment.belief.k_sd).map(|(k, sd)| (k - K).abs() <= 2.0 * sd);
            }
            if moment.tick == last {
                run.k_error = moment.belief.k.map_or(f64::NAN, |k| k - K);
                for axis in 0..2 {
                    let (position, velocity) = moment.state_error(axis).unwrap_or((f64::NAN, f64::NAN));
                    (run.state_error[axis], run.state_error[2 + axis]) = (position, velocity);
                }
            }
        });
        run
    }

    fn count(&mut self, moment: &Moment) {
        if moment.t < RMS_FROM - 1e-9 {
            return;
        }
        if let Some(((x, dx), (y, dy))) = moment.state_error(0).zip(moment.state_error(1)) {
            self.position.add(x.hypot(y));
            self.velocity.add(dx.hypot(dy));
        }
    }
}

impl LoopStatistics {
    fn of(runs: &[Run], duration: f64) -> Self {
        let (mut position, mut velocity) = (Squares::default(), Squares::default());
        let mut coverage = [Coverage::default(); COVERAGE_TIMES.len()];
        for run in runs {
            position.append(&run.position);
            velocity.append(&run.velocity);
            for ((coverage, held), t) in coverage.iter_mut().zip(run.held).zip(COVERAGE_TIMES) {
                if t <= duration {
                    coverage.add(held);
                }
            }
        }
        let column = |value: &dyn Fn(&Run) -> f64| Summary::of(&runs.iter().map(value).collect::<Vec<_>>());
        Self {
            k_error: column(&|run| run.k_error),
            state_error: [0, 1, 2, 3].map(|i| column(&|run| run.state_error[i])),
            position_rms: position.rms(),
            velocity_rms: velocity.rms(),
            coverage,
        }
    }
}

/// Flies `runs` runs with seeds `scenario.seed`, `scenario.seed` + 1, … on all cores; `done` is called after each. The
/// result does not depend on how the runs are spread over the cores.
///
/// # Errors
/// [`PilotError`] where an estimator refuses the scenario.
pub fn monte_carlo(scenario: &Scenario, runs: u64, done: impl Fn() + Sync) -> Result<MonteCarlo, PilotError> {
    let fly_both = |run: u64| {
        let seed = seed_of_run(scenario.seed, run);
        let core = Run::fly(scenario, seed, &mut CorePilot::new(scenario)?);
        let paper = Run::fly(scenario, seed, &mut PaperPilot::new(scenario)?);
        done();
        Ok((core, paper))
    };
    let flown: Result<Vec<(Run, Run)>, PilotError> = (0..runs).into_par_iter().map(fly_both).collect();
    let (core, paper): (Vec<_>, Vec<_>) = flown?.into_iter().unzip();
    Ok(MonteCarlo {
        runs,
        core: LoopStatistics::of(&core, scenario.duration),
        paper_form: LoopStatistics::of(&paper, scenario.duration),
    })
}
