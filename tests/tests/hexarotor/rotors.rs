//! Rotor lag and the rotors' own angular momentum.

use fsb_sim_host::hexarotor::vector::{Vector, add_scaled, by_components};
use fsb_sim_host::hexarotor::{FrameConfig, Hexarotor, HexarotorConfig, LagOn, RotorConfig};

use super::{TICK, built, close, fly};

fn lagging(lag_on: LagOn) -> HexarotorConfig {
    let rotor = RotorConfig { time_constant: 0.05, lag_on, ..Default::default() };
    HexarotorConfig { rotor, ..Default::default() }
}

/// The step response of Ω or T is 1 - e^(-t/T_r) at every tick, and the thrust is k_T Ω².
#[test]
fn the_step_response_is_of_first_order() {
    for lag_on in [LagOn::Speed, LagOn::Thrust] {
        let config = lagging(lag_on);
        let level = |thrust: f64| match lag_on {
            LagOn::Speed => (thrust / config.rotor.thrust_coefficient).sqrt(),
            LagOn::Thrust => thrust,
        };
        let mut vehicle = built(&config);
        let from = vehicle.thrusts()[0];
        for n in 1..=300 {
            vehicle.step(&[9.0; 6], TICK);
            let expected = level(9.0) + (level(from) - level(9.0)) * (-f64::from(n) * TICK / 0.05).exp();
            for (thrust, speed) in vehicle.thrusts().into_iter().zip(vehicle.rotor_speeds()) {
                assert!((level(thrust) / expected - 1.0).abs() < 1e-12, "{n}: {thrust}");
                assert!((thrust / (config.rotor.thrust_coefficient * speed * speed) - 1.0).abs() < 1e-12);
            }
        }
    }
}

/// The climb under a lagging thrust in closed form: with e = e^(-t/T_r), ∫T dt = T_c t + (T_0 - T_c) T_r (1 - e) if the
/// thrust lags, and k_T (Ω_c² t + 2 Ω_c Δ T_r (1 - e) + Δ² T_r/2 (1 - e²)) if the speed does.
#[test]
fn the_lag_acts_within_the_ticks() {
    for lag_on in [LagOn::Speed, LagOn::Thrust] {
        let config = lagging(lag_on);
        let mut vehicle = built(&config);
        let from = vehicle.thrusts()[0];
        let (t, lag, k) = (0.1, 0.05, config.rotor.thrust_coefficient);
        fly(&mut vehicle, [9.0; 6], t);
        let gone = 1.0 - (-t / lag).exp();
        let impulse = match lag_on {
            LagOn::Thrust => 9.0 * t + (from - 9.0) * lag * gone,
            LagOn::Speed => {
                let (to, off) = ((9.0 / k).sqrt(), (from / k).sqrt() - (9.0 / k).sqrt());
                let square = 1.0 - (-2.0 * t / lag).exp();
                k * (to * to * t + 2.0 * to * off * lag * gone + off * off * lag / 2.0 * square)
            }
        };
        let expected = 6.0 * (std::f64::consts::FRAC_PI_6).cos() * impulse / 2.5 - 9.81 * t;
        close(vehicle.state().velocity, [0.0, 0.0, expected], 1e-9);
    }
}

/// Rotors that push next to nothing (1e-6 N on 1 mm arms), but turn at up to 1000 rad/s.
fn flywheels() -> HexarotorConfig {
    HexarotorConfig {
        gravity: 0.0,
        frame: FrameConfig { arm: 1e-3, ..Default::default() },
        rotor: RotorConfig {
            thrust_max: 1e-6,
            thrust_coefficient: 1e-12,
            drag_ratio: 0.0,
            time_constant: 0.2,
            inertia: 2e-5,
            ..Default::default()
        },
        ..Default::default()
    }
}

fn rotor_momentum(vehicle: &Hexarotor) -> Vector {
    let frame = vehicle.allocator().frame();
    let pairs = frame.axes().iter().zip(vehicle.rotor_speeds()).enumerate();
    pairs
        .fold([0.0; 3], |sum, (i, (axis, speed))| add_scaled(sum, if i % 2 == 0 { 2e-5 } else { -2e-5 } * speed, *axis))
}

/// Three rotors that turn counter-clockwise spin up: the body turns clockwise, I_z ω_z = -3 J Ω cos β.
#[test]
fn spinning_up_turns_the_body_back() {
    let mut vehicle = built(&flywheels());
    fly(&mut vehicle, [1e-6, 0.0, 1e-6, 0.0, 1e-6, 0.0], 4.0);
    let yaw = -3.0 * 2e-5 * 1000.0 * (std::f64::consts::FRAC_PI_6).cos() / 0.055;
    close(vehicle.state().body_rates, [0.0, 0.0, yaw], 1e-6);
}

/// Body and rotors together keep their angular momentum in the world, while the rotors change speed and the body tumbles.
#[test]
fn body_and_rotors_together_keep_their_momentum() {
    let mut config = flywheels();
    config.start.body_rates = [2.0, -1.0, 0.5];
    let mut vehicle = built(&config);
    let momentum = |vehicle: &Hexarotor| {
        let own = by_components(config.inertia, vehicle.state().body_rates);
        vehicle.state().attitude.rotate(add_scaled(own, 1.0, rotor_momentum(vehicle)))
    };
    let start = momentum(&vehicle);
    for commands in [[1e-6, 0.0, 3e-7, 0.0, 0.0, 0.0], [0.0, 1e-6, 0.0, 0.0, 5e-7, 1e-6], [2e-7; 6]] {
        fly(&mut vehicle, commands, 1.0);
        close(momentum(&vehicle), start, 1e-8);
    }
    assert!(rotor_momentum(&vehicle).iter().any(|h| h.abs() > 1e-5));
}
