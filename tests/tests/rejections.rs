//! What is wrong with a measurement or an input is counted and does no harm.

use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::{HeldInputAxis, Motion, Recording, RecordingConfig, record};

const PERIOD: f64 = 1e-3;

fn flight(samples: usize) -> Recording {
    let motion = Motion { centre: 3.0, amplitude: 1.0, frequency: 1.3 };
    record(&RecordingConfig { period: PERIOD, samples, drift: 0.0, motion, ..Default::default() })
}

fn config<const N: usize, const P: usize>() -> EstimatorConfig<N, P> {
    EstimatorConfig { noise_sd: Some(1e-7), ..EstimatorConfig::new(PERIOD) }
}

/// NaN, infinity and what is beyond the limit count, and do nothing else than being missed.
#[test]
fn rejected_measurements_are_missed_ones() {
    let flight = flight(3000);
    let limited = EstimatorConfig { position_limit: 50.0, ..config::<1, 1>() };
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 50.01, -1e30, f32::MAX];
    let (mut rejecting, mut missing) = (Estimator::new(&limited).unwrap(), Estimator::new(&limited).unwrap());
    let mut count = 0;
    for n in 0..3000 {
        let good = Some(flight.positions[n] as f32);
        let is_bad = n > 100 && n % 3 == 0;
        let given = if is_bad { Some(bad[n / 3 % bad.len()]) } else { good };
        rejecting.measure(&[given]).unwrap();
        missing.measure(&[if is_bad { None } else { good }]).unwrap();
        count += u32::from(is_bad);
        assert_eq!(rejecting.states(), missing.states());
        assert_eq!(rejecting.parameters(), missing.parameters());
        rejecting.apply(&[flight.forces[n] as f32]);
        missing.apply(&[flight.forces[n] as f32]);
    }
    let (r, m) = (rejecting.counters(), missing.counters());
    assert_eq!((r.missed, r.rejected_measurements, r.rejected_inputs), (count, count, 0));
    assert_eq!((m.missed, m.rejected_measurements), (count, 0));
    assert!((f64::from(rejecting.parameters()[0].unwrap().value) * 1.3 - 1.0).abs() < 2e-6);
}

/// "Measurements that were not finite or beyond the limit" are counted as rejected.
#[test]
fn a_measurement_of_nan_is_rejected() {
    let mut estimator = Estimator::<1, 1>::new(&config()).unwrap();
    estimator.measure(&[Some(f32::NAN)]).unwrap();
    assert_eq!(estimator.counters().rejected_measurements, 1);
}

/// A rejected input counts and is replaced by the axis's mean input of late: the last one, where every control tick is a
/// measurement.
#[test]
fn rejected_inputs_are_the_last_good_one() {
    let limited = EstimatorConfig { input_limit: 100.0, ..config::<1, 1>() };
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 100.1, -1e30];
    let (mut rejecting, mut repeating) = (Estimator::new(&limited).unwrap(), Estimator::new(&limited).unwrap());
    let flight = flight(2000);
    let (mut good, mut count) = (0.0, 0);
    for n in 0..2000 {
        let y = [Some(flight.positions[n] as f32)];
        rejecting.measure(&y).unwrap();
        repeating.measure(&y).unwrap();
        if n % 4 == 2 {
            count += 1;
            rejecting.apply(&[bad[n % bad.len()]]);
        } else {
            good = flight.forces[n] as f32;
            rejecting.apply(&[good]);
        }
        repeating.apply(&[good]);
        assert_eq!((rejecting.states(), rejecting.parameters()), (repeating.states(), repeating.parameters()));
    }
    assert_eq!(rejecting.counters().rejected_inputs, count);
    assert_eq!(repeating.counters().rejected_inputs, 0);
}

/// The same within a longer interval, and in a ramp: on an input that stays, nothing is lost.
#[test]
fn rejected_inputs_of_a_constant_flight() {
    let mut axis = HeldInputAxis { position: 0.5, velocity: 1.0, k: 0.7, drift: -9.81 };
    let hover = (9.81 / 0.7) as f32;
    let limited = EstimatorConfig { substeps: 5, drift: [-9.81], ..config::<1, 1>() };
    let mut estimator = Estimator::new(&limited).unwrap();
    for n in 0..5000 {
        if n % 5 == 0 {
            estimator.measure(&[Some(axis.position as f32)]).unwrap();
        }
        match n % 7 {
            3 if n > 100 => estimator.apply(&[f32::NAN]),
            5 if n > 100 => estimator.apply_ramp(&[hover], &[f32::INFINITY]),
            6 if n > 100 => estimator.apply_ramp(&[f32::NAN], &[-1e30]),
            _ => estimator.apply(&[hover]),
        }
        axis.step(f64::from(hover), PERIOD);
    }
    let found = f64::from(estimator.parameters()[0].expect("valid").value);
    println!("k off by {:.1e}, rejected {}", found / 0.7 - 1.0, estimator.counters().rejected_inputs);
    assert!((found / 0.7 - 1.0).abs() < 2e-6 && estimator.counters().rejected_inputs > 2500);
}
