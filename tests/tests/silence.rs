//! A sensor that falls silent for an hour: the craft stands, nothing moves, no noise. Every filter decays then, and none of them may
//! end among the subnormal numbers, on which some processors are slow.

use fsb_core::readout::Memory;
use fsb_core::regression::{DragConfig, DragEstimator};
use fsb_core::vehicle::{Attitude, ChangeRule, Expected, Measured, VehicleConfig, VehicleEstimator, Wrench};
use fsb_core::{Estimator, EstimatorConfig};
use fsb_tests::subnormal::subnormal;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::fmt::Debug;

/// Motion and noise until then (s), silence for an hour after it.
const SILENT_FROM: f64 = 20.0;
const UNTIL: f64 = 3620.0;

/// A vertical axis: `step` is shown position and force.
fn fall_silent<E: Debug>(what: &str, estimator: &mut E, period: f64, step: impl Fn(&mut E, f32, f32)) {
    let mut rng = Pcg64::seed_from_u64(1);
    let (mut y, mut v) = (0.0, 0.0);
    for n in 0..(UNTIL / period) as u32 {
        let t = f64::from(n) * period;
        let silent = t > SILENT_FROM;
        let force = (9.81 + if silent { 0.0 } else { (2.0 * t).sin() }) as f32;
        let noise = if silent { 0.0 } else { 1e-3 * rng.random_range(-1.0..1.0) };
        step(estimator, (y + noise) as f32, force);
        let a = if silent { 0.0 } else { f64::from(force) - 9.81 };
        v = if silent { 0.0 } else { v };
        y += v * period + 0.5 * a * period * period;
        v += a * period;
        if n % 997 == 0 {
            let found = subnormal(estimator);
            assert!(found.is_empty(), "{what}, {t} s: {found:?}");
        }
    }
}

#[test]
fn an_axis() {
    println!("seed 1");
    for (period, block, memory) in [
        (0.02, 1, Memory::Fading { tau: 20.0 }),
        (0.02, 3, Memory::Infinite),
        (0.004, 5, Memory::Fading { tau: 5.0 }),
        (0.004, 1, Memory::Infinite),
    ] {
        let config = EstimatorConfig::<1, 1> { drift: [-9.81], block, memory, ..EstimatorConfig::new(period) };
        let mut estimator = Estimator::new(&config).unwrap();
        fall_silent(
            &format!("{period} s, blocks of {block}, {memory:?}"),
            &mut estimator,
            period,
            |estimator, y, f| {
                estimator.measure(&[Some(y)]).unwrap();
                estimator.apply(&[f]);
            },
        );
    }
}

#[test]
fn drag() {
    println!("seed 1");
    let mut estimator = DragEstimator::<1>::new(&DragConfig { drift: [-9.81], ..DragConfig::new(0.02) }).unwrap();
    fall_silent("drag", &mut estimator, 0.02, |estimator, y, f| {
        estimator.measure(&[Some(y)]).unwrap();
        estimator.apply(&[f]);
    });
}

#[test]
fn a_vehicle() {
    const PERIOD: f64 = 0.01;
    println!("seed 1");
    let mut config = VehicleConfig::new(PERIOD);
    config.mass = Expected::about(1.2);
    config.inertia = [0.02; 3].map(Expected::about);
    config.change = Some(ChangeRule::default());
    let mut vehicle = VehicleEstimator::<1>::new(&config).unwrap();
    let mut rng = Pcg64::seed_from_u64(1);
    let wrench = Wrench { force: [0.0, 0.0, 9.81 * 1.2], torque: [0.0; 3] };
    for n in 0..(UNTIL / PERIOD) as u32 {
        let t = f64::from(n) * PERIOD;
        let [x, y, z, turn] = [(); 4].map(|()| if t > SILENT_FROM { 0.0 } else { rng.random_range(-1e-3..1e-3) });
        let attitude = Attitude::Matrix([[1.0, turn, 0.0], [-turn, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        vehicle.update(&Measured { position: Some([x, y, z]), attitude: Some(attitude) }, &wrench);
        if n % 997 == 0 {
            let found = subnormal(&vehicle);
            assert!(found.is_empty(), "{t} s: {found:?}");
        }
    }
}
