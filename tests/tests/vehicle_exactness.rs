//! What is exact at any attitude: position and velocity under a known force, with actuators that lag, and over measurements
//! that are late. Without noise, against a rigid body in f64, k being known.

use fsb_core::vehicle::{Expected, Measured, VehicleConfig, VehicleEstimator, VehicleState};
use fsb_sim_host::hexarotor::Quaternion;
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};
use std::collections::VecDeque;

/// Mass and inertia known: nothing is left to identify.
fn known(period: f64, body: &RigidBody) -> VehicleConfig {
    let mut config = VehicleConfig::new(period);
    config.mass = Expected::about(body.mass);
    config.inertia = body.inertia.map(Expected::about);
    config
}

/// What rounding to f32 leaves: some ulp of the position, 3 m, and of its difference over a period, and the same of angles.
const EXACT: Errors = [2e-6, 2e-5, 5e-6, 2e-5];

/// Largest errors of position (m), velocity (m/s), attitude (rad) and rates (rad/s).
type Errors = [f64; 4];

fn errors(state: &VehicleState, body: &RigidBody) -> Errors {
    let off = |got: Option<[f32; 3]>, truth: [f64; 3]| {
        got.map_or(f64::INFINITY, |got| (0..3).map(|i| (f64::from(got[i]) - truth[i]).abs()).fold(0.0, f64::max))
    };
    let truth = body.attitude.matrix();
    let attitude = state.attitude.map_or(f64::INFINITY, |r| {
        let entries = r.iter().flatten().zip(truth.iter().flatten());
        entries.map(|(got, truth)| (f64::from(*got) - truth).abs()).fold(0.0, f64::max)
    });
    [off(state.position, body.position), off(state.velocity, body.velocity), attitude, off(state.rates, body.rates)]
}

/// The worst from `from` to `end` s; `arrives` makes of what is measured now what the estimator gets.
fn worst<const D: usize>(
    config: &VehicleConfig,
    flight: &mut Flight,
    [from, end]: [f64; 2],
    mut arrives: impl FnMut(Measured, u64) -> Measured,
) -> Errors {
    let mut vehicle = VehicleEstimator::<D>::new(config).unwrap();
    let mut worst = [0.0_f64; 4];
    let mut wrench = flight.pilot();
    let mut tick = 0;
    while flight.t() < end {
        vehicle.update(&arrives(flight.measure(), tick), &wrench);
        if flight.t() >= from {
            let errors = errors(&vehicle.state(), &flight.body);
            worst = std::array::from_fn(|i| worst[i].max(errors[i]));
        }
        wrench = flight.pilot();
        flight.step(&wrench);
        tick += 1;
    }
    worst
}

fn within(what: &str, errors: Errors, bounds: Errors) {
    println!(
        "{what}: position {:.1e} m, velocity {:.1e} m/s, attitude {:.1e}, rates {:.1e} rad/s",
        errors[0], errors[1], errors[2], errors[3]
    );
    assert!((0..4).all(|i| errors[i] <= bounds[i]), "{what}: {errors:?} beyond {bounds:?}");
}

/// A force that is constant along the body's axes, on a body that turns by 1 rad/s, far from level: from the third
/// measurement on.
#[test]
fn a_turning_force() {
    for rate in [100.0, 500.0] {
        let body = RigidBody {
            attitude: Quaternion::from_euler([0.7, -0.5, 2.0]),
            rates: [0.6, -0.5, 0.6],
            velocity: [1.0, 2.0, -1.0],
            inertia: [0.04; 3],
            ..RigidBody::default()
        };
        let mut vehicle = VehicleEstimator::<1>::new(&known(1.0 / rate, &body)).unwrap();
        let mut flight = Flight::new(body, Course::HOVER, 1.0 / rate, 1);
        let wrench = fsb_core::vehicle::Wrench { force: [3.0, -5.0, 24.0], torque: [0.0; 3] };
        let mut worst = [0.0_f64; 4];
        for tick in 0..(2.0 * rate) as u64 {
            vehicle.update(&flight.measure(), &wrench);
            if tick >= (0.2 * rate) as u64 {
                let errors = errors(&vehicle.state(), &flight.body);
                worst = std::array::from_fn(|i| worst[i].max(errors[i]));
            }
            flight.step(&wrench);
        }
        within(&format!("{rate} Hz"), worst, EXACT);
    }
}

/// Actuators of first order.
#[test]
fn lag() {
    for (rate, lag) in [(200.0, 0.05), (500.0, 0.02), (200.0, 0.002)] {
        let body = RigidBody { lag, ..RigidBody::default() };
        // In the first period they have settled at what they are told.
        let settled = |mut flight: Flight| {
            let told = flight.pilot();
            flight.body.actual = [told.force, told.torque].map(|v| v.map(f64::from));
            flight
        };
        let mut config = known(1.0 / rate, &body);
        config.actuator_lag = Some(lag);
        let mut flight = settled(Flight::new(body, Course::AGGRESSIVE, 1.0 / rate, 1));
        let with = worst::<1>(&config, &mut flight, [1.0, 6.0], |m, _| m);
        config.actuator_lag = None;
        let mut flight = settled(Flight::new(body, Course::AGGRESSIVE, 1.0 / rate, 1));
        let without = worst::<1>(&config, &mut flight, [1.0, 6.0], |m, _| m);
        within(&format!("{rate} Hz, {lag} s"), with, EXACT);
        assert!(without[1] > 100.0 * with[1], "the lag is there: {without:?}");
    }
}

/// What is measured now arrives so many updates later.
fn late(position: usize, attitude: usize) -> impl FnMut(Measured, u64) -> Measured {
    let (mut positions, mut attitudes) = (VecDeque::new(), VecDeque::new());
    move |measured, _| {
        positions.push_back(measured.position);
        attitudes.push_back(measured.attitude);
        Measured {
            position: if positions.len() > position { positions.pop_front().flatten() } else { None },
            attitude: if attitudes.len() > attitude { attitudes.pop_front().flatten() } else { None },
        }
    }
}

/// The state now from measurements that are late, 80 ms of it.
#[test]
fn latency() {
    let body = RigidBody::default();
    for (rate, position, attitude) in [(1000.0, 80, 0), (1000.0, 80, 80), (250.0, 20, 5), (250.0, 1, 1)] {
        let mut config = known(1.0 / rate, &body);
        config.translation.latency = position as u32;
        config.rotation.latency = attitude as u32;
        let mut flight = Flight::new(body, Course::AGGRESSIVE, 1.0 / rate, 1);
        let got = worst::<80>(&config, &mut flight, [1.0, 6.0], late(position, attitude));
        within(&format!("{rate} Hz, {position} and {attitude} late"), got, EXACT);
    }
}

/// Attitude every fourth and position every tenth period; and three attitudes in ten missing.
#[test]
fn slower_and_missing() {
    let body = RigidBody::default();
    let mut config = known(2e-3, &body);
    config.rotation.substeps = 4;
    config.translation.substeps = 10;
    let mut flight = Flight::new(body, Course::AGGRESSIVE, 2e-3, 1);
    let got = worst::<1>(&config, &mut flight, [1.0, 6.0], |measured, tick| Measured {
        position: measured.position.filter(|_| tick % 10 == 0),
        attitude: measured.attitude.filter(|_| tick % 4 == 0),
    });
    within("slower", got, EXACT);
    // From when on the moments of inertia, identified from a quarter of a second on, are known to 1e-5 as well.
    let config = known(2e-3, &body);
    let mut flight = Flight::new(body, Course::AGGRESSIVE, 2e-3, 1);
    let got = worst::<1>(&config, &mut flight, [2.0, 6.0], |measured, tick| Measured {
        position: measured.position,
        attitude: measured.attitude.filter(|_| tick * 7 % 10 < 7),
    });
    within("missing", got, EXACT);
    // A second without any attitude.
    let mut flight = Flight::new(body, Course::AGGRESSIVE, 2e-3, 1);
    let got = worst::<1>(&config, &mut flight, [1.0, 6.0], |measured, tick| Measured {
        position: measured.position,
        attitude: measured.attitude.filter(|_| !(1500..2000).contains(&tick)),
    });
    within("a gap", got, EXACT);
}

/// A limit of the torque is one of what the actuators are told: the gyroscopic moment of a body that tumbles, many times that here,
/// is not cut off by it.
#[test]
fn gyroscopic_moment_beyond_the_limit() {
    let body = RigidBody { rates: [10.0, 0.5, 10.0], ..RigidBody::default() };
    let run = |limit: f64| {
        let mut config = known(2e-3, &body);
        config.rotation.input_limit = limit;
        // On the known moments of inertia throughout.
        config.rotation.parameter_settle = 1e3;
        let mut vehicle = VehicleEstimator::<1>::new(&config).unwrap();
        let mut flight = Flight::new(body, Course::HOVER, 2e-3, 1);
        let wrench = |t: f64| fsb_core::vehicle::Wrench {
            force: [0.0, 0.0, 25.0],
            torque: [0.2 * (9.0 * t).sin(), 0.2 * (7.0 * t).cos(), 0.1 * (5.0 * t).sin()].map(|x| x as f32),
        };
        let mut worst = [0.0_f64; 4];
        let mut told = wrench(0.0);
        while flight.t() < 4.0 {
            let events = vehicle.update(&flight.measure(), &told);
            assert!(!events.any(), "{events:?}");
            if flight.t() > 0.4 {
                let errors = errors(&vehicle.state(), &flight.body);
                worst = std::array::from_fn(|i| worst[i].max(errors[i]));
            }
            told = wrench(flight.t());
            flight.step(&told);
        }
        worst
    };
    let (free, limited) = (run(1e5), run(0.3));
    println!("rates off by {:.1e} rad/s, with a limit of 0.3 N m by {:.1e}", free[3], limited[3]);
    assert_eq!(limited, free);
    assert!(free[3] < 0.02, "{free:?}");
}

/// A body that spins on and on: its angles begin anew before they lose digits or run into their limit.
#[test]
fn spinning_on() {
    for (limit, axis) in [(1e5, 2), (100.0, 2), (7.0, 0)] {
        for rate in [20.0, -20.0] {
            let mut config = known(0.01, &RigidBody::default());
            config.rotation.measurement_limit = limit;
            let mut vehicle = VehicleEstimator::<1>::new(&config).unwrap();
            let wrench = fsb_core::vehicle::Wrench::default();
            let (mut worst, mut rates) = (0.0_f64, [0.0; 3]);
            rates[axis] = rate;
            for tick in 0..60_000 {
                let mut turn = [0.0; 3];
                turn[axis] = (rate * f64::from(tick) * 0.01) % std::f64::consts::TAU;
                let attitude = fsb_tests::rigid_body::matrix(&Quaternion::from_rotation_vector(turn));
                let events = vehicle.update(&Measured { position: None, attitude: Some(attitude) }, &wrench);
                assert!(!events.any(), "{limit} rad, tick {tick}: {events:?}");
                if tick > 100 {
                    let got = vehicle.state().rates.expect("all the time");
                    worst = (0..3).map(|i| (f64::from(got[i]) - rates[i]).abs()).fold(worst, f64::max);
                }
            }
            println!("{rate} rad/s, limit {limit} rad: off by {worst:.1e} rad/s");
            // Some ulp of 64 rad in a period, through the observer: 4e-6 · λ.
            assert!(worst < 1e-4, "{limit} rad: {worst}");
        }
    }
}
