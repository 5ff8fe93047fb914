//! A flight as it was recorded: positions, attitudes and inputs, each at its own time stamps, on one clock.
//!
//! The core runs at one period, so the positions are brought to a grid (`grid`); the input is not: its moments over each
//! interval of the grid are exact for an input held from stamp to stamp (`response`).
//!
//! | file | what |
//! |---|---|
//! | `quaternion` | attitudes |
//! | `response` | the input's moments over any interval |
//! | `grid` | positions at equal distances, and the log that the core is fed with |
//! | `notice` | gaps, jumps, saturation: what a reader has to be told |
//! | `error` | why recordings are refused |

pub mod error;
mod grid;
pub mod notice;
pub mod quaternion;
pub mod response;

pub use error::FlightError;
pub use grid::{KnownMotion, LARGEST_BRACKET};
pub use response::{AttitudeTrack, HeldInput};

/// What the numbers of an input are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ThrustUnit {
    /// \[N\]: 1/k is a mass \[kg\].
    #[default]
    Newton,
    /// A share of some full thrust: g/k is the thrust that hovers, in the same share.
    Normalised,
}

/// The flight controller's own estimate of the hover thrust at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoverThrust {
    /// \[s\]
    pub t: f64,
    /// As a share of the full thrust.
    pub value: f64,
    /// Its standard deviation.
    pub sd: f64,
    /// Whether the flight controller called it valid.
    pub valid: bool,
}

/// A recorded flight. World frame with z up; body frame with x forward, y left, z up (along the thrust).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Flight {
    /// When the positions were measured \[s\], rising.
    pub times: Vec<f64>,
    /// x, y, z \[m\].
    pub position: Vec<[f64; 3]>,
    /// Which of x, y, z can be used at all.
    pub usable: [bool; 3],
    /// Velocities to compare with \[m/s\], one per position.
    pub reference: Option<Vec<[Option<f64>; 3]>>,
    /// Attitude; may be empty, and the input is one of the world frame then.
    pub attitude: AttitudeTrack,
    /// Force in the body frame.
    pub input: HeldInput,
    /// What the numbers of the input are.
    pub unit: ThrustUnit,
    /// The flight controller's own hover thrust, where it is logged.
    pub hover: Vec<HoverThrust>,
    /// What the reader of the recording noticed.
    pub notices: Vec<String>,
}
