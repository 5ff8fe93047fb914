//! Forces and torques that are no numbers for a while: what acted then nobody knows, and nothing is learned from it.

use fsb_core::vehicle::{Expected, Measured, VehicleConfig, VehicleEstimator, Wrench};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// 6 s of aggressive flight at 200 Hz with 1 mm and 1 mrad of noise, attitudes 5 and positions 20 ms late or not, first guesses right. From 0.2 to 2 s on
/// the wrench told is NaN for 0.1 to 0.5 s. The largest error of a parameter in its standard deviations, and whether all are valid at the end.
fn flown(seed: u64) -> (f64, bool) {
    let mut rng = Pcg64::seed_from_u64(seed);
    let period = 0.005;
    let truth = RigidBody::default();
    let mut config = VehicleConfig::new(period);
    config.mass = Expected::about(truth.mass);
    config.inertia = truth.inertia.map(Expected::about);
    let late = [[0, 0], [4, 1]][rng.random_range(0..2)];
    [config.translation.latency, config.rotation.latency] = late.map(|late| late as u32);
    let mut vehicle = VehicleEstimator::<4>::new(&config).unwrap();
    let mut flight = Flight::new(truth, Course::AGGRESSIVE, period, seed);
    (flight.position_noise, flight.attitude_noise) = (1e-3, 1e-3);
    let begins = rng.random_range(0.2..2.0);
    let ends = begins + rng.random_range(0.1..0.5);
    let (mut wrench, mut worst) = (flight.pilot(), 0.0_f64);
    let mut past = Vec::new();
    for tick in 0..1200 {
        past.push(flight.measure());
        let [position, attitude] = late.map(|late| past.get(usize::wrapping_sub(tick, late)));
        let measured =
            Measured { position: position.and_then(|m| m.position), attitude: attitude.and_then(|m| m.attitude) };
        let lost = (begins..ends).contains(&flight.t());
        let told = if lost { Wrench { force: [f32::NAN; 3], torque: [f32::INFINITY; 3] } } else { wrench };
        assert_eq!(vehicle.update(&measured, &told).wrench_rejected, lost);
        let known = vehicle.inertia().into_iter().chain([vehicle.mass()]);
        for (known, truth) in known.zip(truth.inertia.into_iter().chain([truth.mass])) {
            let off = known.map_or(0.0, |k| (f64::from(k.value) - truth).abs() / (f64::from(k.sd()) + 1e-3 * truth));
            worst = worst.max(off);
        }
        wrench = flight.pilot();
        flight.step(&wrench);
    }
    (worst, vehicle.mass().is_some() && vehicle.inertia().iter().all(Option::is_some))
}

#[test]
fn nothing_is_learned_of_what_nobody_knows() {
    let flights: Vec<_> = (0..100).into_par_iter().map(flown).collect();
    let mut of: Vec<_> = flights.iter().map(|(worst, _)| *worst).collect();
    of.sort_by(f64::total_cmp);
    println!("seeds 0 to 100: off by {:.1} sd in half, {:.1} in 90 %, {:.1} in all of them", of[50], of[90], of[99]);
    assert!(of[90] < 5.0 && of[99] < 9.0);
    assert!(flights.iter().all(|(_, valid)| *valid));
}
