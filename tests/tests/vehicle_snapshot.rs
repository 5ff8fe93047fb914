//! Snapshots of the whole vehicle: what is restored goes on to the last bit, through latency, lag, gaps, a change of mass and a
//! loss of the attitude; what is no snapshot of this vehicle is refused.

use fsb_core::readout::Memory;
use fsb_core::snapshot::SnapshotError;
use fsb_core::vehicle::{Attitude, ChangeRule, Events, Expected, Measured, VehicleConfig, VehicleEstimator, Wrench};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::seal::sealed;
use fsb_tests::six_axes::{Course, Flight};
use proptest::prelude::*;
use std::sync::LazyLock;

type Vehicle = VehicleEstimator<8>;

fn config() -> VehicleConfig {
    let truth = RigidBody::default();
    let mut config = VehicleConfig::new(0.005);
    config.mass = Expected::about(truth.mass);
    config.inertia = truth.inertia.map(Expected::about);
    config.change = Some(ChangeRule::default());
    config.actuator_lag = Some(0.02);
    config.translation.latency = 6;
    config.translation.substeps = 2;
    config.rotation.latency = 2;
    config.rotation.guard.frozen_after = 20;
    config
}

/// What the estimator is given, tick by tick: a flight with gaps, outliers, a mass that changes and a heading that is lost.
fn flight(ticks: usize) -> Vec<(Measured, Wrench)> {
    let mut flight = Flight::new(RigidBody::default(), Course::AGGRESSIVE, 0.005, 1);
    let mut wrench = flight.pilot();
    (0..ticks)
        .map(|tick| {
            let mut measured = flight.measure();
            if tick % 2 == 1 || (700..740).contains(&tick) {
                measured.position = None;
            }
            if tick % 23 == 5 {
                measured.attitude = None;
            }
            if tick % 40 == 20 {
                measured.position = measured.position.map(|p| p.map(|x| x + 4.0));
            }
            if tick == 1600 {
                flight.body.mass *= 0.7;
            }
            if tick >= 2400 {
                measured.attitude = Some(Attitude::Quaternion([0.0, 0.0, 0.0, 1.0]));
            }
            let told = wrench;
            wrench = flight.pilot();
            flight.step(&wrench);
            (measured, told)
        })
        .collect()
}

fn tick(vehicle: &mut Vehicle, (measured, wrench): &(Measured, Wrench)) -> Events {
    vehicle.update(measured, wrench)
}

fn taken(vehicle: &Vehicle) -> Vec<u8> {
    let mut bytes = vec![0; vehicle.snapshot_length()];
    assert_eq!(vehicle.snapshot(&mut bytes), Ok(bytes.len()));
    bytes
}

#[test]
fn what_is_restored_goes_on_to_the_last_bit() {
    let flight = flight(3000);
    let mut config = config();
    for memory in [Memory::Infinite, Memory::Fading { tau: 3.0 }] {
        (config.rotation.memory, config.translation.memory) = (memory, memory);
        for moment in [0, 1, 3, 5, 9, 250, 705, 1599, 1630, 2405, 2700] {
            let mut original = Vehicle::new(&config).unwrap();
            for given in &flight[..moment] {
                tick(&mut original, given);
            }
            let mut restored = Vehicle::new(&config).unwrap();
            // Whatever it was doing before.
            for given in &flight[..137] {
                tick(&mut restored, given);
            }
            restored.restore(&taken(&original)).unwrap();
            for (n, given) in flight.iter().enumerate().skip(moment).take(1000) {
                assert_eq!(taken(&original), taken(&restored), "{moment}, {n}");
                assert_eq!(tick(&mut original, given), tick(&mut restored, given), "{moment}, {n}");
                assert_eq!(original.state(), restored.state(), "{moment}, {n}");
            }
            assert_eq!(original.mass(), restored.mass());
            assert_eq!(original.inertia(), restored.inertia());
            assert_eq!(original.counters(), restored.counters());
        }
    }
}

#[test]
fn others_are_refused() {
    let flight = flight(1000);
    let mut vehicle = Vehicle::new(&config()).unwrap();
    for given in &flight {
        tick(&mut vehicle, given);
    }
    let good = taken(&vehicle);
    let changes: [fn(&mut VehicleConfig); 9] = [
        |c| c.period = 0.004,
        |c| c.actuator_lag = Some(0.03),
        |c| c.translation.latency = 4,
        |c| c.change = None,
        |c| c.change = Some(ChangeRule { relative: 0.3, ..ChangeRule::default() }),
        |c| c.rotation.memory = Memory::Fading { tau: 1.0 },
        |c| c.mass = Expected::about(3.0),
        |c| c.gravity = 9.7,
        |c| c.translation.input_limit = 50.0,
    ];
    for (index, change) in changes.iter().enumerate() {
        let mut other = config();
        change(&mut other);
        let mut other = Vehicle::new(&other).unwrap();
        let refused = other.restore(&good).unwrap_err();
        assert!(matches!(refused, SnapshotError::Design | SnapshotError::Shape), "{index}: {refused}");
    }
    // Room for more latency is no difference.
    let mut roomy = VehicleEstimator::<12>::new(&config()).unwrap();
    assert_eq!(roomy.restore(&good), Ok(()));
    for bit in (0..8 * good.len()).step_by(7) {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(vehicle.restore(&bytes).is_err(), "bit {bit}");
    }
    assert_eq!(taken(&vehicle), good);
}

static FLIGHT: LazyLock<Vec<(Measured, Wrench)>> = LazyLock::new(|| flight(1000));

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, rng_seed: proptest::test_runner::RngSeed::Fixed(8), failure_persistence: None, ..ProptestConfig::default() })]

    /// A state made up, its checksum right: refused, or what follows is numbers and no panic.
    #[test]
    fn a_state_made_up_does_no_harm(words in prop::collection::vec((0_usize..4096, any::<u32>()), 1..6), moment in 1_usize..900) {
        let flight = &*FLIGHT;
        let mut vehicle = Vehicle::new(&config()).unwrap();
        for given in &flight[..moment] {
            tick(&mut vehicle, given);
        }
        let mut bytes = taken(&vehicle);
        let state = bytes.len() / 4 - 5;
        for (place, word) in words {
            let at = 16 + 4 * (place % state);
            bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
        }
        let sealed = sealed(bytes);
        if vehicle.restore(&sealed).is_ok() {
            for given in &flight[moment..] {
                tick(&mut vehicle, given);
                let state = vehicle.state();
                for x in [state.position, state.velocity, state.rates].iter().flatten().flatten() {
                    prop_assert!(x.is_finite());
                }
            }
            for k in vehicle.inertia().iter().chain([&vehicle.mass()]).flatten() {
                prop_assert!(k.value.is_finite() && k.variance >= 0.0);
            }
        }
    }
}
