//! A flight as data: what is written in a scenario file.

use serde::{Deserialize, Serialize};

use super::bus::BusConfig;
use super::error::Refused;
use super::path::{AttitudePath, PositionPath};
use super::pilot::CorePilot;
use super::random::RandomConfig;
use super::settings::{ControlSettings, EstimatorSettings};
use crate::hexarotor::HexarotorConfig;
use crate::hexarotor::error::check;
use crate::sensors::SensorConfig;

/// A flight: vehicle, sensors, what it shall do, and how it is estimated and controlled. Whatever a file leaves out has the
/// default stated with it; an unknown name is refused.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Name; of a built-in one that of its file.
    pub name: String,
    /// What is flown and why, in a sentence or two.
    pub description: String,
    /// Length of the flight [s], 0.1 to 1e6.
    pub duration: f64,
    /// Control ticks a second [Hz], 10 to 10000: estimation, control and new thrust commands.
    pub rate: f64,
    /// The vehicle, the air and the start.
    #[serde(default)]
    pub plant: HexarotorConfig,
    /// What is measured; all of it at every tick and exact by default.
    #[serde(default)]
    pub sensors: Sensors,
    /// What happens to the numbers on their way to the estimator; nothing by default.
    #[serde(default)]
    pub bus: BusConfig,
    /// Where to fly.
    pub reference: References,
    /// Gains.
    #[serde(default)]
    pub control: ControlSettings,
    /// Tunings and first guesses.
    pub estimator: EstimatorSettings,
    /// When a flight counts as diverged.
    #[serde(default)]
    pub limits: Limits,
    /// What is drawn anew for every flight from its seed; nothing by default.
    #[serde(default)]
    pub random: RandomConfig,
}

/// The two sensors.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sensors {
    /// Position in the world frame [m].
    pub position: SensorConfig,
    /// Attitude [rad].
    pub attitude: SensorConfig,
}

/// The two paths.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct References {
    /// x_d(t).
    pub position: PositionPath,
    /// η_d(t).
    #[serde(default)]
    pub attitude: AttitudePath,
}

/// A flight has diverged, and ends, when it is farther from its reference than this, or where a number is not finite.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Limits {
    /// Distance from the reference [m]; 20.
    pub position: f64,
    /// Angle between attitude and reference [rad]; 2.
    pub attitude: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { position: 20.0, attitude: 2.0 }
    }
}

impl Scenario {
    /// Control period [s].
    pub fn period(&self) -> f64 {
        1.0 / self.rate
    }

    /// Control periods from start to end.
    pub fn ticks(&self) -> u64 {
        (self.duration * self.rate).round() as u64
    }

    /// Checks every parameter.
    ///
    /// # Errors
    /// Names the first that cannot be right, as it is written in the file.
    pub fn check(&self) -> Result<(), Refused> {
        check("duration", self.duration, 0.1..=1e6, "must be from 0.1 to 1e6 s")?;
        check("rate", self.rate, 10.0..=1e4, "must be from 10 to 10000 Hz")?;
        self.plant.check().map_err(|error| error.within("plant"))?;
        let period = self.period();
        self.sensors.position.check(period).map_err(|error| error.within("sensors.position"))?;
        self.sensors.attitude.check(period).map_err(|error| error.within("sensors.attitude"))?;
        self.reference.position.check().map_err(|error| error.within("reference.position"))?;
        self.reference.attitude.check().map_err(|error| error.within("reference.attitude"))?;
        check("limits.position", self.limits.position, 1e-3..=1e6, "must be from 0.001 to 1e6 m")?;
        check("limits.attitude", self.limits.attitude, 1e-3..=4.0, "must be from 0.001 to 4 rad")?;
        self.random.check(&self.estimator).map_err(|error| error.within("random"))?;
        self.estimator.check().map_err(|error| error.within("estimator"))?;
        self.control.controller(self.plant.gravity)?;
        CorePilot::new(self, 0)?;
        self.check_draws()
    }
}
