//! Days of simulated flight through the f32 identifier and observer, beside the f64 twin on the very same samples.
//!
//! | file | what |
//! |---|---|
//! | `faulty` | the same with faults in every signal, through the gate |
//! | `plan` | what is flown: sines, hover, and minutes on the ground with a silent sensor |
//! | `twin_pair` | the twin's identifier and observer of both axes |
//! | `words` | every number the estimator holds, read from its `Debug` form |
//!
//! Two axes share k: a horizontal one and a vertical one with gravity. The plant moves exactly; both estimators get the
//! positions and forces rounded to f32. Identifier λ = 2, q = 1 without block means, the hardest case for f32 (a filter step
//! of 0.002 at 1 kHz); observer λ = 10, q = 5.

// Units stand in brackets; they are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod faulty;
mod plan;
mod twin_pair;
mod words;

use fsb_core::estimator::EstimatorConfig;
use fsb_core::readout::ParameterRule;
use fsb_core::{ConfigError, Estimator};

use crate::plant::HeldInputAxis;
use crate::section_v::noise::Noise;
use plan::{DRIFT, K};
use twin_pair::TwinPair;

/// How long, how fast, and with which noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoakConfig {
    /// Simulated flight [h].
    pub hours: f64,
    /// Ticks a second [Hz].
    pub rate: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl SoakConfig {
    /// Ticks of the flight.
    pub fn ticks(&self) -> u64 {
        (self.hours * 3600.0 * self.rate).round() as u64
    }
}

/// Standard deviation of the position noise [m].
pub const SIGMA: f64 = 0.01;
/// The largest difference of k, core to twin, over k.
pub const K_LIMIT: f64 = 1e-4;
/// The largest difference of a position, core to twin [m]: a few roundings of a position of some metres in f32.
pub const POSITION_LIMIT: f64 = 5e-6;
/// The largest difference of a velocity, core to twin [m/s].
pub const VELOCITY_LIMIT: f64 = 2e-5;
/// No signal of identifier and observer exceeds this, in SI units.
pub const BOUND: f64 = 100.0;
/// Signals count from here on [s]: the first velocity is the difference of two noisy positions, and grows with the rate.
const SIGNALS_FROM: f64 = 1.0;

/// Differences count from here on [s].
const COMPARE_FROM: f64 = 10.0;

/// What was seen. Differences are core to twin, from 10 s on: the core reads k every few blocks, and until then k moves
/// noticeably in between.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SoakReport {
    /// Ticks flown.
    pub ticks: u64,
    /// k̂ of the core at the end; NaN where there is none.
    pub k_core: f64,
    /// k̂ of the twin at the end.
    pub k_twin: f64,
    /// The largest |k̂ - k̂ of the twin|/k.
    pub k_difference: f64,
    /// The same at the end.
    pub k_difference_end: f64,
    /// The largest difference of a position [m].
    pub position_difference: f64,
    /// The largest difference of a velocity [m/s].
    pub velocity_difference: f64,
    /// The largest of |ẑ2|, |ẑ0|, |ẑu|, |position|, |velocity|, |innovation|, from 1 s on.
    pub largest_signal: f64,
    /// Numbers looked at, over all looks at the whole state.
    pub words: u64,
    /// Subnormal ones among them.
    pub subnormal: u64,
    /// Ones that are not finite among them.
    pub not_finite: u64,
    /// Ticks, from 1 s on, at which no k̂ was valid.
    pub without_k: u64,
}

impl SoakReport {
    /// What was required and is not met, in words; empty where all is well.
    pub fn violations(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut check = |good: bool, what: String| {
            if !good {
                found.push(what);
            }
        };
        let within =
            |name: &str, value: f64, limit: f64| (value <= limit, format!("{name} {value:.2e} above {limit:e}"));
        for (good, what) in [
            within("difference of k", self.k_difference, K_LIMIT),
            within("difference of a position [m]", self.position_difference, POSITION_LIMIT),
            within("difference of a velocity [m/s]", self.velocity_difference, VELOCITY_LIMIT),
            within("largest signal", self.largest_signal, BOUND),
        ] {
            check(good, what);
        }
        check(self.subnormal == 0, format!("{} subnormal numbers", self.subnormal));
        check(self.not_finite == 0, format!("{} numbers that are not finite", self.not_finite));
        check(self.without_k == 0, format!("{} ticks without a valid k", self.without_k));
        found
    }
}

fn core_config(rate: f64) -> EstimatorConfig<2, 1> {
    EstimatorConfig {
        drift: DRIFT.map(f64::from),
        nominal: [Some(0.8 * K)],
        rule: [ParameterRule { min: 0.1, max: 10.0, max_relative_sd: 0.5 }],
        ..EstimatorConfig::new(1.0 / rate)
    }
}

/// Flies. `minute` is called after each simulated minute.
///
/// # Errors
/// What the core refuses, of the rate.
pub fn soak(config: &SoakConfig, minute: impl Fn()) -> Result<SoakReport, ConfigError> {
    let period = 1.0 / config.rate;
    let core_config = core_config(config.rate);
    let mut core = Estimator::new(&core_config)?;
    let mut twin = TwinPair::new(&core_config);
    let mut plant: [HeldInputAxis; 2] = std::array::from_fn(|i| HeldInputAxis {
        position: plan::CENTRE[i],
        velocity: 0.0,
        k: K,
        drift: f64::from(DRIFT[i]),
    });
    let mut noise = Noise::new(SIGMA, config.seed);
    let mut report = SoakReport { k_core: f64::NAN, k_twin: f64::NAN, ..SoakReport::default() };
    let mut forces = [0.0_f32; 2];
    // The whole state is read four times a simulated second, diagnostics and states at every tick.
    let look = (config.rate / 4.0).ceil().max(1.0) as u64;
    let per_minute = (60.0 * config.rate).ceil() as u64;
    for tick in 0..config.ticks() {
        let t = tick as f64 * period;
        let scatter = if plan::is_silent(t) { [0.0; 2] } else { noise.next_pair() };
        let measured: [f32; 2] = std::array::from_fn(|i| (plant[i].position + scatter[i]) as f32);
        // Cannot be out of step: one input follows each measurement.
        let _ = core.measure(&measured.map(Some));
        twin.update(&measured, &forces);
        compare(&core, &twin, t, &mut report);
        if tick % look == 0 {
            let count = words::count(&core);
            report.words += count.all;
            report.subnormal += count.subnormal;
            report.not_finite += count.not_finite;
        }
        if let Some(k) = core.parameters()[0] {
            twin.set_k(f64::from(k.value));
        }
        forces = plan::forces(t, &plant);
        core.apply(&forces);
        for (axis, force) in plant.iter_mut().zip(forces) {
            axis.step(f64::from(force), period);
        }
        report.ticks += 1;
        if report.ticks.is_multiple_of(per_minute) {
            minute();
        }
    }
    Ok(report)
}

/// Looks at both estimators at time `t`.
fn compare(core: &Estimator<2, 1>, twin: &TwinPair, t: f64, report: &mut SoakReport) {
    if t >= 1.0 {
        match core.parameters()[0].map(|k| f64::from(k.value)).zip(twin.k()) {
            Some((k, of_twin)) => {
                (report.k_core, report.k_twin) = (k, of_twin);
                report.k_difference_end = (k - of_twin).abs() / K;
                if t >= COMPARE_FROM {
                    report.k_difference = report.k_difference.max(report.k_difference_end);
                }
            }
            None => report.without_k += 1,
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
    for (state, of_twin) in core.states().iter().zip(twin.states()) {
        let Some(state) = state else { continue };
        let (position, velocity) = (f64::from(state.position), f64::from(state.velocity));
        *largest = largest.max(position.abs()).max(velocity.abs());
        if let Some((y, v)) = of_twin.filter(|_| t >= COMPARE_FROM) {
            report.position_difference = report.position_difference.max((position - y).abs());
            report.velocity_difference = report.velocity_difference.max((velocity - v).abs());
        }
    }
}
