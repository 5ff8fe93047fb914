//! Both paths at one time as the controller takes them: Euler angles turned into an attitude, its rates and accelerations.

use fsb_core::control::VehicleReference;

use super::path::Point;
use super::scenario::References;
use crate::hexarotor::vector::{Matrix, Vector};
use crate::hexarotor::{Quaternion, body_rates};

/// What the vehicle shall do at one time, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// x_d and its derivatives.
    pub position: Point,
    /// (roll, pitch, yaw) and their derivatives.
    pub euler: Point,
    /// Body to world.
    pub attitude: Quaternion,
    /// ω_d about the axes of that attitude [rad/s].
    pub rates: Vector,
    /// ω_d' [rad/s²].
    pub angular_acceleration: Vector,
}

impl Wanted {
    /// Of `references` at `t` [s].
    pub fn at(references: &References, t: f64) -> Self {
        let (position, euler) = (references.position.at(t), references.attitude.at(t));
        Self {
            position,
            euler,
            attitude: Quaternion::from_euler(euler.value),
            rates: body_rates(euler.value, euler.rate),
            angular_acceleration: body_accelerations(&euler),
        }
    }

    /// The same for the f32 controller.
    pub fn in_f32(&self) -> VehicleReference {
        VehicleReference {
            position: narrow(self.position.value),
            velocity: narrow(self.position.rate),
            acceleration: narrow(self.position.acceleration),
            attitude: narrow_matrix(&self.attitude.matrix()),
            rates: narrow(self.rates),
            angular_acceleration: narrow(self.angular_acceleration),
        }
    }
}

/// ω' of η, η', η'': the derivative of the inverse of (1).
fn body_accelerations(euler: &Point) -> Vector {
    let [(sf, cf), (st, ct), _] = euler.value.map(f64::sin_cos);
    let ([df, dt, dp], [ddf, ddt, ddp]) = (euler.rate, euler.acceleration);
    [
        ddf - st * ddp - ct * dt * dp,
        cf * ddt + sf * ct * ddp - sf * df * dt + (cf * ct * df - sf * st * dt) * dp,
        cf * ct * ddp - sf * ddt - cf * df * dt - (sf * ct * df + cf * st * dt) * dp,
    ]
}

/// Rounded to f32.
pub fn narrow(v: Vector) -> [f32; 3] {
    v.map(|value| value as f32)
}

/// Rounded to f32.
pub fn narrow_matrix(m: &Matrix) -> [[f32; 3]; 3] {
    m.map(narrow)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fly::path::{AttitudePath, PositionPath, Sinusoids};

    /// Rates and accelerations are those of the attitude: from its turn over a short time, and from the rates.
    #[test]
    fn rates_belong_to_the_attitude() {
        let references = References {
            position: PositionPath::Hover { at: [0.0; 3] },
            attitude: AttitudePath::Sinusoids(Sinusoids {
                centre: [0.1, -0.2, 0.7],
                amplitude: [0.4, 0.5, 0.8],
                frequency: [2.3, 1.7, 1.1],
                phase: [0.3, 1.0, 2.0],
                ramp: 0.0,
            }),
        };
        let h = 1e-4;
        for t in [0.0, 0.8, 2.9] {
            let [before, here, after] = [t - h, t, t + h].map(|t| Wanted::at(&references, t));
            let turn = before.attitude.inverse().then_in_body(&after.attitude).rotation_vector();
            for (i, turn) in turn.iter().enumerate() {
                assert!((turn / (2.0 * h) - here.rates[i]).abs() < 1e-6, "rate {i} at {t}");
                let acceleration = (after.rates[i] - before.rates[i]) / (2.0 * h);
                assert!((acceleration - here.angular_acceleration[i]).abs() < 1e-6, "acceleration {i} at {t}");
            }
        }
    }
}
