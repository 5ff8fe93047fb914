//! Whatever comes in, what goes out is finite, and what is wrong is named.

use fsb_core::guard::GuardConfig;
use fsb_core::readout::ParameterStatus;
use fsb_core::vehicle::{Attitude, ChangeRule, Expected, Measured, VehicleConfig, VehicleEstimator, Wrench};
use fsb_core::{ConfigError, Tuning};
use fsb_sim_host::hexarotor::Quaternion;
use fsb_tests::rigid_body::{RigidBody, matrix};
use fsb_tests::six_axes::{Course, Flight};
use proptest::prelude::*;

fn config() -> VehicleConfig {
    let truth = RigidBody::default();
    let mut config = VehicleConfig::new(0.005);
    config.mass = Expected::about(truth.mass);
    config.inertia = truth.inertia.map(Expected::about);
    config.change = Some(ChangeRule::default());
    config
}

fn all_finite<const D: usize>(vehicle: &VehicleEstimator<D>) -> bool {
    let state = vehicle.state();
    let vectors = [state.position, state.velocity, state.rates];
    let (mass, model) = (vehicle.mass(), vehicle.model());
    vectors.iter().flatten().flatten().all(|x| x.is_finite())
        && state.attitude.iter().flatten().flatten().all(|x| x.is_finite())
        && vehicle.inertia().iter().chain([&mass]).flatten().all(|x| x.value.is_finite() && x.variance.is_finite())
        && model.inertia.iter().chain([&model.mass]).flatten().all(|x| x.is_finite() && *x > 0.0)
}

/// Nonsense every tenth update, of every kind: rejected, counted, told; the flight goes on as if it had not come.
#[test]
fn nonsense_in_flight() {
    let mut vehicle = VehicleEstimator::<1>::new(&config()).unwrap();
    let mut flight = Flight::new(RigidBody::default(), Course::AGGRESSIVE, 0.005, 1);
    let mut wrench = flight.pilot();
    for tick in 0..2000_u32 {
        let mut measured = flight.measure();
        let mut told = wrench;
        if tick % 10 == 3 {
            let bad = [f32::NAN, f32::INFINITY, -1e30][tick as usize / 10 % 3];
            measured.position = Some([1.0, bad, 0.0]);
            measured.attitude = Some(Attitude::Quaternion([0.1, bad, 0.3, 0.4]));
            told.force[0] = bad;
            told.torque[2] = bad;
        }
        let events = vehicle.update(&measured, &told);
        let expected = tick % 10 == 3;
        assert_eq!(
            [events.position_rejected, events.attitude_rejected, events.wrench_rejected],
            [expected; 3],
            "{tick}"
        );
        assert!(!events.attitude_lost && !events.mass_changed && !events.inertia_changed, "{tick}: {events:?}");
        assert!(all_finite(&vehicle), "{tick}");
        wrench = flight.pilot();
        flight.step(&wrench);
    }
    let counters = vehicle.counters();
    assert_eq!([counters.rejected_positions, counters.rejected_attitudes, counters.rejected_wrenches], [200; 3]);
    // A tenth of the wrenches was replaced by the one before.
    let mass = vehicle.mass().unwrap().value;
    assert!((mass / 2.5 - 1.0).abs() < 0.002, "{mass}");
}

/// Attitudes 65 ms late of a body that tumbles, and moments of inertia so far off that the gyroscopic moment over that time, as
/// predicted, grows without bound: then there is neither an attitude nor a rate.
#[test]
fn rates_beyond_all_bounds() {
    let mut config = config();
    (config.translation.latency, config.rotation.latency) = (13, 13);
    config.inertia = [0.005, 0.03, 0.25].map(Expected::about);
    config.rotation.parameter_settle = 1e3;
    let mut vehicle = VehicleEstimator::<13>::new(&config).unwrap();
    let body = RigidBody { rates: [10.0, 5.0, 10.0], ..RigidBody::default() };
    let mut flight = Flight::new(body, Course::HOVER, 0.005, 1);
    let mut late = std::collections::VecDeque::from([Measured::default(); 13]);
    let wrench = Wrench { force: [0.0, 0.0, 25.0], torque: [0.0; 3] };
    let mut nothing = 0;
    for tick in 0..400 {
        late.push_back(flight.measure());
        vehicle.update(&late.pop_front().unwrap(), &wrench);
        let state = vehicle.state();
        assert!(all_finite(&vehicle), "{tick}: {state:?}");
        assert_eq!(state.attitude.is_none(), state.rates.is_none(), "{tick}");
        nothing += u32::from(state.rates.is_none());
        flight.step(&wrench);
    }
    println!("nothing handed out at {nothing} of 400 updates");
    assert!((50..400).contains(&nothing));
}

/// A heading that jumps and stays there for ten samples: the rotation begins anew, with the moments of inertia that were
/// known. Until then it is taken for an outlier.
#[test]
fn a_jump_of_the_heading() {
    let mut vehicle = VehicleEstimator::<1>::new(&config()).unwrap();
    let mut flight = Flight::new(RigidBody::default(), Course::AGGRESSIVE, 0.005, 1);
    let mut wrench = flight.pilot();
    let mut before = vehicle.inertia();
    for tick in 0..1000 {
        let mut measured = flight.measure();
        if tick >= 600 {
            let away = Quaternion::from_euler([0.0, 0.0, 1.5]);
            measured.attitude = Some(matrix(&away.then_in_body(&flight.body.attitude)));
        }
        let events = vehicle.update(&measured, &wrench);
        assert_eq!(events.attitude_lost, tick == 609, "{tick}");
        assert_eq!(events.attitude_rejected, (600..609).contains(&tick), "{tick}");
        if tick == 609 {
            assert_eq!(vehicle.inertia(), before);
            assert_eq!(vehicle.inertia_status(), [ParameterStatus::Held; 3]);
        }
        before = vehicle.inertia();
        if tick >= 619 {
            let rates = vehicle.state().rates.expect("again");
            let worst = (0..3).map(|i| (f64::from(rates[i]) - flight.body.rates[i]).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-3, "{tick}: {worst}");
        }
        wrench = flight.pilot();
        flight.step(&wrench);
    }
    assert_eq!(vehicle.inertia_status(), [ParameterStatus::Valid; 3], "known anew");
}

/// Before it begins, and after a reset, there is nothing; and the same flight gives the same bits.
#[test]
fn reset_is_a_new_start() {
    let mut vehicle = VehicleEstimator::<1>::new(&config()).unwrap();
    let run = |vehicle: &mut VehicleEstimator<1>| {
        assert_eq!((vehicle.mass(), vehicle.state().position, vehicle.state().rates), (None, None, None));
        let mut flight = Flight::new(RigidBody::default(), Course::AGGRESSIVE, 0.005, 4);
        flight.position_noise = 1e-3;
        let mut wrench = Wrench { force: [f32::NAN; 3], torque: [9e9; 3] };
        for _ in 0..500 {
            let events = vehicle.update(&flight.measure(), &wrench);
            assert!(!events.any(), "the first wrench does not matter");
            wrench = flight.pilot();
            flight.step(&wrench);
        }
        (vehicle.state(), vehicle.mass(), vehicle.inertia())
    };
    let first = run(&mut vehicle);
    assert!(first.1.is_some());
    vehicle.reset();
    assert_eq!(run(&mut vehicle), first);
}

/// Matrix, quaternion and Euler angles are the same attitude.
#[test]
fn forms_of_the_attitude() {
    let euler = [0.3, -0.4, 2.0];
    let q = Quaternion::from_euler(euler);
    let forms = [matrix(&q), Attitude::Quaternion(q.0.map(|x| x as f32)), Attitude::Euler(euler.map(|x| x as f32))];
    for attitude in forms {
        let mut vehicle = VehicleEstimator::<1>::new(&VehicleConfig::new(0.01)).unwrap();
        vehicle.update(&Measured { position: None, attitude: Some(attitude) }, &Wrench::default());
        let got = vehicle.state().attitude.expect("as measured");
        for (got, truth) in got.iter().flatten().zip(q.matrix().iter().flatten()) {
            assert!((f64::from(*got) - truth).abs() < 3e-7, "{attitude:?}");
        }
    }
}

/// Each parameter that cannot be right is named as it is written.
/// The ends of what a mass and an inertia may be, and the defaults that are documented.
#[test]
fn ends_and_defaults() {
    for nominal in [1e-12, 1e12] {
        let all = Expected { nominal: Some(nominal), min: 1e-12, max: 1e12 };
        let config = VehicleConfig { mass: all, inertia: [all; 3], ..VehicleConfig::new(2e-3) };
        assert!(VehicleEstimator::<1>::new(&config).is_ok(), "{nominal}");
    }
    let default = VehicleConfig::new(2e-3);
    assert_eq!((default.mass, default.inertia), (Expected::within(1e-3, 1e3), [Expected::within(1e-7, 1e3); 3]));
    let VehicleConfig { translation, rotation, gravity, .. } = default;
    assert_eq!(
        (gravity, translation.identifier, rotation.identifier),
        (9.81, Tuning::from_lambda(4.0), Tuning::from_lambda(4.0))
    );
    assert_eq!((translation.observer, rotation.observer), (Tuning::from_lambda(10.0), Tuning::from_lambda(20.0)));
    let guard =
        GuardConfig { sigmas: 8.0, acceleration: 20.0, floor: 5e-3, jump_after: 10, bridge: 2.0, frozen_after: 0 };
    assert_eq!((translation.guard, rotation.guard), (guard, GuardConfig { acceleration: 200.0, ..guard }));
    assert_eq!(ChangeRule::default(), ChangeRule { relative: 0.15, sigmas: 6.0, hold_off: 1.0 });
    assert_eq!(Expected::about(2.0), Expected { nominal: Some(2.0), min: 0.2, max: 20.0 });
}

#[test]
fn refused() {
    let refused = |change: fn(&mut VehicleConfig)| {
        let mut config = config();
        change(&mut config);
        VehicleEstimator::<10>::new(&config).map(|_| ()).unwrap_err()
    };
    assert_eq!(refused(|c| c.gravity = -1.0), ConfigError::Negative("gravity"));
    assert_eq!(refused(|c| c.gravity = 1e7), ConfigError::OutOfRange("gravity"));
    assert_eq!(refused(|c| c.period = 0.0), ConfigError::NonPositive("period"));
    assert_eq!(refused(|c| c.mass.min = 0.0), ConfigError::NonPositive("mass.min"));
    assert_eq!(refused(|c| c.mass.max = c.mass.min), ConfigError::InvertedRange("mass.min"));
    assert_eq!(refused(|c| c.mass.nominal = Some(f64::NAN)), ConfigError::NonFinite("mass.nominal"));
    assert_eq!(refused(|c| c.mass.min = 0.9e-12), ConfigError::OutOfRange("mass.min"));
    assert_eq!(refused(|c| c.mass.max = 1.1e12), ConfigError::OutOfRange("mass.max"));
    assert_eq!(refused(|c| c.mass.nominal = Some(1.1e12)), ConfigError::OutOfRange("mass.nominal"));
    assert_eq!(refused(|c| c.inertia[0].nominal = Some(0.9e-12)), ConfigError::OutOfRange("inertia.nominal"));
    assert_eq!(refused(|c| c.inertia[2].max = f64::INFINITY), ConfigError::NonFinite("inertia.max"));
    assert_eq!(refused(|c| c.inertia[1].nominal = Some(-1.0)), ConfigError::NonPositive("inertia.nominal"));
    assert_eq!(refused(|c| c.translation.substeps = 0), ConfigError::Zero("translation.substeps"));
    assert_eq!(refused(|c| c.rotation.block = 0), ConfigError::Zero("rotation.block"));
    assert_eq!(refused(|c| c.translation.latency = 11), ConfigError::OutOfRange("translation.latency"));
    assert_eq!(refused(|c| c.rotation.latency = 1), ConfigError::OutOfRange("translation.latency"));
    assert_eq!(refused(|c| c.rotation.latency = 11), ConfigError::OutOfRange("rotation.latency"));
    assert_eq!(
        refused(|c| c.rotation.observer.lambda = 1e4),
        ConfigError::TooFastForPeriod("rotation.observer.lambda")
    );
    assert_eq!(
        refused(|c| c.translation.measurement_limit = 0.0),
        ConfigError::NonPositive("translation.measurement_limit")
    );
    assert_eq!(refused(|c| c.rotation.max_relative_sd = 0.0), ConfigError::NonPositive("rotation.max_relative_sd"));
    assert_eq!(refused(|c| c.rotation.input_limit = 6e5), ConfigError::OutOfRange("rotation.input_limit"));
    assert_eq!(refused(|c| c.actuator_lag = Some(-1.0)), ConfigError::NonPositive("actuator_lag"));
    assert_eq!(refused(|c| c.actuator_lag = Some(1e-4)), ConfigError::OutOfRange("actuator_lag"));
    let change = |relative, sigmas, hold_off| {
        let change = Some(ChangeRule { relative, sigmas, hold_off });
        VehicleEstimator::<1>::new(&VehicleConfig { change, ..config() }).map(|_| ()).unwrap_err()
    };
    assert_eq!(change(0.15, 0.0, 1.0), ConfigError::NonPositive("change.sigmas"));
    assert_eq!(change(1e-9, 6.0, 1.0), ConfigError::OutOfRange("change.relative"));
    assert_eq!(change(0.15, 6.0, -1.0), ConfigError::Negative("change.hold_off"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(12), ..Default::default() })]

    /// Any bit pattern, in any order, late or not: never a number that is none.
    #[test]
    fn any_bits(bits in prop::collection::vec(any::<u32>(), 40 * 17), lag in any::<bool>(), latency in 0_u32..4) {
        let mut config = config();
        config.actuator_lag = lag.then_some(0.02);
        config.translation.latency = latency;
        config.rotation.latency = latency / 2;
        let mut vehicle = VehicleEstimator::<4>::new(&config).unwrap();
        for words in bits.chunks_exact(17) {
            let word = |i: usize| f32::from_bits(words[i]);
            // Half of it plausible, so that the estimator begins.
            let plausible = |i: usize| if words[16] >> i & 1 == 0 { word(i) } else { (words[i] % 1000) as f32 * 1e-3 };
            let quaternion = if words[16] >> 20 & 3 != 0 {
                [1.0, 0.0, 0.0, 0.0]
            } else {
                [word(3), word(4), word(5), word(6)]
            };
            let measured = Measured {
                position: (words[16] >> 22 & 3 != 0).then(|| [0, 1, 2].map(plausible)),
                attitude: (words[16] >> 24 & 3 != 0).then_some(Attitude::Quaternion(quaternion)),
            };
            vehicle.update(&measured, &Wrench { force: [7, 8, 9].map(plausible), torque: [10, 11, 12].map(plausible) });
            prop_assert!(all_finite(&vehicle));
        }
    }
}
