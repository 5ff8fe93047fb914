//! The allocation matrix against geometry by hand.

use fsb_sim_host::hexarotor::{FrameConfig, HexarotorConfig, RotorConfig};

use super::{built, close};

fn tilted(arm: f64, tilt: f64, drag_ratio: f64) -> HexarotorConfig {
    let rotor = RotorConfig { drag_ratio, ..Default::default() };
    HexarotorConfig { frame: FrameConfig { arm, tilt }, rotor, ..Default::default() }
}

fn cases() -> [HexarotorConfig; 4] {
    [HexarotorConfig::default(), tilted(0.2, 0.1, 0.0), tilted(1.0, 1.2, 0.05), tilted(0.3, 0.96, 0.016)]
}

/// A A⁻¹ = A⁻¹ A = 1.
#[test]
fn the_inverse_is_the_inverse() {
    for config in cases() {
        let vehicle = built(&config);
        let (a, b) = (*vehicle.allocator().frame().matrix(), *vehicle.allocator().frame().inverse());
        for (left, right) in [(a, b), (b, a)] {
            for (i, row) in left.iter().enumerate() {
                for j in 0..6 {
                    let value: f64 = row.iter().zip(&right).map(|(l, r)| l * r[j]).sum();
                    assert!((value - f64::from(u8::from(i == j))).abs() < 1e-13, "{i}, {j}: {value}");
                }
            }
        }
    }
}

/// β = 30°, L = 0.3 m, κ = 0.016 m, 2 N on rotor 1, which sits on body x: n = (0, -1/2, √3/2), F = 2 n,
/// τ = 0.3 e1 × 2 n - 0.016 · 2 n. On rotor 4, opposite and tilted the other way about its own arm, n is the same, as the
/// arm has turned by 180° too; the lever and the sense of rotation change sign.
#[test]
fn single_rotors_by_hand() {
    let vehicle = built(&HexarotorConfig::default());
    let root = 3.0_f64.sqrt();
    let first = vehicle.wrench(&[2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    close(first.force, [0.0, -1.0, root], 1e-15);
    close(first.torque, [0.0, -0.3 * root + 0.016, -0.3 - 0.016 * root], 1e-15);
    let fourth = vehicle.wrench(&[0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    close(fourth.force, [0.0, -1.0, root], 1e-15);
    close(fourth.torque, [0.0, 0.3 * root - 0.016, 0.3 + 0.016 * root], 1e-15);
}

/// Symmetric cases: all alike lift only; odd against even rotors yaw only; hover shares the weight.
#[test]
fn symmetric_cases_by_hand() {
    let vehicle = built(&HexarotorConfig::default());
    let root = 3.0_f64.sqrt();
    let all = vehicle.wrench(&[1.0; 6]);
    close(all.force, [0.0, 0.0, 3.0 * root], 1e-14);
    close(all.torque, [0.0; 3], 1e-15);
    let odd = vehicle.wrench(&[1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
    close(odd.force, [0.0, 0.0, 1.5 * root], 1e-14);
    close(odd.torque, [0.0, 0.0, -3.0 * (0.15 + 0.008 * root)], 1e-15);
    let hover = vehicle.allocate([0.0, 0.0, 2.5 * 9.81], [0.0; 3]);
    assert!(!hover.saturated);
    hover.thrusts.iter().for_each(|thrust| assert!((thrust - 2.5 * 9.81 / (3.0 * root)).abs() < 1e-14));
}

/// The condition number against power iteration on AᵀA and on its inverse, torques in units of L.
#[test]
fn the_condition_number_is_that_of_power_iteration() {
    let largest = |m: [[f64; 6]; 6]| {
        let mut v = [0.9, -0.4, 0.7, 0.3, -0.8, 0.5];
        let mut length = 0.0;
        for _ in 0..3000 {
            let image = m.map(|row| row.iter().zip(&v).map(|(a, b)| a * b).sum::<f64>());
            v = std::array::from_fn(|j| (0..6).map(|i| m[i][j] * image[i]).sum());
            length = v.iter().map(|value| value * value).sum::<f64>().sqrt();
            v = v.map(|value| value / length);
        }
        length.sqrt()
    };
    for config in cases() {
        let vehicle = built(&config);
        let frame = vehicle.allocator().frame();
        let unit = |i: usize| if i < 3 { 1.0 } else { config.frame.arm };
        let matrix = std::array::from_fn(|i| frame.matrix()[i].map(|value| value / unit(i)));
        let inverse = std::array::from_fn(|i| std::array::from_fn(|j| frame.inverse()[i][j] * unit(j)));
        let expected = largest(matrix) * largest(inverse);
        println!("{:?}: condition {}", config.frame, frame.condition());
        assert!((frame.condition() / expected - 1.0).abs() < 1e-6, "{} against {expected}", frame.condition());
    }
    // β = 30°, L = 0.3 m, κ = 0.016 m: √6 cos 30° by √3 sin 30°.
    let condition = built(&HexarotorConfig::default()).allocator().frame().condition();
    assert!((condition - 6.0_f64.sqrt()).abs() < 1e-12, "{condition}");
}
