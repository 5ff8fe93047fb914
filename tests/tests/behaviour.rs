//! What is not valid is not handed out; calls out of step, calls left out, resets.

use fsb_core::estimator::StateStatus;
use fsb_core::readout::ParameterStatus;
use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::{Motion, Recording, RecordingConfig, record};

const PERIOD: f64 = 1e-3;

fn flight(samples: usize) -> Recording {
    let motion = Motion { centre: 3.0, amplitude: 1.0, frequency: 1.3 };
    record(&RecordingConfig { period: PERIOD, samples, drift: 0.0, motion, ..Default::default() })
}

fn config<const N: usize, const P: usize>() -> EstimatorConfig<N, P> {
    EstimatorConfig { noise_sd: Some(1e-7), ..EstimatorConfig::new(PERIOD) }
}

fn debug<const N: usize, const P: usize>(estimator: &Estimator<N, P>) -> String {
    format!("{estimator:?}")
}

/// Runs `estimator` over samples `range` of `flight`, the same on all axes.
fn fly<const N: usize, const P: usize>(
    estimator: &mut Estimator<N, P>,
    flight: &Recording,
    range: std::ops::Range<usize>,
) {
    for n in range {
        estimator.measure(&[Some(flight.positions[n] as f32); N]).unwrap();
        estimator.apply(&[flight.forces[n] as f32; N]);
    }
}

/// ε of the parameter and ε of the state, to the tick; nothing before the first measurement.
#[test]
fn nothing_is_handed_out_before_its_time() {
    for substeps in [1, 4] {
        for block in [1, 8] {
            let flight = flight(2000);
            let mut estimator = Estimator::<1, 1>::new(&EstimatorConfig {
                substeps,
                block,
                nominal: [Some(1.0)],
                parameter_settle: 0.2,
                state_settle: 0.1,
                ..config()
            })
            .unwrap();
            assert_eq!((estimator.parameters(), estimator.states()), ([None], [None]));
            assert_eq!(estimator.state_status(), [StateStatus::NotMeasured]);
            assert_eq!(estimator.parameter_status(), [ParameterStatus::Settling]);
            let mut valid_from = None;
            for n in 0..2000 {
                let t = n as f64 * PERIOD;
                if n % substeps as usize == 0 {
                    estimator.measure(&[Some(flight.positions[n] as f32)]).unwrap();
                }
                let (parameter, state) = (estimator.parameters()[0], estimator.states()[0]);
                assert!(parameter.is_none() || t >= 0.2, "a parameter at {t}");
                assert_eq!(state.is_some(), t >= 0.1 - 1e-9, "state at {t}: {state:?}");
                let status = estimator.state_status()[0];
                assert_eq!(state.is_some(), matches!(status, StateStatus::Nominal | StateStatus::Identified));
                assert_eq!(parameter.is_some(), estimator.parameter_status() == [ParameterStatus::Valid]);
                assert_eq!(status == StateStatus::Identified, parameter.is_some(), "at {t}: {status}");
                if parameter.is_some() {
                    valid_from.get_or_insert(t);
                }
                estimator.apply(&[flight.forces[n] as f32]);
            }
            // A parameter has its turn once in a block, or in eight measurements.
            let late = f64::from(substeps * block.max(8)) * PERIOD;
            let valid_from = valid_from.unwrap();
            assert!(valid_from <= 0.2 + late + 1e-9, "substeps {substeps}, block {block}: from {valid_from}");
        }
    }
}

/// Nothing begins before every axis has been measured at one instant: nothing is handed out, and what is missing counts.
#[test]
fn an_axis_never_measured() {
    let flight = flight(2000);
    let mut pooled = Estimator::<3, 1>::new(&config()).unwrap();
    let mut apart = Estimator::<3, 3>::new(&config()).unwrap();
    for n in 0..2000 {
        let (y, f) = (Some(flight.positions[n] as f32), flight.forces[n] as f32);
        pooled.measure(&[y, None, y]).unwrap();
        apart.measure(&[y, None, y]).unwrap();
        pooled.apply(&[f; 3]);
        apart.apply(&[f; 3]);
    }
    for status in [pooled.state_status(), apart.state_status()] {
        assert_eq!(status, [StateStatus::NotMeasured; 3]);
    }
    assert_eq!((pooled.states(), apart.states()), ([None; 3], [None; 3]));
    assert_eq!((pooled.parameters(), apart.parameters()), ([None; 1], [None; 3]));
    assert_eq!((pooled.counters().missed, pooled.counters().rejected_measurements), (2000, 0));
}

/// When the last axis is measured at last, all begin together, dead-beat, as if it had been the first instant.
#[test]
fn a_late_axis_holds_up_the_start() {
    let flight = flight(3000);
    let nominal = [Some(RecordingConfig::default().k); 2];
    let mut estimator = Estimator::<2, 2>::new(&EstimatorConfig { nominal, ..config() }).unwrap();
    let (mut first, mut worst) = (None, 0.0_f64);
    for n in 0..3000 {
        let y = Some(flight.positions[n] as f32);
        estimator.measure(&[y, y.filter(|_| n >= 500)]).unwrap();
        for state in estimator.states().into_iter().flatten() {
            first.get_or_insert(n);
            if n >= 600 {
                worst = worst.max((f64::from(state.velocity) - flight.velocities[n]).abs());
            }
        }
        estimator.apply(&[flight.forces[n] as f32; 2]);
    }
    println!("measured from 0.5 s, handed out from {first:?} ms, from 0.6 s off by {worst:.1e} m/s at most");
    assert!((501..700).contains(&first.unwrap()) && worst < 5e-6);
}

/// The first measurement may be the one that is lost: identification must begin with the next.
#[test]
fn a_lost_first_measurement_is_not_the_end() {
    let flight = flight(3000);
    for first in [None, Some(f32::NAN)] {
        let mut estimator = Estimator::<1, 1>::new(&config()).unwrap();
        estimator.measure(&[first]).unwrap();
        estimator.apply(&[flight.forces[0] as f32]);
        fly(&mut estimator, &flight, 1..3000);
        let status = estimator.parameter_status();
        assert_eq!(status, [ParameterStatus::Valid], "first measurement {first:?}: {status:?} after 3 s");
    }
}

/// A measurement out of step is refused, says by how much, and leaves no trace.
#[test]
fn out_of_step_changes_nothing() {
    let flight = flight(500);
    let mut estimator = Estimator::<1, 1>::new(&EstimatorConfig { substeps: 5, block: 3, ..config() }).unwrap();
    for n in 0..500 {
        let y = [Some(flight.positions[n] as f32)];
        if n % 5 == 0 {
            estimator.measure(&y).unwrap();
        }
        let before = debug(&estimator);
        let refused = estimator.measure(&y).unwrap_err();
        assert_eq!(refused.missing as usize, 5 - n % 5);
        assert_eq!(debug(&estimator), before);
        estimator.apply(&[flight.forces[n] as f32]);
    }
}

/// Not calling `measure` where a measurement was due is the same as saying that there was none.
#[test]
fn a_measurement_not_given_is_a_missed_one() {
    for (substeps, block) in [(1, 1), (1, 7), (4, 1)] {
        let flight = flight(4000);
        let config = EstimatorConfig { substeps, block, ..config::<1, 1>() };
        let (mut silent, mut telling) = (Estimator::new(&config).unwrap(), Estimator::new(&config).unwrap());
        for n in 0..4000 {
            let instant = n / substeps as usize;
            if n % substeps as usize == 0 {
                let y = [Some(flight.positions[n] as f32)];
                if instant % 3 == 1 {
                    telling.measure(&[None]).unwrap();
                } else {
                    silent.measure(&y).unwrap();
                    telling.measure(&y).unwrap();
                }
            }
            silent.apply(&[flight.forces[n] as f32]);
            telling.apply(&[flight.forces[n] as f32]);
            assert_eq!(debug(&silent), debug(&telling), "substeps {substeps}, block {block}, tick {n}");
        }
        assert!(silent.counters().missed > 300);
    }
}

/// After a reset nothing of the past is left but the counters.
#[test]
fn reset_is_new() {
    let flight = flight(1500);
    let config = EstimatorConfig { block: 4, turn: 2, nominal: [Some(2.0); 2], ..config::<2, 2>() };
    let mut estimator = Estimator::new(&config).unwrap();
    let new = debug(&estimator);
    fly(&mut estimator, &flight, 0..1500);
    assert_ne!(debug(&estimator), new);
    estimator.reset();
    assert_eq!(debug(&estimator), new);
    fly(&mut estimator, &flight, 0..10);
    estimator.measure(&[None; 2]).unwrap();
    estimator.apply(&[f32::NAN; 2]);
    let counters = estimator.counters();
    estimator.reset();
    assert_eq!((counters.missed, counters.rejected_inputs), (2, 2));
    assert_eq!(estimator.counters(), counters);
}

/// `reset_identifier`: k̂ is anew, the observer goes on.
#[test]
fn reset_identifier_keeps_the_observer() {
    let flight = flight(3000);
    let k = RecordingConfig::default().k;
    let config = EstimatorConfig { nominal: [Some(k)], parameter_settle: 0.1, ..config::<1, 1>() };
    let mut estimator = Estimator::new(&config).unwrap();
    fly(&mut estimator, &flight, 0..1500);
    assert!(estimator.parameters()[0].is_some());
    estimator.reset_identifier();
    for n in 1500..3000 {
        estimator.measure(&[Some(flight.positions[n] as f32)]).unwrap();
        let (status, valid) = (estimator.state_status()[0], estimator.parameters()[0].is_some());
        assert_eq!(status == StateStatus::Identified, valid, "{n}");
        assert!(valid || status == StateStatus::Nominal, "{n}: {status}");
        // Its turn comes within eight measurements.
        assert!(if n < 1600 { !valid } else { valid || n < 1608 }, "{n}: {valid}");
        let velocity = f64::from(estimator.states()[0].unwrap().velocity);
        assert!((velocity - flight.velocities[n]).abs() < 1e-5, "{n}: {velocity}");
        estimator.apply(&[flight.forces[n] as f32]);
    }
    let found = f64::from(estimator.parameters()[0].unwrap().value);
    assert!((found / k - 1.0).abs() < 1e-6, "{found}");
}
