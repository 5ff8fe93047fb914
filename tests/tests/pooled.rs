//! Axes that share a parameter: its sums are those of its axes apart, added up.

use fsb_core::estimator::StateStatus;
use fsb_core::readout::{Memory, ParameterRule, Readout};
use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::{Motion, RecordingConfig, record};
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

const PERIOD: f64 = 1e-3;

/// Numerator and denominator of the pooled parameter over the sums of those of its axes apart: the worst over 6 s.
fn pooled_over_apart(readout: Readout, memory: Memory) -> (f64, f64) {
    let flights = [0.8, 1.3, 2.1].map(|frequency| {
        let motion = Motion { centre: 3.0, amplitude: 1.0, frequency };
        record(&RecordingConfig { samples: 6000, drift: 0.0, motion, ..Default::default() })
    });
    let mut pooled =
        Estimator::<3, 1>::new(&EstimatorConfig { readout, memory, ..EstimatorConfig::new(PERIOD) }).unwrap();
    let mut apart =
        Estimator::<3, 3>::new(&EstimatorConfig { readout, memory, ..EstimatorConfig::new(PERIOD) }).unwrap();
    let mut rng = Pcg64::seed_from_u64(3);
    let mut worst = (0.0_f64, 0.0_f64);
    for n in 0..6000 {
        let y = flights.each_ref().map(|f| {
            let noise: f64 = rng.sample(StandardNormal);
            Some((f.positions[n] + 0.01 * noise) as f32)
        });
        pooled.measure(&y).unwrap();
        apart.measure(&y).unwrap();
        if n > 100 {
            let one = pooled.diagnostics()[0];
            let (up, down) = apart
                .diagnostics()
                .iter()
                .fold((0.0, 0.0), |sum, d| (sum.0 + f64::from(d.numerator), sum.1 + f64::from(d.denominator)));
            worst.0 = worst.0.max((f64::from(one.numerator) / up - 1.0).abs());
            worst.1 = worst.1.max((f64::from(one.denominator) / down - 1.0).abs());
        }
        let f = flights.each_ref().map(|f| f.forces[n] as f32);
        pooled.apply(&f);
        apart.apply(&f);
    }
    worst
}

/// A pooled parameter is the quotient of the summed sums of its axes, each of which has its own when apart.
#[test]
fn pooled_is_the_sum_of_apart() {
    for readout in [Readout::LeastSquares, Readout::AbsoluteRatio] {
        let (up, down) = pooled_over_apart(readout, Memory::Infinite);
        println!("{readout:?}: pooled over the sum of apart, off by {up:.1e}, {down:.1e}");
        assert!(up < 1e-6 && down < 1e-6);
    }
}

/// So it is with fading memory, but for the order in which a tick's additions fade (T/τ).
#[test]
fn pooled_fades_as_apart() {
    for readout in [Readout::LeastSquares, Readout::AbsoluteRatio] {
        let (up, down) = pooled_over_apart(readout, Memory::Fading { tau: 1.0 });
        println!("{readout:?}: pooled over the sum of apart, off by {up:.1e}, {down:.1e}");
        assert!(up < 5e-3 && down < 5e-3);
    }
}

/// One of two axes is lost, the one from which k is known: no measurement comes and its prediction leaves the range. k̂ stays
/// what it was, and as uncertain: over 60 flights the rms of its error in its own standard deviations is 1, to 5 of its own.
#[test]
fn what_a_lost_axis_left_stays_uncertain() {
    let config = EstimatorConfig {
        noise_sd: Some(0.1),
        rule: [ParameterRule { max_relative_sd: 0.3, ..ParameterRule::DEFAULT }],
        position_limit: 5.0,
        ..EstimatorConfig::<2, 1>::new(0.01)
    };
    let mut sum = 0.0;
    for seed in 0..60 {
        let mut estimator = Estimator::new(&config).unwrap();
        let mut rng = Pcg64::seed_from_u64(seed);
        let (mut y, mut v, mut known) = (0.0_f64, 0.0_f64, 0.0_f32);
        for n in 0..800 {
            let mut noise = || 0.1 * rng.sample::<f64, _>(StandardNormal);
            let measured = [Some(noise() as f32), (n < 200).then_some((y + noise()) as f32)];
            estimator.measure(&measured).unwrap();
            if n == 200 {
                known = estimator.parameters()[0].expect("known by now").sd();
            }
            let force = if n < 200 { 3.0 * (0.04 * f64::from(n)).sin() } else { 3.0 };
            estimator.apply(&[0.0, force as f32]);
            y += 0.01 * v + 0.5e-4 * force;
            v += 0.01 * force;
        }
        assert_eq!(estimator.state_status()[1], StateStatus::NotMeasured);
        let found = estimator.parameters()[0].expect("still known");
        assert!((found.sd() / known - 1.0).abs() < 0.05, "seed {seed}: sd {} was {known}", found.sd());
        sum += f64::from(found.value - 1.0).powi(2) / f64::from(found.variance);
    }
    let rms = f64::sqrt(sum / 60.0);
    println!("rms of the error, in standard deviations: {rms:.2}");
    assert!((rms - 1.0).abs() < 5.0 / f64::sqrt(120.0), "{rms}");
}
