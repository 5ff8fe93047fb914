//! The vehicle as data. Every struct has defaults, so a file names only what differs; an unknown name is refused.

use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_6;

use super::error::{ParameterError, check, check_each};

/// The vehicle, the air around it, and where it starts.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct HexarotorConfig {
    /// m, without payload [kg]; 2.5.
    pub mass: f64,
    /// I_x, I_y, I_z, without payload [kg m²]; 0.03, 0.035, 0.055.
    pub inertia: [f64; 3],
    /// g [m/s²]; 9.81.
    pub gravity: f64,
    /// Arms and tilts.
    pub frame: FrameConfig,
    /// The six rotors.
    pub rotor: RotorConfig,
    /// Aerodynamic drag of the body; none.
    pub drag: DragConfig,
    /// Wind; none.
    pub wind: WindConfig,
    /// What is picked up and dropped, in order of time; nothing.
    pub payload: Vec<PayloadStep>,
    /// Where the flight starts.
    pub start: StartConfig,
    /// Longest step of the integration [s]; 0.001. Runge-Kutta of order four: at 10 rad/s its error is 1e-12 rad a step.
    pub max_step: f64,
}

/// Arms 60° apart in one plane through the centre of mass, the first along body x. Rotors 1, 3, 5 are tilted about their arms
/// (outwards) by +β, rotors 2, 4, 6 by -β.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct FrameConfig {
    /// L, from the centre of mass to each rotor [m]; 0.3.
    pub arm: f64,
    /// β [rad]; π/6. At 0 and π/2 there is no inverse of the allocation.
    pub tilt: f64,
}

/// A rotor: T = k_T Ω², Q = κ T. Rotors 1, 3, 5 turn counter-clockwise seen from above, 2, 4, 6 clockwise, so that the drag
/// torque helps the tilted thrusts in yaw.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotorConfig {
    /// Least thrust of a rotor [N], at least 0; 0.
    pub thrust_min: f64,
    /// Most thrust of a rotor [N]; 10.4, 2.2 times the weight of the default vehicle when all six give it.
    pub thrust_max: f64,
    /// k_T [N s²/rad²]; 1.6e-5.
    pub thrust_coefficient: f64,
    /// κ = Q/T, drag torque to thrust [m]; 0.016.
    pub drag_ratio: f64,
    /// Time constant of the first-order lag [s]; 0, no lag.
    pub time_constant: f64,
    /// What lags; the speed.
    pub lag_on: LagOn,
    /// Moment of inertia of one rotor about its axis [kg m²]; 0, which leaves the rotors' angular momentum out.
    pub inertia: f64,
}

/// What follows its command with a first-order lag.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LagOn {
    /// Ω' = (Ω_c - Ω)/T_r: the motor. The thrust is its square, so no first-order lag of its own.
    #[default]
    Speed,
    /// T' = (T_c - T)/T_r: then force and torque in the body frame are exactly first-order too.
    Thrust,
}

/// F_drag = -(c1 + c2 |u|) ∘ u in the body frame, u = Rᵀ (x' - wind) the velocity through the air; torque -d ∘ ω.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct DragConfig {
    /// c1 along body x, y, z [N s/m]; 0.
    pub linear: [f64; 3],
    /// c2 along body x, y, z [N s²/m²]; 0.
    pub quadratic: [f64; 3],
    /// d about body x, y, z [N m s/rad]; 0.
    pub angular: [f64; 3],
}

/// A mean and a first-order Gauss-Markov gust on each world axis: exp(-|τ|/T_g) is its correlation over a time τ, as of the
/// longitudinal Dryden gust of scale length T_g times the airspeed. It acts through [`DragConfig`] alone.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct WindConfig {
    /// Mean velocity of the air in the world frame [m/s]; 0.
    pub mean: [f64; 3],
    /// Standard deviation of the gusts on each world axis [m/s]; 0.
    pub gust_sd: [f64; 3],
    /// T_g, correlation time of the gusts [s]; 2.
    pub gust_time: f64,
    /// Seed of the gusts; 1.
    pub seed: u64,
}

/// What hangs on the vehicle: rigidly, its centre of mass in the vehicle's, so the common centre of mass stays where it is.
/// A suspended load or a shifted centre of mass is not modelled.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Payload {
    /// Added to m [kg], at least 0.
    pub mass: f64,
    /// Added to I_x, I_y, I_z [kg m²], at least 0.
    pub inertia: [f64; 3],
}

/// From `at` on the vehicle carries `payload` and nothing else; an empty one drops what was there.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PayloadStep {
    /// [s]; takes effect at the first tick at or after it.
    pub at: f64,
    /// What the vehicle then carries.
    #[serde(default)]
    pub payload: Payload,
}

/// The state at t = 0. The rotors start at the thrust that carries the weight in level attitude, within their limits.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct StartConfig {
    /// x in the world frame [m]; 0.
    pub position: [f64; 3],
    /// x' in the world frame [m/s]; 0.
    pub velocity: [f64; 3],
    /// η = (roll, pitch, yaw) [rad]; 0.
    pub attitude: [f64; 3],
    /// ω in the body frame [rad/s]; 0.
    pub body_rates: [f64; 3],
}

impl Default for HexarotorConfig {
    fn default() -> Self {
        Self {
            mass: 2.5,
            inertia: [0.03, 0.035, 0.055],
            gravity: 9.81,
            frame: FrameConfig::default(),
            rotor: RotorConfig::default(),
            drag: DragConfig::default(),
            wind: WindConfig::default(),
            payload: Vec::new(),
            start: StartConfig::default(),
            max_step: 1e-3,
        }
    }
}

impl Default for FrameConfig {
    fn default() -> Self {
        Self { arm: 0.3, tilt: FRAC_PI_6 }
    }
}

impl Default for RotorConfig {
    fn default() -> Self {
        Self {
            thrust_min: 0.0,
            thrust_max: 10.4,
            thrust_coefficient: 1.6e-5,
            drag_ratio: 0.016,
            time_constant: 0.0,
            lag_on: LagOn::Speed,
            inertia: 0.0,
        }
    }
}

impl Default for WindConfig {
    fn default() -> Self {
        Self { mean: [0.0; 3], gust_sd: [0.0; 3], gust_time: 2.0, seed: 1 }
    }
}

impl HexarotorConfig {
    /// Checks every parameter.
    ///
    /// # Errors
    /// Names the first that cannot be right.
    pub fn check(&self) -> Result<(), ParameterError> {
        check("mass", self.mass, 1e-3..=1e4, "must be from 0.001 to 10000 kg")?;
        check_each("inertia", self.inertia, 1e-7..=1e4, "must each be from 1e-7 to 10000 kg m²")?;
        check("gravity", self.gravity, 0.0..=100.0, "must be from 0 to 100 m/s²")?;
        check("max_step", self.max_step, 1e-6..=0.1, "must be from 1e-6 to 0.1 s")?;
        self.frame.check().map_err(|error| error.within("frame"))?;
        self.rotor.check().map_err(|error| error.within("rotor"))?;
        self.drag.check().map_err(|error| error.within("drag"))?;
        self.wind.check().map_err(|error| error.within("wind"))?;
        self.start.check().map_err(|error| error.within("start"))?;
        if self.rotor.drag_ratio * self.frame.tilt.tan() >= self.frame.arm {
            let needs = "must be longer than rotor.drag_ratio times the tangent of frame.tilt";
            return Err(ParameterError::new("frame.arm", self.frame.arm, needs));
        }
        let mut before = f64::NEG_INFINITY;
        for step in &self.payload {
            step.payload.check().map_err(|error| error.within("payload"))?;
            if !(step.at >= before && step.at.is_finite()) {
                return Err(ParameterError::new(
                    "payload.at",
                    step.at,
                    "must be finite, and not before the one above it",
                ));
            }
            before = step.at;
        }
        Ok(())
    }
}

impl FrameConfig {
    fn check(&self) -> Result<(), ParameterError> {
        check("arm", self.arm, 1e-3..=100.0, "must be from 0.001 to 100 m")?;
        check("tilt", self.tilt, 0.01..=1.5, "must be from 0.01 to 1.5 rad")
    }
}

impl RotorConfig {
    fn check(&self) -> Result<(), ParameterError> {
        check("thrust_min", self.thrust_min, 0.0..=1e5, "must be from 0 to 1e5 N")?;
        if !(self.thrust_max > self.thrust_min && self.thrust_max <= 1e5) {
            return Err(ParameterError::new("thrust_max", self.thrust_max, "must be above thrust_min, up to 1e5 N"));
        }
        check("thrust_coefficient", self.thrust_coefficient, 1e-12..=1.0, "must be from 1e-12 to 1 N s²/rad²")?;
        check("drag_ratio", self.drag_ratio, 0.0..=10.0, "must be from 0 to 10 m")?;
        check("time_constant", self.time_constant, 0.0..=10.0, "must be from 0 to 10 s")?;
        check("inertia", self.inertia, 0.0..=10.0, "must be from 0 to 10 kg m²")?;
        if self.inertia > 0.0 && !(self.time_constant > 0.0 && self.lag_on == LagOn::Speed) {
            let needs = "needs a time_constant above 0 and lag_on = speed: a speed that jumps takes an infinite torque";
            return Err(ParameterError::new("inertia", self.inertia, needs));
        }
        Ok(())
    }
}

impl DragConfig {
    fn check(&self) -> Result<(), ParameterError> {
        let needs = "must each be from 0 to 1000";
        check_each("linear", self.linear, 0.0..=1e3, needs)?;
        check_each("quadratic", self.quadratic, 0.0..=1e3, needs)?;
        check_each("angular", self.angular, 0.0..=1e3, needs)
    }
}

impl WindConfig {
    fn check(&self) -> Result<(), ParameterError> {
        check_each("mean", self.mean, -200.0..=200.0, "must each be from -200 to 200 m/s")?;
        check_each("gust_sd", self.gust_sd, 0.0..=100.0, "must each be from 0 to 100 m/s")?;
        check("gust_time", self.gust_time, 1e-3..=1e4, "must be from 0.001 to 10000 s")
    }
}

impl Payload {
    /// Checks every parameter.
    ///
    /// # Errors
    /// Names the first that cannot be right.
    pub fn check(&self) -> Result<(), ParameterError> {
        check("mass", self.mass, 0.0..=1e4, "must be from 0 to 10000 kg")?;
        check_each("inertia", self.inertia, 0.0..=1e4, "must each be from 0 to 10000 kg m²")
    }
}

impl StartConfig {
    fn check(&self) -> Result<(), ParameterError> {
        check_each("position", self.position, -1e5..=1e5, "must each be of magnitude up to 1e5 m")?;
        check_each("velocity", self.velocity, -1e3..=1e3, "must each be of magnitude up to 1000 m/s")?;
        check_each("attitude", self.attitude, -10.0..=10.0, "must each be of magnitude up to 10 rad")?;
        check_each("body_rates", self.body_rates, -1e3..=1e3, "must each be of magnitude up to 1000 rad/s")
    }
}
