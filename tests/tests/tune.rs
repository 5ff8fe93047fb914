//! What `fsb tune` predicts, against Monte Carlo through the f32 core: velocity noise, noise while the window opens, sd of k.

use fsb_core::readout::ParameterRule;
use fsb_core::{Estimator, EstimatorConfig, Tuning};
use fsb_sim_host::tune::identifier::{Excitation, Spread};
use fsb_sim_host::tune::{Proposal, Sensor, Wish, observer, opening, propose};
use rand::SeedableRng;
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

const RUNS: u64 = 400;

/// One noisy flight of the exact plant y'' = k f - g with k f = `excitation` held over each period: what `look` says at each
/// measurement.
fn fly<T>(
    config: &EstimatorConfig<1, 1>,
    excitation: Excitation,
    sensor: Sensor,
    seed: u64,
    samples: u64,
    mut look: impl FnMut(u64, f64, &Estimator<1, 1>) -> Option<T>,
) -> Vec<T> {
    const K: f64 = 1.7;
    let mut rng = Pcg64::seed_from_u64(seed);
    let noise = Normal::new(0.0, sensor.noise_sd).expect("a standard deviation");
    let mut estimator = Estimator::new(config).expect("a valid configuration");
    let (mut y, mut v, t) = (0.3, -0.2, sensor.period);
    let mut found = Vec::new();
    for n in 0..samples {
        estimator.measure(&[Some((y + noise.sample(&mut rng)) as f32)]).expect("in step");
        found.extend(look(n, v, &estimator));
        let force = (excitation.at((n as f64 + 0.5) * t) / K) as f32;
        estimator.apply(&[force]);
        let acceleration = K * f64::from(force) - excitation.gravity;
        y += t * v + t * t / 2.0 * acceleration;
        v += t * acceleration;
    }
    found
}

fn config(sensor: Sensor, excitation: Excitation, identifier: Tuning, observer: Tuning) -> EstimatorConfig<1, 1> {
    EstimatorConfig {
        identifier,
        observer,
        drift: [-excitation.gravity],
        nominal: [Some(1.7)],
        // The nominal k is the true one, and no other is ever used.
        rule: [ParameterRule { max_relative_sd: 1e-9, ..ParameterRule::default() }],
        ..EstimatorConfig::new(sensor.period)
    }
}

const EXCITATION: Excitation = Excitation { gravity: 9.81, acceleration: 1.5, frequency: 0.5 };

#[test]
fn velocity_noise_within_5_percent() {
    for (rate, noise_sd, lambda) in [(50.0, 0.01, 4.0), (100.0, 0.002, 10.0), (1000.0, 0.01, 20.0)] {
        let sensor = Sensor { noise_sd, period: 1.0 / rate };
        let tuning = Tuning::from_lambda(lambda);
        let config = config(sensor, EXCITATION, Tuning::from_lambda(2.0), tuning);
        // A dozen nearly independent looks a flight, from when the window has opened.
        let (first, apart) = ((12.0 / lambda * rate) as u64, (3.0 / lambda * rate) as u64);
        let errors: Vec<f64> = (0..RUNS)
            .into_par_iter()
            .flat_map_iter(|seed| {
                fly(&config, EXCITATION, sensor, seed, first + 12 * apart, |n, v, estimator| {
                    let state = estimator.states()[0].filter(|_| n >= first && n % apart == 0)?;
                    Some(f64::from(state.velocity) - v)
                })
            })
            .collect();
        let sd = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        let predicted = observer::velocity_sd(&sensor, lambda);
        println!("{rate} Hz, λ = {lambda}: predicted {predicted:.5}, {} looks {sd:.5} m/s", errors.len());
        assert!((sd / predicted - 1.0).abs() < 0.05, "seeds 0 to {}: {sd} against {predicted}", RUNS - 1);
    }
}

#[test]
fn velocity_noise_while_the_window_opens_within_10_percent() {
    let sensor = Sensor { noise_sd: 0.01, period: 0.01 };
    let tuning = Tuning::from_lambda(10.0);
    let config = config(sensor, EXCITATION, Tuning::from_lambda(2.0), tuning);
    let looks = [3, 10, 30, 100];
    let errors: Vec<(u64, f64)> = (0..2 * RUNS)
        .into_par_iter()
        .flat_map_iter(|seed| {
            fly(&config, EXCITATION, sensor, seed, 101, |n, v, estimator| {
                let state = estimator.states()[0].filter(|_| looks.contains(&n))?;
                Some((n, f64::from(state.velocity) - v))
            })
        })
        .collect();
    let predicted: Vec<(f64, f64)> = opening::velocity_sd(&sensor, tuning, 1.01).collect();
    for look in looks {
        let here: Vec<f64> = errors.iter().filter(|(n, _)| *n == look).map(|(_, e)| e * e).collect();
        let sd = (here.iter().sum::<f64>() / here.len() as f64).sqrt();
        let expected = predicted[look as usize - 1].1;
        println!("sample {look}: predicted {expected:.4}, {} flights {sd:.4} m/s", here.len());
        assert!(
            (sd / expected - 1.0).abs() < 0.1,
            "sample {look}, seeds 0 to {}: {sd} against {expected}",
            2 * RUNS - 1
        );
    }
}

#[test]
fn sd_of_k_within_25_percent() {
    let cases = [
        (100.0, 0.01, 2.0, EXCITATION),
        (100.0, 0.01, 2.0, Excitation { acceleration: 0.0, ..EXCITATION }),
        (1000.0, 0.05, 4.0, EXCITATION),
        (200.0, 0.005, 1.0, Excitation { gravity: 0.0, acceleration: 2.0, frequency: 0.3 }),
    ];
    for (rate, noise_sd, lambda, excitation) in cases {
        let sensor = Sensor { noise_sd, period: 1.0 / rate };
        let tuning = Tuning::from_lambda(lambda);
        let config = config(sensor, excitation, tuning, Tuning::from_lambda(10.0));
        let seconds = [1.0, 2.0, 5.0];
        let looks = seconds.map(|s: f64| (s * rate) as u64);
        let errors: Vec<(u64, f64)> = (0..RUNS)
            .into_par_iter()
            .flat_map_iter(|seed| {
                fly(&config, excitation, sensor, seed, looks[2] + 1, |n, _, estimator| {
                    let d = estimator.diagnostics()[0];
                    looks.contains(&n).then(|| (n, f64::from(d.numerator / d.denominator) / 1.7 - 1.0))
                })
            })
            .collect();
        let mut spread = Spread::new(sensor, tuning, excitation);
        let predicted: Vec<f64> = (0..=looks[2]).map(|_| spread.step().1).collect();
        for look in looks {
            let here: Vec<f64> = errors.iter().filter(|(n, _)| *n == look).map(|(_, e)| e * e).collect();
            let sd = (here.iter().sum::<f64>() / here.len() as f64).sqrt();
            let (expected, t) = (predicted[look as usize], look as f64 / rate);
            println!(
                "{rate} Hz, λ = {lambda}, {excitation:?}, {t} s: predicted {expected:.3e}, {} flights {sd:.3e}",
                here.len()
            );
            assert!((sd / expected - 1.0).abs() < 0.25, "seeds 0 to {}: {sd} against {expected}", RUNS - 1);
        }
    }
}

/// The time to k that a proposal states is one at which k is that good: 95 flights in 100, give or take.
#[test]
fn k_is_as_good_as_proposed_when_proposed() {
    let sensor = Sensor { noise_sd: 0.02, period: 0.01 };
    let excitation = Excitation { acceleration: 1.0, ..EXCITATION };
    let proposal: Proposal = propose(sensor, Wish::Delay(0.2), excitation, 0.02).expect("can be had");
    let settle = proposal.parameter_settle.expect("k in time");
    let last = (settle / sensor.period).round() as u64;
    let config = config(sensor, excitation, proposal.identifier, proposal.observer);
    let good = (0..RUNS)
        .into_par_iter()
        .filter(|&seed| {
            let k = fly(&config, excitation, sensor, seed, last + 1, |n, _, estimator| {
                let d = estimator.diagnostics()[0];
                (n == last).then(|| f64::from(d.numerator / d.denominator) / 1.7)
            });
            (k[0] - 1.0).abs() <= proposal.k_within
        })
        .count();
    println!("λ = {}, {settle} s: {good} of {RUNS} within {}", proposal.identifier.lambda, proposal.k_within);
    assert!(good as f64 >= 0.92 * RUNS as f64, "seeds 0 to {}: {good} of {RUNS}", RUNS - 1);
}

#[test]
fn every_wish_is_met_and_what_cannot_be_had_is_refused_by_name() {
    let sensor = Sensor { noise_sd: 0.01, period: 0.01 };
    let proposed = |wish| propose(sensor, wish, EXCITATION, 0.05);
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-6, "{a} is not {b}");
    near(proposed(Wish::VelocityNoise(0.04)).expect("can be had").velocity_sd, 0.04);
    near(proposed(Wish::Bandwidth(1.5)).expect("can be had").bandwidth, 1.5);
    near(proposed(Wish::Delay(0.15)).expect("can be had").delay, 0.15);
    near(proposed(Wish::Lambda(7.0)).expect("can be had").observer.lambda, 7.0);
    for (wish, name) in [
        (Wish::VelocityNoise(2.0), "--velocity-noise 2"),
        (Wish::Bandwidth(45.0), "--bandwidth 45"),
        (Wish::Delay(0.001), "--delay 0.001"),
        (Wish::Lambda(200.0), "--observer-lambda 200"),
    ] {
        let message = proposed(wish).expect_err("out of reach").to_string();
        assert!(message.starts_with(name), "{message}");
    }
}
