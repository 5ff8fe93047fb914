//! Where D and d are told from k, and where they count as zero: each limit from both sides.

use fsb_core::Tuning;
use fsb_core::regression::{AxisTerms, DragConfig, DragEstimator, Identify, Term};
use fsb_tests::drag_flight::{DRIFT, DragAxis, DragFlight, FLIGHT, Flyer, feed, fly};
use rand::SeedableRng;
use rand_pcg::Pcg64;

fn known(terms: AxisTerms) -> (bool, bool) {
    (terms.drag.value().is_some(), terms.disturbance.value().is_some())
}

/// An axis that swings at λ with an acceleration of the given amplitude, and from `still` on moves without any.
fn swing(amplitude: f64, excitation: f64, still: f64, seconds: f64) -> (bool, bool) {
    let (period, k, rate) = (0.01, 0.8, 2.0);
    let config = DragConfig { excitation, identifier: Tuning::from_lambda(rate), ..DragConfig::new(period) };
    let mut estimator = DragEstimator::<1>::new(&config).expect("a valid configuration");
    let mut axis = DragAxis { position: 1.0, velocity: -amplitude / rate, k, drag: 0.0, acceleration: 0.0 };
    for n in 0..(seconds / period) as u32 {
        let t = f64::from(n) * period;
        estimator.measure(&[Some(axis.position as f32)]).expect("in step");
        let f = if t < still { (amplitude / k * (rate * t).sin()) as f32 } else { 0.0 };
        estimator.apply(&[f]);
        axis.step(f64::from(f), period);
    }
    known(estimator.terms()[0])
}

/// Three stages leave 8^(-1/2) of a swing at λ, and its rms is 2^(-1/2) of its amplitude: a quarter.
#[test]
fn excitation() {
    for limit in [0.03, 0.5] {
        assert_eq!(swing(4.0 * 1.15 * limit, limit, 60.0, 60.0), (true, true), "{limit}");
        // Below two thirds, so that no moment in which it is more than its mean is enough.
        assert_eq!(swing(4.0 * 0.6 * limit, limit, 60.0, 60.0), (false, false), "{limit}");
    }
}

/// Used, they stay so down to two thirds: 1.15² 20 s of t are 4/9 at 59.5 s, and all of one at 26.5 s.
#[test]
fn excitation_that_fades() {
    let at = |seconds: f64| swing(4.0 * 1.15 * 0.5, 0.5, 20.0, seconds);
    assert_eq!([at(20.0), at(40.0), at(53.0)], [(true, true); 3]);
    assert_eq!([at(67.0), at(80.0)], [(false, false); 2]);
}

/// With a limit above what they are known to they are used, with one below it they are not, each by itself.
#[test]
fn standard_deviations() {
    let flight = DragFlight { noise: 0.02, ..FLIGHT };
    let flown = |drag_sd_limit: f64, disturbance_sd_limit: f64| {
        let config = DragConfig { drift: DRIFT, drag_sd_limit, disturbance_sd_limit, ..DragConfig::new(flight.period) };
        let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
        fly(&mut estimator, &flight, 30.0, 12);
        estimator.terms()
    };
    for (axis, terms) in flown(1e3, 1e3).into_iter().enumerate() {
        let [drag, disturbance] = [terms.drag, terms.disturbance].map(|term| match term {
            Term::Known { sd, .. } => f64::from(sd),
            other => panic!("axis {axis}: {other:?}"),
        });
        println!("axis {axis}, seed 12: sd of D {drag:.4} 1/s, of d {disturbance:.4} m/s²");
        for (d, a, expected) in [(1.3, 1.3, (true, true)), (0.4, 1e3, (false, true)), (1e3, 0.4, (true, false))] {
            assert_eq!(known(flown(d * drag, a * disturbance)[axis]), expected, "axis {axis}: {d} {a}");
        }
    }
}

/// Neither is told in the first moments: there are no more independent rows than unknowns.
#[test]
fn not_before_there_are_rows_enough() {
    let config =
        DragConfig { drift: DRIFT, drag_sd_limit: 1e6, disturbance_sd_limit: 1e6, ..DragConfig::new(FLIGHT.period) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    let (mut flyer, mut rng) = (Flyer::new(&FLIGHT), Pcg64::seed_from_u64(14));
    let mut first = None;
    for n in 0..1000 {
        feed(&mut estimator, &flyer.step(&FLIGHT, &mut rng));
        if estimator.terms().iter().any(|&terms| known(terms) != (false, false)) {
            first.get_or_insert(n);
        }
    }
    // One independent row takes 0.79/λ = 0.4 s of an open window, and three unknowns at least three of them.
    let at = f64::from(first.expect("known")) * FLIGHT.period;
    println!("known from {at} s on");
    assert!((1.2..5.0).contains(&at));
}

/// A drag of more than a quarter of a measurement period is none that the model holds for: it counts as zero.
#[test]
fn a_drag_too_large() {
    let period = 0.1;
    for (drag, taken) in [(2.2, true), (2.9, false), (-2.9, false)] {
        let config = DragConfig {
            identifier: Tuning::from_lambda(1.0),
            observer: Tuning::from_lambda(5.0),
            identify: [Identify { drag: true, disturbance: false }],
            drag_sd_limit: 1e6,
            ..DragConfig::new(period)
        };
        let mut estimator = DragEstimator::<1>::new(&config).expect("a valid configuration");
        let mut axis = DragAxis { position: 0.0, velocity: 0.0, k: 0.8, drag, acceleration: 0.0 };
        for n in 0..600 {
            estimator.measure(&[Some(axis.position as f32)]).expect("in step");
            let wanted = 2.0 * (0.13 * f64::from(n)).sin() + (0.07 * f64::from(n)).cos() - 4.0 * axis.velocity;
            let f = ((wanted + drag * axis.velocity) / axis.k) as f32;
            estimator.apply(&[f]);
            axis.step(f64::from(f), period);
        }
        let terms = estimator.terms()[0];
        println!("D {drag}: {terms:?}");
        assert_eq!(known(terms).0, taken, "{drag}");
    }
}

/// At 8 kHz a stage moves by 2.5e-4 of its distance in a step: without sums in two parts it would stall, and so would k.
#[test]
fn no_stage_stalls_at_eight_kilohertz() {
    let flight = DragFlight { period: 1.25e-4, ..FLIGHT };
    let mut estimator = fsb_tests::drag_flight::estimator(flight.period);
    fly(&mut estimator, &flight, 10.0, 15);
    let k = f64::from(estimator.parameter().expect("valid").value) / flight.k - 1.0;
    let mut worst = [0.0_f64; 2];
    for (i, terms) in estimator.terms().into_iter().enumerate() {
        worst[0] = worst[0].max((f64::from(terms.drag.value().expect("known")) - flight.drag[i]).abs());
        worst[1] = worst[1].max((f64::from(terms.disturbance.value().expect("known")) - flight.disturbance[i]).abs());
    }
    println!("k off by {k:.1e}, D by {:.1e}, d by {:.1e}", worst[0], worst[1]);
    assert!(k.abs() < 2e-7 && worst[0] < 1e-6 && worst[1] < 5e-6);
}

/// A drag that is more than the observer's model holds for, |D| T = 0.35, is not handed out, and not put down to the mass either.
#[test]
fn a_drag_too_large_to_hand_out() {
    for seed in 1..=5 {
        let flight = DragFlight { period: 0.1, drag: [3.5; 3], noise: 1e-3, ..FLIGHT };
        let config = DragConfig { drift: DRIFT, ..DragConfig::new(flight.period) };
        let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
        fly(&mut estimator, &flight, 60.0, seed);
        let k = estimator.parameter();
        println!(
            "seed {seed}: {:?} {k:?} {:?}",
            estimator.terms().map(|terms| terms.drag),
            estimator.parameter_status()
        );
        let wrong = k.map_or(0.0, |k| (f64::from(k.value) / flight.k - 1.0).abs());
        assert!(k.is_some() && wrong < 0.03, "seed {seed}: k off by {wrong}");
        assert!(estimator.terms().iter().all(|terms| terms.drag.value().is_none()), "seed {seed}");
    }
}

/// A second and more without measurements while hardly anything is known yet: what was predicted meanwhile is not learned from.
#[test]
fn nothing_is_learned_from_a_gap() {
    for (begin, gap) in [(2.0, 1.0), (3.0, 1.0), (3.0, 1.8), (4.0, 1.8)] {
        for seed in 1..=5 {
            let flight = DragFlight { noise: 1e-3, ..FLIGHT };
            let config = DragConfig { drift: DRIFT, ..DragConfig::new(flight.period) };
            let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
            let (mut flyer, mut rng) = (Flyer::new(&flight), Pcg64::seed_from_u64(seed));
            for _ in 0..2000 {
                let instant = flyer.step(&flight, &mut rng);
                let came = instant.t < begin || instant.t >= begin + gap;
                estimator.measure(&instant.measured.map(|y| came.then_some(y))).expect("in step");
                estimator.apply(&instant.force);
            }
            let k = estimator.parameter().expect("valid");
            let (off, sd) = ((f64::from(k.value) - flight.k).abs(), f64::from(k.sd()));
            assert!(
                off < 1e-3 * flight.k && off < 5.0 * sd,
                "{gap} s from {begin} s, seed {seed}: off by {off}, sd {sd}"
            );
        }
    }
}
