//! What the regression hands out besides k, D and d: signals, statuses, counts, and states between measurements.

use fsb_core::Tuning;
use fsb_core::estimator::{OutOfStep, StateStatus};
use fsb_core::readout::{ParameterRule, ParameterStatus};
use fsb_core::regression::{DragConfig, DragEstimator, Term};
use fsb_tests::drag_flight::{DRIFT, DragFlight, FLIGHT, Flyer, estimator, feed, fly, value};
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// Every signal in its unit: with the true k, D and d, ẑ2 = k ẑ0 - D ẑv + d ẑu; ẑu ends at 1; and the residual is what is left.
#[test]
fn the_inner_signals_obey_the_identity() {
    let mut estimator = estimator(FLIGHT.period);
    let (mut flyer, mut rng) = (Flyer::new(&FLIGHT), Pcg64::seed_from_u64(3));
    let mut largest = [0.0_f64; 3];
    for n in 0..1500 {
        let instant = flyer.step(&FLIGHT, &mut rng);
        estimator.measure(&instant.measured.map(Some)).expect("in step");
        for (i, d) in estimator.diagnostics().into_iter().enumerate() {
            let [z2, z0, zv, zu] = [d.z2, d.z0, d.zv, d.zu].map(f64::from);
            let left = z2 - (FLIGHT.k * z0 - FLIGHT.drag[i] * zv + FLIGHT.disturbance[i] * zu);
            assert!(left.abs() < 2e-4, "{n}, axis {i}: {left:e} of {z2}");
            if n < 2 {
                assert_eq!(d.residual, 0.0, "nothing is credible yet");
            }
            if n > 1000 {
                assert!((zu - 1.0).abs() < 1e-3 && d.residual.abs() < 3e-4, "{n}, axis {i}: {d:?}");
                largest[i] = largest[i].max(z2.abs().min(zv.abs()));
            }
        }
        estimator.apply(&instant.force);
    }
    assert!(largest.iter().all(|&x| x > 0.05), "{largest:?}");
}

/// A term is told with its value, from the first instant on: rows come every so many measurements, and what they say is worked out
/// in between.
#[test]
fn no_term_before_its_value() {
    for (period, noise) in [(0.001, 0.0), (0.002, 0.01), (0.01, 0.001)] {
        let flight = DragFlight { period, noise, ..FLIGHT };
        let mut estimator = estimator(period);
        let (mut flyer, mut rng) = (Flyer::new(&flight), Pcg64::seed_from_u64(8));
        let mut told = [[false; 2]; 3];
        for n in 0..(20.0 / period) as u32 {
            feed(&mut estimator, &flyer.step(&flight, &mut rng));
            for (axis, terms) in estimator.terms().into_iter().enumerate() {
                let truths = [flight.drag[axis], flight.disturbance[axis]];
                for (of, (term, truth)) in [terms.drag, terms.disturbance].into_iter().zip(truths).enumerate() {
                    if let Term::Known { value, sd } = term {
                        let (off, sd) = (f64::from(value) - truth, f64::from(sd));
                        assert!(off.abs() < 6.0 * sd + 0.02, "{period} s, {n}, axis {axis}: {term:?}, truth {truth}");
                        told[axis][of] = true;
                    }
                }
            }
        }
        assert_eq!(told, [[true; 2]; 3]);
    }
}

/// With k, D and d that were identified in another air the residual tells how much is unexplained.
#[test]
fn the_residual_is_what_is_not_explained() {
    let mut estimator = estimator(FLIGHT.period);
    let (mut flyer, mut rng) = (Flyer::new(&FLIGHT), Pcg64::seed_from_u64(4));
    for _ in 0..60_000 {
        feed(&mut estimator, &flyer.step(&FLIGHT, &mut rng));
    }
    let gust = DragFlight { disturbance: FLIGHT.disturbance.map(|d| d + 0.5), ..FLIGHT };
    for _ in 0..400 {
        feed(&mut estimator, &flyer.step(&gust, &mut rng));
    }
    // Three stages of 0.5 s see most of a step after 4 s: 1 - e^(-8)(1 + 8 + 32).
    for d in estimator.diagnostics() {
        assert!((d.residual - 0.5 * 0.986).abs() < 0.02, "{d:?}");
    }
}

/// White noise of σ on the positions leaves σ² λ⁵ T 3/16 in ẑ2: the mean square over rows, of an axis that hardly moves.
#[test]
fn the_residual_variance_is_that_of_the_noise() {
    let (sigma, lambda) = (0.01, 5.0);
    let flight = DragFlight { noise: sigma, ..FLIGHT };
    let config = DragConfig { drift: DRIFT, identifier: Tuning::from_lambda(lambda), ..DragConfig::new(flight.period) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    assert_eq!(estimator.residual_variance(), [None; 3]);
    fly(&mut estimator, &flight, 400.0, 5);
    let expected = sigma * sigma * lambda.powi(5) * flight.period * 3.0 / 16.0;
    for variance in estimator.residual_variance() {
        let ratio = f64::from(variance.expect("rows")) / expected;
        println!("seed 5: residual variance {ratio:.3} of what white noise leaves");
        assert!((0.8..1.2).contains(&ratio), "{ratio}");
    }
}

/// Between measurements position and velocity follow what is applied.
#[test]
fn states_at_every_control_instant() {
    let flight = DragFlight { period: 0.002, ..FLIGHT };
    let config = DragConfig { drift: DRIFT, substeps: 10, ..DragConfig::new(flight.period) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    let (mut flyer, mut rng) = (Flyer::new(&flight), Pcg64::seed_from_u64(6));
    for n in 0..7500 {
        let instant = flyer.step(&flight, &mut rng);
        if n % 10 == 0 {
            estimator.measure(&instant.measured.map(Some)).expect("in step");
        }
        if n > 5000 {
            for i in 0..3 {
                let state = estimator.states()[i].expect("usable");
                let off = (f64::from(state.velocity) - instant.velocity[i]).abs();
                assert!(off < 1e-4 && (state.position - instant.measured[i]).abs() < 1e-5, "{n}, axis {i}: {off:e}");
            }
        }
        estimator.apply(&instant.force);
    }
}

/// A force that goes linearly from instant to instant, in closed form without drag: y = c t²/2 + k (t³/6) slopes. Told as ramps, k is
/// exact; a measurement period is four control periods.
#[test]
fn inputs_that_are_ramps() {
    let (period, k) = (0.005, 0.8);
    let config = DragConfig { substeps: 4, ..DragConfig::new(period) };
    let mut estimator = DragEstimator::<1>::new(&config).expect("a valid configuration");
    let force = |n: u32| ((0.03 * f64::from(n)).sin() + 0.5 * (0.011 * f64::from(n)).cos()) as f32;
    let (mut y, mut v) = (0.0_f64, -0.3_f64);
    for n in 0..6000 {
        if n % 4 == 0 {
            estimator.measure(&[Some(y as f32)]).expect("in step");
        }
        let (from, to) = (force(n), force(n + 1));
        estimator.apply_ramp(&[from], &[to]);
        let (from, to) = (k * f64::from(from), k * f64::from(to));
        y += period * v + period * period * (2.0 * from + to) / 6.0;
        v += period * (from + to) / 2.0;
    }
    let identified = f64::from(estimator.parameter().expect("valid").value);
    assert!((identified / k - 1.0).abs() < 1e-4, "{identified}");
    assert!((value(estimator.terms()[0].drag)).abs() < 1e-4 && value(estimator.terms()[0].disturbance).abs() < 1e-4);
}

/// Why a state is handed out or not, from the first instant on.
#[test]
fn the_status_of_a_state() {
    let base = DragConfig { drift: DRIFT, state_settle: 0.1, parameter_settle: 5.0, ..DragConfig::new(FLIGHT.period) };
    for nominal in [None, Some(0.7)] {
        let mut estimator = DragEstimator::new(&DragConfig { nominal, ..base }).expect("a valid configuration");
        let (mut flyer, mut rng) = (Flyer::new(&FLIGHT), Pcg64::seed_from_u64(8));
        assert_eq!(estimator.state_status(), [StateStatus::NotMeasured; 3]);
        for n in 0..1000 {
            feed(&mut estimator, &flyer.step(&FLIGHT, &mut rng));
            let [status, ..] = estimator.state_status();
            let before = if nominal.is_some() { StateStatus::Nominal } else { StateStatus::NoParameter };
            let expected = match n {
                0..10 => StateStatus::Settling,
                10..500 => before,
                // One row, and a block of work, later.
                500..520 => status,
                _ => StateStatus::Identified,
            };
            assert_eq!(status, expected, "{n}");
            let usable = matches!(status, StateStatus::Nominal | StateStatus::Identified);
            assert_eq!(estimator.states()[0].is_some(), usable, "{n}");
        }
        estimator.reset();
        assert_eq!((estimator.state_status(), estimator.parameter()), ([StateStatus::NotMeasured; 3], None));
        // The same flight again: nothing is left of the first one.
        let mut fresh = DragEstimator::new(&DragConfig { nominal, ..base }).expect("a valid configuration");
        for estimator in [&mut estimator, &mut fresh] {
            fly(estimator, &FLIGHT, 6.0, 8);
        }
        assert_eq!((estimator.parameter(), estimator.states()), (fresh.parameter(), fresh.states()));
    }
}

/// The ways in which k is not valid.
#[test]
fn the_status_of_k() {
    let with = |min: f64, max: f64, max_relative_sd: f64, settle: f64| DragConfig {
        drift: DRIFT,
        rule: ParameterRule { min, max, max_relative_sd },
        parameter_settle: settle,
        ..DragConfig::new(FLIGHT.period)
    };
    let flight = DragFlight { noise: 0.002, ..FLIGHT };
    for (config, seconds, expected) in [
        (with(0.1, 10.0, 0.05, 0.0), 10.0, ParameterStatus::Valid),
        (with(0.1, 10.0, 0.05, 20.0), 10.0, ParameterStatus::Settling),
        (with(0.9, 10.0, 0.05, 0.0), 10.0, ParameterStatus::BelowRange),
        (with(0.1, 0.6, 0.05, 0.0), 10.0, ParameterStatus::AboveRange),
        (with(0.1, 10.0, 1e-6, 0.0), 10.0, ParameterStatus::Uncertain),
    ] {
        let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
        fly(&mut estimator, &flight, seconds, 9);
        assert_eq!(estimator.parameter_status(), expected, "{:?}", config.rule);
        assert_eq!(estimator.parameter().is_some(), expected == ParameterStatus::Valid);
        if expected != ParameterStatus::Valid {
            for terms in estimator.terms() {
                assert_eq!([terms.drag, terms.disturbance], [Term::NotObservable; 2], "{expected}");
            }
        }
    }
}

/// Nothing applied, nothing moved: nothing can be said.
#[test]
fn without_input_k_is_unexcited() {
    let mut estimator = estimator(FLIGHT.period);
    for _ in 0..500 {
        estimator.measure(&[Some(1.0), Some(-2.0), Some(0.5)]).expect("in step");
        estimator.apply(&[0.0; 3]);
    }
    assert_eq!((estimator.parameter_status(), estimator.parameter()), (ParameterStatus::Unexcited, None));
}

/// Measurements missed and rejected, inputs rejected, instants passed over, and one that came early.
#[test]
fn what_is_counted() {
    let config = DragConfig { drift: DRIFT, substeps: 2, ..DragConfig::new(0.005) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    let force = [0.0, 0.0, 12.0];
    // Before the first instant at which every axis is measured it only counts.
    estimator.measure(&[Some(0.0), None, Some(2e5)]).expect("not started");
    estimator.apply(&force);
    estimator.measure(&[Some(0.0); 3]).expect("not started");
    assert_eq!(estimator.measure(&[Some(0.0); 3]), Err(OutOfStep { missing: 2 }));
    estimator.apply(&[f32::NAN, 0.0, 1e6]);
    assert_eq!(estimator.measure(&[Some(0.0); 3]), Err(OutOfStep { missing: 1 }));
    estimator.apply(&force);
    estimator.measure(&[Some(f32::NAN), Some(1e5), Some(-1e5)]).expect("in step");
    // Two instants go by.
    for _ in 0..5 {
        estimator.apply(&force);
    }
    let counters = estimator.counters();
    assert_eq!((counters.missed, counters.rejected_measurements, counters.rejected_inputs), (2 + 1 + 6, 2, 2));
}

/// A rejected input is the mean of those before it in the interval, or of the interval before.
#[test]
fn what_stands_in_for_an_input() {
    let (period, k) = (0.005_f64, 0.8);
    let config = DragConfig { substeps: 4, ..DragConfig::new(period) };
    let mut estimator = DragEstimator::<1>::new(&config).expect("a valid configuration");
    let mut told = DragEstimator::<1>::new(&config).expect("a valid configuration");
    let (mut y, mut v) = (0.0_f64, 0.1_f64);
    let (mut last, mut sum) = (0.0, 0.0);
    for n in 0..4000_u32 {
        if n.is_multiple_of(4) {
            for estimator in [&mut estimator, &mut told] {
                estimator.measure(&[Some(y as f32)]).expect("in step");
            }
            (last, sum) = (sum / 4.0, 0.0);
        }
        let position = n % 4;
        let mean = if position == 0 { last } else { sum / f64::from(position) };
        let bad = n > 100 && (n.is_multiple_of(44) || n % 37 == 5);
        let f = if bad { mean as f32 } else { (0.01 * f64::from(n)).sin() as f32 + 0.3 * (n % 3) as f32 };
        told.apply(&[f]);
        estimator.apply(&[if bad { f32::NAN } else { f }]);
        sum += f64::from(f);
        y += period * v + 0.5 * period * period * k * f64::from(f);
        v += period * k * f64::from(f);
    }
    let [identified, told] = [estimator, told].map(|e| f64::from(e.parameter().expect("valid").value));
    assert!((identified / told - 1.0).abs() < 1e-5 && (told / k - 1.0).abs() < 1e-3, "{identified}, {told}");
}
