//! What is kept of a flight.

use serde::Serialize;

use super::flight::Moment;
use super::pilot::Belief;

/// Errors of the parameters are kept this often [s], each at the tick nearest to that.
pub const ERRORS_EVERY: f64 = 0.1;
/// Tracking is judged from this time on [s].
pub const TRACKING_FROM: f64 = 6.0;
/// The names of the four parameters, as in the JSON.
pub const NAMES: [&str; 4] = ["mass", "ixx", "iyy", "izz"];

/// One kept tick.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// The tick.
    pub moment: Moment,
    /// What was believed then.
    pub belief: Belief,
    /// The yardstick's distance from the reference [m], and angle [rad]; not finite where it was not flown.
    pub yardstick: [f64; 2],
}

/// Errors of the parameters at one time, in percent of the truth then.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Errors {
    /// [s]
    pub t: f64,
    /// m.
    pub mass: Option<f64>,
    /// I_x.
    pub ixx: Option<f64>,
    /// I_y.
    pub iyy: Option<f64>,
    /// I_z.
    pub izz: Option<f64>,
}

impl Errors {
    /// All four.
    pub fn all(&self) -> [Option<f64>; 4] {
        [self.mass, self.ixx, self.iyy, self.izz]
    }

    pub(super) fn of(t: f64, [mass, ixx, iyy, izz]: [Option<f64>; 4]) -> Self {
        Self { t, mass, ixx, iyy, izz }
    }
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// [s]
    pub t: f64,
    /// In a few words.
    pub what: String,
}

/// One parameter at the end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ParameterEnd {
    /// What it is then, payload included.
    #[serde(rename = "true")]
    pub real: f64,
    /// What it is taken for, where it is valid or an older value stands in.
    pub estimated: Option<f64>,
    /// Standard deviation, as reported.
    pub sd: Option<f64>,
    /// Whether it is valid, not an older value.
    pub valid: bool,
}

/// Root mean squares over the flight from [`TRACKING_FROM`] on, `null` of a shorter one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Tracking {
    /// Distance from the reference [m].
    pub position_rms: f64,
    /// Angle from the reference [rad].
    pub attitude_rms: f64,
    /// The yardstick's distance [m].
    pub yardstick_position_rms: f64,
    /// The yardstick's angle [rad].
    pub yardstick_attitude_rms: f64,
    /// Largest height error, either way [m].
    pub height_error_max: f64,
    /// The yardstick's [m].
    pub yardstick_height_error_max: f64,
    /// Largest distance [m].
    pub position_error_max: f64,
    /// The yardstick's [m].
    pub yardstick_position_error_max: f64,
}

/// Errors of the estimated state, rms from [`TRACKING_FROM`] on where it is handed out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct StateErrors {
    /// Of the position vector [m].
    pub position_rms: f64,
    /// Of the velocity vector [m/s].
    pub velocity_rms: f64,
    /// Of the body rates [rad/s].
    pub rates_rms: f64,
}

/// A flight.
#[derive(Clone, Debug)]
pub struct Flight {
    /// Samples, evenly spaced.
    pub samples: Vec<Sample>,
    /// Errors every [`ERRORS_EVERY`].
    pub errors: Vec<Errors>,
    /// What happened, in order.
    pub events: Vec<Event>,
    /// The parameters at the end.
    pub parameters: [ParameterEnd; 4],
    /// Tracking; the yardstick's is NaN where it was not flown.
    pub tracking: Tracking,
    /// Errors of the state.
    pub state: StateErrors,
    /// Errors of the paper's small-angle model looking on, where it was asked for.
    pub small_angle: Option<Vec<Errors>>,
    /// When it diverged [s].
    pub diverged: Option<f64>,
    /// How long it was [s].
    pub flown: f64,
}
