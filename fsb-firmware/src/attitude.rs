//! R of (2), body to world, by rows.

use crate::sample::Attitude;

/// From the unit quaternion w + xi + yj + zk that turns body vectors into world vectors. No trigonometry.
pub fn attitude_from_quaternion([w, x, y, z]: [f32; 4]) -> Attitude {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// From the Euler angles φ, θ, ψ \[rad\] of (2), by `micromath`: no entry is off by more than 2.5e-3 for angles up to π, which
/// on a hovering vehicle is 2.5e-3 of its weight as a force along the wrong axis. Where that matters bring the quaternion.
#[cfg(feature = "micromath")]
pub fn attitude_from_angles([roll, pitch, yaw]: [f32; 3]) -> Attitude {
    // By path: as a method it would be the standard library's wherever that is linked, and host and target would differ.
    let sin_cos = <f32 as micromath::F32Ext>::sin_cos;
    let ((sr, cr), (sp, cp), (sy, cy)) = (sin_cos(roll), sin_cos(pitch), sin_cos(yaw));
    [
        [cp * cy, cy * sr * sp - cr * sy, sr * sy + cr * cy * sp],
        [cp * sy, cr * cy + sr * sp * sy, cr * sp * sy - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
}

/// Whether it is one, to 0.02 in each product of axes: the first two of length one and at right angles, the third their product.
/// Zeros are none, and neither is NaN. Cost: about 45 operations.
pub(crate) fn is_rotation(&[x, y, z]: &Attitude) -> bool {
    let small = |off: f32| off.abs() <= 0.02;
    let ([a, b, c], [d, e, f], [g, h, i]) = (x, y, z);
    small(a * a + b * b + c * c - 1.0)
        && small(d * d + e * e + f * f - 1.0)
        && small(a * d + b * e + c * f)
        && small(b * f - c * e - g)
        && small(c * d - a * f - h)
        && small(a * e - b * d - i)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (2) in f64.
    fn exact([roll, pitch, yaw]: [f64; 3]) -> [[f64; 3]; 3] {
        let about = |axis: usize, angle: f64| {
            let mut m = [[0.0; 3]; 3];
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            m[axis][axis] = 1.0;
            (m[i][i], m[i][j], m[j][i], m[j][j]) =
                (libm::cos(angle), -libm::sin(angle), libm::sin(angle), libm::cos(angle));
            m
        };
        let times = |a: [[f64; 3]; 3], b: [[f64; 3]; 3]| {
            core::array::from_fn(|i| core::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
        };
        times(times(about(2, yaw), about(1, pitch)), about(0, roll))
    }

    fn largest_error(got: &Attitude, wanted: &[[f64; 3]; 3]) -> f64 {
        got.iter().flatten().zip(wanted.iter().flatten()).map(|(&a, b)| (f64::from(a) - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn quaternions() {
        for [roll, pitch, yaw] in [[0.3, -0.2, 1.1], [-1.0, 0.7, 3.0], [0.0, 0.0, 0.0]] {
            // Hamilton product of the three elementary turns, yaw first.
            let half = |angle: f64| (libm::sin(angle / 2.0), libm::cos(angle / 2.0));
            let ((sr, cr), (sp, cp), (sy, cy)) = (half(roll), half(pitch), half(yaw));
            let q = [
                cr * cp * cy + sr * sp * sy,
                sr * cp * cy - cr * sp * sy,
                cr * sp * cy + sr * cp * sy,
                cr * cp * sy - sr * sp * cy,
            ];
            let got = attitude_from_quaternion(q.map(|c| c as f32));
            assert!(largest_error(&got, &exact([roll, pitch, yaw])) < 5e-7);
        }
    }

    #[test]
    fn what_is_a_rotation() {
        let good = exact([0.3, -0.2, 1.1]).map(|row| row.map(|entry| entry as f32));
        assert!(is_rotation(&good));
        let bad = |change: fn(&mut Attitude)| {
            let mut matrix = good;
            change(&mut matrix);
            !is_rotation(&matrix)
        };
        assert!(bad(|m| *m = [[0.0; 3]; 3]));
        assert!(bad(|m| m[2] = m[2].map(|entry| -entry)), "a reflection");
        assert!(bad(|m| m.swap(0, 1)));
        for entry in 0..9 {
            for value in [f32::NAN, f32::INFINITY, 1e30, 2.0] {
                let mut matrix = good;
                matrix[entry / 3][entry % 3] = value;
                assert!(!is_rotation(&matrix), "{entry} {value}");
            }
            // What rounding, or micromath, does.
            let mut matrix = good;
            matrix[entry / 3][entry % 3] += 2.5e-3;
            assert!(is_rotation(&matrix), "{entry}");
        }
    }

    #[cfg(feature = "micromath")]
    #[test]
    fn accuracy_of_micromath() {
        let mut worst = 0.0_f64;
        for i in -30..=30 {
            for j in -30..=30 {
                for k in -30..=30 {
                    let angles = [i, j, k].map(|n| f64::from(n) * core::f64::consts::PI / 30.0);
                    let got = attitude_from_angles(angles.map(|a| a as f32));
                    worst = worst.max(largest_error(&got, &exact(angles)));
                    assert!(is_rotation(&got), "{angles:?}");
                }
            }
        }
        assert!(worst < 2.5e-3, "{worst}");
        // The documented bound is not a loose one.
        assert!(worst > 2e-3, "{worst}");
    }
}
