//! The gates' configuration: plain data, and the same validated.

use crate::error::{ConfigError, finite, positive};
use crate::tuning::Tuning;

/// Plain data; [`GuardDesign::new`] validates it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct GuardConfig {
    /// s: a step of the innovation of more than so many of its standard deviations is improbable. 3..=1000.
    pub sigmas: f64,
    /// a: the largest acceleration that the model may not know of (m/s² or rad/s²): a load dropped, wind, a wrong first k.
    /// What it moves passes the gate. Not negative, up to 1e6.
    pub acceleration: f64,
    /// Steps up to this always pass (m or rad): a few quanta of the sensor. Not negative, up to 1e6.
    pub floor: f64,
    /// So many improbable measurements in a row that agree with each other are a jump of the sensor, and so many on a straight
    /// line a push: the velocity has changed at once. 2..=65535.
    pub jump_after: u32,
    /// Gaps up to this are bridged by prediction (s). An axis that has not been measured for longer is stale: its state is not
    /// handed out. Where all axes are, the windows start anew with the next measurement; where one was, the identification.
    /// Parameters are held. Rounded to whole measurement periods, 1..=65534 of them.
    pub bridge: f64,
    /// A measurement whose bits have been the same for more than so many samples is one of a frozen sensor; 0: never. It takes
    /// two that differ to end that, as a bit of a frozen value may flip. Up to 65535.
    pub frozen_after: u32,
}

impl Default for GuardConfig {
    /// For positions in metres and angles in radians of a small vehicle: 8 standard deviations, 20 m/s², 5 mm, 10
    /// measurements, 2 s, never frozen.
    fn default() -> Self {
        Self { sigmas: 8.0, acceleration: 20.0, floor: 5e-3, jump_after: 10, bridge: 2.0, frozen_after: 0 }
    }
}

/// A [`GuardConfig`] validated, for an observer's tuning and measurement period.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct GuardDesign {
    /// s²
    pub(super) sigmas2: f32,
    /// floor + a T/(eλ)
    pub(super) step: f32,
    /// 2a T/λ
    pub(super) drift: f32,
    /// a T²/2
    pub(super) fall: f32,
    /// λT
    pub(super) lambda_t: f32,
    /// 3λT: the share of itself by which an innovation changes at most from one sample to the next, both poles at e^(-λT)
    pub(super) decay: f32,
    /// 1/T
    pub(super) per_period: f32,
    pub(super) jump_after: u16,
    /// In measurement periods.
    pub(super) bridge: u16,
    pub(super) frozen_after: u16,
}

impl GuardDesign {
    /// For an observer with `tuning` at the measurement `period` (s), both of which have been validated.
    ///
    /// # Errors
    /// Names the parameter, with `guard.` before it.
    pub fn new(config: &GuardConfig, tuning: Tuning, period: f64) -> Result<Self, ConfigError> {
        if !(3.0..=1000.0).contains(&finite("guard.sigmas", config.sigmas)?) {
            return Err(ConfigError::OutOfRange("guard.sigmas"));
        }
        for (name, value) in [("guard.acceleration", config.acceleration), ("guard.floor", config.floor)] {
            if finite(name, value)? < 0.0 {
                return Err(ConfigError::Negative(name));
            }
            if value > 1e6 {
                return Err(ConfigError::OutOfRange(name));
            }
        }
        let count = |name, value: u32, least| match u16::try_from(value) {
            Ok(count) if count >= least => Ok(count),
            _ => Err(ConfigError::OutOfRange(name)),
        };
        let bridge = libm::round(positive("guard.bridge", config.bridge)? / period);
        if !(1.0..=65_534.0).contains(&bridge) {
            return Err(ConfigError::OutOfRange("guard.bridge"));
        }
        let lambda = positive("observer.lambda", tuning.lambda)?;
        Ok(Self {
            sigmas2: (config.sigmas * config.sigmas) as f32,
            step: (config.floor + config.acceleration * period / (core::f64::consts::E * lambda)) as f32,
            drift: (2.0 * config.acceleration * period / lambda) as f32,
            fall: (0.5 * config.acceleration * period * period) as f32,
            lambda_t: (lambda * period) as f32,
            decay: (3.0 * lambda * period) as f32,
            per_period: (1.0 / period) as f32,
            jump_after: count("guard.jump_after", config.jump_after, 2)?,
            bridge: bridge as u16,
            frozen_after: count("guard.frozen_after", config.frozen_after, 0)?,
        })
    }
}
