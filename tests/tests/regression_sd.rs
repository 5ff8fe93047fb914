//! Standard deviations where noise is not all that is wrong: the rule by which ẑv is taken, rounding, columns next to parallel.

use fsb_core::Tuning;
use fsb_core::regression::{DragConfig, DragEstimator};
use fsb_tests::drag_flight::{DRIFT, DragFlight, FLIGHT, Flyer};
use fsb_tests::drag_flights::Off;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// The largest errors over `seconds`, in standard deviations.
fn flown(flight: &DragFlight, config: &DragConfig<3>, seconds: f64, rng: &mut Pcg64) -> Off {
    let mut estimator = DragEstimator::new(config).expect("a valid configuration");
    let (mut flyer, mut off) = (Flyer::new(flight), Off::default());
    for _ in 0..(seconds / flight.period) as u32 {
        let instant = flyer.step(flight, rng);
        estimator.measure(&instant.measured.map(Some)).expect("in step");
        off.look(&estimator, flight, &instant);
        estimator.apply(&instant.force);
    }
    off
}

fn worst(what: &str, runs: u64, run: impl Fn(&mut Pcg64) -> Off + Sync) -> [f64; 2] {
    let flights: Vec<_> = (0..runs).into_par_iter().map(|seed| run(&mut Pcg64::seed_from_u64(seed))).collect();
    let most = [|off: &Off| off.k, |off: &Off| off.term].map(|of| flights.iter().map(of).fold(0.0, f64::max));
    println!("{what}, seeds 0..{runs}: k off by {:.1} sd at most, terms by {:.1}", most[0], most[1]);
    most
}

/// Ten and twenty measurements a second and little noise: the trapezoidal rule is what is wrong. Without it in the standard deviation
/// D was off by 24 of them, k by 20.
#[test]
fn few_measurements() {
    for period in [0.1, 0.05, 0.02] {
        let [k, term] = worst(&format!("{period} s"), 100, |rng| {
            let noise = 10.0_f64.powf(rng.random_range(-5.0..-3.0));
            let identifier = Tuning::from_lambda(rng.random_range(1.0..5.0));
            let flight = DragFlight { period, noise, ..FLIGHT };
            let observer = Tuning::from_lambda(5.0);
            flown(&flight, &DragConfig { drift: DRIFT, identifier, observer, ..DragConfig::new(period) }, 30.0, rng)
        });
        assert!(k < 5.0 && term < 6.0, "{period}: {k} {term}");
    }
}

/// With no noise at all, and none known to be there, k is known to what rounding leaves of it. It was told to nothing.
#[test]
fn rounding() {
    let [k, _] = worst("no noise", 60, |rng| {
        let k = rng.random_range(0.1..30.0);
        let hover = DragFlight { k, noise: 0.0, amplitude: [0.0; 3], disturbance: [0.0; 3], ..FLIGHT };
        let config = DragConfig { drift: DRIFT, disturbance_prior_sd: 0.0, ..DragConfig::new(hover.period) };
        flown(&hover, &config, 30.0, rng)
    });
    assert!(k < 4.0, "{k}");
}

/// In hover, with d known to be none, k is what holds the vehicle, to the noise.
#[test]
fn hover() {
    let [k, _] = worst("hover", 60, |rng| {
        let period = [0.1, 0.02, 0.005][rng.random_range(0..3)];
        let hover = DragFlight { period, noise: 1e-3, amplitude: [0.0; 3], disturbance: [0.0; 3], ..FLIGHT };
        let (identifier, observer) = (Tuning::from_lambda(rng.random_range(2.0..7.0)), Tuning::from_lambda(5.0));
        let config =
            DragConfig { drift: DRIFT, identifier, observer, disturbance_prior_sd: 0.0, ..DragConfig::new(period) };
        flown(&hover, &config, 30.0, rng)
    });
    assert!(k < 5.0, "{k}");
}
