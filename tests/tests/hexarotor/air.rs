//! Drag and wind.

use fsb_sim_host::hexarotor::{DragConfig, HexarotorConfig, StartConfig, WindConfig};
use fsb_sim_host::statistics::Summary;

use super::{built, close, fly};

/// Quadratic drag from rest: v = -v_t tanh(g t/v_t), v_t = √(m g/c2).
#[test]
fn quadratic_drag_leads_to_the_terminal_velocity() {
    let drag = DragConfig { quadratic: [0.3, 0.3, 0.1], ..Default::default() };
    let mut vehicle = built(&HexarotorConfig { drag, ..Default::default() });
    let terminal = (2.5_f64 * 9.81 / 0.1).sqrt();
    for second in 1..=12 {
        fly(&mut vehicle, [0.0; 6], 1.0);
        let v = -terminal * (9.81 * f64::from(second) / terminal).tanh();
        close(vehicle.state().velocity, [0.0, 0.0, v], 1e-9);
    }
    assert!((vehicle.state().velocity[2] / terminal + 1.0).abs() < 1e-6);
}

/// Linear drag in a steady wind, level: v - w decays with m/c1 on each axis of the body; the fall ends at m g/c1.
#[test]
fn linear_drag_leads_to_the_velocity_of_the_wind() {
    let wind = WindConfig { mean: [4.0, -2.0, 0.0], ..Default::default() };
    let drag = DragConfig { linear: [0.5, 0.8, 1.0], ..Default::default() };
    let start = StartConfig { velocity: [10.0, 0.0, 0.0], ..Default::default() };
    let mut vehicle = built(&HexarotorConfig { wind, drag, start, ..Default::default() });
    fly(&mut vehicle, [0.0; 6], 3.0);
    let left = |c: f64| (-c * 3.0 / 2.5).exp();
    let fall = 2.5 * 9.81 / 1.0;
    let expected = [4.0 + 6.0 * left(0.5), -2.0 + 2.0 * left(0.8), -fall * (1.0 - left(1.0))];
    close(vehicle.state().velocity, expected, 1e-10);
}

/// Drag is along the axes of the body: yawed by 90°, the body's y axis meets the motion along the world's x.
#[test]
fn drag_turns_with_the_body() {
    let drag = DragConfig { linear: [0.1, 0.9, 0.0], ..Default::default() };
    let start = StartConfig {
        velocity: [5.0, 0.0, 0.0],
        attitude: [0.0, 0.0, std::f64::consts::FRAC_PI_2],
        ..Default::default()
    };
    let mut vehicle = built(&HexarotorConfig { drag, start, gravity: 0.0, ..Default::default() });
    fly(&mut vehicle, [0.0; 6], 1.0);
    close(vehicle.state().velocity, [5.0 * (-0.9_f64 / 2.5).exp(), 0.0, 0.0], 1e-11);
}

/// d slows each rate with I/d.
#[test]
fn angular_damping_slows_the_spin() {
    let drag = DragConfig { angular: [0.0, 0.0, 0.02], ..Default::default() };
    let start = StartConfig { body_rates: [0.0, 0.0, 6.0], ..Default::default() };
    let mut vehicle = built(&HexarotorConfig { drag, start, ..Default::default() });
    fly(&mut vehicle, [0.0; 6], 4.0);
    close(vehicle.state().body_rates, [0.0, 0.0, 6.0 * (-0.02_f64 * 4.0 / 0.055).exp()], 1e-11);
}

/// Mean, spread and correlation of the gusts over 20 000 s. The number of independent values is t/(2 T_g) for the mean and
/// t/T_g for squares; bounds hold with 99.9 % (3.29 standard errors) each, for the fixed seed.
#[test]
fn gusts_have_their_statistics() {
    let (seed, gust_time, tick, count) = (7, 2.0, 0.1, 200_000_usize);
    let wind = WindConfig { mean: [3.0, 0.0, -1.0], gust_sd: [2.0, 1.0, 0.5], gust_time, seed };
    let mut vehicle = built(&HexarotorConfig { wind, max_step: 0.1, gravity: 0.0, ..Default::default() });
    let mut axes = [const { Vec::new() }; 3];
    for _ in 0..count {
        let now = vehicle.wind();
        axes.iter_mut().zip(now).for_each(|(axis, value)| axis.push(value));
        vehicle.step(&[0.0; 6], tick);
    }
    let duration = count as f64 * tick;
    let (of_mean, of_square) = ((2.0 * gust_time / duration).sqrt(), (2.0 * gust_time / duration).sqrt());
    for (axis, values) in axes.iter().enumerate() {
        let (sd, mean) = (wind.gust_sd[axis], wind.mean[axis]);
        let found = Summary::of(values);
        println!("seed {seed}, axis {axis}: {found:?}");
        assert!((found.mean - mean).abs() < 3.29 * sd * of_mean, "{found:?}");
        assert!((found.sd.powi(2) / sd.powi(2) - 1.0).abs() < 3.29 * of_square, "{found:?}");
        for lag in [10, 20] {
            let products: Vec<f64> =
                values.windows(lag + 1).map(|w| (w[0] - mean) * (w[lag] - mean) / (sd * sd)).collect();
            let expected = (-(lag as f64) * tick / gust_time).exp();
            let correlation = Summary::of(&products).mean;
            assert!((correlation - expected).abs() < 3.29 * of_square, "lag {lag}: {correlation} against {expected}");
        }
    }
    let cross: Vec<f64> = axes[0].iter().zip(&axes[1]).map(|(x, y)| (x - 3.0) * y / 2.0).collect();
    assert!(Summary::of(&cross).mean.abs() < 3.29 * (gust_time / duration).sqrt());
}

/// The same seed gives the same flight, another another.
#[test]
fn gusts_come_from_the_seed() {
    let end = |seed| {
        let wind = WindConfig { gust_sd: [2.0; 3], seed, ..Default::default() };
        let drag = DragConfig { linear: [0.4; 3], ..Default::default() };
        let mut vehicle = built(&HexarotorConfig { wind, drag, ..Default::default() });
        fly(&mut vehicle, [4.7; 6], 1.0);
        *vehicle.state()
    };
    assert_eq!(end(3), end(3));
    assert_ne!(end(3), end(4));
}
