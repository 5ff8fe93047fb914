//! What is replayed, wherever it came from: an axis log, two files, or a ULog.

use super::convention::opposed;
use super::fit::{Terms, fit, rows};
use super::flight::{Flight, FlightError, HoverThrust, ThrustUnit, notice};
use super::lag::{FoundLag, Lag, find};
use super::log::{AxisLog, FEWEST_SAMPLES};
use super::options::ReplayOptions;
use crate::replay::flight::KnownMotion;

/// A recording, ready for the core.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Positions on the grid, and the moments of the input.
    pub log: AxisLog,
    /// By how much the input acts later than its time stamps say \[s\].
    pub lag: f64,
    /// How that was found, where it was.
    pub search: Option<FoundLag>,
    /// What a reader has to be told.
    pub notices: Vec<String>,
    /// What the numbers of the input are.
    pub unit: ThrustUnit,
    /// The flight controller's own hover thrust, where it is logged.
    pub hover: Vec<HoverThrust>,
    /// Whether it came as positions and inputs at time stamps of their own.
    pub at_own_stamps: bool,
}

impl Recording {
    /// The flight controller's own hover thrust: the last one within the recording that it called valid.
    #[must_use]
    pub fn px4_hover(&self) -> Option<f64> {
        let end = self.log.time(self.log.len() - 1);
        self.hover.iter().rev().find(|hover| hover.valid && hover.t <= end).map(|hover| hover.value)
    }

    /// Of an axis log, `file` standing for it in messages: the part of it in which the input, with its lag, is known. `tried` is
    /// called after each trial of the search for the lag.
    ///
    /// # Errors
    /// [`FlightError`]: a lag that leaves too few positions.
    pub fn of_log(
        file: &str,
        log: AxisLog,
        lag: Lag,
        options: &ReplayOptions,
        tried: impl Fn(),
    ) -> Result<Self, FlightError> {
        let mut notices = notice::noticed(&log);
        let search = match lag {
            Lag::Given(_) => None,
            Lag::Auto => find(|lag| log.delayed(lag), options.gravity, tried),
        };
        let lag = chosen(lag, search.as_ref(), &mut notices);
        let log = log.delayed(lag).known(lag).ok_or_else(|| too_late(file))?;
        Ok(Self { log, lag, search, notices, unit: ThrustUnit::Newton, hover: Vec::new(), at_own_stamps: false })
    }

    /// Of a flight at its own time stamps, `file` standing for it in messages.
    ///
    /// The positions are interpolated beside the known input's response, for which a k is needed: first the one that hovers,
    /// then the one that the whole flight tells. Positions before the first input, with its lag, and after the last one are left
    /// out.
    ///
    /// # Errors
    /// [`FlightError`]: too few positions, or a lag that leaves too few.
    pub fn of_flight(
        file: &str,
        mut flight: Flight,
        lag: Lag,
        options: &ReplayOptions,
        tried: impl Fn(),
    ) -> Result<Self, FlightError> {
        let gravity = options.gravity;
        let mut notices = flight.noticed();
        let mut known = KnownMotion { k: flight.hovering(gravity), gravity };
        let first = flight.on_grid(file, 0.0, known)?;
        let delayed = |lag| flight.on_grid(file, lag, known).unwrap_or_else(|_| first.clone());
        let search = match lag {
            Lag::Given(_) => None,
            Lag::Auto => find(delayed, gravity, tried),
        };
        let lag = chosen(lag, search.as_ref(), &mut notices);
        if let (Some(first), Some(last)) = (flight.input.times.first(), flight.input.times.last())
            && lag != 0.0
        {
            flight.keep(first + lag, last + lag);
        }
        if flight.times.len() < FEWEST_SAMPLES {
            return Err(too_late(file));
        }
        let log = flight.on_grid(file, lag, known)?;
        let filtered = rows(&log, options.identifier, gravity);
        if let Some(told) = fit(&filtered, Terms { drag: false, disturbance: false }) {
            known.k = told.k;
        }
        let names: Vec<&str> = log.axes.iter().map(|axis| axis.axis.name()).collect();
        notices.extend(opposed(&names, &filtered, known.k, options.identifier.lambda * log.period));
        let log = flight.on_grid(file, lag, known)?;
        Ok(Self { log, lag, search, notices, unit: flight.unit, hover: flight.hover, at_own_stamps: true })
    }
}

fn too_late(file: &str) -> FlightError {
    FlightError::NoInput { file: file.to_owned() }
}

fn chosen(lag: Lag, search: Option<&FoundLag>, notices: &mut Vec<String>) -> f64 {
    match (lag, search) {
        (Lag::Given(lag), _) => lag,
        (Lag::Auto, Some(found)) => {
            if found.at_the_end {
                notices.push(format!(
                    "the lag is at the end of its range, {:.3} s: the true one may lie beyond",
                    found.lag
                ));
            }
            found.lag
        }
        (Lag::Auto, None) => {
            notices.push("no lag can be told: the log does not tell k".into());
            0.0
        }
    }
}
