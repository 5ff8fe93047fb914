//! k, drag and disturbance together, against plants that obey the model exactly.

use fsb_core::readout::Memory;
use fsb_core::regression::{DragConfig, DragEstimator, Identify, Term};
use fsb_tests::drag_flight::{DRIFT, DragFlight, FLIGHT, Flyer, estimator, feed, fly, fly_on, value};
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// D from 0 to 1 1/s, three axes, 50 Hz to 1 kHz: k relative, D (1/s) and d (m/s²) to 1e-3.
#[test]
fn exact() {
    for period in [0.02, 0.01, 0.004, 0.001] {
        for drag in [[0.0; 3], [0.35, 0.5, 0.2], [1.0; 3]] {
            let flight = DragFlight { period, drag, ..FLIGHT };
            let mut estimator = estimator(period);
            fly(&mut estimator, &flight, 10.0, 1);
            let k = f64::from(estimator.parameter().expect("valid").value) / flight.k - 1.0;
            let mut worst = [0.0_f64; 2];
            for (i, terms) in estimator.terms().into_iter().enumerate() {
                worst[0] = worst[0].max((value(terms.drag) - drag[i]).abs());
                worst[1] = worst[1].max((value(terms.disturbance) - flight.disturbance[i]).abs());
            }
            println!("{period} s, D {drag:?}: k {k:.1e}, D {:.1e}, d {:.1e}", worst[0], worst[1]);
            assert!(k.abs() < 1e-3 && worst[0] < 1e-3 && worst[1] < 1e-3);
        }
    }
}

/// Only what is asked for is identified; what is not counts as zero.
#[test]
fn as_chosen_per_axis() {
    let drag = Identify { drag: true, disturbance: false };
    let disturbance = Identify { drag: false, disturbance: true };
    let identify = [drag, disturbance, Identify::NOTHING_ELSE];
    let flight = DragFlight { drag: [0.35, 0.0, 0.0], disturbance: [0.0, -0.4, 0.0], ..FLIGHT };
    let config = DragConfig { drift: DRIFT, identify, ..DragConfig::new(flight.period) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    fly(&mut estimator, &flight, 10.0, 6);
    let [x, y, z] = estimator.terms();
    assert!((value(x.drag) - 0.35).abs() < 1e-3 && x.disturbance == Term::NotAsked, "{x:?}");
    assert!((value(y.disturbance) + 0.4).abs() < 1e-3 && y.drag == Term::NotAsked, "{y:?}");
    assert_eq!([z.drag, z.disturbance], [Term::NotAsked; 2]);
    assert!((f64::from(estimator.parameter().expect("valid").value) / flight.k - 1.0).abs() < 1e-3);
}

/// A fading memory forgets what was: d changes in flight.
#[test]
fn a_fading_memory_follows() {
    let memory = Memory::Fading { tau: 5.0 };
    let config = DragConfig { drift: DRIFT, memory, ..DragConfig::new(FLIGHT.period) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    let (mut flyer, mut rng) = (Flyer::new(&FLIGHT), Pcg64::seed_from_u64(7));
    fly_on(&mut estimator, &mut flyer, &FLIGHT, 20.0, &mut rng);
    let after = DragFlight { drag: [0.6, 0.2, 0.4], disturbance: [-0.2, 0.1, 0.0], ..FLIGHT };
    fly_on(&mut estimator, &mut flyer, &after, 60.0, &mut rng);
    for (i, terms) in estimator.terms().into_iter().enumerate() {
        println!("{i}: {terms:?}");
        assert!((value(terms.drag) - after.drag[i]).abs() < 2e-3);
        assert!((value(terms.disturbance) - after.disturbance[i]).abs() < 2e-3);
    }
}

/// Measurements at 100 Hz, control at 500 Hz, one measurement in ten missing: terms, and velocities at every control tick.
#[test]
fn slow_measurements_with_gaps() {
    let flight = DragFlight { period: 0.002, ..FLIGHT };
    let config = DragConfig { drift: DRIFT, substeps: 5, ..DragConfig::new(flight.period) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    let mut rng = Pcg64::seed_from_u64(9);
    let mut worst = 0.0_f64;
    for (n, instant) in flight.fly(20.0, &mut rng).enumerate() {
        if n % 5 == 0 {
            let missing = n >= 2500 && (n / 5) % 10 == 3;
            estimator.measure(&instant.measured.map(|y| (!missing).then_some(y))).expect("in step");
        }
        for (state, truth) in estimator.states().into_iter().zip(instant.velocity) {
            if let Some(state) = state.filter(|_| instant.t > 8.0) {
                worst = worst.max((f64::from(state.velocity) - truth).abs());
            }
        }
        estimator.apply(&instant.force);
    }
    println!("{:?}, velocity to {worst:.1e} m/s", estimator.terms());
    for (i, terms) in estimator.terms().into_iter().enumerate() {
        assert!((value(terms.drag) - flight.drag[i]).abs() < 1e-3);
        assert!((value(terms.disturbance) - flight.disturbance[i]).abs() < 1e-3);
    }
    assert!(estimator.states().iter().all(Option::is_some) && worst > 0.0 && worst < 1e-4);
}

/// k, then D and d of each axis, by the normal equations in f64.
#[derive(Default)]
struct Normal {
    matrix: [[f64; 8]; 7],
}

impl Normal {
    fn add(&mut self, estimator: &DragEstimator<3>) {
        for (i, d) in estimator.diagnostics().into_iter().enumerate() {
            let mut row = [0.0; 8];
            row[0] = f64::from(d.z0);
            row[1 + 2 * i] = -f64::from(d.zv);
            row[2 + 2 * i] = f64::from(d.zu);
            row[7] = f64::from(d.z2);
            for (equation, x) in self.matrix.iter_mut().zip(row) {
                for (sum, y) in equation.iter_mut().zip(row) {
                    *sum += x * y;
                }
            }
        }
    }

    fn solve(mut self) -> [f64; 7] {
        for i in 0..7 {
            let pivot = self.matrix[i];
            for (j, row) in self.matrix.iter_mut().enumerate().filter(|&(j, _)| j != i) {
                let factor = row[i] / pivot[i];
                assert!(factor.is_finite(), "{i} {j}");
                row.iter_mut().zip(pivot).for_each(|(x, p)| *x -= factor * p);
            }
        }
        [0, 1, 2, 3, 4, 5, 6].map(|i| self.matrix[i][7] / self.matrix[i][i])
    }
}

/// Nothing stagnates: half an hour with one drag, half an hour with twice as much, all rows alike. No model fits both; what fits
/// best is what sums in f64 say.
#[test]
fn an_hour_at_a_thousand_hertz() {
    let first = DragFlight { period: 1e-3, ..FLIGHT };
    let second = DragFlight { drag: first.drag.map(|d| 2.0 * d), ..first };
    let mut estimator = estimator(first.period);
    let (mut flyer, mut rng, mut normal) = (Flyer::new(&first), Pcg64::seed_from_u64(10), Normal::default());
    for n in 0..3_600_000 {
        let flight = if n < 1_800_000 { &first } else { &second };
        feed(&mut estimator, &flyer.step(flight, &mut rng));
        if n % 50 == 0 {
            normal.add(&estimator);
        }
    }
    let k = f64::from(estimator.parameter().expect("valid").value);
    let solution = normal.solve();
    println!("k {k}, f64 {}", solution[0]);
    assert!((k / solution[0] - 1.0).abs() < 1e-4);
    for (terms, expected) in estimator.terms().into_iter().zip(solution[1..].chunks_exact(2)) {
        println!("{terms:?}, f64 {expected:?}");
        assert!(
            (value(terms.drag) - expected[0]).abs() < 1e-3 && (value(terms.disturbance) - expected[1]).abs() < 1e-3
        );
    }
}

/// When k̂ becomes valid with D and d known, position and velocity are right at once.
#[test]
fn right_at_once() {
    let config = DragConfig { drift: DRIFT, parameter_settle: 6.0, ..DragConfig::new(FLIGHT.period) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    let (mut flyer, mut rng) = (Flyer::new(&FLIGHT), Pcg64::seed_from_u64(13));
    let mut seen = 0;
    while seen < 20 {
        let instant = flyer.step(&FLIGHT, &mut rng);
        estimator.measure(&instant.measured.map(Some)).expect("in step");
        for ((state, truth), y) in estimator.states().into_iter().zip(instant.velocity).zip(instant.measured) {
            let Some(state) = state else { continue };
            seen += 1;
            let off = (f64::from(state.velocity) - truth).abs();
            assert!(off < 1e-4 && (state.position - y).abs() < 1e-5, "{} s: {off} m/s", instant.t);
        }
        assert!(instant.t < 7.0 && estimator.terms().iter().all(|t| seen == 0 || t.drag.value().is_some()));
        estimator.apply(&instant.force);
    }
}
