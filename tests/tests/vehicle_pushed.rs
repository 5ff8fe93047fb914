//! A vehicle that is pushed, and one that is set spinning: the state follows, and mass and moments of inertia stay within what
//! they say. While it tumbles with little torque only the proportions of the moments of inertia can be told.

use fsb_core::vehicle::{Expected, Identified, VehicleConfig, VehicleEstimator};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};

/// What was seen after the push.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// Updates to the first event, of translation and rotation, lost attitudes included.
    told: [Option<u32>; 2],
    /// Largest errors of velocity (m/s) and rates (rad/s), from 0.2 s on and from 2 s on.
    velocity: [f64; 2],
    rates: [f64; 2],
    /// Of mass and moments of inertia from the truth, in their standard deviations.
    off: f64,
    /// The largest relative error of mass and moments of inertia at the end; not valid counts as infinite.
    end: f64,
}

/// 6 s of aggressive flight, then velocity and rates changed at once, then 8 s more; 1 mm and 1 mrad of noise.
fn flown(period: f64, by: [f64; 3], spun: [f64; 3], seed: u64) -> Seen {
    let truth = RigidBody::default();
    let mut config = VehicleConfig::new(period);
    config.mass = Expected::about(truth.mass);
    config.inertia = truth.inertia.map(Expected::about);
    let mut vehicle = VehicleEstimator::<1>::new(&config).unwrap();
    let mut flight = Flight::new(truth, Course::AGGRESSIVE, period, seed);
    (flight.position_noise, flight.attitude_noise) = (1e-3, 1e-3);
    let mut wrench = flight.pilot();
    let hit = (6.0 / period) as u32;
    let mut seen = Seen::default();
    for tick in 0..hit + (8.0 / period) as u32 {
        if tick == hit {
            for axis in 0..3 {
                flight.body.velocity[axis] += by[axis];
                flight.body.rates[axis] += spun[axis];
            }
        }
        let events = vehicle.update(&flight.measure(), &wrench);
        if tick > hit {
            let happened = [events.translation_pushed, events.rotation_pushed || events.attitude_lost];
            for (told, happened) in seen.told.iter_mut().zip(happened) {
                *told = told.or(happened.then_some(tick - hit));
            }
            let (state, since) = (vehicle.state(), f64::from(tick - hit) * period);
            for (worst, error) in [
                (&mut seen.velocity, largest(state.velocity, flight.body.velocity)),
                (&mut seen.rates, largest(state.rates, flight.body.rates)),
            ] {
                for (worst, from) in worst.iter_mut().zip([0.2, 2.0]) {
                    if since >= from {
                        *worst = worst.max(error);
                    }
                }
            }
            let [x, y, z] = vehicle.inertia();
            let known = [vehicle.mass(), x, y, z].into_iter().zip([truth.mass].into_iter().chain(truth.inertia));
            seen.end = 0.0;
            for (known, truth) in known {
                seen.off = seen.off.max(known.map_or(0.0, |k| off(k, truth)));
                seen.end = seen.end.max(known.map_or(f64::INFINITY, |k| (f64::from(k.value) / truth - 1.0).abs()));
            }
        }
        wrench = flight.pilot();
        flight.step(&wrench);
    }
    seen
}

fn off(known: Identified, truth: f64) -> f64 {
    (f64::from(known.value) - truth).abs() / (f64::from(known.sd()) + 1e-6 * truth)
}

fn largest(found: Option<[f32; 3]>, truth: [f64; 3]) -> f64 {
    found.map_or(f64::INFINITY, |found| {
        found.iter().zip(truth).map(|(found, truth)| (f64::from(*found) - truth).abs()).fold(0.0, f64::max)
    })
}

#[test]
fn pushed() {
    println!("seeds 1..=5");
    for (period, by) in [(0.005, [3.0, -2.0, 4.0]), (0.002, [0.0, 8.0, -7.0]), (0.01, [0.0, 0.0, 5.0])] {
        for seed in 1..=5 {
            let seen = flown(period, by, [0.0; 3], seed);
            let Seen { told, velocity, rates, off, end } = seen;
            assert!(told[0].is_some_and(|n| n <= 12) && told[1].is_none(), "{period} s, {by:?}, {seed}: {told:?}");
            assert!(velocity[0] < 0.1 && velocity[1] < 0.01 && rates[0] < 0.03, "{period} s, {by:?}, {seed}: {seen:?}");
            assert!(off < 7.0 && end < 1e-3, "{period} s, {by:?}, {seed}: {seen:?}");
        }
    }
}

#[test]
fn set_spinning() {
    println!("seeds 1..=5");
    for (period, by) in
        [(0.002, [9.0, -7.0, 15.0]), (0.005, [9.0, -7.0, 5.0]), (0.005, [4.0, 3.0, -12.0]), (0.01, [6.0, -6.0, 6.0])]
    {
        for seed in 1..=5 {
            let seen = flown(period, [0.0; 3], by, seed);
            let Seen { told, velocity, rates, off, end } = seen;
            assert!(told[0].is_none() && told[1].is_some_and(|n| n <= 20), "{period} s, {by:?}, {seed}: {told:?}");
            assert!(rates[0] < 0.2 && rates[1] < 0.03 && velocity[1] < 0.01, "{period} s, {by:?}, {seed}: {seen:?}");
            assert!(off < 7.0 && end < 2e-3, "{period} s, {by:?}, {seed}: {seen:?}");
        }
    }
}
