//! What has been learned of an axis that has moved once and rests since: nothing is added to the sums any more, so its standard deviation
//! stays that of the time when it was learned, whatever noise and residuals have fallen to. A rotational axis; 300 flights each.

use fsb_core::readout::{Memory, ParameterRule};
use fsb_core::{Estimator, EstimatorConfig, Tuning};
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

const K: f64 = 30.0;
const RUNS: u64 = 300;

fn normal(rng: &mut Pcg64) -> f64 {
    StandardNormal.sample(rng)
}

/// Rates, blocks and tunings at random, with or without forgetting.
fn config(rng: &mut Pcg64) -> EstimatorConfig<1, 1> {
    let (period, block) = [(0.01, 1), (0.005, 1), (0.002, 1), (0.002, 10), (0.001, 10)][rng.random_range(0..5)];
    let lambda = rng.random_range(1.0..6.0);
    let identifier = Tuning { lambda, q: lambda * rng.random_range(0.3..1.5) };
    let memory = [Memory::Infinite, Memory::Fading { tau: 10.0 }][usize::from(rng.random::<f64>() < 0.3)];
    EstimatorConfig { block, identifier, memory, ..EstimatorConfig::new(period) }
}

/// One period of a double integrator under a constant acceleration.
fn advance((y, v): (f64, f64), acceleration: f64, period: f64) -> (f64, f64) {
    (y + v * period + 0.5 * acceleration * period * period, v + acceleration * period)
}

/// A push of up to 5 rad/s within a second, which a controller on the estimates answers, is all that happens in 35 s. The largest error
/// of what is handed out in its standard deviations.
fn pushed(seed: u64) -> Option<f64> {
    let mut rng = Pcg64::seed_from_u64(seed);
    let config = EstimatorConfig { nominal: [Some(K * rng.random_range(0.7..1.4))], ..config(&mut rng) };
    let period = config.period;
    let mut estimator = Estimator::new(&config).expect("valid");
    let sigma = 10_f64.powf(rng.random_range(-4.0..-2.5));
    let (bandwidth, damping) = (rng.random_range(2.0..12.0), rng.random_range(0.7..1.2));
    let (begins, lasts) = (rng.random_range(1.0..5.0), 10_f64.powf(rng.random_range(-2.0..0.0)));
    let push = 10_f64.powf(rng.random_range(-1.0..0.7)) / lasts;
    let (mut state, mut worst) = ((0.0, 0.0), None);
    for n in 0..(35.0 / period) as u32 {
        let t = f64::from(n) * period;
        estimator.measure(&[Some((state.0 + sigma * normal(&mut rng)) as f32)]).expect("in step");
        if let [Some(k)] = estimator.parameters() {
            let off = (f64::from(k.value) - K).abs() / f64::from(k.sd());
            worst = Some(off.max(worst.unwrap_or(0.0)));
        }
        let (y, v) = estimator.states()[0].map_or(state, |s| (f64::from(s.position), f64::from(s.velocity)));
        let input = (-bandwidth * (bandwidth * y + 2.0 * damping * v) / K) as f32;
        estimator.apply(&[input]);
        let untold = if (begins..begins + lasts).contains(&t) { push } else { 0.0 };
        state = advance(state, K * f64::from(input) + untold, period);
    }
    worst
}

/// What fits the push and what was done against it is no k: most of it is never handed out, and nothing as known that is not.
#[test]
fn a_push_is_all_there_was() {
    let of: Vec<_> = (0..RUNS).into_par_iter().filter_map(pushed).collect();
    let worst = of.iter().copied().fold(0.0, f64::max);
    println!("seeds 0..{RUNS}: a k in {}, off by {worst:.1} sd at most", of.len());
    assert!(worst < 5.0, "{worst}");
}

/// Ten seconds of motion with noise, then rest with a twentieth of it: the error of k over its standard deviation at the end of the motion, and
/// 50 s later.
fn quieter(seed: u64) -> [f64; 2] {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut config = EstimatorConfig { memory: Memory::Infinite, ..config(&mut rng) };
    // Valid however little is known of it: the spread is that of all flights.
    config.rule = [ParameterRule { max_relative_sd: 1e6, ..ParameterRule::DEFAULT }];
    let period = config.period;
    let mut estimator = Estimator::new(&config).expect("valid");
    let (rate, sigma) = (rng.random_range(0.5..3.0), 2e-3 * (0.01 / period).sqrt());
    let (mut state, mut off) = ((0.0, 0.0), [f64::INFINITY; 2]);
    for n in 0..=(60.0 / period) as u32 {
        let t = f64::from(n) * period;
        let moves = t < 10.0;
        let noise = if moves { sigma } else { sigma / 20.0 };
        estimator.measure(&[Some((state.0 + noise * normal(&mut rng)) as f32)]).expect("in step");
        if let [Some(k)] = estimator.parameters() {
            off[usize::from(!moves)] = (f64::from(k.value) - K).abs() / f64::from(k.sd());
        }
        // At rest by friction, and by a controller that shivers.
        let wanted = if moves { 3.0 * (rate * t).cos() } else { 1e-3 * normal(&mut rng) - 1.5 * state.1 };
        let input = (wanted / K) as f32;
        estimator.apply(&[input]);
        state = advance(state, K * f64::from(input), period);
    }
    off
}

/// Half of the errors within 0.67 standard deviations, 95 % within 1.96, then and later.
#[test]
fn it_was_louder_when_k_was_learned() {
    let runs: Vec<_> = (0..RUNS).into_par_iter().map(quieter).collect();
    for (i, when) in ["at the end of the motion", "after 50 s of rest"].into_iter().enumerate() {
        let mut of: Vec<_> = runs.iter().map(|run| run[i]).collect();
        of.sort_by(f64::total_cmp);
        let [half, most, all] = [0.5, 0.95, 1.0].map(|share| of[((RUNS - 1) as f64 * share) as usize]);
        println!("seeds 0..{RUNS}, {when}: {half:.2}, {most:.2}, {all:.2} sd in half, in 95 %, in all of them");
        assert!((0.45..0.8).contains(&half) && (1.4..2.3).contains(&most) && all < 5.0, "{half} {most} {all}");
    }
}
