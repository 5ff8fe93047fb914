//! Body angles against rotations that are known in closed form.

use fsb_core::attitude::{AttitudeError, BodyAngles};
use fsb_sim_host::hexarotor::Quaternion;
use proptest::prelude::*;

fn matrix(q: &Quaternion) -> [[f32; 3]; 3] {
    q.matrix().map(|row| row.map(|x| x as f32))
}

/// A constant rate about any body axis, from any attitude, in any step up to 0.3 rad: ϑ = ω t, turn after turn.
#[test]
fn a_constant_rate() {
    let start = Quaternion::from_euler([0.4, -1.2, 2.5]);
    for (rate, steps, bound) in
        [([0.02, -0.01, 0.03], 20_000, 2e-5), ([0.1, 0.2, -0.15], 500, 2e-5), ([0.0, 0.0, 0.29], 200, 2e-5)]
    {
        let mut body = BodyAngles::default();
        let mut attitude = start;
        let step = Quaternion::from_rotation_vector(rate);
        let mut by_quaternion = BodyAngles::default();
        for n in 0..=steps {
            let angles = body.turn_to(&matrix(&attitude)).unwrap();
            let others = by_quaternion.turn_to_quaternion(attitude.0.map(|x| x as f32)).unwrap();
            for i in 0..3 {
                let truth = rate[i] * f64::from(n);
                assert!(
                    (f64::from(angles[i]) - truth).abs() < bound * (1.0 + truth.abs() / 10.0),
                    "step {n}: {angles:?}"
                );
                assert!((angles[i] - others[i]).abs() < 1e-3);
            }
            attitude = attitude.then_in_body(&step);
        }
    }
}

/// Noise of the attitude is noise of the angle, not of the rate: it does not add up.
#[test]
fn noise_does_not_add_up() {
    let mut body = BodyAngles::default();
    for n in 0..100_000_u32 {
        let tilt = 0.01 * f64::from(n.wrapping_mul(2_654_435_761) % 2001) / 1000.0 - 0.01;
        let angles = body.turn_to(&matrix(&Quaternion::from_rotation_vector([tilt, 0.0, 0.0]))).unwrap();
        assert!((f64::from(angles[0]) - tilt).abs() < 0.021, "{n}: {angles:?}");
    }
}

/// A bad attitude changes nothing, the next brings both turns; a large turn is told.
#[test]
fn what_is_refused() {
    let mut body = BodyAngles::default();
    let level = matrix(&Quaternion::from_rotation_vector([0.0; 3]));
    body.turn_to(&level).unwrap();
    for bad in [f32::NAN, f32::INFINITY, 0.5, -1.0, 3e38] {
        let mut attitude = level;
        attitude[2][2] = bad;
        assert_eq!(body.turn_to(&attitude), Err(AttitudeError::NotARotation), "{bad}");
    }
    assert_eq!(body.turn_to_quaternion([0.5, 0.0, 0.0, 0.0]), Err(AttitudeError::NotARotation));
    let angles = body.turn_to(&matrix(&Quaternion::from_rotation_vector([0.2, 0.0, 0.0]))).unwrap();
    assert!((angles[0] - 0.2).abs() < 1e-5, "{angles:?}");
    for far in [0.55, 1.5, 3.1, -2.0] {
        let mut body = BodyAngles::default();
        body.turn_to(&level).unwrap();
        let turned = matrix(&Quaternion::from_rotation_vector([0.0, far, 0.0]));
        assert_eq!(body.turn_to(&turned), Err(AttitudeError::TurnTooLarge), "{far}");
        assert_eq!(body.turn_to(&turned).unwrap(), [0.0; 3], "on from there");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(10), ..Default::default() })]

    /// Any bit pattern: an error or finite angles.
    #[test]
    fn any_bits(bits in prop::collection::vec(any::<u32>(), 18)) {
        let mut body = BodyAngles::default();
        for nine in bits.chunks(9) {
            let mut attitude = [[0.0_f32; 3]; 3];
            for (entry, &b) in attitude.iter_mut().flatten().zip(nine) {
                *entry = f32::from_bits(b);
            }
            if let Ok(angles) = body.turn_to(&attitude) {
                prop_assert!(angles.iter().all(|a| a.is_finite()));
            }
        }
        prop_assert!(body.angles().iter().all(|a| a.is_finite()));
    }
}
