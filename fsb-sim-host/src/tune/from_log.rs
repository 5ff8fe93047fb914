//! Noise and rate of a log.

use super::Sensor;
use crate::replay::Recording;
use crate::replay::compare::noise::measured;
use crate::replay::fit::{Terms, fit, rows};
use crate::replay::log::Axis;
use fsb_core::Tuning;

/// What a log tells of its sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct LogSensor {
    /// The noisiest axis.
    pub sensor: Sensor,
    /// Each translational axis with the standard deviation of its measurements \[m\].
    pub axes: Vec<(Axis, f64)>,
}

/// Less noise than this \[m\] is none: positions that stand still, or that were computed.
const NONE: f64 = 1e-12;

/// Measures the noise of a recording; `None` where no axis has enough measurements in a row, none has noise, or k cannot be
/// told.
#[must_use]
pub fn sensor(recording: &Recording, gravity: f64) -> Option<LogSensor> {
    let log = &recording.log;
    let identifier = Tuning::from_lambda(2f64.min(0.5 / log.period));
    let k = fit(&rows(log, identifier, gravity), Terms { drag: true, disturbance: true })?.k;
    let axes: Vec<(Axis, f64)> = log
        .axes
        .iter()
        .filter(|axis| axis.axis.is_translation())
        .filter_map(|axis| {
            let drift = if axis.axis == Axis::Z { -gravity } else { 0.0 };
            measured(log, axis, k, drift).map(|sd| (axis.axis, sd))
        })
        .collect();
    let noise_sd = axes.iter().map(|&(_, sd)| sd).fold(0.0, f64::max);
    (noise_sd > NONE).then_some(LogSensor { sensor: Sensor { noise_sd, period: log.period }, axes })
}
