//! Moments of inertia while the first guess of them is what predicts: within what they say.

use fsb_core::vehicle::{Expected, VehicleConfig, VehicleEstimator};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};

/// 6 s of aggressive flight at 200 Hz from these body rates on, with 1 mm and 1 mrad of noise and first guesses off by `guess` and its reciprocal:
/// the largest error in standard deviations.
fn flown(rates: [f64; 3], guess: f64, seed: u64) -> f64 {
    let truth = RigidBody { rates, ..RigidBody::default() };
    let mut config = VehicleConfig::new(0.005);
    config.mass = Expected::about(truth.mass);
    let [x, y, z] = truth.inertia;
    config.inertia = [x * guess, y / guess, z * guess].map(Expected::about);
    let mut vehicle = VehicleEstimator::<1>::new(&config).unwrap();
    let mut flight = Flight::new(truth, Course::AGGRESSIVE, 0.005, seed);
    (flight.position_noise, flight.attitude_noise) = (1e-3, 1e-3);
    let (mut wrench, mut off) = (flight.pilot(), 0.0_f64);
    for _ in 0..1200 {
        vehicle.update(&flight.measure(), &wrench);
        for (known, truth) in vehicle.inertia().iter().zip(truth.inertia) {
            let sd = |k: f32| f64::from(k) + 1e-6 * truth;
            off = off.max(known.map_or(0.0, |k| (f64::from(k.value) - truth).abs() / sd(k.sd())));
        }
        wrench = flight.pilot();
        flight.step(&wrench);
    }
    off
}

/// From rest, and set spinning before the first measurement.
#[test]
fn within_what_they_say() {
    println!("seeds 1..=20");
    for rates in [[0.0; 3], [3.0, -2.0, 2.5], [9.0, -7.0, 15.0]] {
        for guess in [0.7, 1.0, 1.4] {
            let off = (1..=20).map(|seed| flown(rates, guess, seed)).fold(0.0, f64::max);
            println!("{rates:?} rad/s, guess {guess}: {off:.1} sd");
            assert!(off < 9.0, "{rates:?}, {guess}: {off}");
        }
    }
}
