//! Attitude: unit quaternion, rotation matrix, the paper's Euler angles.

use super::vector::{Matrix, Vector, add_scaled, cross, norm, scaled};

/// A unit quaternion, scalar first: [w, x, y, z]. It turns body into world coordinates, as R(η) of (2) does; q and -q are the
/// same attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion(pub [f64; 4]);

impl Quaternion {
    /// Body and world axes coincide.
    pub const IDENTITY: Self = Self([1.0, 0.0, 0.0, 0.0]);

    /// Of η = (φ, θ, ψ) [rad]: yaw ψ about z, then pitch θ about the new y, then roll φ about the new x.
    pub fn from_euler(euler: Vector) -> Self {
        let [(sr, cr), (sp, cp), (sy, cy)] = euler.map(|angle| (angle / 2.0).sin_cos());
        Self([
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ])
    }

    /// The rotation about `vector` by its length [rad].
    pub fn from_rotation_vector(vector: Vector) -> Self {
        let angle = norm(vector);
        // sin(a/2)/a; below 1e-4 rad the next term of the series, a⁴/3840, is under the rounding.
        let share = if angle < 1e-4 { 0.5 - angle * angle / 48.0 } else { (angle / 2.0).sin() / angle };
        let [x, y, z] = scaled(share, vector);
        Self([(angle / 2.0).cos(), x, y, z])
    }

    /// The rotation vector [rad], of length up to π.
    pub fn rotation_vector(&self) -> Vector {
        let [w, x, y, z] = self.0;
        let length = norm([x, y, z]);
        let angle = 2.0 * length.atan2(w.abs());
        let share = if length < 1e-12 { 2.0 } else { angle / length };
        scaled(share.copysign(w), [x, y, z])
    }

    /// self ⊗ `other`: first `other`, then self. With a small rotation on the right, that is in body coordinates.
    #[must_use]
    pub fn then_in_body(&self, other: &Self) -> Self {
        let ([w, x, y, z], [ow, ox, oy, oz]) = (self.0, other.0);
        Self([
            w * ow - x * ox - y * oy - z * oz,
            w * ox + x * ow + y * oz - z * oy,
            w * oy - x * oz + y * ow + z * ox,
            w * oz + x * oy - y * ox + z * ow,
        ])
    }

    /// The inverse rotation.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let [w, x, y, z] = self.0;
        Self([w, -x, -y, -z])
    }

    /// Of length one again.
    #[must_use]
    pub fn normalised(&self) -> Self {
        let scale = 1.0 / self.0.iter().map(|value| value * value).sum::<f64>().sqrt();
        Self(self.0.map(|value| scale * value))
    }

    /// R v: from body to world coordinates.
    pub fn rotate(&self, v: Vector) -> Vector {
        let [w, x, y, z] = self.0;
        let axis = [x, y, z];
        let twice = scaled(2.0, cross(axis, v));
        add_scaled(add_scaled(v, w, twice), 1.0, cross(axis, twice))
    }

    /// Rᵀ v: from world to body coordinates.
    pub fn rotate_back(&self, v: Vector) -> Vector {
        self.inverse().rotate(v)
    }

    /// R of (2).
    pub fn matrix(&self) -> Matrix {
        let [w, x, y, z] = self.0;
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    }

    /// η = (φ, θ, ψ) [rad], φ and ψ in (-π, π], θ in [-π/2, π/2]. At θ = ±π/2 only φ ∓ ψ has a meaning.
    pub fn euler(&self) -> Vector {
        let r = self.matrix();
        [r[2][1].atan2(r[2][2]), (-r[2][0]).atan2(r[0][0].hypot(r[1][0])), r[1][0].atan2(r[0][0])]
    }
}

/// R(η) as printed under (2), element by element.
pub fn euler_matrix(euler: Vector) -> Matrix {
    let [(sf, cf), (st, ct), (sp, cp)] = euler.map(f64::sin_cos);
    [
        [ct * cp, cp * sf * st - cf * sp, sf * sp + cf * cp * st],
        [ct * sp, cf * cp + sf * st * sp, cf * st * sp - cp * sf],
        [-st, ct * sf, ct * cf],
    ]
}

/// (1): η' = Ω_B ω [rad/s] at η = `euler`. Grows without bound towards θ = ±π/2.
pub fn euler_rates(euler: Vector, rates: Vector) -> Vector {
    let ((sf, cf), (st, ct)) = (euler[0].sin_cos(), euler[1].sin_cos());
    let [p, q, r] = rates;
    let about_z = (sf * q + cf * r) / ct;
    [p + st * about_z, cf * q - sf * r, about_z]
}

/// The inverse of (1): ω [rad/s] of η' at η = `euler`; at any attitude.
pub fn body_rates(euler: Vector, euler_rates: Vector) -> Vector {
    let ((sf, cf), (st, ct)) = (euler[0].sin_cos(), euler[1].sin_cos());
    let [roll, pitch, yaw] = euler_rates;
    [roll - st * yaw, cf * pitch + sf * ct * yaw, cf * ct * yaw - sf * pitch]
}
