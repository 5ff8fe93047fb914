//! Six axes, each a two-state Kalman filter for position and velocity (kfilter 0.5.1) and a recursive least squares for k
//! from its velocity (flight-solver 0.2.2), the same scenario and counter as for our own tick. No variance of k, no validity,
//! no pooling, no handling of bad samples.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use flight_solver::rls::{CovarianceGuards, RlsParallel};
use kfilter::kalman::{Kalman1M, Kalman1MLinear, Kalman1MLinearNoInput};
use kfilter::{KalmanFilter, KalmanPredict, KalmanPredictInput};
use nalgebra::{Matrix1, Matrix1x2, Matrix2, Matrix2x1, SVector};
use semihosting::println;
use target_tests::board::{instructions, overhead};
use target_tests::scenario::{DRIFT, Faults, K, Scenario};

const DT: f32 = 1e-3;
const TICKS: u32 = 60_000;

struct Axis {
    filter: Kalman1MLinear<f32, 2, 1, 1>,
    rls: RlsParallel<1, 1>,
    velocity: f32,
    input: f32,
    drift: f32,
}

impl Axis {
    fn new(noise: f32, nominal: f32, drift: f64) -> Self {
        Self {
            filter: Kalman1M::new_with_input(
                Matrix2::new(1.0, DT, 0.0, 1.0),
                Matrix2::new(1e-10, 0.0, 0.0, 1e-6),
                Matrix2x1::new(0.5 * DT * DT, DT),
                Matrix1x2::new(1.0, 0.0),
                Matrix1::new(noise * noise),
                SVector::zeros(),
            ),
            rls: {
                let mut rls = RlsParallel::new(1e2, 0.9995, CovarianceGuards::default());
                rls.params_mut()[(0, 0)] = nominal;
                rls
            },
            velocity: 0.0,
            input: 0.0,
            drift: drift as f32,
        }
    }

    /// Acceleration k f + c into the filter, the filter's acceleration less c into the least squares.
    #[inline(always)]
    fn step(&mut self, y: f32) {
        let k = self.rls.params()[(0, 0)];
        let _ = self.filter.predict(Matrix1::new(k * self.input + self.drift));
        let _ = self.filter.update(Matrix1::new(y));
        let velocity = self.filter.state()[1];
        let acceleration = (velocity - self.velocity) * (1.0 / DT) - self.drift;
        self.velocity = velocity;
        self.rls.update(&SVector::<f32, 1>::new(self.input), &SVector::<f32, 1>::new(acceleration));
    }
}

#[inline(never)]
fn tick(axes: &mut [Axis; 6], positions: &[f32; 6], inputs: &[f32; 6]) {
    for ((axis, &y), &input) in axes.iter_mut().zip(positions).zip(inputs) {
        axis.step(y);
        axis.input = input;
    }
}

/// The cheapest that may be called an estimate: a filter that does not know the input, and least squares on what it says.
struct Plain {
    filter: Kalman1MLinearNoInput<f32, 2, 1>,
    rls: RlsParallel<1, 1>,
    velocity: f32,
}

impl Plain {
    fn new(noise: f32) -> Self {
        Self {
            filter: Kalman1M::new(
                Matrix2::new(1.0, DT, 0.0, 1.0),
                Matrix2::new(1e-10, 0.0, 0.0, 1e-3),
                Matrix1x2::new(1.0, 0.0),
                Matrix1::new(noise * noise),
                SVector::zeros(),
            ),
            rls: RlsParallel::new(1e2, 0.9995, CovarianceGuards::default()),
            velocity: 0.0,
        }
    }
}

#[inline(never)]
fn plain(axes: &mut [Plain; 6], positions: &[f32; 6], inputs: &[f32; 6]) {
    for ((axis, &y), &input) in axes.iter_mut().zip(positions).zip(inputs) {
        let _ = axis.filter.predict();
        let _ = axis.filter.update(Matrix1::new(y));
        let velocity = axis.filter.state()[1];
        let acceleration = (velocity - axis.velocity) * (1.0 / DT);
        axis.velocity = velocity;
        axis.rls.update(&SVector::<f32, 1>::new(input), &SVector::<f32, 1>::new(acceleration));
    }
}

#[entry]
fn main() -> ! {
    let axes = || -> [Axis; 6] {
        core::array::from_fn(|i| Axis::new(if i < 3 { 1e-3 } else { 2e-4 }, 0.8 * K[i] as f32, DRIFT[i]))
    };
    let nothing = overhead();
    let mut flying = axes();
    let mut plains: [Plain; 6] = core::array::from_fn(|i| Plain::new(if i < 3 { 1e-3 } else { 2e-4 }));
    let mut scenario = Scenario::new(f64::from(DT), Faults::Without);
    let (mut sum, mut worst, mut plain_sum) = (0_u64, 0, 0_u64);
    for _ in 0..TICKS {
        let now = scenario.step();
        let positions = target_tests::six::raw(&now);
        let start = instructions();
        tick(&mut flying, &positions, &now.inputs);
        let end = instructions();
        plain(&mut plains, &positions, &now.inputs);
        let after = instructions();
        let count = end.wrapping_sub(start) - nothing;
        sum += u64::from(count);
        worst = count.max(worst);
        plain_sum += u64::from(after.wrapping_sub(end) - nothing);
    }
    black_box((&flying, &plains));
    let mean = |sum: u64| sum as f64 / f64::from(TICKS);
    println!("filter with the input, and least squares: mean {:.1} worst {worst}", mean(sum));
    println!("filter without the input, and least squares: mean {:.1}", mean(plain_sum));
    for (axis, k) in flying.iter().zip(K) {
        println!("k {:.4}, in truth {k}", axis.rls.params()[(0, 0)]);
    }
    println!("end");
    semihosting::process::exit(0)
}
