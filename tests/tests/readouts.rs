//! The read-outs: least squares and the paper's absolute ratio (44), infinite and fading memory.

use fsb_core::readout::{Memory, ParameterStatus, Readout};
use fsb_core::{Estimator, EstimatorConfig, Tuning};
use fsb_sim_host::plant::HeldInputAxis;
use fsb_sim_host::twin::{Moments, TwinAbsoluteRatio, TwinIdentifier, TwinLeastSquares};
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

const PERIOD: f64 = 1e-3;

/// The newest quotient, valid or not.
fn newest<const P: usize>(estimator: &Estimator<1, P>) -> Option<f64> {
    let d = estimator.diagnostics()[0];
    (d.denominator > 0.0).then(|| f64::from(d.numerator) / f64::from(d.denominator))
}

/// Both f64 read-outs behind one identifier.
struct Twin {
    identifier: TwinIdentifier,
    squares: TwinLeastSquares,
    ratio: TwinAbsoluteRatio,
}

impl Twin {
    fn new(config: &EstimatorConfig<1, 1>) -> Self {
        let Tuning { lambda, q } = config.identifier;
        let tau = match config.memory {
            Memory::Fading { tau } => Some(tau),
            _ => None,
        };
        let step = config.period * f64::from(config.block);
        Self {
            identifier: TwinIdentifier::new(lambda, q, config.period, config.block as usize),
            squares: TwinLeastSquares::new(tau, step),
            ratio: TwinAbsoluteRatio::new(tau, step),
        }
    }

    fn sample(&mut self, y: f32, f_before: Option<f32>) {
        let moments = f_before.map_or(Moments::default(), |f| Moments::held(f64::from(f), PERIOD));
        if let Some(block) = self.identifier.sample(f64::from(y), moments.j1, moments.j2) {
            self.squares.add(&[(block.z2, block.z0)]);
            self.ratio.add(&[(block.z2, block.z0)]);
        }
    }

    fn k(&self, readout: Readout) -> Option<f64> {
        match readout {
            Readout::AbsoluteRatio => self.ratio.k(),
            _ => self.squares.k(),
        }
    }
}

/// Flies an axis without drift under a PD law on its true state, k(t) given; core and twin see the same noisy f32 samples.
/// Calls `look` at every tick with the time, the core and what the twin reads.
fn fly(
    config: &EstimatorConfig<1, 1>,
    k: impl Fn(f64) -> f64,
    (sigma, gain, seconds): (f64, f64, f64),
    mut look: impl FnMut(f64, &Estimator<1, 1>, Option<f64>),
) {
    let (mut estimator, mut twin) = (Estimator::new(config).unwrap(), Twin::new(config));
    let mut axis = HeldInputAxis { position: 2.0, velocity: 0.0, k: k(0.0), drift: 0.0 };
    let mut rng = Pcg64::seed_from_u64(7);
    let mut before = None;
    for n in 0..(seconds / PERIOD) as usize {
        let t = n as f64 * PERIOD;
        let noise: f64 = rng.sample(StandardNormal);
        let y = (axis.position + sigma * noise) as f32;
        estimator.measure(&[Some(y)]).unwrap();
        twin.sample(y, before);
        look(t, &estimator, twin.k(config.readout));
        axis.k = k(t);
        let wanted = (2.0 + gain * (1.5 * t).sin(), 1.5 * gain * (1.5 * t).cos());
        // The law knows the sign of k, so that the loop is stable for either.
        let f = ((-5.0 * (axis.velocity - wanted.1) - 6.0 * (axis.position - wanted.0)) * axis.k.signum()) as f32;
        estimator.apply(&[f]);
        before = Some(f);
        axis.step(f64::from(f), PERIOD);
    }
}

/// Least squares sees the sign of k; a negative k is never valid. The absolute ratio does not see it: that is the paper's.
#[test]
fn a_negative_parameter() {
    for (readout, seen) in [(Readout::LeastSquares, -0.7), (Readout::AbsoluteRatio, 0.7)] {
        let config = EstimatorConfig { readout, noise_sd: Some(1e-7), ..EstimatorConfig::new(PERIOD) };
        let mut at_end = None;
        fly(
            &config,
            |_| -0.7,
            (0.0, 1.0, 10.0),
            |t, core, _| {
                at_end = newest(core);
                if readout == Readout::LeastSquares {
                    assert_eq!(core.parameters(), [None], "at {t}");
                    if t > 0.1 {
                        assert_eq!(core.parameter_status(), [ParameterStatus::BelowRange], "at {t}");
                    }
                }
            },
        );
        assert!((at_end.unwrap() / seen - 1.0).abs() < 1e-6, "{readout:?}: {at_end:?}");
    }
}

/// Noise or not, blocks or not, fading or not: the core reads what its twin reads.
#[test]
fn both_read_outs_are_their_twins() {
    for readout in [Readout::LeastSquares, Readout::AbsoluteRatio] {
        for memory in [Memory::Infinite, Memory::Fading { tau: 1.5 }] {
            for (block, sigma) in [(1, 0.0), (1, 0.02), (10, 0.02)] {
                let config = EstimatorConfig { readout, memory, block, ..EstimatorConfig::new(PERIOD) };
                let mut worst = 0.0_f64;
                fly(
                    &config,
                    |_| 0.7,
                    (sigma, 1.0, 20.0),
                    |t, core, twin| {
                        if t > 0.5 {
                            worst = worst.max((newest(core).unwrap() / twin.unwrap() - 1.0).abs());
                        }
                    },
                );
                println!("{readout:?}, {memory:?}, block {block}, noise {sigma} m: core/twin - 1 at most {worst:.1e}");
                assert!(worst < 3e-6);
            }
        }
    }
}

/// Weak excitation, strong noise: (44) reads too high, least squares does not.
#[test]
fn the_absolute_ratio_is_biased_where_least_squares_is_not() {
    let read = |readout| {
        let config = EstimatorConfig { readout, ..EstimatorConfig::new(PERIOD) };
        let mut at_end = 0.0;
        fly(&config, |_| 2.0, (0.5, 0.02, 60.0), |_, core, _| at_end = newest(core).unwrap_or(0.0));
        at_end
    };
    let (squares, ratio) = (read(Readout::LeastSquares), read(Readout::AbsoluteRatio));
    println!("k = 2: least squares {squares:.2}, absolute ratio {ratio:.2}");
    assert!((squares - 2.0).abs() < 0.5 && ratio > 3.0);
}

/// After a step of the true k the estimate follows as the twin's does, and the rest of the step fades with τ. The input's
/// information varies as the motion swings, so τ is a period of it, and the first τ is left to the transient of the loop.
#[test]
fn fading_memory_follows_a_step_with_its_time_constant() {
    for readout in [Readout::LeastSquares, Readout::AbsoluteRatio] {
        let (tau, step_at) = (std::f64::consts::TAU / 1.5, 20.0);
        let config = EstimatorConfig { readout, memory: Memory::Fading { tau }, ..EstimatorConfig::new(PERIOD) };
        let (mut worst, mut rest) = (0.0_f64, Vec::new());
        fly(
            &config,
            |t| if t < step_at { 0.7 } else { 0.9 },
            (0.0, 1.0, 45.0),
            |t, core, twin| {
                let k = newest(core);
                if t > 0.5 {
                    worst = worst.max((k.unwrap() / twin.unwrap() - 1.0).abs());
                }
                if (t - step_at) > 4.0 - PERIOD / 2.0 && rest.len() as f64 * tau < t - step_at - 4.0 + PERIOD / 2.0 {
                    rest.push((0.9 - k.unwrap()) / 0.2);
                }
            },
        );
        println!(
            "{readout:?}: core/twin - 1 at most {worst:.1e}; of the step is left, every τ = {tau:.3} s: {rest:.4?}"
        );
        assert!(worst < 3e-6 && rest.len() >= 5);
        for pair in rest.windows(2).skip(1).take(3) {
            assert!((pair[1] / pair[0] * std::f64::consts::E - 1.0).abs() < 0.1, "{pair:?}");
        }
    }
}

/// Exactly so for a constant input: the step of k reaches the quotient through the three stages of the cascade and the
/// fading sum, 1 - R(t) with R the step response of λ³/((λ + s)³ (1 + τ s)).
#[test]
fn a_step_under_a_constant_input() {
    let (lambda, tau, period, k0, k1, step_at) = (4.0, 2.0, 2e-3, 1.0, 1.02, 16.0);
    let config = EstimatorConfig::<1, 1> {
        drift: [-9.81],
        identifier: Tuning { lambda, q: 2.0 },
        memory: Memory::Fading { tau },
        ..EstimatorConfig::new(period)
    };
    let mut estimator = Estimator::new(&config).unwrap();
    let f = (9.81 / k0) as f32;
    let mut axis = HeldInputAxis { position: 0.0, velocity: 0.0, k: 9.81 / f64::from(f), drift: -9.81 };
    // The three stages and the mean, integrated finely.
    let (mut x, dt) = ([0.0; 4], period / 20.0);
    let mut worst = 0.0_f64;
    for n in 0..12_000 {
        let t = n as f64 * period;
        estimator.measure(&[Some(axis.position as f32)]).unwrap();
        if t > 12.0 {
            let expected = k0 + (k1 - k0) * x[3];
            worst = worst.max((newest(&estimator).unwrap() - expected).abs() / (k1 - k0));
        }
        estimator.apply(&[f]);
        if t >= step_at {
            axis.k = k1;
            for _ in 0..20 {
                let rate = [lambda * (1.0 - x[0]), lambda * (x[0] - x[1]), lambda * (x[1] - x[2]), (x[2] - x[3]) / tau];
                for (x, rate) in x.iter_mut().zip(rate) {
                    *x += dt * rate;
                }
            }
        }
        axis.step(f64::from(f), period);
    }
    println!("of the step, core - expected at most {worst:.1e}, after it {:.3} of it is read", x[3]);
    // A sample's delay of 2 ms against λ and τ.
    assert!(worst < 3e-3 && x[3] > 0.95);
}

/// Two million noisy samples: the quotient is the twin's to 1e-6, and both sums go on growing as the twin's do.
#[test]
fn infinite_memory_goes_on_absorbing() {
    let config = EstimatorConfig::<1, 1>::new(PERIOD);
    let mut growth: Option<(f64, f64)> = None;
    let (mut worst_k, mut worst_sum) = (0.0_f64, 0.0_f64);
    let (mut estimator, mut twin) = (Estimator::new(&config).unwrap(), Twin::new(&config));
    let mut axis = HeldInputAxis { position: 3.0, velocity: 0.0, k: 0.7, drift: 0.0 };
    let mut rng = Pcg64::seed_from_u64(2);
    let mut before = None;
    for n in 0..2_000_000_u32 {
        let noise: f64 = rng.sample(StandardNormal);
        let y = (axis.position + 0.01 * noise) as f32;
        estimator.measure(&[Some(y)]).unwrap();
        twin.sample(y, before);
        if n >= 10_000 && n % 10_000 == 0 {
            let d = estimator.diagnostics()[0];
            let (numerator, denominator) = twin.squares.sums();
            let scale = (f64::from(d.numerator) / numerator, f64::from(d.denominator) / denominator);
            let (a, b) = *growth.get_or_insert(scale);
            worst_sum = worst_sum.max((scale.0 / a - 1.0).abs()).max((scale.1 / b - 1.0).abs());
            worst_k = worst_k.max((newest(&estimator).unwrap() / twin.squares.k().unwrap() - 1.0).abs());
        }
        let t = f64::from(n) * PERIOD;
        let f = (-5.0 * (axis.velocity - 1.5 * (1.5 * t).cos()) - 6.0 * (axis.position - 3.0 - (1.5 * t).sin())) as f32;
        estimator.apply(&[f]);
        before = Some(f);
        axis.step(f64::from(f), PERIOD);
    }
    println!("2e6 samples: k̂/twin - 1 at most {worst_k:.1e}, the sums' growth against the twin's {worst_sum:.1e}");
    assert!(worst_k < 1e-6 && worst_sum < 2e-6);
}
