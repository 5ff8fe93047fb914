//! Hover: what cannot be told is not, and does not spoil what can.

use fsb_core::Tuning;
use fsb_core::readout::Memory;
use fsb_core::regression::{DragConfig, DragEstimator, Identify, Term};
use fsb_tests::drag_flight::{
    DRIFT, DragAxis, DragFlight, FLIGHT, Flyer, Instant, estimator, feed, fly, fly_on, value,
};
use rand::SeedableRng;
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;

fn is_unknown(estimator: &DragEstimator<3>) -> bool {
    estimator.terms().iter().all(|t| t.drag == Term::NotObservable && t.disturbance == Term::NotObservable)
}

/// Hover, without noise, with noise, and with a known force that flutters: k from gravity, and no D or d at any time.
#[test]
fn hover_tells_k_alone() {
    for (noise, flutter) in [(0.0, 0.0), (0.002, 0.0), (0.002, 0.01)] {
        let hover = DragFlight { amplitude: [0.0; 3], disturbance: [0.0; 3], noise, flutter, ..FLIGHT };
        let mut estimator = estimator(hover.period);
        let mut rng = Pcg64::seed_from_u64(2);
        for instant in hover.fly(60.0, &mut rng) {
            feed(&mut estimator, &instant);
            assert!(is_unknown(&estimator), "{} s: {:?}", instant.t, estimator.terms());
        }
        let k = f64::from(estimator.parameter().expect("valid").value) / hover.k - 1.0;
        println!("noise {noise} m, flutter {flutter} m/s²: k {k:.1e}");
        assert!(k.abs() < 1e-3);
    }
}

/// Two axes move, z hovers: theirs are known, its own are not, and k is right.
#[test]
fn an_axis_that_hovers_does_not_spoil_the_others() {
    let flight = DragFlight { amplitude: [0.8, 0.6, 0.0], disturbance: [0.3, -0.4, 0.0], noise: 0.001, ..FLIGHT };
    let mut estimator = estimator(flight.period);
    fly(&mut estimator, &flight, 20.0, 3);
    let [x, y, z] = estimator.terms();
    println!("{x:?} {y:?} {z:?}");
    assert_eq!([z.drag, z.disturbance], [Term::NotObservable; 2]);
    for (i, terms) in [x, y].into_iter().enumerate() {
        assert!(
            (value(terms.drag) - flight.drag[i]).abs() < 2e-3
                && (value(terms.disturbance) - flight.disturbance[i]).abs() < 2e-3
        );
    }
    assert!((f64::from(estimator.parameter().expect("valid").value) / flight.k - 1.0).abs() < 1e-3);
}

/// A steady wind on axes that do not move: their constant force tells nothing of k, be z in hover or moving.
#[test]
fn a_wind_that_cannot_be_told_does_not_spoil_k() {
    for up_and_down in [0.0, 0.5] {
        let flight =
            DragFlight { amplitude: [0.0, 0.0, up_and_down], disturbance: [2.3, -1.5, 0.0], noise: 0.001, ..FLIGHT };
        let mut estimator = estimator(flight.period);
        let (mut flyer, mut rng) = (Flyer::new(&flight), Pcg64::seed_from_u64(6));
        for _ in 0..3 {
            fly_on(&mut estimator, &mut flyer, &flight, 20.0, &mut rng);
            let k = estimator.parameter().expect("valid");
            let (off, sd) = (f64::from(k.value) / flight.k - 1.0, f64::from(k.sd()) / flight.k);
            println!("z ±{up_and_down} m, seed 6: k off by {off:.1e}, its sd {sd:.1e}");
            assert!(off.abs() < 5e-3 && off.abs() < 5.0 * sd + 1e-3, "{off} {sd}");
            let [x, y, _] = estimator.terms();
            assert_eq!([x.disturbance, y.disturbance], [Term::NotObservable; 2]);
        }
    }
}

/// The same where D alone is asked for: what varies counts beyond a constant, which is all there is to a hover.
#[test]
fn a_hover_tells_no_drag() {
    for (period, lambda, noise) in [(0.01, 2.0, 0.01), (0.002, 0.5, 0.01), (0.002, 0.5, 0.03)] {
        let (amplitude, disturbance) = ([1.0, 0.0, 0.0], [0.0; 3]);
        let flight = DragFlight { period, amplitude, disturbance, drag: [1.0, 0.0, 3.0], noise, ..FLIGHT };
        let config = DragConfig {
            drift: DRIFT,
            identify: [Identify { drag: true, disturbance: false }; 3],
            identifier: Tuning::from_lambda(lambda),
            memory: Memory::Fading { tau: 10.0 / lambda },
            ..DragConfig::new(period)
        };
        let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
        let mut rng = Pcg64::seed_from_u64(9);
        for instant in flight.fly(60.0, &mut rng) {
            feed(&mut estimator, &instant);
            let [_, y, z] = estimator.terms();
            assert_eq!([y.drag, z.drag], [Term::NotObservable; 2], "{lambda} 1/s, seed 9, {} s", instant.t);
        }
        let k = f64::from(estimator.parameter().expect("valid").value) / flight.k - 1.0;
        assert!(k.abs() < 1e-3, "{k}");
    }
}

/// What has been learnt in flight stays known in the hover after it.
#[test]
fn known_terms_stay_known() {
    let mut estimator = estimator(FLIGHT.period);
    let flight = DragFlight { noise: 0.001, ..FLIGHT };
    let (mut flyer, mut rng) = (Flyer::new(&flight), Pcg64::seed_from_u64(4));
    fly_on(&mut estimator, &mut flyer, &flight, 30.0, &mut rng);
    let before = estimator.terms();
    let hover = DragFlight { amplitude: [0.0; 3], ..flight };
    fly_on(&mut estimator, &mut flyer, &hover, 120.0, &mut rng);
    for (i, (terms, before)) in estimator.terms().into_iter().zip(before).enumerate() {
        println!("{i}: {terms:?}, in flight {before:?}");
        assert!((value(terms.drag) - FLIGHT.drag[i]).abs() < 0.01);
        assert!((value(terms.disturbance) - FLIGHT.disturbance[i]).abs() < 0.01);
    }
}

/// A hover that the law keeps on its noisy measurements: the force follows the noise, which looks like excitation at first
/// sight.
#[test]
fn a_hover_on_noisy_measurements() {
    for noise in [0.0005, 0.002, 0.01] {
        let mut estimator = estimator(0.01);
        let (mut rng, sensor) = (Pcg64::seed_from_u64(12), Normal::new(0.0, noise).expect("a standard deviation"));
        let mut axes =
            DRIFT.map(|acceleration| DragAxis { position: 0.0, velocity: 0.0, k: FLIGHT.k, drag: 0.3, acceleration });
        let (mut before, mut rate) = ([0.0; 3], [0.0; 3]);
        let mut effort = 0.0_f64;
        for n in 0..6000 {
            let measured = axes.map(|a| (a.position + sensor.sample(&mut rng)) as f32);
            let force = [0, 1, 2].map(|i| {
                let y = f64::from(measured[i]);
                rate[i] += 0.3 * ((y - before[i]) / 0.01 - rate[i]);
                before[i] = y;
                ((-6.0 * y - 4.0 * rate[i] - DRIFT[i]) / FLIGHT.k) as f32
            });
            effort += (f64::from(force[0]) * FLIGHT.k).powi(2) / 6000.0;
            feed(&mut estimator, &Instant { t: f64::from(n) * 0.01, measured, velocity: [0.0; 3], force });
            axes.iter_mut().zip(force).for_each(|(axis, f)| axis.step(f64::from(f), 0.01));
            assert!(is_unknown(&estimator), "{n}: {:?}", estimator.terms());
        }
        let k = f64::from(estimator.parameter().expect("valid").value) / FLIGHT.k - 1.0;
        println!("noise {noise} m, {:.2} m/s² of x by it: k {k:.1e}", effort.sqrt());
        assert!(k.abs() < 1e-4);
    }
}
