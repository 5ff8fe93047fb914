//! The configuration of the vehicle turned into those of its two estimators, errors named as the caller wrote them.

use super::config::{Expected, GroupConfig, VehicleConfig};
use crate::error::{ConfigError, finite, positive};
use crate::estimator::EstimatorConfig;
use crate::readout::ParameterRule;

/// The rotation's turns come so many measurements after the translation's.
const TURN: u32 = 4;

/// The largest limit of an input.
const LARGEST_INPUT: f64 = 1e6;

/// x, y, z, and what they have in common.
pub(super) fn translation(config: &VehicleConfig) -> Result<EstimatorConfig<3, 1>, ConfigError> {
    let gravity = finite("gravity", config.gravity)?;
    if gravity < 0.0 {
        return Err(ConfigError::Negative("gravity"));
    }
    let group = &config.translation;
    let k = parameter(&config.mass, ["mass.nominal", "mass.min", "mass.max"])?;
    Ok(EstimatorConfig {
        drift: [0.0, 0.0, -gravity],
        nominal: [k.nominal],
        rule: [k.rule(group)],
        ..common(config.period, group)
    })
}

/// The angles about the body's axes.
pub(super) fn rotation(config: &VehicleConfig) -> Result<EstimatorConfig<3, 3>, ConfigError> {
    let group = &config.rotation;
    let [x, y, z] = config.inertia;
    let named = |expected: Expected| parameter(&expected, ["inertia.nominal", "inertia.min", "inertia.max"]);
    let [x, y, z] = [named(x)?, named(y)?, named(z)?];
    let common = common(config.period, group);
    // The gyroscopic moment comes on top of the torque, which has been checked, and is no matter of what actuators can do.
    let sound = common.input_limit > 0.0 && common.input_limit <= LARGEST_INPUT;
    Ok(EstimatorConfig {
        turn: TURN,
        nominal: [x.nominal, y.nominal, z.nominal],
        rule: [x.rule(group), y.rule(group), z.rule(group)],
        input_limit: if sound { LARGEST_INPUT } else { common.input_limit },
        ..common
    })
}

fn common<const P: usize>(period: f64, group: &GroupConfig) -> EstimatorConfig<3, P> {
    EstimatorConfig {
        substeps: group.substeps,
        block: group.block,
        identifier: group.identifier,
        observer: group.observer,
        noise_sd: group.noise_sd,
        disturbance_sd: group.disturbance_sd,
        readout: group.readout,
        memory: group.memory,
        max_misfit: group.max_misfit,
        parameter_settle: group.parameter_settle,
        state_settle: group.state_settle,
        position_limit: group.measurement_limit,
        // A force within the limit along every body axis is within √3 of it along any other.
        input_limit: 2.0 * group.input_limit,
        ..EstimatorConfig::new(period)
    }
}

/// k = 1/x of what is expected of x.
struct Reciprocal {
    nominal: Option<f64>,
    min: f64,
    max: f64,
}

impl Reciprocal {
    fn rule(&self, group: &GroupConfig) -> ParameterRule {
        ParameterRule { min: self.min, max: self.max, max_relative_sd: group.max_relative_sd }
    }
}

fn parameter(expected: &Expected, [nominal, min, max]: [&'static str; 3]) -> Result<Reciprocal, ConfigError> {
    if finite(max, expected.max)? <= positive(min, expected.min)? {
        return Err(ConfigError::InvertedRange(min));
    }
    for (name, value) in [(min, Some(expected.min)), (max, Some(expected.max)), (nominal, expected.nominal)] {
        if let Some(value) = value
            && !(1e-12..=1e12).contains(&positive(name, value)?)
        {
            return Err(ConfigError::OutOfRange(name));
        }
    }
    Ok(Reciprocal { nominal: expected.nominal.map(|x| 1.0 / x), min: 1.0 / expected.max, max: 1.0 / expected.min })
}

macro_rules! names {
    ($function:ident, $group:literal, $drift:literal, $nominal:literal, [$($name:literal),+ $(,)?]) => {
        /// An error of the estimator, named as in the configuration of the vehicle.
        pub(super) fn $function(error: ConfigError) -> ConfigError {
            error.renamed(match error.parameter() {
                $($name => concat!($group, ".", $name),)+
                "position_limit" => concat!($group, ".measurement_limit"),
                "rule.max_relative_sd" => concat!($group, ".max_relative_sd"),
                "drift" => $drift,
                "nominal" => $nominal,
                name => name,
            })
        }
    };
}

macro_rules! groups {
    ($($function:ident, $group:literal, $drift:literal, $nominal:literal;)+) => {
        $(names!($function, $group, $drift, $nominal, [
            "substeps", "block", "identifier.lambda", "identifier.q", "observer.lambda", "observer.q", "noise_sd", "disturbance_sd",
            "memory.tau", "max_misfit", "parameter_settle", "state_settle", "input_limit", "guard.sigmas",
            "guard.acceleration", "guard.floor", "guard.jump_after", "guard.bridge", "guard.frozen_after",
        ]);)+
    };
}

groups! {
    of_translation, "translation", "gravity", "mass.nominal";
    of_rotation, "rotation", "rotation", "inertia.nominal";
}
