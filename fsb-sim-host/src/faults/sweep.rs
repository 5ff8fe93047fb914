//! Noise × dropout × outliers × jitter × a change of mass, at 100 Hz behind the gate: what becomes of mass and velocity. A
//! memory that fades (τ = 3 s) follows the mass.

use fsb_core::ConfigError;
use fsb_core::EstimatorConfig;
use fsb_core::guard::GuardConfig;
use fsb_core::readout::Memory;
use fsb_faults::{FaultConfig, Injector};
use rayon::prelude::*;

use super::flight::{Flight, MASS};
use super::subject::{Kind, Subject, config};

/// Standard deviation of a measurement [m].
pub const NOISES: [f64; 3] = [1e-3, 1e-2, 1e-1];
/// Share of the measurements that do not come.
pub const DROPOUTS: [f32; 2] = [0.0, 0.3];
/// Share of the measurements that are off by up to 2 m.
pub const OUTLIERS: [f32; 2] = [0.0, 0.1];
/// Shares of a sampling period.
pub const JITTERS: [f32; 2] = [0.0, 0.2];
/// Relative change of the mass at 20 s.
pub const STEPS: [f64; 2] = [0.0, -0.3];

/// What is varied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Standard deviation of a measurement [m].
    pub noise: f64,
    /// Share of the measurements that do not come.
    pub dropout: f32,
    /// Share of the measurements that are off by up to 2 m.
    pub outliers: f32,
    /// Share of a sampling period.
    pub jitter: f32,
    /// Relative change of the mass at 20 s.
    pub step: f64,
}

/// What was seen. "Settled" leaves out the first 5 s and the 15 s after the change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// What was varied.
    pub case: Case,
    /// Relative error of the mass, rms of the last 5 s.
    pub mass_end: f64,
    /// The largest, settled.
    pub mass_worst: f64,
    /// Error of the velocity, rms of the last 5 s [m/s].
    pub velocity_end: f64,
    /// The largest from 5 s on, the change included [m/s].
    pub velocity_worst: f64,
    /// Measurements turned away.
    pub rejected: u32,
    /// Ticks from 5 s on at which mass or velocity were not valid.
    pub invalid: u32,
}

/// All combinations.
pub fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for noise in NOISES {
        for dropout in DROPOUTS {
            for outliers in OUTLIERS {
                for jitter in JITTERS {
                    all.extend(STEPS.map(|step| Case { noise, dropout, outliers, jitter, step }));
                }
            }
        }
    }
    all
}

/// Flies them all.
///
/// # Errors
/// None: the configurations are right.
pub fn table(seed: u64) -> Result<Vec<Row>, ConfigError> {
    cases().par_iter().map(|case| fly(case, seed)).collect()
}

const PERIOD: f64 = 0.01;
const TICKS: u32 = 5000;
const CHANGE: u32 = 2000;
const SETTLED: u32 = 500;
/// Five times the memory.
const FOLLOWED: u32 = 1500;
const END: u32 = 4500;

/// Flies one.
///
/// # Errors
/// What the core or the injector refuse.
pub fn fly(case: &Case, seed: u64) -> Result<Row, ConfigError> {
    let config = EstimatorConfig { memory: Memory::Fading { tau: 3.0 }, ..config(PERIOD) };
    let mut subject = Subject::new(Kind::Guarded, &config, &GuardConfig::default())?;
    let mut flight = Flight::new(PERIOD, case.noise, seed);
    let Case { dropout: drop, outliers: spike, jitter, .. } = *case;
    let faults = FaultConfig { drop, spike, spike_size: 2.0, jitter, ..FaultConfig::default() };
    let mut injector: Injector<1> =
        Injector::new(&faults, seed).map_err(|error| ConfigError::OutOfRange(error.parameter()))?;
    let mut row = Row {
        case: *case,
        mass_end: 0.0,
        mass_worst: 0.0,
        velocity_end: 0.0,
        velocity_worst: 0.0,
        rejected: 0,
        invalid: 0,
    };
    for n in 0..TICKS {
        if n == CHANGE {
            flight.axis.k = 1.0 / (MASS * (1.0 + case.step));
        }
        let tick = flight.next();
        let given = injector.pass(Some(tick.measured));
        let used = subject.measure(given);
        row.rejected += u32::from(given.is_some() && !used);
        let mass = subject.k().map(|k| (flight.axis.k / k - 1.0).abs());
        let velocity = subject.velocity().map(|v| (v - tick.velocity).abs());
        if n >= SETTLED {
            row.invalid += u32::from(mass.is_none() || velocity.is_none());
            row.velocity_worst = row.velocity_worst.max(velocity.unwrap_or(0.0));
            let following = case.step != 0.0 && (CHANGE..CHANGE + FOLLOWED).contains(&n);
            row.mass_worst = if following { row.mass_worst } else { row.mass_worst.max(mass.unwrap_or(0.0)) };
        }
        if n >= END {
            row.mass_end += mass.unwrap_or(f64::INFINITY).powi(2);
            row.velocity_end += velocity.unwrap_or(f64::INFINITY).powi(2);
        }
        subject.apply(tick.force);
    }
    let count = f64::from(TICKS - END);
    row.mass_end = (row.mass_end / count).sqrt();
    row.velocity_end = (row.velocity_end / count).sqrt();
    Ok(row)
}
