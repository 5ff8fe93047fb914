//! One bad value among good ones: a measurement, or an input, of a flight of 30 s at 100 Hz with 1 mm of noise.

use fsb_core::ConfigError;
use fsb_core::guard::GuardConfig;
use rayon::prelude::*;

use super::flight::Flight;
use super::subject::{Kind, Subject, config};

/// Values that a sensor can send and should not.
pub const BAD_MEASUREMENTS: [f32; 16] = [
    f32::NAN,
    -f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    3e38,
    -3e38,
    1e6,
    -1e6,
    9e4,
    -9e4,
    0.0,
    -0.0,
    1e-40,
    -1e-40,
    1e-45,
    -1e-45,
];

/// The same for a force; 9e4 gives way to what is within the limit of 32 N.
pub const BAD_INPUTS: [f32; 16] = [
    f32::NAN,
    -f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    3e38,
    -3e38,
    1e6,
    -1e6,
    31.0,
    -31.0,
    0.0,
    -0.0,
    1e-40,
    -1e-40,
    1e-45,
    -1e-45,
];

/// A value as it is written in the tables: Rust's shortest form, with the sign of zero and of NaN.
pub fn name(value: f32) -> String {
    let sign = if value.is_sign_negative() { "-" } else { "" };
    if value.is_nan() {
        format!("{sign}NaN")
    } else if value == 0.0 {
        format!("{sign}0")
    } else {
        format!("{value:e}")
    }
}

/// Where the bad value comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In place of the position.
    Measurement,
    /// In place of the force; what acted is the true one.
    Input,
}

/// Compared with the flight without the bad value, over the 20 s after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recovery {
    /// Whether the bad value was used.
    pub used: bool,
    /// The worst deviation of v̂ [m/s].
    pub velocity: f64,
    /// The worst relative deviation of k̂; `None` where it was withdrawn.
    pub k: Option<f64>,
    /// Ticks from the bad value on after which the velocity's error is never again larger than 1.1 times the largest of the
    /// flight without it; `None` where that is not so within 20 s, or nothing is handed out at the end.
    pub ticks: Option<u32>,
}

/// One row of the table.
#[derive(Clone, Copy, Debug)]
pub struct BadValue {
    /// The value.
    pub value: f32,
    /// Behind the gate.
    pub guarded: Recovery,
    /// The bare estimator.
    pub bare: Recovery,
}

const PERIOD: f64 = 0.01;
const NOISE: f64 = 1e-3;
const BAD: u32 = 1000;
const TICKS: u32 = 3000;
/// From here on the flight without the bad value is what it is compared with.
const SETTLED: u32 = 500;

/// The table of one place.
///
/// # Errors
/// None: the configurations are right.
pub fn table(place: Place, seed: u64) -> Result<Vec<BadValue>, ConfigError> {
    let values = match place {
        Place::Measurement => BAD_MEASUREMENTS,
        Place::Input => BAD_INPUTS,
    };
    let row = |&value: &f32| {
        let of = |kind| one(place, value, kind, POSITION_LIMIT, seed);
        Ok(BadValue { value, guarded: of(Kind::Guarded)?, bare: of(Kind::Bare)? })
    };
    values.par_iter().map(row).collect()
}

/// The default limit of a position [m].
pub const POSITION_LIMIT: f64 = 1e5;

/// What one bad `value` does, where measurements up to `position_limit` [m] are physical.
///
/// # Errors
/// A limit that the core refuses.
pub fn one(place: Place, value: f32, kind: Kind, position_limit: f64, seed: u64) -> Result<Recovery, ConfigError> {
    let config = fsb_core::EstimatorConfig { position_limit, ..config(PERIOD) };
    let mut hit = Subject::new(kind, &config, &GuardConfig::default())?;
    let mut spared = hit.clone();
    let mut flight = Flight::new(PERIOD, NOISE, seed);
    let mut found = Recovery { used: false, velocity: 0.0, k: Some(0.0), ticks: None };
    let mut usual = 0.0_f64;
    let mut errors = Vec::new();
    for n in 0..TICKS {
        let tick = flight.next();
        let bad = n == BAD;
        let of = |here: Place, good: f32| if bad && place == here { value } else { good };
        spared.measure(Some(tick.measured));
        let used = hit.measure(Some(of(Place::Measurement, tick.measured)));
        if bad && place == Place::Measurement {
            found.used = used;
        }
        if n >= SETTLED {
            let error = |subject: &Subject| subject.velocity().map_or(f64::INFINITY, |v| (v - tick.velocity).abs());
            usual = usual.max(error(&spared));
            if n >= BAD {
                errors.push(error(&hit));
                let velocities = hit.velocity().zip(spared.velocity());
                found.velocity = velocities.map_or(found.velocity, |(a, b)| found.velocity.max((a - b).abs()));
                let off = hit.k().zip(spared.k()).map(|(a, b)| (a / b - 1.0).abs());
                found.k = found.k.zip(off).map(|(worst, off)| worst.max(off));
            }
        }
        spared.apply(tick.force);
        let used = hit.apply(of(Place::Input, tick.force));
        if bad && place == Place::Input {
            found.used = used;
        }
    }
    let last = errors.iter().rposition(|&error| error > 1.1 * usual).map_or(0, |last| last as u32 + 1);
    found.ticks = (last < errors.len() as u32).then_some(last);
    Ok(found)
}
