//! What is configured is what is done: each of these is of a value that no other test would miss.

use fsb_core::ConfigError::{self, Negative, NonFinite, NonPositive, OutOfRange};
use fsb_core::estimator::SharedConfig;
use fsb_core::guard::{GuardConfig, Guarded};
use fsb_core::readout::ParameterRule;
use fsb_core::{Estimator, EstimatorConfig, Tuning};
use fsb_sim_host::plant::{HeldInputAxis, Motion, RecordingConfig, record};

const PERIOD: f64 = 0.01;

fn falling() -> EstimatorConfig<1, 1> {
    EstimatorConfig { drift: [-9.81], nominal: [Some(1.0)], ..EstimatorConfig::new(PERIOD) }
}

fn configure(estimator: &mut Estimator<1, 1>, shared: &SharedConfig) -> Result<(), ConfigError> {
    let mut configuring = estimator.configuring();
    configuring.shared(shared);
    configuring.drift(0, -9.81);
    configuring.parameter(0, 1.0, &ParameterRule::DEFAULT);
    configuring.finish()
}

/// Two seconds of measurements; whether a state was handed out at any time.
fn hands_out(estimator: &mut Estimator<1, 1>) -> bool {
    let mut axis = HeldInputAxis { position: 1.0, velocity: 0.0, k: 2.0, drift: -9.81 };
    let mut handed_out = false;
    for tick in 0..200 {
        let _ = estimator.measure(&[Some(axis.position as f32)]);
        handed_out |= estimator.states()[0].is_some() || estimator.parameters()[0].is_some();
        let force = if tick % 50 < 25 { 5.5 } else { 4.5 };
        estimator.apply(&[force]);
        axis.step(f64::from(force), PERIOD);
    }
    handed_out
}

/// An estimator that was refused takes nothing in and hands nothing out, until it is configured anew; also one that flew before.
#[test]
fn a_refused_estimator_does_nothing() {
    let good = falling().shared();
    let mut estimator = Estimator::unconfigured();
    assert!(!hands_out(&mut estimator));
    for (bad, expected) in [
        (SharedConfig { readout: 2, ..good }, OutOfRange("readout")),
        (SharedConfig { max_misfit: 1.5, ..good }, OutOfRange("max_misfit")),
    ] {
        assert_eq!(configure(&mut estimator, &bad), Err(expected));
        assert!(!hands_out(&mut estimator), "{expected}");
        assert_eq!(configure(&mut estimator, &good), Ok(()));
        assert!(hands_out(&mut estimator));
    }
}

/// The known drift counts on whichever axis it is, the first or the last.
#[test]
fn a_drift_on_any_axis() {
    for drift in [[-9.81, 0.0], [0.0, -9.81]] {
        let config = EstimatorConfig { drift, ..EstimatorConfig::<2, 1>::new(PERIOD) };
        let mut estimator = Estimator::new(&config).unwrap();
        let mut axes = drift.map(|drift| HeldInputAxis { position: 0.5, velocity: 0.2, k: 2.0, drift });
        for tick in 0..300 {
            estimator.measure(&axes.each_ref().map(|axis| Some(axis.position as f32))).unwrap();
            let wave = if tick % 50 < 25 { 0.5 } else { -0.5 };
            let forces = drift.map(|drift| (wave - drift / 2.0) as f32);
            estimator.apply(&forces);
            axes.iter_mut().zip(forces).for_each(|(axis, force)| axis.step(f64::from(force), PERIOD));
        }
        let k = estimator.parameters()[0].unwrap().value;
        assert!((k / 2.0 - 1.0).abs() < 1e-5, "{drift:?}: {k}");
    }
}

/// The noise of a measurement is given, whatever the block: before it can have been learned, the standard deviation of k is the
/// same with blocks of eight to 20 %.
#[test]
fn noise_is_that_of_a_measurement() {
    let motion = Motion { centre: 0.0, amplitude: 1.0, frequency: 3.0 };
    let flight = record(&RecordingConfig { samples: 300, drift: 0.0, motion, ..Default::default() });
    let sd = |block| {
        let rule = [ParameterRule { max_relative_sd: 1e6, ..ParameterRule::DEFAULT }];
        let config = EstimatorConfig {
            block,
            rule,
            noise_sd: Some(1e-3),
            max_misfit: None,
            ..EstimatorConfig::<1, 1>::new(1e-3)
        };
        let mut estimator = Estimator::new(&config).unwrap();
        for (&y, &f) in flight.positions.iter().zip(&flight.forces) {
            estimator.measure(&[Some(y as f32)]).unwrap();
            estimator.apply(&[f as f32]);
        }
        f64::from(estimator.parameters()[0].unwrap().sd())
    };
    let (single, blocks) = (sd(1), sd(8));
    println!("sd of k at 0.3 s: {single:.3e} sample by sample, {blocks:.3e} by blocks");
    assert!((blocks / single - 1.0).abs() < 0.2, "{single} {blocks}");
}

/// No state before its ε, nor of an axis that was lost right after the start.
#[test]
fn no_state_before_its_time() {
    let config = EstimatorConfig { state_settle: 1.0, nominal: [Some(2.0)], ..EstimatorConfig::<2, 1>::new(PERIOD) };
    let mut estimator = Estimator::new(&config).unwrap();
    for tick in 0..200 {
        let lost = (1..4).contains(&tick);
        estimator.measure(&[Some(1.0), (!lost).then_some(-1.0)]).unwrap();
        for (index, state) in estimator.states().iter().enumerate() {
            assert_eq!(state.is_some(), tick >= 100, "axis {index}, instant {tick}");
        }
        estimator.apply(&[0.0, 0.0]);
    }
}

/// q = λ/2, and the limits that an estimator has by default.
#[test]
fn defaults_are_as_documented() {
    assert_eq!(Tuning::from_lambda(3.0), Tuning { lambda: 3.0, q: 1.5 });
    let default = EstimatorConfig::<1, 1>::new(PERIOD);
    assert_eq!((default.position_limit, default.input_limit, default.max_misfit), (1e5, 1e5, Some(0.02)));
    let beyond = |position: f32, input: f32| {
        let mut estimator = Estimator::<1, 1>::new(&default).unwrap();
        estimator.measure(&[Some(0.0)]).unwrap();
        estimator.apply(&[input]);
        estimator.measure(&[Some(position)]).unwrap();
        let counters = estimator.counters();
        (counters.rejected_measurements, counters.rejected_inputs)
    };
    assert_eq!(beyond(99_999.0, 99_999.0), (0, 0));
    assert_eq!(beyond(100_001.0, 100_001.0), (1, 1));
}

/// Every value of a gate at the ends of its range, and next to them, by name.
#[test]
fn the_ends_of_a_gate() {
    type Set = fn(&mut GuardConfig, f64);
    type Case<'a> = (Set, &'a [f64], &'a [(f64, ConfigError)]);
    let (sigmas, acceleration, floor): (Set, Set, Set) =
        (|c, x| c.sigmas = x, |c, x| c.acceleration = x, |c, x| c.floor = x);
    let (bridge, jump, frozen): (Set, Set, Set) =
        (|c, x| c.bridge = x * PERIOD, |c, x| c.jump_after = x as u32, |c, x| c.frozen_after = x as u32);
    let cases: [Case<'_>; 6] = [
        (
            sigmas,
            &[3.0, 1000.0],
            &[
                (2.99, OutOfRange("guard.sigmas")),
                (1000.1, OutOfRange("guard.sigmas")),
                (f64::NAN, NonFinite("guard.sigmas")),
            ],
        ),
        (
            acceleration,
            &[0.0, 1e6],
            &[(-1e-9, Negative("guard.acceleration")), (1.1e6, OutOfRange("guard.acceleration"))],
        ),
        (
            floor,
            &[0.0, 1e6],
            &[
                (-1e-9, Negative("guard.floor")),
                (1.1e6, OutOfRange("guard.floor")),
                (f64::INFINITY, NonFinite("guard.floor")),
            ],
        ),
        // Rounded to whole measurements.
        (
            bridge,
            &[0.6, 1.0, 65_534.0, 65_534.4],
            &[
                (0.4, OutOfRange("guard.bridge")),
                (65_534.6, OutOfRange("guard.bridge")),
                (0.0, NonPositive("guard.bridge")),
            ],
        ),
        (jump, &[2.0, 65_535.0], &[(1.0, OutOfRange("guard.jump_after")), (65_536.0, OutOfRange("guard.jump_after"))]),
        (frozen, &[0.0, 65_535.0], &[(65_536.0, OutOfRange("guard.frozen_after"))]),
    ];
    for (set, right, wrong) in cases {
        let outcome = |value| {
            let mut guard = GuardConfig::default();
            set(&mut guard, value);
            Guarded::new(&falling(), &guard).err()
        };
        for &value in right {
            assert_eq!(outcome(value), None, "{value}");
        }
        for &(value, expected) in wrong {
            assert_eq!(outcome(value), Some(expected), "{value}");
        }
    }
}
