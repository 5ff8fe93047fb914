//! Translation in closed form.

use fsb_sim_host::hexarotor::{HexarotorConfig, StartConfig};

use super::{built, close, fly};

/// A parabola, whatever the body does meanwhile.
#[test]
fn without_thrust_it_falls_on_a_parabola() {
    let start = StartConfig {
        position: [1.0, 2.0, 100.0],
        velocity: [3.0, -1.0, 5.0],
        attitude: [0.3, 0.4, 0.5],
        body_rates: [2.0, -3.0, 4.0],
    };
    let mut vehicle = built(&HexarotorConfig { start, ..Default::default() });
    fly(&mut vehicle, [0.0; 6], 2.0);
    close(vehicle.state().position, [7.0, 0.0, 110.0 - 9.81 * 2.0], 1e-10);
    close(vehicle.state().velocity, [3.0, -1.0, 5.0 - 9.81 * 2.0], 1e-10);
}

/// (9) with R turning: at a yaw rate r a body force along x gives x' = F/(m r) (sin r t, 1 - cos r t).
#[test]
fn a_body_force_turns_with_the_body() {
    let start = StartConfig { body_rates: [0.0, 0.0, 2.0], ..Default::default() };
    let mut vehicle = built(&HexarotorConfig { start, ..Default::default() });
    let allocation = vehicle.allocate([1.5, 0.0, 2.5 * 9.81], [0.0; 3]);
    fly(&mut vehicle, allocation.thrusts, 3.0);
    let scale = 1.5 / (2.5 * 2.0);
    let (sin, cos) = 6.0_f64.sin_cos();
    close(vehicle.state().velocity, [scale * sin, scale * (1.0 - cos), 0.0], 1e-10);
    let position = [scale / 2.0 * (1.0 - cos), scale * (3.0 - sin / 2.0), 0.0];
    close(vehicle.state().position, position, 1e-10);
}

/// The body force of (11) for rest, m g Rᵀ e3, holds it still in a tilted attitude.
#[test]
fn it_hovers_tilted() {
    let attitude = [0.1, -0.12, 0.7];
    let start = StartConfig { attitude, ..Default::default() };
    let mut vehicle = built(&HexarotorConfig { start, ..Default::default() });
    let force = vehicle.state().attitude.rotate_back([0.0, 0.0, 2.5 * 9.81]);
    let allocation = vehicle.allocate(force, [0.0; 3]);
    assert!(!allocation.saturated);
    fly(&mut vehicle, allocation.thrusts, 10.0);
    close(vehicle.state().position, [0.0; 3], 1e-9);
    close(vehicle.state().attitude.euler(), attitude, 1e-9);
}
