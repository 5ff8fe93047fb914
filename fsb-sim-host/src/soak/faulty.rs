//! The same flight with faults in every signal, through the gate; the f64 twin is given the samples as they were before the
//! faults.

use std::ops::RangeInclusive;

use fsb_core::ConfigError;
use fsb_core::guard::{GuardConfig, Guarded, Rejections};
use fsb_faults::{FaultConfig, Injector};

use super::plan::{self, DRIFT, K};
use super::twin_pair::TwinPair;
use super::{BOUND, SIGMA, SIGNALS_FROM, SoakConfig, core_config, words};
use crate::plant::HeldInputAxis;
use crate::section_v::noise::Noise;

/// Faults of a position, at every sample, at 1000 Hz.
pub const POSITION_FAULTS: FaultConfig = FaultConfig {
    drop: 0.01,
    nan: 0.001,
    spike: 0.005,
    spike_size: 5.0,
    bit_flip: 0.002,
    freeze: 1e-5,
    freeze_length: 300,
    jitter: 0.2,
    delay: 0,
    quantum: 1e-3,
};
/// Faults of a force as the estimator is told it; what does not come is told as NaN.
pub const FORCE_FAULTS: FaultConfig = FaultConfig {
    drop: 0.002,
    nan: 0.001,
    spike: 0.0,
    spike_size: 0.0,
    bit_flip: 0.0,
    freeze: 0.0,
    freeze_length: 0,
    jitter: 0.0,
    delay: 0,
    quantum: 1e-3,
};
/// So many samples of the same bits are a frozen sensor.
const FROZEN_AFTER: u32 = 8;

/// The largest difference of k, from a minute on, to the twin without faults, over k.
pub const K_LIMIT: f64 = 5e-5;
/// The rates [Hz] at which the limits are met: below, the frozen samples that go unnoticed take too long; above, a gap of two
/// seconds has more samples than can be bridged.
pub const RATES: RangeInclusive<f64> = 1e3..=3e4;
/// The largest error of a position [m] against the truth, noise of 1 cm, frozen sensors and spikes within the gate included.
pub const POSITION_LIMIT: f64 = 0.05;
/// The largest error of a velocity [m/s] against the truth.
pub const VELOCITY_LIMIT: f64 = 0.2;

/// k counts from here on [s].
const K_FROM: f64 = 60.0;
/// States count from here on [s].
const STATES_FROM: f64 = 10.0;

/// What was seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaultReport {
    /// Ticks flown.
    pub ticks: u64,
    /// k̂ of the core at the end; NaN where there is none.
    pub k_core: f64,
    /// k̂ of the twin at the end.
    pub k_twin: f64,
    /// The largest |k̂ - k̂ of the twin|/k.
    pub k_difference: f64,
    /// The largest error of a position [m].
    pub position_error: f64,
    /// The largest error of a velocity [m/s].
    pub velocity_error: f64,
    /// The largest of |ẑ2|, |ẑ0|, |ẑu|, |position|, |velocity|, |innovation|, from 1 s on.
    pub largest_signal: f64,
    /// Numbers looked at, over all looks at the whole state.
    pub words: u64,
    /// Subnormal ones among them.
    pub subnormal: u64,
    /// Ones that are not finite among them.
    pub not_finite: u64,
    /// Ticks, from a minute on, at which k or a state was not valid.
    pub invalid: u64,
    /// What the gate turned away.
    pub rejections: Rejections,
    /// Inputs that were replaced.
    pub rejected_inputs: u32,
}

impl FaultReport {
    /// What was required and is not met, in words; empty where all is well.
    pub fn violations(&self) -> Vec<String> {
        let within = [
            ("difference of k", self.k_difference, K_LIMIT),
            ("error of a position [m]", self.position_error, POSITION_LIMIT),
            ("error of a velocity [m/s]", self.velocity_error, VELOCITY_LIMIT),
            ("largest signal", self.largest_signal, BOUND),
        ];
        let none = [
            ("subnormal numbers", self.subnormal),
            ("numbers that are not finite", self.not_finite),
            ("ticks without a valid k or state", self.invalid),
            ("jumps of a sensor that did not jump", self.rejections.jumps.into()),
            ("pushes where nothing pushed", self.rejections.pushes.into()),
        ];
        let beyond = within.into_iter().filter(|(_, value, limit)| value.is_nan() || value > limit);
        beyond
            .map(|(name, value, limit)| format!("{name} {value:.2e} above {limit:e}"))
            .chain(none.into_iter().filter(|(_, count)| *count > 0).map(|(name, count)| format!("{count} {name}")))
            .collect()
    }
}

/// [`POSITION_FAULTS`] at another rate: a sensor freezes as often and for as long in seconds, whatever its rate.
fn position_faults(rate: f64) -> FaultConfig {
    let kilohertz = rate / 1e3;
    FaultConfig {
        freeze: (f64::from(POSITION_FAULTS.freeze) / kilohertz) as f32,
        freeze_length: (f64::from(POSITION_FAULTS.freeze_length) * kilohertz).round() as u16,
        ..POSITION_FAULTS
    }
}

/// Flies. `minute` is called after each simulated minute. Noise is never silent here: a sensor that gives the same bits again
/// and again is a frozen one.
///
/// # Errors
/// What the core refuses, of the rate.
pub fn soak_with_faults(config: &SoakConfig, minute: impl Fn()) -> Result<FaultReport, ConfigError> {
    let period = 1.0 / config.rate;
    let of_core = core_config(config.rate);
    let guard = GuardConfig { frozen_after: FROZEN_AFTER, ..GuardConfig::default() };
    let mut core = Guarded::new(&of_core, &guard)?;
    let mut twin = TwinPair::new(&of_core);
    let injector = |faults: &FaultConfig, of: u64| {
        Injector::<1>::new(faults, config.seed.wrapping_mul(4).wrapping_add(of))
            .map_err(|error| ConfigError::OutOfRange(error.parameter()))
    };
    let of_position = position_faults(config.rate);
    let mut positions = [injector(&of_position, 0)?, injector(&of_position, 1)?];
    let mut inputs = [injector(&FORCE_FAULTS, 2)?, injector(&FORCE_FAULTS, 3)?];
    let mut plant: [HeldInputAxis; 2] = std::array::from_fn(|i| HeldInputAxis {
        position: plan::CENTRE[i],
        velocity: 0.0,
        k: K,
        drift: f64::from(DRIFT[i]),
    });
    let mut noise = Noise::new(SIGMA, config.seed);
    let mut report = FaultReport { k_core: f64::NAN, k_twin: f64::NAN, ..FaultReport::default() };
    let mut forces = [0.0_f32; 2];
    let look = (config.rate / 4.0).ceil().max(1.0) as u64;
    let per_minute = (60.0 * config.rate).ceil() as u64;
    for tick in 0..config.ticks() {
        let t = tick as f64 * period;
        let scatter = noise.next_pair();
        let measured: [f32; 2] = std::array::from_fn(|i| (plant[i].position + scatter[i]) as f32);
        let given = std::array::from_fn(|i| positions[i].pass(Some(measured[i])));
        // Cannot be out of step: one input follows each measurement.
        let _ = core.measure(&given);
        twin.update(&measured, &forces);
        watch(&core, &twin, &plant, t, &mut report);
        // A measurement with a bit of its zero flipped is subnormal itself, and stands in the state until the next one.
        let sound = given.iter().flatten().all(|y: &f32| !y.is_subnormal());
        if tick % look == 0 && sound {
            let count = words::count(&core);
            report.words += count.all;
            report.subnormal += count.subnormal;
            report.not_finite += count.not_finite;
        }
        forces = plan::forces(t, &plant);
        let told = std::array::from_fn(|i| inputs[i].pass(Some(forces[i])).unwrap_or(f32::NAN));
        core.apply(&told);
        for (axis, force) in plant.iter_mut().zip(forces) {
            axis.step(f64::from(force), period);
        }
        report.ticks += 1;
        if report.ticks.is_multiple_of(per_minute) {
            minute();
        }
    }
    report.rejections = core.rejections();
    report.rejected_inputs = core.counters().rejected_inputs;
    Ok(report)
}

fn watch(core: &Guarded<2, 1>, twin: &TwinPair, plant: &[HeldInputAxis; 2], t: f64, report: &mut FaultReport) {
    let (k, states) = (core.parameters()[0], core.states());
    if t >= K_FROM {
        report.invalid += u64::from(k.is_none() || states.contains(&None));
        if let Some((k, of_twin)) = k.map(|k| f64::from(k.value)).zip(twin.k()) {
            (report.k_core, report.k_twin) = (k, of_twin);
            report.k_difference = report.k_difference.max((k - of_twin).abs() / K);
        }
    }
    if t < SIGNALS_FROM {
        return;
    }
    let largest = &mut report.largest_signal;
    for signals in core.diagnostics() {
        for value in [signals.z2, signals.z0, signals.zu, signals.innovation] {
            *largest = largest.max(f64::from(value.abs()));
        }
    }
    for (state, truth) in states.iter().zip(plant) {
        let Some(state) = state else { continue };
        let (position, velocity) = (f64::from(state.position), f64::from(state.velocity));
        *largest = largest.max(position.abs()).max(velocity.abs());
        if t >= STATES_FROM {
            report.position_error = report.position_error.max((position - truth.position).abs());
            report.velocity_error = report.velocity_error.max((velocity - truth.velocity).abs());
        }
    }
}
