//! When k̂ becomes valid, the state handed out is at once that of an observer that knew k̂ from the start.

use fsb_core::estimator::StateStatus;
use fsb_core::{Estimator, EstimatorConfig, Tuning};
use fsb_sim_host::plant::{Motion, Recording, RecordingConfig, record};
use fsb_sim_host::twin::{Moments, RetroactiveObserver, TwinObserver};
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

const DRIFT: f64 = -9.81;

fn flight(period: f64, seconds: f64, drift: f64, frequency: f64) -> Recording {
    let motion = Motion { centre: 3.0, amplitude: 1.5, frequency };
    record(&RecordingConfig { period, samples: (seconds / period) as usize, drift, motion, ..Default::default() })
}

/// Nominal k three times too large: half a second of an observer on it, then k̂.
fn misled(period: f64, block: u32, substeps: u32) -> EstimatorConfig<1, 1> {
    EstimatorConfig {
        block,
        substeps,
        drift: [DRIFT],
        nominal: [Some(3.0 * RecordingConfig::default().k)],
        noise_sd: Some(1e-7),
        parameter_settle: 0.5,
        ..EstimatorConfig::new(period)
    }
}

#[test]
fn a_wrong_nominal_parameter_leaves_no_transient() {
    for (period, block, substeps) in [(0.02, 1, 1), (1e-3, 1, 1), (1e-3, 10, 1), (1e-4, 1, 10), (1.25e-4, 40, 1)] {
        let flight = flight(period, 3.0, DRIFT, 1.5);
        let mut estimator = Estimator::new(&misled(period, block, substeps)).unwrap();
        let (mut before, mut first, mut after) = (0.0, None, 0.0_f64);
        for n in 0..flight.positions.len() {
            if n % substeps as usize == 0 {
                estimator.measure(&[Some(flight.positions[n] as f32)]).unwrap();
            }
            let error = |v: f32| (f64::from(v) - flight.velocities[n]).abs();
            match (estimator.state_status()[0], estimator.states()[0]) {
                (StateStatus::Identified, Some(state)) => {
                    first.get_or_insert((n as f64 * period, error(state.velocity)));
                    after = after.max(error(state.velocity));
                    assert!((f64::from(state.position) - flight.positions[n]).abs() < 2e-6, "position at {n}");
                }
                (_, Some(state)) => {
                    assert!(first.is_none(), "back to the nominal one");
                    before = error(state.velocity);
                }
                (_, None) => {}
            }
            estimator.apply(&[flight.forces[n] as f32]);
        }
        let (at, first) = first.expect("identified");
        println!(
            "T {period} s x {substeps}, block {block}: {before:.2} m/s off, then at {at:.3} s {first:.1e}, later at most {after:.1e}"
        );
        assert!(before > 0.1 && first <= 1e-4 && after <= 1e-4);
        assert!(at <= 0.5 + 2.0 * period * f64::from(block.max(8) * substeps));
    }
}

/// An observer that is not seeded does leave one: the textbook observer given the true k at the same time.
#[test]
fn the_transient_is_there_without_a_seed() {
    let (period, flight) = (1e-3, flight(1e-3, 1.0, DRIFT, 1.5));
    let k = RecordingConfig::default().k;
    let mut observer = TwinObserver::new(10.0, 5.0, period, 3.0 * k, DRIFT);
    let mut error = 0.0;
    for n in 0..600 {
        if n == 500 {
            observer.set_k(k);
        }
        let moments = if n == 0 { Moments::default() } else { Moments::held(flight.forces[n - 1], period) };
        if let Some((_, velocity)) = observer.update(Some(flight.positions[n]), moments.j1, moments.j2) {
            error = (velocity - flight.velocities[n]).abs();
        }
    }
    assert!(error > 0.1, "0.1 s after the change: {error}");
}

/// Three axes share a parameter: each is seeded at one of its own next steps, and is on the nominal one until then.
#[test]
fn pooled_axes_are_seeded_in_turn() {
    for block in [1, 10] {
        let (period, drifts) = (1e-3, [0.0, 0.0, DRIFT]);
        let flights: [Recording; 3] = std::array::from_fn(|i| flight(period, 2.0, drifts[i], 1.0 + 0.3 * i as f64));
        let mut estimator = Estimator::<3, 1>::new(&EstimatorConfig {
            block,
            drift: drifts,
            nominal: [Some(3.0 * RecordingConfig::default().k)],
            noise_sd: Some(1e-7),
            parameter_settle: 0.5,
            ..EstimatorConfig::new(period)
        })
        .unwrap();
        let (mut seeded, mut worst) = ([None; 3], 0.0_f64);
        for n in 0..2000 {
            estimator.measure(&flights.each_ref().map(|f| Some(f.positions[n] as f32))).unwrap();
            for axis in 0..3 {
                if estimator.state_status()[axis] == StateStatus::Identified {
                    seeded[axis].get_or_insert(n);
                    let velocity = f64::from(estimator.states()[axis].unwrap().velocity);
                    worst = worst.max((velocity - flights[axis].velocities[n]).abs());
                } else {
                    assert_eq!(seeded[axis], None, "axis {axis} fell back at {n}");
                }
            }
            estimator.apply(&flights.each_ref().map(|f| f.forces[n] as f32));
        }
        println!("block {block}: seeded at {seeded:?}, velocity off by {worst:.1e} m/s at most from then on");
        assert!(worst <= 1e-4);
        let mut order = seeded.map(|at| at.expect("seeded"));
        assert!(order.iter().all(|&n| n <= 500 + 3 * block.max(8) as usize));
        order.sort_unstable();
        assert!(order[0] < order[1] && order[1] < order[2], "one an instant: {order:?}");
    }
}

/// With noise: the seed is the estimate, at the identifier's tuning, of an observer that knew k̂ all along.
#[test]
fn the_seed_is_the_retroactive_estimate() {
    let (period, sigma) = (2e-3, 0.003);
    let tuning = Tuning { lambda: 3.0, q: 1.0 };
    for seed in 0..20 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let flight = flight(period, 2.0, DRIFT, 1.5);
        let mut config = EstimatorConfig { identifier: tuning, noise_sd: Some(sigma), ..misled(period, 1, 1) };
        config.parameter_settle = 0.3 + 0.05 * seed as f64;
        let mut estimator = Estimator::new(&config).unwrap();
        let mut twin = RetroactiveObserver::new(tuning.lambda, tuning.q, period, DRIFT);
        let mut moments = Moments::default();
        let compared = (0..flight.positions.len()).find_map(|n| {
            let noise: f64 = rng.sample(StandardNormal);
            let y = (flight.positions[n] + sigma * noise) as f32;
            estimator.measure(&[Some(y)]).unwrap();
            twin.update(Some(f64::from(y)), moments.j1, moments.j2);
            let f = flight.forces[n] as f32;
            moments = Moments::held(f64::from(f), period);
            if estimator.state_status()[0] == StateStatus::Identified {
                let (state, k) = (estimator.states()[0].unwrap(), estimator.parameters()[0].unwrap().value);
                let (position, velocity) = twin.estimate(f64::from(k)).unwrap();
                return Some((f64::from(state.position) - position, f64::from(state.velocity) - velocity));
            }
            estimator.apply(&[f]);
            None
        });
        let (position, velocity) = compared.expect("identified");
        println!("seed {seed}: core - retroactive twin {position:.1e} m, {velocity:.1e} m/s");
        assert!(position.abs() < 2e-6 && velocity.abs() < 2e-5, "{position:e}, {velocity:e}");
    }
}
