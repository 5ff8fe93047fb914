//! The whole vehicle: (11) for the force, (13) carried to any attitude for the torque.

use super::body_force::to_body;
use super::tracking::ControlError;
use crate::checks::{Checks, Range, Rule};
use crate::error::ConfigError;
use crate::vehicle::Wrench;

/// K_P and K_D of (12) for one group of axes. Plain data.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Gains {
    /// K_P (1/s²); positive, 1e-15..=1e15.
    pub kp: f64,
    /// K_D (1/s); positive, 1e-15..=1e15.
    pub kd: f64,
}

/// Gains and limits of a [`VehicleController`]. Plain data.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VehicleControlConfig {
    /// Gains of (11).
    pub translation: Gains,
    /// Gains of (13).
    pub rotation: Gains,
    /// g (m/s²), the world's z pointing up; 0..=100.
    pub gravity: f64,
    /// The masses (kg) that the controller may be given: smallest and largest; positive, 1e-15..=1e15.
    pub mass: [f64; 2],
    /// The moments of inertia (kg m²) that the controller may be given, likewise.
    pub inertia: [f64; 2],
}

impl VehicleControlConfig {
    /// K_P = 6, K_D = 5 as in the paper's Section V for the position; K_P = 100, K_D = 20 for the attitude, an order faster;
    /// g = 9.81; any mass from 1 g to 1 t and any inertia from 1e-7 to 1e4 kg m².
    pub const fn new() -> Self {
        Self {
            translation: Gains { kp: 6.0, kd: 5.0 },
            rotation: Gains { kp: 100.0, kd: 20.0 },
            gravity: 9.81,
            mass: [1e-3, 1e3],
            inertia: [1e-7, 1e4],
        }
    }
}

impl Default for VehicleControlConfig {
    fn default() -> Self {
        Self::new()
    }
}

/// What the vehicle shall do now. Attitudes turn body into world coordinates, by rows, as R of (2).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VehicleReference {
    /// x_d, world frame (m).
    pub position: [f32; 3],
    /// x_d' (m/s).
    pub velocity: [f32; 3],
    /// x_d'' (m/s²).
    pub acceleration: [f32; 3],
    /// R_d.
    pub attitude: [[f32; 3]; 3],
    /// ω_d, the rates of R_d about its own axes (rad/s).
    pub rates: [f32; 3],
    /// ω_d' (rad/s²), likewise.
    pub angular_acceleration: [f32; 3],
}

impl VehicleReference {
    /// At rest at `position`, level, nose along the world's x.
    pub const fn hover(position: [f32; 3]) -> Self {
        Self {
            position,
            velocity: [0.0; 3],
            acceleration: [0.0; 3],
            attitude: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            rates: [0.0; 3],
            angular_acceleration: [0.0; 3],
        }
    }
}

/// How the vehicle moves, as far as the controller knows: estimated, measured or true.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Motion {
    /// x̂, world frame (m).
    pub position: [f32; 3],
    /// x̂' (m/s).
    pub velocity: [f32; 3],
    /// R̂, body to world, by rows.
    pub attitude: [[f32; 3]; 3],
    /// ω̂ about the body's axes (rad/s).
    pub rates: [f32; 3],
}

/// Force and torque of a vehicle that can push in every direction, in the body frame:
///
/// ```text
/// F = Rᵀ m̂ (x_d'' + g e3 - K_D (x̂' - x_d') - K_P (x̂ - x_d))                                        (11)
/// τ = Î (α_d - K_D (ω̂ - Q ω_d) - K_P e) + ω̂ × Î ω̂,     Q = Rᵀ R_d,  α_d = Q ω_d' - ω̂ × Q ω_d
/// ```
///
/// e = ½ vee(R_dᵀ R - Rᵀ R_d) is the attitude error as a rotation vector times sin θ/θ, so K_P weakens beyond about a
/// radian and vanishes at half a turn. Near level, where e = η̂ - η_d and Q is the identity, τ is (13) and its error obeys
/// (12); the term ω × Iω makes up for the gyroscopic torque that (10) leaves out.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VehicleController {
    translation: [f32; 2],
    rotation: [f32; 2],
    gravity: f32,
    mass: [f32; 2],
    inertia: [f32; 2],
}

impl VehicleController {
    /// Validates `config`.
    ///
    /// # Errors
    /// Names the parameter: `translation.kp`, `rotation.kd`, `gravity`, `mass`, `inertia` and so on.
    pub fn new(config: &VehicleControlConfig) -> Result<Self, ConfigError> {
        const GRAVITY: Range = Range::from_zero(100.0);
        const MASS: [Rule; 2] = [Rule("mass", &Range::PARAMETER); 2];
        const INERTIA: [Rule; 2] = [Rule("inertia", &Range::PARAMETER); 2];
        let VehicleControlConfig { translation, rotation, gravity, mass, inertia } = *config;
        let mut checks = Checks::new();
        let mut gain = |rule: &'static Rule, value| checks.number(rule, value);
        let controller = Self {
            gravity: gain(&Rule("gravity", &GRAVITY), gravity),
            translation: [
                gain(&Rule("translation.kp", &Range::PARAMETER), translation.kp),
                gain(&Rule("translation.kd", &Range::PARAMETER), translation.kd),
            ],
            rotation: [
                gain(&Rule("rotation.kp", &Range::PARAMETER), rotation.kp),
                gain(&Rule("rotation.kd", &Range::PARAMETER), rotation.kd),
            ],
            mass: checks.limits(&MASS, mass, false).into(),
            inertia: checks.limits(&INERTIA, inertia, false).into(),
        };
        checks.outcome()?;
        Ok(controller)
    }

    /// The wrench for `motion`, with the parameters m̂ = `mass` (kg) and Î = diag(`inertia`) (kg m²): identified, nominal
    /// or true.
    ///
    /// # Errors
    /// [`ControlError`]; a wrench that is not finite is never returned. Cost: about 170 operations, none of them a division.
    pub fn wrench(
        &self,
        reference: &VehicleReference,
        motion: &Motion,
        mass: f32,
        inertia: [f32; 3],
    ) -> Result<Wrench, ControlError> {
        if !inside(self.mass, mass) || !inertia.iter().all(|&value| inside(self.inertia, value)) {
            return Err(ControlError::ParameterOutOfRange);
        }
        let [kp, kd] = self.translation;
        let pull = pd(kp, kd, motion.position, reference.position, motion.velocity, reference.velocity);
        let [ax, ay, az] = minus(reference.acceleration, pull);
        let force = to_body(&motion.attitude, &times(mass, [ax, ay, az + self.gravity]));

        // Column j of Q is body axis j of the reference in the vehicle's body frame.
        let (r, d) = (&motion.attitude, columns(&reference.attitude));
        let [x, y, z] = d.map(|axis| to_body(r, &axis));
        let turn = |v: [f32; 3]| {
            let ([vx, vy, vz], [x0, x1, x2], [y0, y1, y2], [z0, z1, z2]) = (v, x, y, z);
            [vx * x0 + vy * y0 + vz * z0, vx * x1 + vy * y1 + vz * z1, vx * x2 + vy * y2 + vz * z2]
        };
        // vee(Qᵀ - Q)/2
        let ([_, x1, x2], [y0, _, y2], [z0, z1, _]) = (x, y, z);
        let error = times(0.5, [z1 - y2, x2 - z0, y0 - x1]);
        let (rates, wanted) = (motion.rates, turn(reference.rates));
        let ahead = minus(turn(reference.angular_acceleration), cross(rates, wanted));
        let [kp, kd] = self.rotation;
        let angular = minus(ahead, pd(kp, kd, error, [0.0; 3], rates, wanted));
        let gyroscopic = cross(rates, by_components(inertia, rates));
        let torque = plus(by_components(inertia, angular), gyroscopic);
        if force.iter().chain(&torque).all(|value| value.is_finite()) {
            Ok(Wrench { force, torque })
        } else {
            Err(ControlError::NonFinite)
        }
    }
}

/// Written so that NaN is outside.
fn inside([low, high]: [f32; 2], value: f32) -> bool {
    value >= low && value <= high
}

/// K_D (v - v_d) + K_P (x - x_d).
fn pd(kp: f32, kd: f32, x: [f32; 3], x_d: [f32; 3], v: [f32; 3], v_d: [f32; 3]) -> [f32; 3] {
    plus(times(kd, minus(v, v_d)), times(kp, minus(x, x_d)))
}

fn columns(m: &[[f32; 3]; 3]) -> [[f32; 3]; 3] {
    let [[a, b, c], [d, e, f], [g, h, i]] = *m;
    [[a, d, g], [b, e, h], [c, f, i]]
}

fn plus([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> [f32; 3] {
    [a + d, b + e, c + f]
}

fn minus([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> [f32; 3] {
    [a - d, b - e, c - f]
}

fn times(s: f32, v: [f32; 3]) -> [f32; 3] {
    v.map(|value| s * value)
}

fn by_components([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> [f32; 3] {
    [a * d, b * e, c * f]
}

fn cross([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> [f32; 3] {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}
