//! Drag and disturbance with measurements missing at random from the start, with and without a first k.

use fsb_core::Tuning;
use fsb_core::regression::{DragConfig, DragEstimator};
use fsb_tests::drag_flight::{DRIFT, DragFlight, Flyer};
use fsb_tests::drag_flights::{Draw, Off};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

const DRAW: Draw = Draw { periods: [0.02, 0.01, 0.005], still: 0.3, noise: -4.0 };

/// 20 s: the largest error of k and of a term, in their standard deviations, and that of the velocity.
fn fly(seed: u64, missing: f64, first: Option<f64>) -> [f64; 3] {
    let mut rng = Pcg64::seed_from_u64(seed);
    let flight = DRAW.flight(&mut rng);
    let identifier = Tuning::from_lambda(rng.random_range(1.0..4.0));
    let nominal = first.map(|first| first * flight.k);
    let config = DragConfig { drift: DRIFT, identifier, nominal, ..DragConfig::new(flight.period) };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    let (mut flyer, mut off) = (Flyer::new(&flight), Off::default());
    for n in 0..(20.0 / flight.period) as u32 {
        let instant = flyer.step(&flight, &mut rng);
        let came = n == 0 || !rng.random_bool(missing);
        estimator.measure(&instant.measured.map(|y| came.then_some(y))).expect("in step");
        off.look(&estimator, &flight, &instant);
        estimator.apply(&instant.force);
    }
    [off.k, off.term, off.velocity(&flight)]
}

/// In 300 flights each no k and no term is ever off by more than 5 of its standard deviations (it was by 5.8 and 6.8), and in nine of ten flights
/// the velocity by less than so many times what noise makes of it (without a first k it was by 10).
#[test]
fn predictions_are_not_taken_for_measurements() {
    const FLIGHTS: u64 = 300;
    for (missing, first, most) in [(0.5, None, 5.0), (0.5, Some(1.3), 12.0), (0.8, Some(1.3), 130.0)] {
        let flights: Vec<_> = (0..FLIGHTS).into_par_iter().map(|seed| fly(seed, missing, first)).collect();
        let sorted = |of: usize| {
            let mut values: Vec<f64> = flights.iter().map(|flight| flight[of]).collect();
            values.sort_by(f64::total_cmp);
            [0.5, 0.9, 1.0].map(|share| values[((FLIGHTS - 1) as f64 * share) as usize])
        };
        let [k, term, velocity] = [0, 1, 2].map(sorted);
        println!(
            "{missing} missing, first k {first:?}, seeds 0 to 299, median, 90 %, worst: k {k:.1?} sd, terms {term:.1?} sd, velocity {velocity:.1?} times noise"
        );
        assert!(k[2] < 5.0 && term[2] < 5.0 && velocity[1] < most);
    }
}

/// In hover, where any k predicts well, and then in motion.
fn after_hover(seed: u64, missing: f64) -> Off {
    let mut rng = Pcg64::seed_from_u64(seed);
    let flight = DragFlight { disturbance: [0.0; 3], ..DRAW.flight(&mut rng) };
    let at_first = DragFlight { amplitude: [0.0; 3], ..flight };
    let (lambda, hover) = (rng.random_range(3.0..5.0), rng.random_range(6.0..10.0));
    let config = DragConfig {
        drift: DRIFT,
        identifier: Tuning::from_lambda(lambda),
        disturbance_prior_sd: 0.0,
        ..DragConfig::new(flight.period)
    };
    let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
    let (mut flyer, mut off) = (Flyer::new(&at_first), Off::default());
    for n in 0..(14.0 / flight.period) as u32 {
        let hovers = f64::from(n) * flight.period < hover;
        let instant = flyer.step(if hovers { &at_first } else { &flight }, &mut rng);
        let came = n == 0 || !rng.random_bool(missing);
        estimator.measure(&instant.measured.map(|y| came.then_some(y))).expect("in step");
        off.look(&estimator, &flight, &instant);
        estimator.apply(&instant.force);
    }
    off
}

/// What hover says of how well predictions fit is not what they do in motion: in one of ten flights k was off by 6.6 to 8.1 standard deviations and a term
/// by 9 to 11, when it alone was asked; by 23 and 26 at worst. With nothing missing it is by 3.1 and 3.5 in one of ten, and by 5.9.
#[test]
fn hover_is_not_all() {
    const FLIGHTS: u64 = 400;
    for missing in [0.2, 0.4, 0.6] {
        let flights: Vec<_> = (0..FLIGHTS).into_par_iter().map(|seed| after_hover(seed, missing)).collect();
        let spread = |of: fn(&Off) -> f64| {
            let mut values: Vec<f64> = flights.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            [0.5, 0.9, 0.99, 1.0].map(|share| values[((FLIGHTS - 1) as f64 * share) as usize])
        };
        let (k, term) = (spread(|off| off.k), spread(|off| off.term));
        println!("{missing} missing, seeds 0..{FLIGHTS}, median, 90, 99 %, worst: k {k:.1?} sd, terms {term:.1?} sd");
        assert!(k[1] < 4.5 && term[1] < 5.5 && k[3] < 12.0 && term[3] < 12.0, "{missing}");
    }
}
