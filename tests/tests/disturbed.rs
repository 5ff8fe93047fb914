//! What is in the sums for ever is in the standard deviation for ever: noise that was larger once, a gust, a push. A vertical axis
//! under gravity, in motion, the identifier with infinite memory.

use fsb_core::{Estimator, EstimatorConfig, Tuning};
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

const K: f64 = 0.7;
const RUNS: u64 = 400;

/// What is not as the model has it, at the time t (s): the noise (m), and an acceleration (m/s²) or a change of velocity (m/s) that
/// nobody told, which comes at one of these times. Measurements to a block.
#[derive(Clone, Copy)]
struct Disturbed {
    noise: fn(f64) -> f64,
    gust: f64,
    push: f64,
    when: (f64, f64),
    block: u32,
}

const QUIET: Disturbed = Disturbed { noise: |_| 1e-3, gust: 0.0, push: 0.0, when: (5.0, 20.0), block: 1 };

/// The largest error of k in its standard deviations, at any time and after 40 s.
fn fly(case: &Disturbed, seed: u64) -> [f64; 2] {
    let mut rng = Pcg64::seed_from_u64(seed);
    let unit = Normal::new(0.0, 1.0).expect("a standard deviation");
    let period = [0.01, 0.005, 0.002][rng.random_range(0..3)];
    let config = EstimatorConfig::<1, 1> {
        identifier: Tuning::from_lambda(rng.random_range(1.0..4.0)),
        drift: [-9.81],
        block: case.block,
        ..EstimatorConfig::new(period)
    };
    let mut estimator = Estimator::new(&config).expect("valid");
    let (rate, amplitude, phase) =
        (rng.random_range(0.5..4.0), rng.random_range(0.3..3.0), rng.random_range(0.0..core::f64::consts::TAU));
    let (when, lasts) = (rng.random_range(case.when.0..case.when.1), rng.random_range(0.1..1.0));
    let (mut y, mut v, mut worst, mut last) = (0.0, 0.0, 0.0_f64, f64::INFINITY);
    for n in 0..(40.0 / period) as u32 {
        let t = f64::from(n) * period;
        if (t - when).abs() < 0.5 * period {
            v += case.push;
        }
        estimator.measure(&[Some((y + (case.noise)(t) * unit.sample(&mut rng)) as f32)]).expect("in step");
        if let [Some(k)] = estimator.parameters() {
            last = (f64::from(k.value) - K).abs() / f64::from(k.sd());
            worst = worst.max(last);
        }
        let force = ((9.81 + amplitude * (rate * t + phase).sin()) / K) as f32;
        estimator.apply(&[force]);
        let gust = if (when..when + lasts).contains(&t) { case.gust } else { 0.0 };
        let acceleration = K * f64::from(force) - 9.81 + gust;
        y += v * period + 0.5 * acceleration * period * period;
        v += acceleration * period;
    }
    [worst, last]
}

/// Half, 95 % and all of the runs are within this, at any time and at the end.
fn spread(what: &str, case: &Disturbed) -> [[f64; 3]; 2] {
    let runs: Vec<_> = (0..RUNS).into_par_iter().map(|seed| fly(case, seed)).collect();
    let found = [0, 1].map(|i| {
        let mut of: Vec<_> = runs.iter().map(|run| run[i]).collect();
        of.sort_by(f64::total_cmp);
        [0.5, 0.95, 1.0].map(|share| of[((RUNS - 1) as f64 * share) as usize])
    });
    println!(
        "{what}, seeds 0 to {RUNS}: errors of k over their sd, at any time {:.2?}, at the end {:.2?}",
        found[0], found[1]
    );
    found
}

/// Noise alone: as it is to be, half of the errors within 0.67 standard deviations, 95 % within 1.96.
#[test]
fn quiet() {
    let [worst, end] = spread("quiet", &QUIET);
    assert!(worst[2] < 6.0 && (0.45..0.75).contains(&end[0]) && (1.3..2.1).contains(&end[1]), "{worst:?} {end:?}");
}

/// Ten millimetres for 20 s, half a millimetre from then on.
#[test]
fn noise_that_was() {
    let [worst, end] = spread("noise that was", &Disturbed { noise: |t| if t < 20.0 { 1e-2 } else { 5e-4 }, ..QUIET });
    assert!(worst[2] < 6.0 && (0.4..0.75).contains(&end[0]) && (1.2..2.1).contains(&end[1]), "{worst:?} {end:?}");
}

/// One gust of up to a second, one push: all that has happened of its kind is one sample, and k is off by about its standard
/// deviation.
#[test]
fn what_happened_once() {
    for case in [
        Disturbed { gust: 3.0, ..QUIET },
        Disturbed { gust: -0.6, ..QUIET },
        Disturbed { push: 0.6, ..QUIET },
        Disturbed { push: -0.1, ..QUIET },
    ] {
        let [worst, end] = spread(&format!("gust {} m/s², push {} m/s", case.gust, case.push), &case);
        assert!(worst[1] < 5.0 && worst[2] < 8.0, "{worst:?}");
        assert!((0.6..1.5).contains(&end[0]) && end[1] < 2.5, "{end:?}");
    }
}

/// In the first seconds, while what noise and the gust make of k̂ is large: what the residuals show beyond measurement noise is no error of k̂,
/// and stays in its standard deviation when noise and residuals have been forgotten.
#[test]
fn what_happened_early() {
    for (gust, push) in [(0.6, 0.0), (3.0, 0.0), (0.0, 0.6)] {
        let case = Disturbed { gust, push, when: (0.5, 3.0), ..QUIET };
        let [worst, end] = spread(&format!("in the first seconds, gust {gust} m/s², push {push} m/s"), &case);
        assert!(worst[0] < 4.0 && worst[1] < 10.0, "{worst:?}");
        assert!((0.6..1.5).contains(&end[0]) && end[1] < 2.5, "{end:?}");
    }
}

/// In large blocks, up to a third of 1/λ, one block alone moves k by all of a push: from that very moment on its standard deviation knows.
#[test]
fn a_push_in_one_block() {
    for push in [0.6, -0.1] {
        let [worst, end] = spread(&format!("push {push} m/s, blocks of 9"), &Disturbed { push, block: 9, ..QUIET });
        assert!(worst[1] < 5.0 && worst[2] < 8.0, "{worst:?}");
        assert!((0.5..1.5).contains(&end[0]) && end[1] < 2.5, "{end:?}");
    }
}
