//! A second of each kind of fault in flight, then clean samples, behind the gate: what is left of it N ticks later. 100 Hz,
//! 1 mm of noise, λ = 10 and q = 5 of the observer.

use fsb_core::ConfigError;
use fsb_core::guard::GuardConfig;
use fsb_faults::{FaultConfig, Injector};
use rayon::prelude::*;

use super::flight::Flight;
use super::subject::{Kind, Subject, config};

/// A kind of fault, and what is promised after it.
#[derive(Clone, Copy, Debug)]
pub struct Burst {
    /// Name of the fault.
    pub name: &'static str,
    /// What happens in that second.
    pub what: &'static str,
    /// The same as data.
    pub faults: FaultConfig,
    /// `frozen_after` of the gate.
    pub frozen_after: u32,
    /// N: ticks after the last bad sample.
    pub ticks: u32,
    /// E: the velocity's error from then on [m/s].
    pub limit: f64,
}

const NONE: FaultConfig = FaultConfig {
    drop: 0.0,
    nan: 0.0,
    spike: 0.0,
    spike_size: 0.0,
    bit_flip: 0.0,
    freeze: 0.0,
    freeze_length: 0,
    jitter: 0.0,
    delay: 0,
    quantum: 0.0,
};

const fn burst(name: &'static str, what: &'static str, faults: FaultConfig, limit: f64) -> Burst {
    Burst { name, what, faults, frozen_after: 0, ticks: 100, limit }
}

/// Every kind that `fsb-faults` knows.
pub const BURSTS: [Burst; 10] = [
    burst("drop", "nothing comes", FaultConfig { drop: 1.0, ..NONE }, 0.01),
    burst("NaN", "every second sample NaN or infinite", FaultConfig { nan: 0.5, ..NONE }, 0.01),
    burst("spike", "every second sample off by up to 3 m", FaultConfig { spike: 0.5, spike_size: 3.0, ..NONE }, 0.01),
    burst("bit flip", "one bit of every second sample", FaultConfig { bit_flip: 0.5, ..NONE }, 0.01),
    Burst {
        frozen_after: 3,
        ..burst("freeze", "one value again and again", FaultConfig { freeze: 1.0, freeze_length: 100, ..NONE }, 0.01)
    },
    burst(
        "freeze, `frozen_after` 0",
        "the same, not looked for",
        FaultConfig { freeze: 1.0, freeze_length: 100, ..NONE },
        0.02,
    ),
    burst("jitter", "taken up to half a period early or late", FaultConfig { jitter: 0.5, ..NONE }, 0.01),
    burst("delay", "five samples late", FaultConfig { delay: 5, ..NONE }, 0.01),
    burst("quantise", "in steps of 5 cm", FaultConfig { quantum: 0.05, ..NONE }, 0.01),
    burst(
        "all at once",
        "a tenth each of drop, NaN, spike, bit flip; 20 % jitter, 1 cm",
        FaultConfig {
            drop: 0.1,
            nan: 0.1,
            spike: 0.1,
            spike_size: 3.0,
            bit_flip: 0.1,
            jitter: 0.2,
            quantum: 0.01,
            ..NONE
        },
        0.01,
    ),
];

/// What was seen, the worst of all seeds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Aftermath {
    /// Share of the burst's samples that were not used, on average.
    pub unused: f64,
    /// The largest error of v̂ in the burst [m/s].
    pub during: f64,
    /// The largest N ticks after the last bad sample and later [m/s].
    pub after: f64,
    /// The largest relative error of k̂ from the burst on.
    pub k: f64,
}

impl Burst {
    /// Whether the promise is kept.
    pub fn holds(&self, seen: &Aftermath) -> bool {
        seen.after <= self.limit
    }
}

const PERIOD: f64 = 0.01;
const NOISE: f64 = 1e-3;
const BEGIN: u32 = 1000;
/// Ticks of a burst.
pub const LENGTH: u32 = 100;
const TICKS: u32 = 3000;
/// Flights of each kind.
pub const SEEDS: u64 = 100;

/// Flies [`SEEDS`] flights with a burst in each, from `seed` on.
///
/// # Errors
/// None: the configurations are right.
pub fn fly(burst: &Burst, seed: u64) -> Result<Aftermath, ConfigError> {
    let flights = (0..SEEDS).into_par_iter().map(|run| fly_once(burst, seed.wrapping_add(run)));
    let seen = flights.collect::<Result<Vec<_>, _>>()?;
    Ok(seen.iter().fold(Aftermath::default(), |worst, one| Aftermath {
        unused: worst.unused + one.unused / SEEDS as f64,
        during: worst.during.max(one.during),
        after: worst.after.max(one.after),
        k: worst.k.max(one.k),
    }))
}

fn fly_once(burst: &Burst, seed: u64) -> Result<Aftermath, ConfigError> {
    let guard = GuardConfig { frozen_after: burst.frozen_after, ..GuardConfig::default() };
    let mut subject = Subject::new(Kind::Guarded, &config(PERIOD), &guard)?;
    let mut flight = Flight::new(PERIOD, NOISE, seed);
    let mut injector: Injector<8> =
        Injector::new(&burst.faults, seed).map_err(|error| ConfigError::OutOfRange(error.parameter()))?;
    let mut seen = Aftermath::default();
    for n in 0..TICKS {
        let tick = flight.next();
        let in_burst = (BEGIN..BEGIN + LENGTH).contains(&n);
        let given = if in_burst { injector.pass(Some(tick.measured)) } else { Some(tick.measured) };
        let used = subject.measure(given);
        // What is not handed out is not wrong, but it is not recovered either.
        let error = subject.velocity().map(|v| (v - tick.velocity).abs());
        if in_burst {
            seen.unused += f64::from(u8::from(!used)) / f64::from(LENGTH);
            seen.during = seen.during.max(error.unwrap_or(0.0));
        }
        if n >= BEGIN + LENGTH + burst.ticks {
            seen.after = seen.after.max(error.unwrap_or(f64::INFINITY));
        }
        if n >= BEGIN {
            seen.k = seen.k.max(subject.k().map_or(f64::INFINITY, |k| (k / flight.axis.k - 1.0).abs()));
        }
        subject.apply(tick.force);
    }
    Ok(seen)
}
