//! Controller and estimator as they are written in a scenario file.

use fsb_core::control::{Gains, VehicleControlConfig, VehicleController};
use fsb_core::readout::{Memory, Readout};
use fsb_core::tuning::Tuning;
use fsb_core::vehicle::{ChangeRule, Expected, GroupConfig, VehicleConfig};
use serde::{Deserialize, Serialize};

use super::error::Refused;
use super::scenario::Scenario;
use crate::hexarotor::ParameterError;
use crate::hexarotor::error::check;
use crate::sensors::SensorConfig;

/// Gains of (11) and (13).
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ControlSettings {
    /// Of the position.
    pub translation: TranslationGains,
    /// Of the attitude.
    pub rotation: RotationGains,
}

/// K_P and K_D of (11).
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct TranslationGains {
    /// K_P [1/s²]; 6, as in Section V.
    pub kp: f64,
    /// K_D [1/s]; 5.
    pub kd: f64,
}

/// K_P and K_D of (13).
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotationGains {
    /// K_P [1/s²]; 100.
    pub kp: f64,
    /// K_D [1/s]; 20.
    pub kd: f64,
}

impl Default for TranslationGains {
    fn default() -> Self {
        let Gains { kp, kd } = VehicleControlConfig::new().translation;
        Self { kp, kd }
    }
}

impl Default for RotationGains {
    fn default() -> Self {
        let Gains { kp, kd } = VehicleControlConfig::new().rotation;
        Self { kp, kd }
    }
}

impl ControlSettings {
    /// The controller, for the given gravity [m/s²].
    ///
    /// # Errors
    /// Names the gain.
    pub fn controller(&self, gravity: f64) -> Result<VehicleController, Refused> {
        let config = VehicleControlConfig {
            translation: Gains { kp: self.translation.kp, kd: self.translation.kd },
            rotation: Gains { kp: self.rotation.kp, kd: self.rotation.kd },
            gravity,
            ..VehicleControlConfig::new()
        };
        VehicleController::new(&config).map_err(|error| Refused::Core("control", error))
    }
}

/// The estimator. What is absent has the default of [`VehicleConfig::new`].
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct EstimatorSettings {
    /// What is known of the mass before the flight [kg].
    pub mass: ExpectedMass,
    /// What is known of the moments of inertia [kg m²].
    pub inertia: ExpectedInertia,
    /// Time constant of the first-order lag of the rotors that the estimator reckons with [s]; none.
    pub actuator_lag: Option<f64>,
    /// The change detector; off.
    pub change: Option<ChangeSettings>,
    /// Position, velocity, mass.
    #[serde(default)]
    pub translation: GroupSettings,
    /// Attitude, rates, inertia.
    #[serde(default)]
    pub rotation: GroupSettings,
}

/// First guess and range of the mass [kg].
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedMass {
    /// What the flight begins with.
    pub nominal: Option<f64>,
    /// Least that is believed.
    pub min: f64,
    /// Most that is believed.
    pub max: f64,
}

/// First guess and range of the moments of inertia [kg m²].
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedInertia {
    /// What the flight begins with.
    pub nominal: Option<[f64; 3]>,
    /// Least that is believed of any.
    pub min: f64,
    /// Most that is believed of any.
    pub max: f64,
}

/// See [`ChangeRule`].
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ChangeSettings {
    /// Smallest relative change of k to react to.
    pub relative: f64,
    /// How many of its own standard deviations the change must be.
    pub sigmas: f64,
    /// Time after a start in which nothing is decided [s].
    pub hold_off: f64,
}

/// One group of three axes, see [`GroupConfig`]. What is absent has its default there, but `substeps` and `latency`, which
/// are those of the sensor, and `input_limit`.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct GroupSettings {
    /// λ of the identifier [1/s].
    pub lambda: Option<f64>,
    /// q of the identifier [1/s]; half of its λ.
    pub q: Option<f64>,
    /// λ of the observer [1/s].
    pub observer_lambda: Option<f64>,
    /// q of the observer [1/s]; half of its λ.
    pub observer_q: Option<f64>,
    /// Measurements per step of the identifier.
    pub block: Option<u32>,
    /// Standard deviation of a measurement [m] or [rad], where known beforehand.
    pub noise_sd: Option<f64>,
    /// (44) in place of least squares.
    pub absolute_ratio: Option<bool>,
    /// Time constant with which the read-out forgets [s]; it never does.
    pub fade: Option<f64>,
    /// Largest relative standard deviation at which a parameter is used.
    pub max_relative_sd: Option<f64>,
    /// ε of the parameters [s].
    pub parameter_settle: Option<f64>,
    /// ε of the states [s].
    pub state_settle: Option<f64>,
    /// Control periods from one measurement to the next.
    pub substeps: Option<u32>,
    /// How late a measurement is [s].
    pub latency: Option<f64>,
    /// The largest component of a force [N] or torque [N m] that is believed; what all rotors together can do.
    pub input_limit: Option<f64>,
}

impl EstimatorSettings {
    /// Checks what the core does not see as it is written in the file.
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        self.translation.check().map_err(|error| error.within("translation"))?;
        self.rotation.check().map_err(|error| error.within("rotation"))
    }

    /// The core's configuration for `scenario`; the core checks it.
    pub fn estimator(&self, scenario: &Scenario) -> VehicleConfig {
        let period = scenario.period();
        let default = VehicleConfig::new(period);
        let expected = |nominal, min, max| Expected { nominal, min, max };
        let inertia =
            |i: usize| expected(self.inertia.nominal.map(|nominal| nominal[i]), self.inertia.min, self.inertia.max);
        // Nothing more than all rotors at their limit, in one direction, at the end of their arms.
        let (rotor, arm) = (&scenario.plant.rotor, scenario.plant.frame.arm);
        let force = 6.0 * rotor.thrust_max;
        let torque = force * (arm + rotor.drag_ratio);
        VehicleConfig {
            translation: self.translation.group(default.translation, &scenario.sensors.position, period, force),
            rotation: self.rotation.group(default.rotation, &scenario.sensors.attitude, period, torque),
            gravity: scenario.plant.gravity,
            mass: expected(self.mass.nominal, self.mass.min, self.mass.max),
            inertia: [inertia(0), inertia(1), inertia(2)],
            actuator_lag: self.actuator_lag,
            change: self.change.map(|c| ChangeRule { relative: c.relative, sigmas: c.sigmas, hold_off: c.hold_off }),
            ..default
        }
    }
}

/// The largest force or torque that the core takes for possible.
const MOST: f64 = 5e5;

impl GroupSettings {
    /// What becomes a number of control periods must be one; everything else the core checks.
    fn check(&self) -> Result<(), ParameterError> {
        self.latency.map_or(Ok(()), |latency| check("latency", latency, 0.0..=60.0, "must be from 0 to 60 s"))
    }

    fn group(&self, default: GroupConfig, sensor: &SensorConfig, period: f64, most: f64) -> GroupConfig {
        let tuning = |lambda: Option<f64>, q: Option<f64>, default: Tuning| {
            let lambda_or = lambda.unwrap_or(default.lambda);
            Tuning { lambda: lambda_or, q: q.unwrap_or(if lambda.is_some() { lambda_or / 2.0 } else { default.q }) }
        };
        let every = sensor.rate.map_or(1.0, |rate| 1.0 / (rate * period));
        let late = self.latency.unwrap_or(sensor.latency) / period;
        GroupConfig {
            substeps: self.substeps.unwrap_or(every.round() as u32),
            latency: late.round() as u32,
            block: self.block.unwrap_or(default.block),
            identifier: tuning(self.lambda, self.q, default.identifier),
            observer: tuning(self.observer_lambda, self.observer_q, default.observer),
            noise_sd: self.noise_sd.or(default.noise_sd),
            readout: match self.absolute_ratio {
                Some(true) => Readout::AbsoluteRatio,
                Some(false) => Readout::LeastSquares,
                None => default.readout,
            },
            memory: self.fade.map_or(default.memory, |tau| Memory::Fading { tau }),
            max_relative_sd: self.max_relative_sd.unwrap_or(default.max_relative_sd),
            parameter_settle: self.parameter_settle.unwrap_or(default.parameter_settle),
            state_settle: self.state_settle.unwrap_or(default.state_settle),
            input_limit: self.input_limit.unwrap_or(most.min(MOST)),
            ..default
        }
    }
}
