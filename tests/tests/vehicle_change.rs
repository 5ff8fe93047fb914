//! A load dropped in flight, and the value held until the new one is known.

use fsb_core::estimator::{Learning, StateStatus};
use fsb_core::readout::ParameterStatus;
use fsb_core::vehicle::{ChangeRule, Events, Expected, Group, VehicleConfig, VehicleEstimator};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

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

/// Flies to `end` s on what is estimated.
fn fly(
    flight: &mut Flight,
    vehicle: &mut VehicleEstimator<1>,
    end: f64,
    mut each: impl FnMut(&mut Flight, &mut VehicleEstimator<1>, Events),
) {
    let mut wrench = flight.pilot();
    while flight.t() < end - 1e-9 {
        let events = vehicle.update(&flight.measure(), &wrench);
        each(flight, vehicle, events);
        wrench = flight.pilot_on(&flight.seen(&vehicle.state()));
        flight.step(&wrench);
    }
}

fn mass(vehicle: &VehicleEstimator<1>) -> f64 {
    vehicle.mass().map_or(f64::INFINITY, |m| f64::from(m.value))
}

/// 40 % of the mass dropped, 1 mm at 100 Hz: the new mass to 2 % within 0.7 s, and from then on.
#[test]
fn a_dropped_load() {
    let mut worst = (0.0_f64, 0.0_f64);
    for course in [Course::HOVER, Course::AGGRESSIVE] {
        for seed in 1..=50 {
            let (mut told, mut known) = (f64::INFINITY, f64::INFINITY);
            let mut vehicle = VehicleEstimator::new(&config()).unwrap();
            fly(&mut noisy(course, seed), &mut vehicle, 8.0, |flight, vehicle, events| {
                let since = flight.t() - 5.0;
                assert!(!events.inertia_changed && (!events.mass_changed || since > 0.0), "{course:?} {seed}: {since}");
                if events.mass_changed {
                    told = told.min(since);
                }
                if since > 0.0 {
                    let right = (mass(vehicle) / flight.body.mass - 1.0).abs() < 0.02;
                    known = if right { known.min(since) } else { f64::INFINITY };
                } else if since.abs() < 1e-9 {
                    flight.body.mass *= 0.6;
                }
            });
            worst = (worst.0.max(told), worst.1.max(known));
        }
    }
    println!("told after {:.2} s at the latest, known to 2 % after {:.2} s at the latest", worst.0, worst.1);
    assert!(worst.1 < 0.7, "{worst:?}");
}

/// 3 cm at 20 Hz: the mass is contradicted before it is seen to have changed, and identified anew all the same; to 2 % within 4 s.
#[test]
fn a_dropped_load_under_noise() {
    println!("seeds 1..=10");
    for (course, seed) in [Course::HOVER, Course::AGGRESSIVE].into_iter().flat_map(|of| (1..=10).map(move |n| (of, n)))
    {
        let mut flight = Flight::new(RigidBody::default(), course, PERIOD, seed);
        (flight.position_noise, flight.attitude_noise) = (0.03, 1e-3);
        let mut config = config();
        config.translation.substeps = 5;
        let mut vehicle = VehicleEstimator::new(&config).unwrap();
        let mut told = None;
        fly(&mut flight, &mut vehicle, 10.0, |flight, vehicle, events| {
            let since = flight.t() - 6.0;
            if since.abs() < 1e-9 {
                flight.body.mass *= 0.6;
            }
            if events.mass_changed {
                told.get_or_insert(since);
            }
            let off = (mass(vehicle) / flight.body.mass - 1.0).abs();
            assert!(since < 3.9 || off < 0.02, "{course:?}, {seed}: mass off by {off} after {since} s");
        });
        assert!(told.is_some_and(|told| told > 0.0 && told < 1.5), "{course:?}, {seed}: {told:?}");
    }
}

/// Nothing has changed: what first guesses 40 to 50 % off left in the innovations is no change of what is known since.
#[test]
fn a_bad_guess_is_no_change() {
    println!("seeds 1..=20");
    for (guess, seed) in [1.5, 0.6].into_iter().flat_map(|guess| (1..=20).map(move |n| (guess, n))) {
        let [x, y, z] = RigidBody::default().inertia;
        let config = VehicleConfig { inertia: [x * guess, y / guess, z * guess].map(Expected::about), ..config() };
        let mut vehicle = VehicleEstimator::new(&config).unwrap();
        fly(&mut noisy(Course::AGGRESSIVE, seed), &mut vehicle, 4.0, |flight, _, events| {
            assert!(!events.inertia_changed && !events.mass_changed, "guess {guess}, seed {seed}: at {} s", flight.t());
        });
    }
}

/// The moments of inertia likewise, where there is something to see them by.
#[test]
fn a_dropped_inertia() {
    let mut vehicle = VehicleEstimator::new(&config()).unwrap();
    let mut told = None;
    fly(&mut noisy(Course::AGGRESSIVE, 3), &mut vehicle, 10.0, |flight, vehicle, events| {
        if (flight.t() - 5.0).abs() < 1e-9 {
            flight.body.inertia = flight.body.inertia.map(|i| 0.6 * i);
        }
        assert!(!events.mass_changed && (!events.inertia_changed || flight.t() > 5.0), "{}", flight.t());
        if events.inertia_changed && told.is_none() {
            told = Some(flight.t() - 5.0);
            assert_eq!(vehicle.inertia_status(), [ParameterStatus::Held; 3]);
        }
    });
    let truth = RigidBody::default().inertia;
    let errors = [0, 1, 2].map(|i| f64::from(vehicle.inertia()[i].unwrap().value) / (0.6 * truth[i]) - 1.0);
    println!("told after {told:?} s; after 5 s off by {errors:.4?}");
    assert!(told.unwrap() < 1.0 && errors.iter().all(|e| e.abs() < 0.02));
}

/// When a change of one moment of inertia, or all three, by a quarter and more was told and when all were known to 5 % from then on (s
/// after it), in flights whose noise and softness hide it from the innovations of a sample.
fn hidden(seed: u64) -> [f64; 2] {
    let mut rng = Pcg64::seed_from_u64(seed);
    let period = [0.01, 0.005, 0.002][rng.random_range(0..3)];
    let mut truth = RigidBody::default();
    let config = VehicleConfig { period, ..config() };
    let mut vehicle = VehicleEstimator::<1>::new(&config).unwrap();
    let soft = rng.random_range(0.3..1.0);
    let course = Course { angles: Course::AGGRESSIVE.angles.map(|angle| soft * angle), ..Course::AGGRESSIVE };
    let mut flight = Flight::new(truth, course, period, seed);
    (flight.position_noise, flight.attitude_noise) = (1e-3, [1e-4, 1e-3, 3e-3][rng.random_range(0..3)]);
    let (at, of) = (rng.random_range(4.0..8.0), rng.random_range(0..4));
    let factor = [rng.random_range(0.4..0.75), rng.random_range(1.3..2.5)][rng.random_range(0..2)];
    for (axis, inertia) in truth.inertia.iter_mut().enumerate() {
        *inertia *= if of == 3 || of == axis { factor } else { 1.0 };
    }
    let (mut wrench, mut told, mut known) = (flight.pilot(), f64::INFINITY, f64::INFINITY);
    while flight.t() < 20.0 {
        let since = flight.t() - at;
        if since >= 0.0 {
            flight.body.inertia = truth.inertia;
        }
        let events = vehicle.update(&flight.measure(), &wrench);
        assert!(!events.inertia_changed || since > 0.0, "seed {seed}: {since}");
        told = if events.inertia_changed { told.min(since) } else { told };
        let mut all = vehicle.inertia().into_iter().zip(flight.body.inertia);
        let right = all.all(|(known, truth)| known.is_some_and(|k| (f64::from(k.value) / truth - 1.0).abs() < 0.05));
        known = if right && since > 0.0 { known.min(since) } else { f64::INFINITY };
        wrench = flight.pilot();
        flight.step(&wrench);
    }
    [told, known]
}

#[test]
fn a_hidden_change() {
    const RUNS: usize = 200;
    let flights: Vec<_> = (0..RUNS as u64).into_par_iter().map(hidden).collect();
    let [told, known] = [0, 1].map(|i| {
        let mut of: Vec<_> = flights.iter().map(|flight| flight[i]).collect();
        of.sort_by(f64::total_cmp);
        [RUNS / 2, RUNS * 9 / 10, RUNS * 99 / 100].map(|n| of[n])
    });
    println!(
        "seeds 0..{RUNS}: told after {told:.2?} s, known after {known:.2?} s, in half, 90 % and 99 % of the flights"
    );
    assert!(told[1] < 2.0 && told[2] < 4.0 && known[1] < 4.0 && known[2] < 8.0, "{told:?} {known:?}");
}

/// While nothing is learned nothing is taken for a change: the parameters stay as they are, and in contact, where the states are
/// predicted with constant velocity, any motion would look like one.
#[test]
fn nothing_learned_nothing_changed() {
    for learning in [Learning::Off, Learning::Contact] {
        let mut vehicle = VehicleEstimator::new(&config()).unwrap();
        fly(&mut noisy(Course::AGGRESSIVE, 9), &mut vehicle, 10.0, |flight, vehicle, events| {
            if (flight.t() - 4.0).abs() < 1e-9 {
                vehicle.set_learning(learning);
            } else if (flight.t() - 6.0).abs() < 1e-9 {
                flight.body.mass *= 0.6;
                flight.body.inertia = flight.body.inertia.map(|i| 0.6 * i);
            }
            assert!(!events.mass_changed && !events.inertia_changed, "{learning:?}: {events:?} at {}", flight.t());
        });
        let statuses = vehicle.inertia_status().into_iter().chain([vehicle.mass_status()]);
        assert!(statuses.into_iter().all(|status| status == ParameterStatus::Valid), "{learning:?}");
    }
}

/// After a gap in the positions, bridged or not, a change is found as soon as without one.
#[test]
fn after_a_gap() {
    for course in [Course::HOVER, Course::AGGRESSIVE] {
        for gap in [0.3, 0.7, 1.5, 1.9, 2.5] {
            let mut vehicle = VehicleEstimator::<1>::new(&config()).unwrap();
            let mut flight = noisy(course, 2);
            let (mut wrench, mut told) = (flight.pilot(), None);
            while flight.t() < 12.0 {
                let mut measured = flight.measure();
                if flight.t() > 5.0 && flight.t() < 5.0 + gap {
                    measured.position = None;
                }
                let events = vehicle.update(&measured, &wrench);
                if events.mass_changed {
                    told = told.or(Some(flight.t() - 10.0));
                }
                if (flight.t() - 10.0).abs() < 1e-9 {
                    flight.body.mass *= 0.6;
                }
                wrench = flight.pilot_on(&flight.seen(&vehicle.state()));
                flight.step(&wrench);
            }
            let off = mass(&vehicle) / flight.body.mass - 1.0;
            println!("{course:?}, {gap} s: told after {told:.2?} s, mass off by {off:.1e}");
            assert!(told.is_some_and(|t| t > 0.0 && t < 0.5) && off.abs() < 0.02, "{course:?} {gap}: {told:?} {off}");
        }
    }
}

fn alarms(course: Course, disturbance: [f64; 3], seconds: f64, seed: u64) -> u32 {
    let mut vehicle = VehicleEstimator::new(&config()).unwrap();
    let mut flight = noisy(course, seed);
    flight.body.disturbance = disturbance;
    fly(&mut flight, &mut vehicle, seconds, |_, _, _| ());
    vehicle.counters().mass_changes + vehicle.counters().inertia_changes
}

/// No false alarm in ten minutes of hover and of flight, also with a force across the thrust of a tenth of the weight.
#[test]
fn no_false_alarm() {
    for (course, disturbance) in
        [(Course::HOVER, [0.0; 3]), (Course::AGGRESSIVE, [0.0; 3]), (Course::HOVER, [2.5, 0.0, 0.0])]
    {
        assert_eq!(alarms(course, disturbance, 600.0, 7), 0, "{course:?} {disturbance:?}");
    }
}

/// The same over ten hours each; takes a minute or two.
#[test]
#[ignore = "long"]
fn no_false_alarm_in_ten_hours() {
    for course in [Course::HOVER, Course::AGGRESSIVE] {
        assert_eq!(alarms(course, [0.0; 3], 36_000.0, 11), 0, "{course:?}");
    }
}

/// A re-initialisation by hand: the old value is handed out and predicted with until the new one takes over.
#[test]
fn held_until_known() {
    let mut config = config();
    config.change = None;
    config.mass.nominal = None;
    let mut vehicle = VehicleEstimator::new(&config).unwrap();
    let (mut before, mut held_for, mut worst) = (0.0, 0, 0.0_f64);
    fly(&mut noisy(Course::HOVER, 5), &mut vehicle, 6.0, |flight, vehicle, _| {
        let status = vehicle.mass_status();
        if (flight.t() - 4.0).abs() < 1e-9 {
            assert_eq!(status, ParameterStatus::Valid);
            before = mass(vehicle);
            vehicle.reinitialise(Group::Translation);
            assert_eq!(vehicle.mass_status(), ParameterStatus::Held);
            assert_eq!(vehicle.translation().state_status(), [StateStatus::Held; 3]);
            assert!(!vehicle.inertia_status().contains(&ParameterStatus::Held));
        } else if status == ParameterStatus::Held {
            held_for += 1;
            assert_eq!(mass(vehicle), before);
            assert_eq!(f64::from(vehicle.model().mass.unwrap()), before);
        } else if flight.t() > 4.0 {
            assert_eq!(status, ParameterStatus::Valid, "no gap after it");
        }
        if flight.t() > 2.0 {
            let velocity = vehicle.state().velocity.expect("all the time");
            worst = (0..3).map(|i| (f64::from(velocity[i]) - flight.body.velocity[i]).abs()).fold(worst, f64::max);
        }
    });
    println!("held for {held_for} instants; velocity off by at most {worst:.4} m/s");
    assert!((5..100).contains(&held_for) && mass(&vehicle) != before);
    // Eight standard deviations of the observer's own noise: 1 mm, λ = 10 at 100 Hz.
    let p = (-0.1_f64).exp();
    assert!(worst < 8.0 * 1e-3 / PERIOD * (2.0 * (1.0 - p).powi(3) / (1.0 + p).powi(3)).sqrt(), "{worst}");
}
