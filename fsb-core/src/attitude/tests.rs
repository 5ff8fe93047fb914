//! Turns about any axis.

use super::rotation::{Matrix, exponential};
use super::{AttitudeError, BodyAngles};

/// Rodrigues: I + sin θ/θ S + (1 - cos θ)/θ² S², in f64.
fn turned([x, y, z]: [f64; 3]) -> [[f64; 3]; 3] {
    let s = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let angle = libm::sqrt(x * x + y * y + z * z);
    let (a, b) =
        if angle > 0.0 { (libm::sin(angle) / angle, (1.0 - libm::cos(angle)) / (angle * angle)) } else { (1.0, 0.5) };
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let square: f64 = (0..3).map(|k| s[i][k] * s[k][j]).sum();
            f64::from(i == j) + a * s[i][j] + b * square
        })
    })
}

fn off(a: &Matrix, b: &[[f64; 3]; 3]) -> f64 {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (f64::from(*a) - b).abs()).fold(0.0, f64::max)
}

const AXES: [[f64; 3]; 5] =
    [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.6, -0.48, 0.64], [-0.36, 0.48, 0.8]];

/// To 1e-6 up to 1 rad, to 6e-5 up to 2 rad; beyond that there is none.
#[test]
fn the_exponential_is_rodrigues() {
    for axis in AXES {
        for (angle, bound) in
            [(0.0, 1e-7), (0.1, 1e-6), (0.5, 1e-6), (0.9, 1e-6), (1.0, 1e-6), (1.4, 3e-5), (1.8, 3e-5), (1.99, 6e-5)]
        {
            let turn = axis.map(|x| x * angle);
            let got = exponential(&turn.map(|x| x as f32)).expect("near");
            let worst = off(&got, &turned(turn));
            assert!(worst < bound, "{turn:?}: {worst:e}");
        }
        assert!(exponential(&axis.map(|x| (2.01 * x) as f32)).is_none());
    }
    assert!(exponential(&[0.0, f32::NAN, 0.0]).is_none());
}

/// A turn known otherwise is taken up to 0.3 rad, about any axis; the next attitude is compared with where it leads.
#[test]
fn a_turn_known_otherwise() {
    let level = turned([0.0; 3]).map(|row| row.map(|x| x as f32));
    for axis in AXES {
        for (angle, taken) in [(0.05, true), (0.29, true), (0.31, false), (1.0, false)] {
            let mut body = BodyAngles::default();
            let turn = axis.map(|x| (x * angle) as f32);
            body.turn_by(&turn);
            assert_eq!((body.attitude(), body.angles()), (None, [0.0; 3]), "before the first attitude");
            body.turn_to(&level).expect("a rotation");
            body.turn_by(&turn);
            let there = turned(axis.map(|x| x * if taken { angle } else { 0.0 }));
            assert!(off(&body.attitude().expect("given"), &there) < 1e-6, "{turn:?}");
            assert_eq!(body.angles(), if taken { turn } else { [0.0; 3] });
            // From there on by the attitude: 0.1 rad more.
            let further = turned(axis.map(|x| x * (angle * if taken { 1.0 } else { 0.0 } + 0.1)));
            let angles = body.turn_to(&further.map(|row| row.map(|x| x as f32))).expect("near");
            for (angle_now, (before, x)) in angles.into_iter().zip(there_angles(turn, taken).into_iter().zip(axis)) {
                assert!((f64::from(angle_now) - f64::from(before) - 0.1 * x).abs() < 2e-6, "{turn:?}: {angles:?}");
            }
        }
    }
}

fn there_angles(turn: [f32; 3], taken: bool) -> [f32; 3] {
    if taken { turn } else { [0.0; 3] }
}

#[test]
fn the_errors_say_what_is_wrong() {
    use core::fmt::Write;

    let shown = [AttitudeError::NotARotation, AttitudeError::TurnTooLarge].map(|error| {
        let mut text = heapless::String::<96>::new();
        write!(text, "{error}").expect("short");
        text
    });
    assert!(shown[0].contains("no rotation") && shown[1].contains("0.3 rad"), "{shown:?}");
}
