//! One case flown twice on the same recording: on the identified k, and with k known.

use fsb_core::readout::ParameterRule;
use fsb_core::{ConfigError, Estimator, EstimatorConfig};

use super::{Case, Deviation, FROM, K_LIMIT, K_LIMIT_LATE, POSITION_LIMIT, SECONDS, SETTLED, VELOCITY_LIMIT};
use crate::plant::{Motion, Recording, RecordingConfig, record};

const GRAVITY: f64 = -9.81;

/// Errors of one case, of all its axes together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exactness {
    /// What was flown.
    pub case: Case,
    /// k̂/k - 1 from 0.1 s on. k̂ is due three blocks after that; until then only a valid one counts.
    pub k: Deviation,
    /// The same from 1 s on.
    pub k_late: Deviation,
    /// ŷ - y on the identified k [m], from 0.1 s (and three blocks) on.
    pub position: Deviation,
    /// v̂ - v on the identified k [m/s], from 0.5 s on.
    pub velocity: Deviation,
    /// ŷ - y with k known [m], from 0.1 s on.
    pub position_known: Deviation,
    /// v̂ - v with k known [m/s], from 0.1 s on.
    pub velocity_known: Deviation,
}

impl Exactness {
    /// Whether every error is within its limit.
    pub fn holds(&self) -> bool {
        self.k.max() <= K_LIMIT
            && self.k_late.max() <= K_LIMIT_LATE
            && self.position.max().max(self.position_known.max()) <= POSITION_LIMIT
            && self.velocity.max().max(self.velocity_known.max()) <= VELOCITY_LIMIT
    }
}

/// Flies a case.
///
/// # Errors
/// What the core refuses: a case far outside [`super::CASES`].
pub fn fly(case: &Case) -> Result<Exactness, ConfigError> {
    if case.axes == 3 {
        let axes = [(0.0, 1.3, 0.4), (0.0, 0.9, -2.0), (GRAVITY, 1.0, 3.0)];
        let axes = axes.map(|(drift, frequency, centre)| (drift, Motion { centre, amplitude: 1.0, frequency }));
        fly_axes(case, axes)
    } else {
        fly_axes(case, [(GRAVITY, Motion { centre: 3.0, amplitude: 2.0, frequency: 1.5 })])
    }
}

fn fly_axes<const N: usize>(case: &Case, axes: [(f64, Motion); N]) -> Result<Exactness, ConfigError> {
    let period = case.period();
    let recordings = axes.map(|(drift, motion)| {
        let samples = (SECONDS / period).round() as usize;
        record(&RecordingConfig { period, samples, drift, motion, position: motion.centre, ..Default::default() })
    });
    let k = RecordingConfig::default().k;
    let identified = EstimatorConfig {
        substeps: case.substeps,
        block: case.block,
        drift: axes.map(|(drift, _)| drift),
        // The rounding of the positions: half an ulp of 3 m is 1.2e-7 m.
        noise_sd: Some(1e-7),
        parameter_settle: 0.09,
        ..EstimatorConfig::<N, 1>::new(period)
    };
    // No estimate of k is good enough to take the place of the known one.
    let rule = ParameterRule { max_relative_sd: 1e-12, ..Default::default() };
    let known = EstimatorConfig { nominal: [Some(k)], rule: [rule], ..identified };

    let due = FROM + 3.0 * case.block_time();
    let (mut k_all, mut k_late) = (Deviation::default(), Deviation::default());
    let (position, velocity) = run(&identified, &recordings, due, SETTLED, |t, found| {
        let error = found.map(|found| f64::from(found) / k - 1.0);
        if t >= due || (t >= FROM && error.is_some()) {
            k_all.add(error.unwrap_or(f64::INFINITY));
        }
        if t >= 1.0 {
            k_late.add(error.unwrap_or(f64::INFINITY));
        }
    })?;
    let (position_known, velocity_known) = run(&known, &recordings, FROM, FROM, |_, _| ())?;
    Ok(Exactness { case: *case, k: k_all, k_late, position, velocity, position_known, velocity_known })
}

/// Errors of position and velocity at every control tick, each from its own time on; `at_tick` is told the valid k.
fn run<const N: usize>(
    config: &EstimatorConfig<N, 1>,
    axes: &[Recording; N],
    position_from: f64,
    velocity_from: f64,
    mut at_tick: impl FnMut(f64, Option<f32>),
) -> Result<(Deviation, Deviation), ConfigError> {
    let mut estimator = Estimator::new(config)?;
    let (mut position, mut velocity) = (Deviation::default(), Deviation::default());
    for i in 0..axes[0].positions.len() {
        let t = i as f64 * config.period + 1e-9;
        if i.is_multiple_of(config.substeps as usize) {
            // Cannot be out of step: an input follows at every tick.
            let _ = estimator.measure(&axes.each_ref().map(|axis| Some(axis.positions[i] as f32)));
        }
        at_tick(t, estimator.parameters()[0].map(|found| found.value));
        for (state, axis) in estimator.states().iter().zip(axes) {
            let (y, v) = state.map_or((f64::NAN, f64::NAN), |s| (f64::from(s.position), f64::from(s.velocity)));
            if t >= position_from {
                position.add(y - axis.positions[i]);
            }
            if t >= velocity_from {
                velocity.add(v - axis.velocities[i]);
            }
        }
        estimator.apply(&axes.each_ref().map(|axis| axis.forces[i] as f32));
    }
    Ok((position, velocity))
}
