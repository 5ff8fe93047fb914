//! The f32 core on a recorded axis, and the f64 twin on the same f32 inputs.

use fsb_core::estimator::AxisState;
use fsb_core::readout::Parameter;
use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::Recording;
use fsb_sim_host::twin::{Moments, TwinIdentifier, TwinLeastSquares, TwinObserver};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// What the core said at one control tick, after the measurement if there was one.
#[derive(Clone, Copy, Debug)]
pub struct Tick {
    /// Time, in s.
    pub t: f64,
    /// Whether this was a measurement instant.
    pub measured: bool,
    /// The valid parameter.
    pub parameter: Option<Parameter>,
    /// The newest quotient, valid or not.
    pub newest: Option<f64>,
    /// The state handed out.
    pub state: Option<AxisState>,
}

/// Runs one axis; `measured(i)` tells whether the i-th measurement arrives.
pub fn fly(config: &EstimatorConfig<1, 1>, recording: &Recording, measured: impl Fn(usize) -> bool) -> Vec<Tick> {
    let mut estimator = Estimator::new(config).expect("a valid configuration");
    let substeps = config.substeps as usize;
    (0..recording.positions.len())
        .map(|i| {
            let instant = i % substeps == 0;
            if instant {
                let y = recording.positions[i] as f32;
                estimator.measure(&[measured(i / substeps).then_some(y)]).expect("in step");
            }
            let d = estimator.diagnostics()[0];
            let tick = Tick {
                t: i as f64 * recording.period,
                measured: instant,
                parameter: estimator.parameters()[0],
                newest: (d.denominator > 0.0).then(|| f64::from(d.numerator / d.denominator)),
                state: estimator.states()[0],
            };
            estimator.apply(&[recording.forces[i] as f32]);
            tick
        })
        .collect()
}

/// What the twin said at one measurement instant.
#[derive(Clone, Copy, Debug)]
pub struct TwinTick {
    /// The newest quotient.
    pub k: Option<f64>,
    /// Position and velocity of the observer that knows the true k.
    pub state: Option<(f64, f64)>,
}

/// Runs the f64 twin on the core's own inputs: positions and forces rounded to f32, and, with a seed, moved by up to half
/// an ulp more, at random. The spread over seeds is what rounding of the inputs explains.
pub fn fly_twin(config: &EstimatorConfig<1, 1>, recording: &Recording, k: f64, seed: Option<u64>) -> Vec<TwinTick> {
    let mut rng = seed.map(Pcg64::seed_from_u64);
    let mut rounded = |x: f64| {
        let x = x as f32;
        let half_ulp = f64::from(x.abs()) * f64::from(f32::EPSILON) / 2.0;
        f64::from(x) + rng.as_mut().map_or(0.0, |r| r.random_range(-1.0..1.0) * half_ulp)
    };
    let substeps = config.substeps as usize;
    let period = recording.period * substeps as f64;
    let drift = config.drift[0];
    let mut identifier =
        TwinIdentifier::new(config.identifier.lambda, config.identifier.q, period, config.block as usize);
    let mut observer = TwinObserver::new(config.observer.lambda, config.observer.q, period, k, drift);
    let mut squares = TwinLeastSquares::new(None, period * f64::from(config.block));
    let mut moments = Moments::default();
    let instants = recording.positions.len().div_ceil(substeps);
    (0..instants)
        .map(|i| {
            let y = rounded(recording.positions[i * substeps]);
            let state = observer.update(Some(y), moments.j1, moments.j2);
            if let Some(block) = identifier.sample(y, moments.j1, moments.j2) {
                squares.add(&[(block.z2_without_drift(drift), block.z0)]);
            }
            let last = ((i + 1) * substeps).min(recording.forces.len());
            let forces: Vec<f64> = recording.forces[i * substeps..last].iter().map(|&f| rounded(f)).collect();
            moments = Moments::held_in_parts(&forces, period);
            TwinTick { k: squares.k(), state }
        })
        .collect()
}
