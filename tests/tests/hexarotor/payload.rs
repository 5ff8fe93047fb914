//! What is picked up and dropped in flight.

use fsb_sim_host::hexarotor::{HexarotorConfig, Payload, PayloadStep, TrueParameters};

use super::{TICK, built, close, fly};

const LOAD: Payload = Payload { mass: 1.0, inertia: [0.002, 0.003, 0.004] };

/// Carried from 0 s, dropped at 1 s: hover, then at the held thrusts upwards with (m + m_p)/m g - g, from a velocity that
/// did not jump.
#[test]
fn a_dropped_load_lets_it_climb() {
    let payload = vec![PayloadStep { at: 0.0, payload: LOAD }, PayloadStep { at: 1.0, payload: Payload::default() }];
    let mut vehicle = built(&HexarotorConfig { payload, ..Default::default() });
    let loaded = vehicle.true_parameters();
    assert_eq!(loaded.mass, 3.5);
    close(loaded.inertia, [0.032, 0.038, 0.059], 1e-16);
    let hover = vehicle.allocate([0.0, 0.0, 3.5 * 9.81], [0.0; 3]).thrusts;
    fly(&mut vehicle, hover, 1.0 - TICK);
    assert_eq!(vehicle.true_parameters(), loaded);
    vehicle.step(&hover, TICK);
    assert_eq!(vehicle.true_parameters(), TrueParameters { mass: 2.5, inertia: [0.03, 0.035, 0.055] });
    close(vehicle.state().velocity, [0.0; 3], 1e-11);
    fly(&mut vehicle, hover, 0.5);
    let acceleration = 9.81 * (3.5 / 2.5 - 1.0);
    close(vehicle.state().velocity, [0.0, 0.0, 0.5 * acceleration], 1e-10);
    close(vehicle.state().position, [0.0, 0.0, 0.125 * acceleration], 1e-10);
}

/// By hand in mid-flight: the same torque turns the heavier body more slowly.
#[test]
fn a_load_adds_its_inertia() {
    let mut vehicle = built(&HexarotorConfig::default());
    vehicle.set_payload(LOAD).unwrap();
    let thrusts = vehicle.allocate([0.0, 0.0, 20.0], [0.0, 0.0, 0.05]).thrusts;
    fly(&mut vehicle, thrusts, 1.0);
    close(vehicle.state().body_rates, [0.0, 0.0, 0.05 / 0.059], 1e-12);
    let refused = vehicle.set_payload(Payload { mass: -1.0, ..LOAD }).unwrap_err();
    assert_eq!((refused.name.as_str(), vehicle.true_parameters().mass), ("payload.mass", 3.5));
}

/// The rotors start at the thrust that carries what hangs on it at t = 0.
#[test]
fn it_starts_in_hover() {
    let payload = vec![PayloadStep { at: 0.0, payload: LOAD }];
    let mut config = HexarotorConfig { payload, ..Default::default() };
    config.rotor.time_constant = 0.05;
    let mut vehicle = built(&config);
    let thrusts = vehicle.thrusts();
    assert!((vehicle.wrench(&thrusts).force[2] - 3.5 * 9.81).abs() < 1e-12);
    fly(&mut vehicle, thrusts, 1.0);
    close(vehicle.state().position, [0.0; 3], 1e-10);
}

/// After a million ticks of 1 ms it is 1000 s, and what is due then happens then.
#[test]
fn times_add_up() {
    let payload = vec![PayloadStep { at: 1000.0, payload: LOAD }];
    let mut vehicle = built(&HexarotorConfig { payload, ..Default::default() });
    fly(&mut vehicle, [4.7; 6], 1000.0 - TICK);
    assert_eq!(vehicle.true_parameters().mass, 2.5);
    fly(&mut vehicle, [4.7; 6], TICK);
    assert_eq!((vehicle.state().time, vehicle.true_parameters().mass), (1000.0, 3.5));
}
