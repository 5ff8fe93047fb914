//! k, drag and disturbance together, against plants that obey the model exactly.

use fsb_core::regression::{DragConfig, DragEstimator, Term};
use fsb_tests::drag_flight::{DRIFT, DragFlight};
use rand::SeedableRng;
use rand_pcg::Pcg64;

const FLIGHT: DragFlight = DragFlight {
    period: 0.01,
    k: 1.0 / 1.3,
    drag: [0.35, 0.5, 0.2],
    disturbance: [0.3, -0.4, 0.25],
    amplitude: [0.8, 0.6, 0.5],
    noise: 0.0,
};

fn estimator(period: f64) -> DragEstimator<3> {
    DragEstimator::new(&DragConfig { drift: DRIFT, ..DragConfig::new(period) }).expect("a valid configuration")
}

fn fly(estimator: &mut DragEstimator<3>, flight: &DragFlight, seconds: f64, seed: u64) {
    let mut rng = Pcg64::seed_from_u64(seed);
    for instant in flight.fly(seconds, &mut rng) {
        estimator.measure(&instant.measured.map(Some)).expect("in step");
        estimator.apply(&instant.force);
    }
}

fn value(term: Term) -> f64 {
    f64::from(term.value().expect("known"))
}

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
