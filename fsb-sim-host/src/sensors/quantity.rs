//! What noise, an outlier and a quantisation step are for a position and for an attitude.

use crate::hexarotor::Quaternion;
use crate::hexarotor::vector::{Vector, add_scaled, difference, scaled, sum};

/// Something that a [`super::Sensor`] can measure: a point of a space in which a small error has three components.
pub trait Quantity: Copy {
    /// With an error of three components [m] or [rad].
    #[must_use]
    fn displaced(&self, by: Vector) -> Self;
    /// The error that leads from self to `other` [m] or [rad].
    fn error_of(&self, other: &Self) -> Vector;
    /// Rounded to whole multiples of `resolution`.
    #[must_use]
    fn quantised(&self, resolution: f64) -> Self;

    /// The point at `share` (0..=1) of the shortest way from self to `other`.
    #[must_use]
    fn towards(&self, other: &Self, share: f64) -> Self {
        self.displaced(scaled(share, self.error_of(other)))
    }
}

/// A position [m].
impl Quantity for Vector {
    fn displaced(&self, by: Vector) -> Self {
        sum(*self, by)
    }

    fn error_of(&self, other: &Self) -> Vector {
        difference(*other, *self)
    }

    fn quantised(&self, resolution: f64) -> Self {
        self.map(|value| rounded(value, resolution))
    }

    fn towards(&self, other: &Self, share: f64) -> Self {
        add_scaled(*self, share, difference(*other, *self))
    }
}

/// An attitude: errors are rotation vectors in the body frame [rad], and what is rounded are the Euler angles.
impl Quantity for Quaternion {
    fn displaced(&self, by: Vector) -> Self {
        self.then_in_body(&Self::from_rotation_vector(by)).normalised()
    }

    fn error_of(&self, other: &Self) -> Vector {
        self.inverse().then_in_body(other).rotation_vector()
    }

    fn quantised(&self, resolution: f64) -> Self {
        Self::from_euler(self.euler().map(|angle| rounded(angle, resolution)))
    }
}

fn rounded(value: f64, resolution: f64) -> f64 {
    (value / resolution).round() * resolution
}
