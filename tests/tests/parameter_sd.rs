//! The standard deviation of k̂ and the learned noise level against Monte Carlo.

use fsb_core::readout::Memory;
use fsb_core::{Estimator, EstimatorConfig, Tuning};
use fsb_sim_host::plant::{HeldInputAxis, Motion, Recording, RecordingConfig, record};
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Sample period, block, identifier's λ and q, drift, amplitude of the swing.
type Setting = (f64, u32, f64, f64, f64, f64);

/// Gravity and a swing at four rates, another tuning, hover, a lateral swing.
const SETTINGS: [Setting; 7] = [
    (1e-3, 1, 2.0, 1.0, -9.81, 1.0),
    (1e-3, 10, 2.0, 1.0, -9.81, 1.0),
    (1.25e-4, 40, 2.0, 1.0, -9.81, 1.0),
    (0.01, 1, 2.0, 1.0, -9.81, 1.0),
    (1e-3, 5, 4.0, 4.0, -9.81, 1.0),
    (1e-3, 1, 2.0, 1.0, -9.81, 0.0),
    (1e-3, 1, 2.0, 1.0, 0.0, 1.0),
];

const CHECKS: [f64; 5] = [0.3, 0.5, 1.0, 2.0, 5.0];
const RUNS: u32 = 800;

fn recording((period, _, _, _, drift, amplitude): Setting) -> Recording {
    record(&RecordingConfig {
        period,
        samples: (CHECKS[4] / period) as usize + 2,
        drift,
        position: 3.3,
        velocity: 0.5,
        motion: Motion { centre: 3.0, amplitude, frequency: 1.5 },
        ..Default::default()
    })
}

/// Valid at any spread.
fn config((period, block, lambda, q, drift, _): Setting) -> EstimatorConfig<1, 1> {
    let mut config =
        EstimatorConfig { block, drift: [drift], identifier: Tuning { lambda, q }, ..EstimatorConfig::new(period) };
    (config.rule[0].max_relative_sd, config.rule[0].min) = (1e3, 1e-9);
    config
}

/// The same noise per second at any rate: 5 mm at 1 kHz.
fn sigma((period, ..): Setting) -> f64 {
    0.005 * (1e-3 / period).sqrt()
}

/// Error of k̂ and reported variance at the five times of one run.
fn run(recording: &Recording, config: &EstimatorConfig<1, 1>, sigma: f64, seed: u64) -> [(f64, f64); 5] {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut estimator = Estimator::new(config).unwrap();
    let mut found = [(f64::NAN, f64::NAN); 5];
    for n in 0..recording.positions.len() {
        let noise: f64 = rng.sample(StandardNormal);
        estimator.measure(&[Some((recording.positions[n] + sigma * noise) as f32)]).unwrap();
        if let Some(i) = CHECKS.iter().position(|t| (t / recording.period).round() as usize == n) {
            let parameter = estimator.parameters()[0].expect("valid at any spread");
            found[i] = (f64::from(parameter.value) - RecordingConfig::default().k, f64::from(parameter.variance));
        }
        estimator.apply(&[recording.forces[n] as f32]);
    }
    found
}

/// Reported over true sd at the five times, the noise level being given: rms of the reported over the spread of 800 runs, which
/// is known to 2.5 % (one sd). Also prints the bias and the share of the runs within 2 sd.
fn reported_over_spread(setting: Setting) -> [f64; 5] {
    let (recording, sigma) = (recording(setting), sigma(setting));
    let config = EstimatorConfig { noise_sd: Some(sigma), ..config(setting) };
    let all: Vec<_> = (0..u64::from(RUNS)).into_par_iter().map(|seed| run(&recording, &config, sigma, seed)).collect();
    std::array::from_fn(|i| {
        let mean = |value: &dyn Fn(&(f64, f64)) -> f64| all.iter().map(|r| value(&r[i])).sum::<f64>() / f64::from(RUNS);
        let bias = mean(&|r| r.0);
        let spread = (mean(&|r| r.0 * r.0) - bias * bias).sqrt();
        let ratio = mean(&|r| r.1).sqrt() / spread;
        let covered = mean(&|r| f64::from(u8::from(r.0 * r.0 <= 4.0 * r.1)));
        println!(
            "{setting:?}, t {} s: sd {spread:.2e}, reported/spread {ratio:.3}, bias/sd {:.2}, within 2 sd {:.1} %",
            CHECKS[i],
            bias / spread,
            100.0 * covered
        );
        assert!(bias.abs() < 0.15 * spread, "four sd of the mean");
        assert!(covered >= 0.9, "{covered}");
        ratio
    })
}

/// Within 15 % from 2 s on; before, where the coarse steps of its recursion show, up to 35 % too high at 0.3 s and 25 % from
/// 0.5 s on, never too low.
#[test]
fn the_parameter_sd_is_the_spread() {
    for setting in SETTINGS {
        let ratio = reported_over_spread(setting);
        assert!((0.85..1.35).contains(&ratio[0]), "{setting:?}: {ratio:?}");
        assert!(ratio[1..3].iter().all(|r| (0.85..1.25).contains(r)), "{setting:?}: {ratio:?}");
        assert!(ratio[3..].iter().all(|r| (0.85..1.15).contains(r)), "{setting:?}: {ratio:?}");
    }
}

/// Nor does it depend on how q is chosen.
#[test]
fn the_parameter_sd_is_the_spread_for_any_tuning() {
    for (period, lambda, q) in [(1e-3, 2.0, 2.0), (1e-3, 2.0, 0.5), (2e-3, 1.0, 3.0), (0.01, 2.0, 2.0)] {
        let ratio = reported_over_spread((period, 1, lambda, q, -9.81, 1.0));
        assert!(ratio[3..].iter().all(|r| (0.85..1.15).contains(r)), "λ {lambda}, q {q}, T {period}: {ratio:?}");
    }
}

/// The noise level learned in 5 s [σ²], in both bands, of ten runs: median.
fn learned(setting: Setting) -> [f64; 2] {
    let (recording, sigma) = (recording(setting), sigma(setting));
    let mut levels: Vec<[f64; 2]> = (0..10)
        .map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed);
            let mut estimator = Estimator::new(&config(setting)).unwrap();
            for n in 0..recording.positions.len() {
                let noise: f64 = rng.sample(StandardNormal);
                estimator.measure(&[Some((recording.positions[n] + sigma * noise) as f32)]).unwrap();
                estimator.apply(&[recording.forces[n] as f32]);
            }
            let mean_variance = sigma * sigma / f64::from(setting.1);
            estimator.diagnostics()[0].noise_variance.map(|v| f64::from(v) / mean_variance)
        })
        .collect();
    std::array::from_fn(|band| {
        levels.sort_by(|a, b| a[band].total_cmp(&b[band]));
        (levels[4][band] + levels[5][band]) / 2.0
    })
}

/// Not told, the level is learned: from sample to sample to 20 %, in the identifier's band, where few values are
/// independent, not above twice.
#[test]
fn the_noise_level_is_learned() {
    for setting in SETTINGS {
        let [fine, slow] = learned(setting);
        println!("{setting:?}: learned over true variance {fine:.2} from sample to sample, {slow:.2} in the band");
        assert!((0.8..1.2).contains(&fine) && slow < 2.0, "{setting:?}: {fine}, {slow}");
    }
}

#[test]
fn the_noise_level_is_learned_for_any_tuning() {
    for (period, block) in [(1e-3, 1), (2e-3, 1), (0.01, 1), (1e-3, 10)] {
        for (lambda, ratio) in [(0.5, 0.25), (1.0, 1.0), (2.0, 0.25), (2.0, 1.0), (1.0, 3.0), (4.0, 1.0)] {
            let setting = (period, block, lambda, ratio * lambda, -9.81, 1.0);
            let [fine, slow] = learned(setting);
            println!("{setting:?}: learned over true variance {fine:.2} from sample to sample, {slow:.2} in the band");
            // A value in 0.08/λ: 31 in 5 s for the slowest.
            assert!((0.7..1.3).contains(&fine) && slow < 2.0, "{setting:?}: {fine}, {slow}");
        }
    }
}

/// A second of strong noise, on a slow motion, with the defaults: the variance is one at every tick.
#[test]
fn the_variance_survives_a_change_of_the_noise() {
    let motion = Motion { centre: 3.0, amplitude: 1.0, frequency: 0.5 };
    let recording =
        record(&RecordingConfig { samples: 15_000, drift: 0.0, velocity: 0.0, motion, ..Default::default() });
    let mut rng = Pcg64::seed_from_u64(1);
    let mut estimator = Estimator::<1, 1>::new(&EstimatorConfig::new(1e-3)).unwrap();
    let (mut valid, mut wrong) = (0, 0);
    for n in 0..15_000 {
        let noise: f64 = rng.sample(StandardNormal);
        let sigma = if (4000..5000).contains(&n) { 0.1 } else { 1e-4 };
        estimator.measure(&[Some((recording.positions[n] + sigma * noise) as f32)]).unwrap();
        if let Some(parameter) = estimator.parameters()[0] {
            valid += 1;
            wrong += u32::from(!(parameter.variance >= 0.0 && parameter.sd().is_finite()));
        }
        estimator.apply(&[recording.forces[n] as f32]);
    }
    println!("valid in {valid} ticks, of these {wrong} with a variance that is none");
    assert!(valid > 5000 && wrong == 0);
}

/// Landed, with fading memory: nothing new is learned, so the sd of what is handed out does not fall.
#[test]
fn the_sd_does_not_fall_without_input() {
    let memory = Memory::Fading { tau: 10.0 };
    let mut estimator = Estimator::<1, 1>::new(&EstimatorConfig { memory, ..EstimatorConfig::new(1e-3) }).unwrap();
    let mut rng = Pcg64::seed_from_u64(1);
    let mut measure = |estimator: &mut Estimator<1, 1>, y: f64| {
        let noise: f64 = rng.sample(StandardNormal);
        estimator.measure(&[Some((y + 0.02 * noise) as f32)]).unwrap();
    };
    let mut axis = HeldInputAxis { position: 3.0, velocity: 0.0, k: RecordingConfig::default().k, drift: 0.0 };
    for n in 0..10_000 {
        measure(&mut estimator, axis.position);
        // Comes to rest in the last 4 s.
        let (wanted, swing) = if n < 6000 { ((n as f64 * 1e-3).sin(), 1.0) } else { (0.0, 0.0) };
        let rate = swing * (n as f64 * 1e-3).cos();
        let f = (-5.0 * (axis.velocity - rate) - 6.0 * (axis.position - 3.0 - wanted)) as f32;
        estimator.apply(&[f]);
        axis.step(f64::from(f), 1e-3);
    }
    let mut before = 0.0;
    for n in 0..100_000 {
        measure(&mut estimator, axis.position);
        estimator.apply(&[0.0]);
        if n > 20_000
            && n % 10_000 == 0
            && let Some(parameter) = estimator.parameters()[0]
        {
            println!("{} s after landing: sd {:e}", n / 1000, parameter.sd());
            assert!(parameter.sd() >= 0.99 * before, "{} after {before}", parameter.sd());
            before = parameter.sd();
        }
    }
}
