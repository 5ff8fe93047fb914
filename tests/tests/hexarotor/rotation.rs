//! Free rotation: what is conserved, and the symmetric top in closed form.

use fsb_sim_host::hexarotor::vector::{Vector, by_components, dot, norm, scaled};
use fsb_sim_host::hexarotor::{Hexarotor, HexarotorConfig, Quaternion, StartConfig};

use super::{TICK, built, close, fly};

fn spinning(inertia: Vector, body_rates: Vector) -> HexarotorConfig {
    let start = StartConfig { attitude: [0.3, -0.4, 1.0], body_rates, ..Default::default() };
    HexarotorConfig { inertia, start, ..Default::default() }
}

/// Angular momentum in the world frame [kg m²/s] and kinetic energy of rotation [J].
fn conserved(vehicle: &Hexarotor) -> (Vector, f64) {
    let (state, inertia) = (vehicle.state(), vehicle.true_parameters().inertia);
    let momentum = by_components(inertia, state.body_rates);
    (state.attitude.rotate(momentum), dot(momentum, state.body_rates) / 2.0)
}

/// An asymmetric top, started close to its middle axis so that it turns over again and again.
#[test]
fn momentum_and_energy_of_a_free_rotation_stay() {
    for rates in [[4.0, 5.0, -3.0], [0.05, 9.0, 0.05], [0.0, 0.1, 12.0]] {
        let mut vehicle = built(&spinning([0.03, 0.035, 0.055], rates));
        let (momentum, energy) = conserved(&vehicle);
        for _ in 0..20 {
            fly(&mut vehicle, [0.0; 6], 1.0);
            let (now, energy_now) = conserved(&vehicle);
            close(now, momentum, 1e-9 * norm(momentum));
            assert!((energy_now / energy - 1.0).abs() < 1e-9, "{energy_now} against {energy}");
            let length: f64 = vehicle.state().attitude.0.iter().map(|value| value * value).sum();
            assert!((length - 1.0).abs() < 1e-15, "{length}");
        }
        assert!(norm(vehicle.state().body_rates) > 1.0);
    }
}

/// ω_x + i ω_y turns at n = (I_z - I_x)/I_x ω_z in the body; the body's z axis turns about the angular momentum at |L|/I_x.
#[test]
fn a_symmetric_top_precesses_at_the_analytic_rates() {
    let (inertia, rates) = ([0.03, 0.03, 0.055], [3.0, 0.0, 8.0]);
    let mut vehicle = built(&spinning(inertia, rates));
    let momentum = conserved(&vehicle).0;
    let axis = vehicle.state().attitude.rotate([0.0, 0.0, 1.0]);
    let n = (inertia[2] - inertia[0]) / inertia[0] * rates[2];
    for second in 1..=10 {
        fly(&mut vehicle, [0.0; 6], 1.0);
        let t = f64::from(second);
        close(vehicle.state().body_rates, [3.0 * (n * t).cos(), 3.0 * (n * t).sin(), 8.0], 1e-8);
        let turn = Quaternion::from_rotation_vector(scaled(t / inertia[0], momentum));
        close(vehicle.state().attitude.rotate([0.0, 0.0, 1.0]), turn.rotate(axis), 1e-8);
    }
}

/// Halving the step divides the error by 16.
#[test]
fn the_integration_is_of_fourth_order() {
    let (inertia, rates) = ([0.03, 0.03, 0.055], [3.0, 0.0, 8.0]);
    let n = (inertia[2] - inertia[0]) / inertia[0] * rates[2];
    let error = |max_step| {
        let config = HexarotorConfig { max_step, ..spinning(inertia, rates) };
        let mut vehicle = built(&config);
        let momentum = conserved(&vehicle).0;
        let axis = vehicle.state().attitude.rotate([0.0, 0.0, 1.0]);
        vehicle.step(&[0.0; 6], 2.0);
        let turn = Quaternion::from_rotation_vector(scaled(2.0 / inertia[0], momentum));
        let (to, now) = (turn.rotate(axis), vehicle.state().attitude.rotate([0.0, 0.0, 1.0]));
        let rates = vehicle.state().body_rates;
        [
            (rates[0] - 3.0 * (2.0 * n).cos()).hypot(rates[1] - 3.0 * (2.0 * n).sin()),
            (now[0] - to[0]).hypot(now[1] - to[1]),
        ]
    };
    let (coarse, fine) = (error(0.01), error(0.005));
    for (coarse, fine) in coarse.iter().zip(fine) {
        let ratio = coarse / fine;
        assert!((14.5..17.5).contains(&ratio), "{coarse:e} to {fine:e}: {ratio}");
    }
}

/// A held torque about one axis from rest: ω = τ t/I, the angle τ t²/(2 I).
#[test]
fn a_held_torque_turns_a_body_at_rest() {
    let inertia = HexarotorConfig::default().inertia;
    for axis in 0..3 {
        let mut vehicle = built(&HexarotorConfig::default());
        let mut torque = [0.0; 3];
        torque[axis] = 0.04;
        let allocation = vehicle.allocate([0.0, 0.0, 24.5], torque);
        assert!(!allocation.saturated);
        fly(&mut vehicle, allocation.thrusts, 1.0);
        let mut expected = [0.0; 3];
        expected[axis] = 0.04 / inertia[axis];
        close(vehicle.state().body_rates, expected, 1e-12);
        close(vehicle.state().attitude.rotation_vector(), scaled(0.5, expected), 1e-12);
    }
}

/// Tick by tick and in one go it is the same motion: max_step divides both.
#[test]
fn the_tick_does_not_change_the_motion() {
    let config = spinning([0.03, 0.035, 0.055], [4.0, 5.0, -3.0]);
    let (mut ticks, mut once) = (built(&config), built(&config));
    fly(&mut ticks, [1.0, 3.0, 2.0, 4.0, 5.0, 3.0], 0.5);
    once.step(&[1.0, 3.0, 2.0, 4.0, 5.0, 3.0], 500.0 * TICK);
    close(ticks.state().position, once.state().position, 1e-10);
    close(ticks.state().body_rates, once.state().body_rates, 1e-10);
}
