//! The vehicle's controller: (11) by hand, (13) near level, the attitude error and its motion far from level, refusals.

use fsb_core::control::{ControlError, Gains, Motion, VehicleControlConfig, VehicleController, VehicleReference};
use fsb_sim_host::fly::path::{AttitudePath, PositionPath, Sinusoids};
use fsb_sim_host::fly::reference::{Wanted, narrow, narrow_matrix};
use fsb_sim_host::fly::scenario::References;
use fsb_sim_host::hexarotor::vector::{Vector, norm};
use fsb_sim_host::hexarotor::{Hexarotor, HexarotorConfig, Quaternion, RotorConfig, StartConfig};

const MASS: f64 = 2.5;
const INERTIA: [f64; 3] = [0.03, 0.035, 0.055];

fn controller() -> VehicleController {
    VehicleController::new(&VehicleControlConfig::new()).unwrap()
}

fn motion(attitude: &Quaternion, rates: Vector) -> Motion {
    Motion { position: [0.0; 3], velocity: [0.0; 3], attitude: narrow_matrix(&attitude.matrix()), rates: narrow(rates) }
}

/// 2 (a_d + g e3 - 5 (v - v_d) - 6 (x - x_d)) in the world, seen from a body yawed by 90°: its x is the world's y.
#[test]
fn eleven_by_hand() {
    let reference = VehicleReference {
        position: [1.0, 0.0, 0.0],
        velocity: [0.0, 0.2, 0.0],
        acceleration: [0.0, 0.0, 0.5],
        attitude: [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        ..VehicleReference::hover([0.0; 3])
    };
    let seen =
        Motion { position: [1.5, 0.0, 0.1], velocity: [0.1, 0.0, 0.0], attitude: reference.attitude, rates: [0.0; 3] };
    // World: x: -5 0.1 - 6 0.5 = -3.5; y: 5 0.2 = 1; z: 0.5 + 9.81 - 0.6 = 9.71.
    let wrench = controller().wrench(&reference, &seen, 2.0, [0.1; 3]).unwrap();
    for (found, expected) in wrench.force.iter().zip([2.0, 7.0, 19.42]) {
        assert!((found - expected).abs() < 1e-5, "{:?}", wrench.force);
    }
    assert!(wrench.torque.iter().all(|value| value.abs() < 1e-6), "{:?}", wrench.torque);
}

/// Near level the torque is (13), I (η_d'' - K_D (η' - η_d') - K_P (η - η_d)), up to products of small angles.
#[test]
fn thirteen_near_level() {
    let size = 1e-3;
    let (eta, rate) = ([1.0, -2.0, 0.5].map(|v| v * size), [0.7, 0.2, -1.0].map(|v| v * size));
    let (eta_d, rate_d, acceleration) =
        ([-1.0, 0.5, 2.0].map(|v| v * size), [0.1, -0.4, 0.3].map(|v| v * size), [3.0, -5.0, 2.0].map(|v| v * size));
    let reference = VehicleReference {
        attitude: narrow_matrix(&Quaternion::from_euler(eta_d).matrix()),
        rates: narrow(rate_d),
        angular_acceleration: narrow(acceleration),
        ..VehicleReference::hover([0.0; 3])
    };
    let seen = motion(&Quaternion::from_euler(eta), rate);
    let torque = controller().wrench(&reference, &seen, MASS as f32, narrow(INERTIA)).unwrap().torque;
    for i in 0..3 {
        let wanted = acceleration[i] - 20.0 * (rate[i] - rate_d[i]) - 100.0 * (eta[i] - eta_d[i]);
        let found = f64::from(torque[i]) / INERTIA[i];
        assert!((found - wanted).abs() < 0.003 * 100.0 * size, "axis {i}: {found}, {wanted}");
    }
}

/// At rest the torque is -I K_P a sin θ for a turn by θ about the unit vector a, whatever the reference attitude.
#[test]
fn the_error_is_the_axis_times_the_sine() {
    let axis = [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0];
    let wanted = Quaternion::from_euler([0.4, -0.9, 2.5]);
    for angle in [0.01_f64, 0.5, 1.2, 2.5] {
        let turned = wanted.then_in_body(&Quaternion::from_rotation_vector(axis.map(|a| a * angle)));
        let reference =
            VehicleReference { attitude: narrow_matrix(&wanted.matrix()), ..VehicleReference::hover([0.0; 3]) };
        let torque = controller().wrench(&reference, &motion(&turned, [0.0; 3]), 1.0, narrow(INERTIA)).unwrap().torque;
        for i in 0..3 {
            let expected = -INERTIA[i] * 100.0 * axis[i] * angle.sin();
            assert!((f64::from(torque[i]) - expected).abs() < 2e-6 * 100.0, "{angle}: {torque:?}");
        }
    }
}

/// Far from level, everything turning: (11) and the law of the torque by matrices in f64.
#[test]
fn a_wrench_in_any_attitude() {
    let (seen_at, wanted_at) = (Quaternion::from_euler([0.7, -0.5, 2.1]), Quaternion::from_euler([-0.3, 0.9, 1.2]));
    let (rates, wanted_rates, wanted_angular): (Vector, Vector, Vector) =
        ([0.8, -1.3, 0.5], [1.1, 0.4, -0.9], [2.0, -3.0, 1.5]);
    let reference = VehicleReference {
        acceleration: [1.0, -2.0, 0.7],
        attitude: narrow_matrix(&wanted_at.matrix()),
        rates: narrow(wanted_rates),
        angular_acceleration: narrow(wanted_angular),
        ..VehicleReference::hover([0.0; 3])
    };
    let (r, d) = (seen_at.matrix(), wanted_at.matrix());
    // Q = Rᵀ R_d and its action.
    let q: [Vector; 3] =
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| r[k][i] * d[k][j]).sum::<f64>()));
    let turn = |v: Vector| -> Vector { std::array::from_fn(|i| (0..3).map(|j| q[i][j] * v[j]).sum::<f64>()) };
    let cross = |a: Vector, b: Vector| -> Vector {
        std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
    };
    // R_dᵀ R is Qᵀ.
    let error: Vector = std::array::from_fn(|i| 0.5 * (q[(i + 1) % 3][(i + 2) % 3] - q[(i + 2) % 3][(i + 1) % 3]));
    let moving = turn(wanted_rates);
    let (ahead, coriolis) = (turn(wanted_angular), cross(rates, moving));
    let momentum: Vector = std::array::from_fn(|i| INERTIA[i] * rates[i]);
    let gyroscopic = cross(rates, momentum);
    let wrench = controller().wrench(&reference, &motion(&seen_at, rates), MASS as f32, narrow(INERTIA)).unwrap();
    for i in 0..3 {
        let pull: f64 = (0..3).map(|j| r[j][i] * [1.0, -2.0, 0.7 + 9.81][j]).sum();
        assert!((f64::from(wrench.force[i]) - MASS * pull).abs() < 1e-4, "{wrench:?}");
        let angular = ahead[i] - coriolis[i] - 20.0 * (rates[i] - moving[i]) - 100.0 * error[i];
        let expected = INERTIA[i] * angular + gyroscopic[i];
        assert!((f64::from(wrench.torque[i]) - expected).abs() < 1e-4, "axis {i}: {wrench:?}, {expected}");
    }
}

/// A vehicle with thrust to spare. So far from level it cannot hold its place, but the allocation keeps the torque first.
fn strong(start: StartConfig) -> Hexarotor {
    let rotor = RotorConfig { thrust_max: 200.0, ..RotorConfig::default() };
    let config = HexarotorConfig { mass: MASS, inertia: INERTIA, rotor, start, ..HexarotorConfig::default() };
    Hexarotor::new(&config).unwrap()
}

fn flown(vehicle: &mut Hexarotor, reference: &VehicleReference, controller: &VehicleController, period: f64) {
    let state = vehicle.state();
    let seen = Motion {
        position: narrow(state.position),
        velocity: narrow(state.velocity),
        attitude: narrow_matrix(&state.attitude.matrix()),
        rates: narrow(state.body_rates),
    };
    let wrench = controller.wrench(reference, &seen, MASS as f32, narrow(INERTIA)).unwrap();
    let allocation = vehicle.allocate(wrench.force.map(f64::from), wrench.torque.map(f64::from));
    let given = vehicle.wrench(&allocation.thrusts).torque;
    assert!(given.iter().zip(wrench.torque).all(|(given, wanted)| (given - f64::from(wanted)).abs() < 1e-9));
    vehicle.step(&allocation.thrusts, period);
}

/// Turned by 1.5 rad about an axis that is no principal one, the closed loop turns back about this very axis:
/// θ'' = -K_D θ' - K_P sin θ. The ω × Iω of the body is made up for, else the axis would wander.
#[test]
fn a_large_turn_comes_back_about_its_axis() {
    let (period, axis) = (2e-4, [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0]);
    let start = Quaternion::from_rotation_vector(axis.map(|a| 1.5 * a));
    let mut vehicle = strong(StartConfig { attitude: start.euler(), ..StartConfig::default() });
    let reference = VehicleReference::hover([0.0; 3]);
    let (mut angle, mut rate, controller) = (1.5_f64, 0.0_f64, controller());
    for _ in 0..(0.4 / period) as usize {
        flown(&mut vehicle, &reference, &controller, period);
        // Semi-implicit steps of a tenth: their error is far below the tolerance.
        for _ in 0..10 {
            rate += period / 10.0 * (-20.0 * rate - 100.0 * angle.sin());
            angle += period / 10.0 * rate;
        }
    }
    let turn = vehicle.state().attitude.rotation_vector();
    println!("{turn:?}, {angle}");
    for i in 0..3 {
        assert!((turn[i] - angle * axis[i]).abs() < 2e-3, "{turn:?}, {angle}");
    }
    assert!(norm(turn) < 0.4, "it does come back: {turn:?}");
}

/// Started on a fast large-angle reference with its rates, the vehicle stays on it: what is left is the hold of a period.
#[test]
fn a_large_motion_is_followed() {
    let references = References {
        position: PositionPath::Hover { at: [0.0; 3] },
        attitude: AttitudePath::Sinusoids(Sinusoids {
            centre: [0.0; 3],
            amplitude: [0.8, 0.7, 1.5],
            frequency: [2.0, 2.7, 1.4],
            phase: [0.3, 1.0, 0.0],
            ramp: 0.0,
        }),
    };
    let worst = |period: f64| {
        let begin = Wanted::at(&references, 0.0);
        let start = StartConfig { attitude: begin.euler.value, body_rates: begin.rates, ..StartConfig::default() };
        let (mut vehicle, mut worst, controller) = (strong(start), 0.0_f64, controller());
        for n in 0..(4.0 / period) as usize {
            let wanted = Wanted::at(&references, n as f64 * period);
            worst =
                worst.max(norm(wanted.attitude.inverse().then_in_body(&vehicle.state().attitude).rotation_vector()));
            flown(&mut vehicle, &wanted.in_f32(), &controller, period);
        }
        worst
    };
    let (coarse, fine) = (worst(2e-3), worst(1e-3));
    println!("largest angle: {coarse:.2e} rad at 500 Hz, {fine:.2e} at 1 kHz");
    assert!(fine < 1.5e-3 && (1.8..2.2).contains(&(coarse / fine)), "{coarse}, {fine}");
}

#[test]
fn what_it_refuses() {
    let good = VehicleControlConfig::new();
    let name = |config: VehicleControlConfig| VehicleController::new(&config).unwrap_err().parameter();
    assert_eq!(name(VehicleControlConfig { translation: Gains { kp: 0.0, kd: 1.0 }, ..good }), "translation.kp");
    assert_eq!(name(VehicleControlConfig { translation: Gains { kp: 1.0, kd: f64::NAN }, ..good }), "translation.kd");
    assert_eq!(name(VehicleControlConfig { rotation: Gains { kp: 1e30, kd: 1.0 }, ..good }), "rotation.kp");
    assert_eq!(name(VehicleControlConfig { rotation: Gains { kp: 1.0, kd: -1.0 }, ..good }), "rotation.kd");
    assert_eq!(name(VehicleControlConfig { gravity: -1.0, ..good }), "gravity");
    assert_eq!(name(VehicleControlConfig { mass: [2.0, 1.0], ..good }), "mass");
    assert_eq!(name(VehicleControlConfig { mass: [2.0, 2.0], ..good }), "mass");
    assert_eq!(name(VehicleControlConfig { inertia: [0.0, 1.0], ..good }), "inertia");

    let (controller, reference) = (controller(), VehicleReference::hover([0.0; 3]));
    let level = motion(&Quaternion::IDENTITY, [0.0; 3]);
    let refused = |mass, inertia| controller.wrench(&reference, &level, mass, inertia).unwrap_err();
    for mass in [0.0, -1.0, 1e9, f32::NAN, f32::INFINITY] {
        assert_eq!(refused(mass, [0.1; 3]), ControlError::ParameterOutOfRange);
        assert_eq!(refused(1.0, [0.1, mass, 0.1]), ControlError::ParameterOutOfRange);
    }
    for bad in [f32::NAN, f32::INFINITY, 3e38] {
        let seen = Motion { velocity: [0.0, bad, 0.0], ..level };
        assert_eq!(controller.wrench(&reference, &seen, 1.0, [0.1; 3]), Err(ControlError::NonFinite));
        let seen = Motion { rates: [bad, 0.0, 0.0], ..level };
        assert_eq!(controller.wrench(&reference, &seen, 1.0, [0.1; 3]), Err(ControlError::NonFinite));
    }
}
