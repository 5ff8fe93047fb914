//! Reported standard deviations of k, D and d against the spread over many flights with white measurement noise.

use fsb_core::regression::{DragConfig, DragEstimator, Term};
use fsb_tests::drag_flight::{DRIFT, DragFlight, FLIGHT as FLIGHT_WITH_DRAG};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

const FLIGHT: DragFlight = DragFlight { noise: 0.002, ..FLIGHT_WITH_DRAG };

/// Error and reported sd of k, then of D and d of each axis.
fn fly(flight: &DragFlight, seconds: f64, seed: u64) -> Option<Vec<[f64; 2]>> {
    let mut estimator = DragEstimator::new(&DragConfig { drift: DRIFT, ..DragConfig::new(flight.period) }).unwrap();
    let mut rng = Pcg64::seed_from_u64(seed);
    for instant in flight.fly(seconds, &mut rng) {
        estimator.measure(&instant.measured.map(Some)).unwrap();
        estimator.apply(&instant.force);
    }
    let k = estimator.parameter()?;
    let mut out = vec![[f64::from(k.value) - flight.k, f64::from(k.sd())]];
    for (i, terms) in estimator.terms().into_iter().enumerate() {
        for (term, truth) in [(terms.drag, flight.drag[i]), (terms.disturbance, flight.disturbance[i])] {
            let Term::Known { value, sd } = term else { return None };
            out.push([f64::from(value) - truth, f64::from(sd)]);
        }
    }
    Some(out)
}

const RUNS: u64 = 300;

/// Reported sd over spread, of k, then of D and d of each axis.
fn ratios(flight: &DragFlight, seconds: f64) -> Vec<f64> {
    let runs: Vec<_> = (0..RUNS).into_par_iter().filter_map(|seed| fly(flight, seconds, seed)).collect();
    assert_eq!(runs.len() as u64, RUNS, "everything is known in every run");
    let n = runs.len() as f64;
    let ratios = (0..7).map(|i| {
        let mean = runs.iter().map(|r| r[i][0]).sum::<f64>() / n;
        let spread = (runs.iter().map(|r| (r[i][0] - mean).powi(2)).sum::<f64>() / n).sqrt();
        let reported = (runs.iter().map(|r| r[i][1].powi(2)).sum::<f64>() / n).sqrt();
        println!(
            "{} s: {}: mean error {mean:.1e}, spread {spread:.2e}",
            flight.period,
            ["k", "Dx", "dx", "Dy", "dy", "Dz", "dz"][i]
        );
        assert!(mean.abs() < 0.25 * spread, "biased: mean error {mean}, spread {spread}");
        reported / spread
    });
    let ratios = ratios.collect();
    println!("{} s, {seconds} s of flight, seeds 0 to {RUNS}: k, D and d of x, y, z: {ratios:.2?}", flight.period);
    ratios
}

/// k and D within 25 %. That of d is never too small, and at most three times too large: white noise has hardly any part
/// as slow as d, errors of the model have.
#[test]
fn reported_standard_deviations() {
    for (period, seconds) in [(0.01, 10.0), (0.01, 20.0), (0.002, 15.0)] {
        for (i, ratio) in ratios(&DragFlight { period, ..FLIGHT }, seconds).into_iter().enumerate() {
            let limits = if i == 0 || i % 2 == 1 { 0.8..1.25 } else { 0.8..3.0 };
            assert!(limits.contains(&ratio), "number {i}: reported sd over spread {ratio}");
        }
    }
}
