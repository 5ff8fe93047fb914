//! The certainty-equivalence controller (11), (13), (70)-(71): the closed loop (12), the rotation, and what it refuses.

use fsb_core::control::{ControlError, Reference, TrackingConfig, TrackingController, to_body};
use fsb_core::estimator::AxisState;
use fsb_sim_host::plant::HeldInputAxis;
use proptest::prelude::*;

const CONFIG: TrackingConfig =
    TrackingConfig { kp: 6.0, kd: 5.0, drift: -9.81, parameter_min: 0.1, parameter_max: 10.0 };

/// Flies y'' = k f - g on the true state to `t_end`; the reference is 1 + sin t. Returns ỹ, ỹ'.
fn closed_loop(k: f64, period: f64, t_end: f64, start: (f64, f64)) -> (f64, f64) {
    let controller = TrackingController::new(&CONFIG).unwrap();
    let mut axis = HeldInputAxis { position: 1.0 + start.0, velocity: 1.0 + start.1, k, drift: CONFIG.drift };
    for n in 0..(t_end / period).round() as usize {
        let t = n as f64 * period;
        let reference =
            Reference { position: (1.0 + t.sin()) as f32, velocity: t.cos() as f32, acceleration: -t.sin() as f32 };
        let state = AxisState { position: axis.position as f32, velocity: axis.velocity as f32 };
        let f = controller.input(&reference, &state, k as f32).unwrap();
        axis.step(f64::from(f), period);
    }
    (axis.position - 1.0 - t_end.sin(), axis.velocity - t_end.cos())
}

/// (12) with K_D = 5, K_P = 6 has the roots -2, -3: ỹ = (3a + b) e^(-2t) - (2a + b) e^(-3t). A held input adds O(T), which
/// two periods tell; what is left is O(T²).
#[test]
fn the_error_decays_as_twelve_says() {
    for (k, a, b) in [(0.7, 1.0, 0.0), (2.0, -0.5, 1.5), (5.0, 0.0, -2.0)] {
        for t in [0.3_f64, 1.0, 2.0] {
            let (fast, slow) = ((-3.0 * t).exp(), (-2.0 * t).exp());
            let truth =
                ((3.0 * a + b) * slow - (2.0 * a + b) * fast, -2.0 * (3.0 * a + b) * slow + 3.0 * (2.0 * a + b) * fast);
            let (coarse, fine) = (closed_loop(k, 2e-3, t, (a, b)), closed_loop(k, 1e-3, t, (a, b)));
            let limit = (2.0 * fine.0 - coarse.0, 2.0 * fine.1 - coarse.1);
            println!("k {k}, t {t}: {limit:?}, (12) {truth:?}, at 1 kHz {fine:?}");
            assert!((limit.0 - truth.0).abs() < 2e-5 && (limit.1 - truth.1).abs() < 6e-5, "{limit:?}, {truth:?}");
            assert!((fine.0 - truth.0).abs() < 2e-2 && (fine.1 - truth.1).abs() < 2e-2, "{fine:?}, {truth:?}");
        }
    }
}

/// One value by hand: (2 + 9.81 - 5·(0.5 - 0.3) - 6·(1.5 - 1))/0.8.
#[test]
fn one_input_by_hand() {
    let controller = TrackingController::new(&CONFIG).unwrap();
    let reference = Reference { position: 1.0, velocity: 0.3, acceleration: 2.0 };
    let f = controller.input(&reference, &AxisState { position: 1.5, velocity: 0.5 }, 0.8).unwrap();
    assert!((f - 9.7625).abs() < 1e-5, "{f}");
}

/// Quarter turns by hand, body to world by rows: yaw 90° takes body x to world y, so a force along world x is along body -y.
#[test]
fn quarter_turns() {
    let [x, y, z] = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    let yaw = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!([x, y, z].map(|f| to_body(&yaw, &f)), [[0.0, -2.0, 0.0], x, z]);
    let roll = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
    assert_eq!([x, y, z].map(|f| to_body(&roll, &f)), [x, [0.0, 0.0, -2.0], y]);
    let pitch = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]];
    assert_eq!([x, y, z].map(|f| to_body(&pitch, &f)), [z, y, [-2.0, 0.0, 0.0]]);
}

/// A force along world z at roll φ and pitch θ is (-sin θ, cos θ sin φ, cos θ cos φ) in the body: -R₃₁… of (2).
#[test]
fn thrust_of_a_tilted_body() {
    let (phi, theta, psi) = (0.3_f64, -0.5_f64, 1.1_f64);
    let body = to_body(&zyx(phi, theta, psi), &[0.0, 0.0, 1.0]);
    let expected = [-theta.sin(), theta.cos() * phi.sin(), theta.cos() * phi.cos()];
    for (found, expected) in body.iter().zip(expected) {
        assert!((f64::from(*found) - expected).abs() < 1e-7);
    }
}

/// (2): yaw ψ, pitch θ, roll φ, body to world.
fn zyx(phi: f64, theta: f64, psi: f64) -> [[f32; 3]; 3] {
    let ((sf, cf), (st, ct), (sp, cp)) = (phi.sin_cos(), theta.sin_cos(), psi.sin_cos());
    [
        [cp * ct, cp * st * sf - sp * cf, cp * st * cf + sp * sf],
        [sp * ct, sp * st * sf + cp * cf, sp * st * cf - cp * sf],
        [-st, ct * sf, ct * cf],
    ]
    .map(|row| row.map(|x| x as f32))
}

#[test]
fn a_parameter_out_of_range_is_an_error() {
    let controller = TrackingController::new(&CONFIG).unwrap();
    let (reference, state) = (Reference::default(), AxisState { position: 0.1, velocity: 0.2 });
    for k in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, -1.0, 0.099_999, 10.000_01, f32::MIN_POSITIVE] {
        assert_eq!(controller.input(&reference, &state, k), Err(ControlError::ParameterOutOfRange), "k = {k}");
    }
    for k in [0.1, 1.0, 10.0] {
        assert!(controller.input(&reference, &state, k).is_ok(), "k = {k}");
    }
}

#[test]
fn the_errors_say_what_is_wrong() {
    let [range, finite] = [ControlError::ParameterOutOfRange, ControlError::NonFinite].map(|e| e.to_string());
    assert!(!range.is_empty() && !finite.is_empty() && range != finite, "{range}, {finite}");
}

#[test]
fn what_is_not_finite_is_an_error() {
    let controller = TrackingController::new(&CONFIG).unwrap();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN] {
        let (r, s) = (Reference::default(), AxisState { position: 0.0, velocity: 0.0 });
        for (reference, state) in [
            (r, AxisState { position: bad, ..s }),
            (r, AxisState { velocity: bad, ..s }),
            (Reference { position: bad, ..r }, s),
            (Reference { velocity: bad, ..r }, s),
            (Reference { acceleration: bad, ..r }, s),
        ] {
            assert_eq!(controller.input(&reference, &state, 0.5), Err(ControlError::NonFinite), "{bad}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, rng_seed: proptest::test_runner::RngSeed::Fixed(70), failure_persistence: None, ..ProptestConfig::default() })]

    /// R (Rᵀ f) = f, and the length stays.
    #[test]
    fn the_rotation_keeps_the_force(phi in -3.1..3.1_f64, theta in -1.5..1.5_f64, psi in -3.1..3.1_f64, force in prop::array::uniform3(-50.0..50.0_f32)) {
        let attitude = zyx(phi, theta, psi);
        let body = to_body(&attitude, &force);
        for (row, &f) in attitude.iter().zip(&force) {
            let back: f32 = row.iter().zip(&body).map(|(r, b)| r * b).sum();
            prop_assert!((back - f).abs() < 4e-5, "{back} for {f}");
        }
        let length = |v: &[f32; 3]| v.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
        prop_assert!((length(&body) - length(&force)).abs() < 4e-5);
    }

    /// Whatever the bits are: a finite input or an error, and an error of the parameter exactly when it is out of range.
    #[test]
    fn never_a_number_that_is_none(bits in prop::array::uniform6(any::<u32>())) {
        let [k, y, v, position, velocity, acceleration] = bits.map(f32::from_bits);
        let controller = TrackingController::new(&CONFIG).unwrap();
        let result = controller.input(&Reference { position, velocity, acceleration }, &AxisState { position: y, velocity: v }, k);
        match result {
            Ok(f) => prop_assert!(f.is_finite()),
            Err(error) => prop_assert_eq!(error == ControlError::ParameterOutOfRange, !(0.1..=10.0).contains(&k)),
        }
    }
}
