//! What the vehicle's estimator is told reaches its two parts, and what it hands out is theirs.

use fsb_core::estimator::Learning;
use fsb_core::readout::{Memory, ParameterStatus, Readout};
use fsb_core::vehicle::{Events, Expected, GroupConfig, VehicleConfig, VehicleEstimator, Wrench};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};

const PERIOD: f64 = 0.01;

fn flown(config: &VehicleConfig, seconds: f64) -> VehicleEstimator<1> {
    let mut flight = Flight::new(RigidBody::default(), Course::AGGRESSIVE, PERIOD, 3);
    (flight.position_noise, flight.attitude_noise) = (2e-3, 1e-3);
    let mut vehicle = VehicleEstimator::new(config).unwrap();
    for _ in 0..(seconds / PERIOD) as u32 {
        let wrench = flight.pilot();
        vehicle.update(&flight.measure(), &wrench);
        flight.step(&wrench);
    }
    vehicle
}

fn config() -> VehicleConfig {
    let truth = RigidBody::default();
    let mut config = VehicleConfig::new(PERIOD);
    config.mass = Expected::about(1.3 * truth.mass);
    config.inertia = truth.inertia.map(|i| Expected::about(1.3 * i));
    config
}

/// m = 1/k with var(k)/k⁴, and so the moments of inertia.
#[test]
fn identified_values_are_inverses() {
    let vehicle = flown(&config(), 8.0);
    let masses = vehicle.translation().parameters().map(|k| (k, vehicle.mass()));
    let inertias = vehicle.rotation().parameters().into_iter().zip(vehicle.inertia());
    for (k, found) in masses.into_iter().chain(inertias) {
        let (k, found) = (k.expect("valid"), found.expect("valid"));
        let (value, variance) = (f64::from(k.value), f64::from(k.variance));
        assert!((f64::from(found.value) * value - 1.0).abs() < 1e-6);
        assert!((f64::from(found.variance) * value.powi(4) / variance - 1.0).abs() < 1e-5);
        assert!((f64::from(found.sd()) * value * value / variance.sqrt() - 1.0).abs() < 1e-5);
    }
    assert!((f64::from(vehicle.mass().unwrap().value) / RigidBody::default().mass - 1.0).abs() < 0.02);
}

/// Expected about x: from a tenth to ten times of it.
#[test]
fn expected_about() {
    for x in [0.02, 1.0, 300.0] {
        let Expected { nominal, min, max } = Expected::about(x);
        assert_eq!(nominal, Some(x));
        assert!((10.0 * min / x - 1.0).abs() < 1e-12 && (max / (10.0 * x) - 1.0).abs() < 1e-12, "{x}: {min} to {max}");
    }
}

/// The settings of a group are those of its estimator, group by group.
#[test]
fn settings_arrive() {
    let mass = |vehicle: &VehicleEstimator<1>| vehicle.mass().map(|m| m.value.to_bits());
    let inertia = |vehicle: &VehicleEstimator<1>| vehicle.inertia().map(|i| i.map(|i| i.value.to_bits()));
    let plain = flown(&config(), 6.0);
    // Each changes what is identified of its own group, and of that alone.
    let changes: [fn(&mut GroupConfig); 2] =
        [|g| g.readout = Readout::AbsoluteRatio, |g| g.memory = Memory::Fading { tau: 2.0 }];
    for change in changes {
        let mut one = config();
        change(&mut one.translation);
        let one = flown(&one, 6.0);
        assert!(mass(&one) != mass(&plain) && inertia(&one) == inertia(&plain));
        let mut other = config();
        change(&mut other.rotation);
        let other = flown(&other, 6.0);
        assert!(inertia(&other) != inertia(&plain) && mass(&other) == mass(&plain));
    }
    // Not before ε.
    let mut late = config();
    late.translation.parameter_settle = 5.0;
    late.rotation.state_settle = 5.0;
    assert_eq!(flown(&late, 4.9).mass_status(), ParameterStatus::Settling);
    assert_eq!(flown(&late, 5.3).mass_status(), ParameterStatus::Valid);
    assert!(flown(&late, 4.9).state().rates.is_none() && flown(&late, 5.1).state().rates.is_some());
    // Bounds, and what is predicted with until it is known.
    let truth = RigidBody::default();
    let mut bounded = config();
    bounded.mass = Expected { nominal: None, min: 1.5 * truth.mass, max: 3.0 * truth.mass };
    let bounded = flown(&bounded, 4.0);
    assert_eq!((bounded.mass(), bounded.mass_status()), (None, ParameterStatus::AboveRange));
    let start = flown(&config(), 0.1);
    assert!((f64::from(start.model().mass.expect("nominal")) / (1.3 * truth.mass) - 1.0).abs() < 1e-6);
    // A noise known beforehand is known at once.
    let mut known = config();
    (known.translation.noise_sd, known.rotation.noise_sd) = (Some(2e-3), Some(1e-3));
    let known = flown(&known, 0.05);
    assert!(known.translation().state_sd()[0].is_some() && known.rotation().state_sd()[0].is_some());
    let unknown = flown(&config(), 0.05);
    assert!(unknown.translation().state_sd()[0].is_none() && unknown.rotation().state_sd()[0].is_none());
}

/// Free fall has its place; a gravity that pulls up has not.
#[test]
fn without_gravity() {
    let with = |gravity: f64| VehicleEstimator::<1>::new(&VehicleConfig { gravity, ..config() }).map(|_| ());
    assert_eq!(with(0.0), Ok(()));
    assert_eq!(with(-0.1).unwrap_err().parameter(), "gravity");
}

/// Told not to learn nothing moves; nothing is learned on the ground.
#[test]
fn learning_is_told_to_both() {
    let mut flight = Flight::new(RigidBody::default(), Course::AGGRESSIVE, PERIOD, 4);
    let mut vehicle = VehicleEstimator::<1>::new(&config()).unwrap();
    let mut known = None;
    for n in 0..1200 {
        if n == 600 {
            known = Some((vehicle.mass().expect("valid"), vehicle.inertia()));
            vehicle.set_learning(Learning::Off);
        }
        let wrench = flight.pilot();
        vehicle.update(&flight.measure(), &wrench);
        flight.step(&wrench);
        if let Some((mass, inertia)) = known {
            assert_eq!((vehicle.mass(), vehicle.inertia()), (Some(mass), inertia), "{n}");
        }
    }
}

/// On the ground nobody knows what acts: thrust and torque move nothing, over the time by which measurements are late neither.
#[test]
fn at_rest_in_contact() {
    let mut config = config();
    (config.translation.latency, config.rotation.latency) = (10, 8);
    let mut vehicle = VehicleEstimator::<10>::new(&config).unwrap();
    vehicle.set_learning(Learning::Contact);
    let measured = Flight::new(RigidBody::default(), Course::HOVER, PERIOD, 1).measure();
    for _ in 0..200 {
        vehicle.update(&measured, &Wrench { force: [0.0, 0.0, 15.0], torque: [0.3, 0.1, 0.0] });
    }
    let state = vehicle.state();
    assert_eq!((state.velocity, state.rates), (Some([0.0; 3]), Some([0.0; 3])));
}

#[test]
fn any_event_is_one() {
    assert!(!Events::default().any());
    let mut jumped = Events::default();
    jumped.position_jumped = true;
    assert!(jumped.any());
}
