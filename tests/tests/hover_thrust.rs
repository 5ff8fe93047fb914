//! The six scenarios of the unit tests of PX4's hover thrust estimator (`zero_order_hover_thrust_ekf_test.cpp`) as mass
//! scenarios: a position is measured in place of an acceleration, every 20 ms, and the mass read in place of the hover
//! thrust g/k. Each must stay within half of the tolerance there.
//!
//! White noise of sd s on an acceleration corresponds to white noise of s T²/√6 on the positions whose second difference
//! it is; the noise here is ten times that: 5 mm for 3 m/s², 11 mm for 7 m/s².

use fsb_core::readout::Memory;
use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::HeldInputAxis;
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

const PERIOD: f64 = 0.02;
const G: f64 = 9.806_65;

struct Scenario {
    /// Hover thrusts: assumed at first, true, and true from half-time on.
    hover: [f64; 3],
    seconds: f64,
    /// Noise of the acceleration (m/s²) and of the thrust (in parts of it).
    noise: [f64; 2],
    /// Climb (m/s).
    climb: f64,
    memory: Memory,
}

impl Scenario {
    fn of(hover: f64) -> Self {
        Self { hover: [0.5, hover, hover], seconds: 10.0, noise: [0.0; 2], climb: 0.0, memory: Memory::Infinite }
    }

    /// The worst relative error of the mass at the end over 100 seeds, and the mean of the learned noise variance over the
    /// true one.
    fn fly(&self) -> (f64, f64) {
        println!("seeds 0..100");
        let (mut worst, mut learned) = (0.0_f64, 0.0);
        for seed in 0..100 {
            let (error, noise) = self.fly_once(seed);
            worst = worst.max(error);
            learned += noise / 100.0;
        }
        println!("worst error {worst:.2e}, noise variance {learned:.2} of the true one");
        (worst, learned)
    }

    fn fly_once(&self, seed: u64) -> (f64, f64) {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut rng) };
        let k = |hover: f64| G / hover;
        let config = EstimatorConfig {
            drift: [-G],
            nominal: [Some(k(self.hover[0]))],
            memory: self.memory,
            ..EstimatorConfig::<1, 1>::new(PERIOD)
        };
        let mut estimator = Estimator::new(&config).unwrap();
        let mut axis = HeldInputAxis { position: 100.0, velocity: self.climb, k: k(self.hover[1]), drift: -G };
        let sd = 10.0 * self.noise[0] * PERIOD * PERIOD / 6.0_f64.sqrt();
        let samples = (self.seconds / PERIOD) as usize;
        for n in 0..samples {
            if n == samples / 2 {
                axis.k = k(self.hover[2]);
            }
            estimator.measure(&[Some((axis.position + sd * normal()) as f32)]).unwrap();
            let wanted = 100.0 + self.climb * n as f64 * PERIOD;
            let thrust = (G - 5.0 * (axis.velocity - self.climb) - 6.0 * (axis.position - wanted)) / axis.k;
            estimator.apply(&[(thrust * (1.0 + self.noise[1] * normal())) as f32]);
            axis.step(thrust, PERIOD);
        }
        let found = estimator.parameters()[0].expect("valid").value;
        let noise = f64::from(estimator.diagnostics()[0].noise_variance[0]);
        ((k(self.hover[2]) / f64::from(found) - 1.0).abs(), noise / (sd * sd))
    }
}

#[test]
fn static_hover() {
    let (error, _) = Scenario::of(0.5).fly();
    assert!(error < 0.5e-4);
}

#[test]
fn convergence_within_two_seconds() {
    let (error, _) = Scenario { seconds: 2.0, ..Scenario::of(0.72) }.fly();
    assert!(error < 0.5e-2);
}

#[test]
fn noise() {
    let (error, learned) = Scenario { noise: [3.0, 0.0], ..Scenario::of(0.72) }.fly();
    assert!(error < 2.5e-2 && (learned - 1.0).abs() < 0.1);
}

#[test]
fn much_noise_in_descent() {
    let (error, learned) = Scenario { noise: [7.0, 0.0], climb: -2.0, ..Scenario::of(0.72) }.fly();
    assert!(error < 3.5e-2 && (learned - 1.0).abs() < 0.1);
}

#[test]
fn noise_of_acceleration_and_thrust() {
    let (error, _) = Scenario { noise: [3.0, 0.05], ..Scenario::of(0.72) }.fly();
    assert!(error < 2.5e-2);
}

/// From 0.8 to 0.3 with a memory of 1 s: old samples weigh seven times the new ones, as the thrust was larger.
#[test]
fn jump() {
    let jump = Scenario { hover: [0.5, 0.8, 0.3], seconds: 20.0, noise: [3.0, 0.0], ..Scenario::of(0.8) };
    let (error, _) = Scenario { memory: Memory::Fading { tau: 1.0 }, ..jump }.fly();
    assert!(error < 2.5e-2);
}
