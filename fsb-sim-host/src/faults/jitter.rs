//! Sampling instants up to ±x % of a period early or late, uniformly and independently.

use fsb_core::ConfigError;
use fsb_core::guard::GuardConfig;
use fsb_faults::{FaultConfig, Injector};

use super::flight::Flight;
use super::subject::{Kind, Subject, config};

/// Shares of a sampling period.
pub const SHARES: [f32; 6] = [0.0, 0.01, 0.05, 0.1, 0.2, 0.5];
/// Measurement rates [Hz].
pub const RATES: [f64; 2] = [100.0, 1000.0];
/// Noise of the position [m]: none, and some.
pub const NOISES: [f64; 2] = [0.0, 1e-3];
/// Length of a flight [s].
pub const SECONDS: f64 = 60.0;

/// What it does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    /// Share of a sampling period.
    pub share: f32,
    /// Measurement rate [Hz].
    pub rate: f64,
    /// Noise of the position [m].
    pub noise: f64,
    /// Error of v̂ from 5 s on, rms [m/s].
    pub velocity_rms: f64,
    /// The largest [m/s].
    pub velocity: f64,
    /// Relative error of k̂ at the end.
    pub k: f64,
    /// Measurements turned away by the gate.
    pub rejected: u32,
}

/// All of it.
///
/// # Errors
/// None: the configurations are right.
pub fn table(seed: u64) -> Result<Vec<Effect>, ConfigError> {
    let mut effects = Vec::new();
    for rate in RATES {
        for noise in NOISES {
            for share in SHARES {
                effects.push(fly(share, rate, noise, seed)?);
            }
        }
    }
    Ok(effects)
}

fn fly(share: f32, rate: f64, noise: f64, seed: u64) -> Result<Effect, ConfigError> {
    let period = 1.0 / rate;
    let mut subject = Subject::new(Kind::Guarded, &config(period), &GuardConfig::default())?;
    let mut flight = Flight::new(period, noise, seed);
    let faults = FaultConfig { jitter: share, ..FaultConfig::default() };
    let mut injector: Injector<1> =
        Injector::new(&faults, seed).map_err(|error| ConfigError::OutOfRange(error.parameter()))?;
    let (mut squares, mut count, mut worst, mut rejected) = (0.0, 0.0, 0.0_f64, 0);
    let ticks = (SECONDS * rate) as u64;
    for n in 0..ticks {
        let tick = flight.next();
        rejected += u32::from(!subject.measure(injector.pass(Some(tick.measured))));
        if n as f64 * period >= 5.0 {
            let error = subject.velocity().map_or(f64::INFINITY, |v| (v - tick.velocity).abs());
            squares += error * error;
            count += 1.0;
            worst = worst.max(error);
        }
        subject.apply(tick.force);
    }
    let k = subject.k().map_or(f64::INFINITY, |k| (k / flight.axis.k - 1.0).abs());
    Ok(Effect { share, rate, noise, velocity_rms: f64::sqrt(squares / count), velocity: worst, k, rejected })
}
