//! One axis of (11), (13), (70)-(71).

use crate::checks::{Checks, Range, Rule, rule};
use crate::error::ConfigError;
use crate::estimator::AxisState;
use core::fmt;

/// Gains and limits of an axis's controller. Plain data.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TrackingConfig {
    /// K_P of (12) (1/s²); positive, 1e-15..=1e15.
    pub kp: f64,
    /// K_D of (12) (1/s); positive, 1e-15..=1e15.
    pub kd: f64,
    /// Known drift c of the axis (m/s² or rad/s²), -g on a vertical axis that points up; the input makes up for it.
    /// Magnitude up to 1e6.
    pub drift: f64,
    /// The smallest parameter that the controller divides by; 1e-15..=1e15.
    pub parameter_min: f64,
    /// The largest parameter that the controller divides by; not below the smallest, up to 1e15.
    pub parameter_max: f64,
}

/// What the axis shall do now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Reference {
    /// y_d (m or rad).
    pub position: f32,
    /// y_d' (m/s or rad/s).
    pub velocity: f32,
    /// y_d'' (m/s² or rad/s²).
    pub acceleration: f32,
}

/// No input could be computed. What to do then (hold, descend, hand over) is the caller's decision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ControlError {
    /// The parameter is outside the configured range, or not finite.
    ParameterOutOfRange,
    /// The reference, the state or the result is not finite.
    NonFinite,
}

impl fmt::Display for ControlError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::ParameterOutOfRange => "the parameter is outside the range the controller may divide by",
            Self::NonFinite => "the reference, the state or the resulting input is not finite",
        })
    }
}

impl core::error::Error for ControlError {}

/// f = (y_d'' - c - K_D (v̂ - y_d') - K_P (ŷ - y_d)) / k̂, (70)-(71); on the world axes it is (11) before the rotation, on
/// the attitude axes (13). With the true k, ŷ and v̂ the error obeys (12): ỹ'' + K_D ỹ' + K_P ỹ = 0.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TrackingController {
    kp: f32,
    kd: f32,
    drift: f32,
    min: f32,
    max: f32,
}

impl TrackingController {
    /// Validates `config`.
    ///
    /// # Errors
    /// Names `kp`, `kd`, `drift`, `parameter_min` or `parameter_max`.
    pub fn new(config: &TrackingConfig) -> Result<Self, ConfigError> {
        const LIMITS: [Rule; 2] =
            [*rule!("parameter_min", Range::PARAMETER), *rule!("parameter_max", Range::PARAMETER)];
        let mut checks = Checks::new();
        let (min, max) = checks.limits(&LIMITS, [config.parameter_min, config.parameter_max], true);
        let controller = Self {
            kp: checks.number(rule!("kp", Range::PARAMETER), config.kp),
            kd: checks.number(rule!("kd", Range::PARAMETER), config.kd),
            drift: checks.signed(rule!("drift", Range::MAGNITUDE), config.drift),
            min,
            max,
        };
        checks.outcome()?;
        Ok(controller)
    }

    /// The input for `state`, with the parameter `k` (identified, nominal or true).
    ///
    /// # Errors
    /// [`ControlError`]; an input that is not finite is never returned. Cost: 10 operations, one of them a division.
    pub fn input(&self, reference: &Reference, state: &AxisState, k: f32) -> Result<f32, ControlError> {
        if !(k >= self.min && k <= self.max) {
            return Err(ControlError::ParameterOutOfRange);
        }
        let wanted = reference.acceleration
            - self.drift
            - self.kd * (state.velocity - reference.velocity)
            - self.kp * (state.position - reference.position);
        let input = wanted / k;
        if input.is_finite() { Ok(input) } else { Err(ControlError::NonFinite) }
    }
}
