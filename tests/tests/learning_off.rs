//! The observer while nothing is learned: as good as ever, for as long as it takes.

use fsb_core::estimator::Learning;
use fsb_core::{Estimator, EstimatorConfig};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

const PERIOD: f64 = 1e-3;
const SIGMA: f64 = 1e-3;

fn estimator(block: u32, learning_off_at: u32, seed: u64, each: &mut dyn FnMut(u32, f64)) {
    let config = EstimatorConfig { block, nominal: [Some(2.0)], ..EstimatorConfig::<1, 1>::new(PERIOD) };
    let mut estimator = Estimator::new(&config).expect("valid");
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let (mut y, mut v) = (0.3_f64, 0.2_f64);
    for n in 0..20_000 {
        if n == learning_off_at {
            estimator.set_learning(Learning::Off);
        }
        let noise: f64 = StandardNormal.sample(&mut random);
        estimator.measure(&[Some((y + SIGMA * noise) as f32)]).expect("in step");
        if let Some(state) = estimator.states()[0] {
            each(n, f64::from(state.velocity) - v);
        }
        let force = (if n / 400 % 2 == 0 { 1.0 } else { -1.0 } - 2.0 * y) as f32;
        estimator.apply(&[force]);
        let acceleration = 2.0 * f64::from(force);
        y += PERIOD * v + 0.5 * PERIOD * PERIOD * acceleration;
        v += PERIOD * acceleration;
    }
}

/// Learning ends while the gains are still those of a short past. They go on: the velocity's noise is that of the steady state,
/// var v̂ = 2(1-p)³/(1+p)³ σ²/T², to 10 % of its standard deviation, which 15 s of it are known to.
#[test]
fn the_gains_go_on() {
    let p = (-10.0 * PERIOD).exp();
    let steady = (2.0 * (1.0 - p).powi(3) / (1.0 + p).powi(3)).sqrt() * SIGMA / PERIOD;
    for (block, off_at) in [(1, 60), (10, 60), (10, 100), (40, 130)] {
        let (mut sum, mut count) = (0.0, 0.0);
        for seed in 0..8 {
            estimator(block, off_at, seed, &mut |n, error| {
                if n >= 5000 {
                    sum += error * error;
                    count += 1.0;
                }
            });
        }
        let sd = f64::sqrt(sum / count);
        println!("blocks of {block}, off after {off_at} samples: {:.3} of the steady state's", sd / steady);
        assert!((0.9..1.1).contains(&(sd / steady)), "block {block}, off at {off_at}: {sd} for {steady}");
    }
}

/// On the ground at rest: what is left of the last innovation ends at zero, instead of among the subnormal numbers.
#[test]
fn at_rest_nothing_turns_subnormal() {
    for block in [1, 10] {
        let config = EstimatorConfig { block, nominal: [Some(2.0)], ..EstimatorConfig::<1, 1>::new(PERIOD) };
        let mut estimator = Estimator::new(&config).expect("valid");
        estimator.set_learning(Learning::Contact);
        for n in 0..60_000 {
            let position = if n < 100 { 0.1 + 0.01 * (n % 7) as f32 } else { 0.125 };
            estimator.measure(&[Some(position)]).expect("in step");
            let innovation = estimator.diagnostics()[0].innovation;
            let velocity = estimator.states()[0].map_or(0.0, |state| state.velocity);
            assert!(
                !innovation.is_subnormal() && !velocity.is_subnormal(),
                "block {block}, {n}: {innovation} {velocity}"
            );
            estimator.apply(&[1.0]);
        }
        let state = estimator.states()[0].expect("nominal");
        assert_eq!((state.position, state.velocity), (0.125, 0.0), "block {block}");
    }
}
