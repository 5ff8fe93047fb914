//! The rotation matrix from Euler angles, against (2) in f64.

use fsb_core::attitude::euler;
use fsb_sim_host::hexarotor::euler_matrix;
use std::f64::consts::PI;

/// The largest error of an entry, angles up to π.
fn worst(of: impl Fn([f32; 3]) -> [[f32; 3]; 3]) -> f64 {
    let mut worst = 0.0_f64;
    for i in -24..=24 {
        for j in -24..=24 {
            for k in -24..=24 {
                let angles = [i, j, k].map(|n| (f64::from(n) * PI / 24.0) as f32);
                let truth = euler_matrix(angles.map(f64::from));
                for (got, truth) in of(angles).iter().flatten().zip(truth.iter().flatten()) {
                    worst = worst.max((f64::from(*got) - truth).abs());
                }
            }
        }
    }
    worst
}

/// The documented accuracies, which are no loose bounds.
#[test]
fn accuracy() {
    let (libm, micromath) = (worst(euler::with_libm), worst(euler::with_micromath));
    println!("libm {libm:.1e}, micromath {micromath:.1e}");
    assert!(libm < 2e-7 && libm > 3e-8, "{libm}");
    assert!(micromath < 2.5e-3 && micromath > 1e-3, "{micromath}");
}

/// An angle that is none gives a matrix that is refused.
#[test]
fn not_finite() {
    for bad in [f32::NAN, f32::INFINITY] {
        let got = euler::with_libm([0.1, bad, 0.2]);
        assert!(fsb_core::attitude::BodyAngles::default().turn_to(&got).is_err());
    }
}
