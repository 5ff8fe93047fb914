//! Changes are looked for where the identifier's steps are of blocks of several samples as well: none is told where there is none, one that is is.

use fsb_core::Tuning;
use fsb_core::readout::ParameterStatus;
use fsb_core::vehicle::{ChangeRule, Expected, VehicleConfig, VehicleEstimator};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};

/// Changes of mass and inertia told in 9 s, and by how much the mass is off at the end, of which 40 % are dropped after 6 s if `drops`.
fn fly(block: u32, hold_off: f64, course: Course, drops: bool) -> ([u32; 2], f64) {
    let truth = RigidBody::default();
    let mut config = VehicleConfig::new(0.005);
    config.mass = Expected::about(truth.mass);
    config.inertia = truth.inertia.map(Expected::about);
    config.change = Some(ChangeRule { hold_off, ..ChangeRule::default() });
    for group in [&mut config.translation, &mut config.rotation] {
        group.block = block;
        (group.identifier, group.observer) = (Tuning::from_lambda(2.0), Tuning::from_lambda(8.0));
    }
    let mut vehicle = VehicleEstimator::<1>::new(&config).unwrap();
    let mut flight = Flight::new(truth, course, 0.005, u64::from(block));
    (flight.position_noise, flight.attitude_noise) = (1e-3, 1e-3);
    let mut wrench = flight.pilot();
    while flight.t() < 9.0 {
        if drops && (flight.t() - 6.0).abs() < 1e-9 {
            flight.body.mass *= 0.6;
        }
        vehicle.update(&flight.measure(), &wrench);
        wrench = flight.pilot_on(&flight.seen(&vehicle.state()));
        flight.step(&wrench);
    }
    assert_eq!(vehicle.mass_status(), ParameterStatus::Valid, "blocks of {block}");
    let off = vehicle.mass().map_or(f64::INFINITY, |mass| f64::from(mass.value) / flight.body.mass - 1.0);
    ([vehicle.counters().mass_changes, vehicle.counters().inertia_changes], off)
}

#[test]
fn changes_with_blocks() {
    println!("seeds 1 to 30, one for each length of blocks");
    for block in [1, 2, 3, 4, 5, 6, 7, 8, 12, 20, 30] {
        for hold_off in [0.0, 1.0] {
            for course in [Course::HOVER, Course::AGGRESSIVE] {
                for drops in [false, true] {
                    let (told, off) = fly(block, hold_off, course, drops);
                    let wanted = [u32::from(drops), 0];
                    assert_eq!(told, wanted, "blocks of {block}, hold-off {hold_off} s, {course:?}: off by {off}");
                    assert!(off.abs() < 0.02, "blocks of {block}, hold-off {hold_off} s, {course:?}: off by {off}");
                }
            }
        }
    }
}
