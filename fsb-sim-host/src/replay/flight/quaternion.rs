//! Attitudes: unit quaternions (w, x, y, z) that turn a body vector into the world's.

/// A unit quaternion, body to world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion(pub [f64; 4]);

impl Quaternion {
    /// No turn.
    pub const LEVEL: Self = Self([1.0, 0.0, 0.0, 0.0]);

    /// At length one; `None` where the four numbers are no attitude: their length is off by more than 10 %, or not a number.
    #[must_use]
    pub fn normalised(numbers: [f64; 4]) -> Option<Self> {
        let length = numbers.iter().map(|x| x * x).sum::<f64>().sqrt();
        ((length - 1.0).abs() < 0.1).then(|| Self(numbers.map(|x| x / length)))
    }

    /// The turn `other` first, then this one.
    #[must_use]
    pub fn after(self, other: Self) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Self([
            a * e - b * f - c * g - d * h,
            a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e,
        ])
    }

    /// A body vector in the world frame.
    #[must_use]
    pub fn turn(self, v: [f64; 3]) -> [f64; 3] {
        let [w, x, y, z] = self.0;
        let [a, b, c] = v;
        [
            (1.0 - 2.0 * (y * y + z * z)) * a + 2.0 * (x * y - w * z) * b + 2.0 * (x * z + w * y) * c,
            2.0 * (x * y + w * z) * a + (1.0 - 2.0 * (x * x + z * z)) * b + 2.0 * (y * z - w * x) * c,
            2.0 * (x * z - w * y) * a + 2.0 * (y * z + w * x) * b + (1.0 - 2.0 * (x * x + y * y)) * c,
        ]
    }

    /// The attitude a `share` (0..=1) of the way to `to`, at a constant rate about one axis, the short way round.
    #[must_use]
    pub fn towards(self, to: Self, share: f64) -> Self {
        let dot: f64 = self.0.iter().zip(to.0).map(|(a, b)| a * b).sum();
        let (sign, cosine) = if dot < 0.0 { (-1.0, -dot) } else { (1.0, dot) };
        // Below a milliradian the chord is the arc to 1e-7 of it.
        let (a, b) = if cosine > 1.0 - 1e-7 {
            (1.0 - share, share)
        } else {
            let angle = cosine.min(1.0).acos();
            (((1.0 - share) * angle).sin() / angle.sin(), (share * angle).sin() / angle.sin())
        };
        let mixed: [f64; 4] = std::array::from_fn(|i| a * self.0[i] + sign * b * to.0[i]);
        Self::normalised(mixed).unwrap_or(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn about_z(angle: f64) -> Quaternion {
        Quaternion([(angle / 2.0).cos(), 0.0, 0.0, (angle / 2.0).sin()])
    }

    #[test]
    fn turns_add_up_and_the_way_between_is_even() {
        let [x, y, z] = about_z(0.3).after(about_z(0.4)).turn([1.0, 0.0, 2.0]);
        assert!((x - 0.7f64.cos()).abs() < 1e-15 && (y - 0.7f64.sin()).abs() < 1e-15 && z == 2.0);
        for to in [about_z(1.2), Quaternion(about_z(1.2).0.map(|q| -q))] {
            let [x, y, _] = about_z(0.2).towards(to, 0.25).turn([1.0, 0.0, 0.0]);
            assert!((y.atan2(x) - 0.45).abs() < 1e-12);
        }
    }

    #[test]
    fn numbers_that_are_no_attitude() {
        assert!(Quaternion::normalised([0.0; 4]).is_none());
        assert!(Quaternion::normalised([f64::NAN, 0.0, 0.0, 1.0]).is_none());
        assert_eq!(Quaternion::normalised([0.96, 0.0, 0.0, 0.0]), Some(Quaternion::LEVEL));
    }
}
