//! Moments of inertia while the first guess of them is what predicts, or nothing is, or no state is handed out: within what they say.

use fsb_core::vehicle::{Expected, VehicleConfig, VehicleEstimator};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};

/// 6 s of aggressive flight at 200 Hz from these body rates on, with 1 mm and 1 mrad of noise and these first guesses of the moments of inertia:
/// the largest error in standard deviations.
fn flown(rates: [f64; 3], guesses: [Expected; 3], settle: f64, seed: u64) -> f64 {
    let truth = RigidBody { rates, ..RigidBody::default() };
    let mut config = VehicleConfig::new(0.005);
    config.mass = Expected::about(truth.mass);
    config.inertia = guesses;
    config.rotation.state_settle = settle;
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

const RATES: [[f64; 3]; 3] = [[0.0; 3], [3.0, -2.0, 2.5], [9.0, -7.0, 15.0]];

/// The largest error of 20 flights.
fn worst(rates: [f64; 3], guesses: [Expected; 3], settle: f64, what: &str) -> f64 {
    let off = (1..=20).map(|seed| flown(rates, guesses, settle, seed)).fold(0.0, f64::max);
    println!("seeds 1..=20, {rates:?} rad/s, {what}: {off:.1} sd");
    off
}

/// From rest, and set spinning before the first measurement.
#[test]
fn within_what_they_say() {
    let [x, y, z] = RigidBody::default().inertia;
    for rates in RATES {
        for guess in [0.7, 1.0, 1.4] {
            let guesses = [x * guess, y / guess, z * guess].map(Expected::about);
            let off = worst(rates, guesses, 0.0, &format!("guess {guess}"));
            assert!(off < 9.0, "{rates:?}, {guess}: {off}");
        }
    }
}

/// There are no rates to compute the gyroscopic moment with, and it counts all the same.
#[test]
fn without_a_guess_and_without_a_state() {
    let inertia = RigidBody::default().inertia;
    for rates in RATES {
        let off = worst(rates, inertia.map(|i| Expected::within(0.1 * i, 10.0 * i)), 0.0, "no guess");
        assert!(off < 12.0, "{rates:?}, no guess: {off}");
        let off = worst(rates, inertia.map(Expected::about), 1.0, "no state for a second");
        assert!(off < 12.0, "{rates:?}, no state: {off}");
    }
}
