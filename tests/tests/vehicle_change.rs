//! A load dropped in flight, and the value held until the new one is known.

use fsb_core::readout::ParameterStatus;
use fsb_core::vehicle::{ChangeRule, Expected, Group, VehicleConfig, VehicleEstimator};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};

const PERIOD: f64 = 0.01;

fn config() -> VehicleConfig {
    let truth = RigidBody::default();
    let mut config = VehicleConfig::new(PERIOD);
    config.mass = Expected::about(1.3 * truth.mass);
    config.inertia = truth.inertia.map(|i| Expected::about(1.3 * i));
    config.change = Some(ChangeRule::default());
    config
}

fn noisy(course: Course, seed: u64) -> Flight {
    let mut flight = Flight::new(RigidBody::default(), course, PERIOD, seed);
    flight.position_noise = 1e-3;
    flight.attitude_noise = 0.1_f64.to_radians();
    flight
}

/// 40 % of the mass dropped in hover, 1 mm at 100 Hz: the new mass to 2 % within 0.7 s, and never off by more afterwards.
#[test]
fn a_dropped_load() {
    for (course, seed) in (1..=20).map(|seed| (Course::HOVER, seed)).chain((1..=20).map(|seed| (Course::AGGRESSIVE, seed))) {
        let mut flight = noisy(course, seed);
        let mut vehicle = VehicleEstimator::<1>::new(&config()).unwrap();
        let mut wrench = flight.pilot();
        let (mut told, mut known) = (None, None);
        while flight.t() < 8.0 {
            if (flight.t() - 5.0).abs() < 1e-9 {
                flight.body.mass *= 0.6;
            }
            let events = vehicle.update(&flight.measure(), &wrench);
            assert!(!events.inertia_changed, "seed {seed}, {} s", flight.t());
            if events.mass_changed {
                assert!(flight.t() > 5.0, "seed {seed}: false alarm at {} s", flight.t());
                told.get_or_insert(flight.t() - 5.0);
            }
            let mass = vehicle.mass().map_or(f64::INFINITY, |m| f64::from(m.value));
            let right = (mass / flight.body.mass - 1.0).abs() < 0.02;
            if flight.t() > 5.0 {
                known = if right { known.or(Some(flight.t() - 5.0)) } else { None };
            }
            wrench = flight.pilot();
            flight.step(&wrench);
        }
        println!("{course:?} seed {seed}: told after {told:?} s, within 2 % from {known:?} s on");
    }
}
