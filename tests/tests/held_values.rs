//! Sensors that send a value again: receivers slower than the loop that asks them, and positions rounded to coarse steps. The
//! gate is to make nothing worse of them than they are.

use fsb_core::guard::{GuardConfig, Guarded, Verdict};
use fsb_core::{Estimator, EstimatorConfig};
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

const K: f64 = 0.8;

/// What the sensor makes of a position.
#[derive(Clone, Copy, Debug)]
enum Sensor {
    /// A new value every so many samples.
    Slow(u32),
    /// Rounded to steps of so many metres.
    Rounded(f64),
}

/// A vertical axis on a sine of this amplitude (m) and angular frequency (rad/s).
#[derive(Clone, Copy, Debug)]
struct Motion(f64, f64);

impl Motion {
    fn position(self, t: f64) -> f64 {
        0.3 + self.0 * (self.1 * t).sin()
    }

    fn velocity(self, t: f64) -> f64 {
        self.0 * self.1 * (self.1 * t).cos()
    }

    /// The force held from `t` on for a `period` that leads from one velocity to the next.
    fn force(self, t: f64, period: f64) -> f32 {
        (((self.velocity(t + period) - self.velocity(t)) / period + 9.81) / K) as f32
    }
}

/// From 5 s on: rms error of the velocity (m/s) behind the gate and without, the largest error of k behind the gate.
fn fly(sensor: Sensor, motion: Motion, period: f64, noise: f64, seed: u64) -> ([f64; 2], f64) {
    let config = EstimatorConfig::<1, 1> { drift: [-9.81], nominal: [Some(K)], ..EstimatorConfig::new(period) };
    let mut guarded = Guarded::<1, 1>::new(&config, &GuardConfig::default()).unwrap();
    let mut bare = Estimator::<1, 1>::new(&config).unwrap();
    let mut rng = Pcg64::seed_from_u64(seed);
    let (mut y, mut squares, mut count, mut of_k) = (0.0, [0.0; 2], 0.0, 0.0_f64);
    for n in 0..(60.0 / period) as u32 {
        let t = f64::from(n) * period;
        let noisy = motion.position(t) + noise * rng.sample::<f64, _>(StandardNormal);
        y = match sensor {
            Sensor::Slow(every) if n % every != 0 => y,
            Sensor::Slow(_) => noisy as f32,
            Sensor::Rounded(step) => ((noisy / step).round() * step) as f32,
        };
        guarded.measure(&[Some(y)]).unwrap();
        bare.measure(&[Some(y)]).unwrap();
        if t > 5.0 {
            count += 1.0;
            for (square, state) in squares.iter_mut().zip([guarded.states()[0], bare.states()[0]]) {
                *square += (f64::from(state.expect("nominal").velocity) - motion.velocity(t)).powi(2);
            }
            if let [Some(k)] = guarded.parameters() {
                of_k = of_k.max((f64::from(k.value) / K - 1.0).abs());
            }
        }
        let force = motion.force(t, period);
        guarded.apply(&[force]);
        bare.apply(&[force]);
    }
    (squares.map(|square| (square / count).sqrt()), of_k)
}

/// Taken for jumps of the sensor, one after the other, these steps made a velocity of up to 2.2 m/s and half of k disappear.
#[test]
fn steps_are_no_jumps() {
    let slow = [(0.001, 100), (0.001, 25), (0.004, 25), (0.01, 10), (0.02, 5)].map(|(t, n)| (t, Sensor::Slow(n)));
    let rounded = [(0.001, 0.01), (0.004, 0.05), (0.01, 0.05)].map(|(t, step)| (t, Sensor::Rounded(step)));
    println!("seed 1");
    for (period, sensor) in slow.into_iter().chain(rounded) {
        for motion in [Motion(0.1, 0.5), Motion(1.0, 0.5), Motion(2.0, 1.5)] {
            for noise in [0.0, 1e-3] {
                let ([guarded, bare], k) = fly(sensor, motion, period, noise, 1);
                println!(
                    "{period} s, {sensor:?}, {motion:?}, noise {noise}: {guarded:.4} m/s, bare {bare:.4}, k {k:.4}"
                );
                assert!(guarded < 1.1 * bare + 1e-3 && k < 0.02, "{guarded} {bare} {k}");
            }
        }
    }
}

/// Outliers of such a receiver, each sent as often as any value, are told as ever.
#[test]
fn an_outlier_of_a_slow_receiver() {
    const PERIOD: f64 = 0.01;
    let (config, motion) =
        (EstimatorConfig::<1, 1> { drift: [-9.81], ..EstimatorConfig::new(PERIOD) }, Motion(1.0, 1.0));
    let mut guarded = Guarded::<1, 1>::new(&config, &GuardConfig::default()).unwrap();
    let mut rng = Pcg64::seed_from_u64(7);
    let (mut y, mut outlier, mut outliers, mut worst) = (0.0, false, 0, 0.0_f64);
    println!("seed 7");
    for n in 0..12_000 {
        let t = f64::from(n) * PERIOD;
        if n % 5 == 0 {
            outlier = t > 5.0 && !outlier && rng.random_range(0..20) == 0;
            let off = if outlier { [-1.0, 1.0][rng.random_range(0..2)] * rng.random_range(3.0..100.0) } else { 0.0 };
            y = (motion.position(t) + off + 1e-3 * rng.sample::<f64, _>(StandardNormal)) as f32;
        }
        let [verdict] = guarded.measure(&[Some(y)]).unwrap();
        outliers += u32::from(outlier);
        assert!(!outlier || verdict == Verdict::Improbable, "{t}: {verdict}");
        if t > 5.0 {
            let state = guarded.states()[0].expect("identified");
            worst = worst.max((f64::from(state.velocity) - motion.velocity(t)).abs());
        }
        guarded.apply(&[motion.force(t, PERIOD)]);
    }
    println!("{outliers} samples of outliers; the velocity is never off by more than {worst:.3} m/s");
    assert!(outliers > 300 && worst < 0.3, "{outliers} {worst}");
}
