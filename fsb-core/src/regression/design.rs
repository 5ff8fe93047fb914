//! A configuration validated and turned into constants.

use super::config::{DragConfig, Identify};
use super::velocity::VelocityDesign;
use crate::error::{ConfigError, finite, positive};
use crate::estimator::{limit, samples};
use crate::identifier::IdentifierDesign;
use crate::moments::Substep;
use crate::observer::ObserverDesign;
use crate::readout::CheckedRule;
use crate::tuning::checked_period;
use crate::window::WindowDesign;

/// What does not depend on the axis.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Common {
    /// R
    pub substeps: u32,
    pub substep: Substep,
    /// 1/R
    pub substep_share: f32,
    pub identifier: IdentifierDesign,
    pub velocity: VelocityDesign,
    pub observer: ObserverDesign,
    /// The observer's window over `gains_every` samples.
    pub observer_stride: WindowDesign,
    /// The observer's gains are renewed every so many measurements, once they change slowly.
    pub gains_every: u32,
    /// Measurements from one row of the regression to the next.
    pub row_every: u32,
    /// Items of work between two rows, and how many of them fall to one measurement.
    pub items_per_measurement: u32,
    /// 1 - μ over a row.
    pub forgetting: f32,
    /// Rows that one independent observation takes: 0.79/(λ T_row).
    pub colour: f32,
    /// (λ T_row)²
    pub row_rate2: f32,
    pub per_scale: f32,
    pub per_scale2: f32,
    pub nominal: Option<f32>,
    pub rule: CheckedRule,
    /// Squares of the limits.
    pub excitation2: f32,
    pub drag_variance: f32,
    pub disturbance_variance: f32,
    /// T
    pub period: f32,
    /// ε in measurements
    pub parameter_settle: u32,
    pub state_settle: u32,
    /// Measurements after which an observer that started late has forgotten its start
    pub late_settle: u32,
    pub position_limit: f32,
    pub input_limit: f32,
}

/// What differs from axis to axis.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct AxisDesign {
    /// c
    pub drift: f32,
    pub identify: Identify,
}

/// λ T_row is kept at about this. The spectrum of ẑ2 falls off above λ: what is left out says nothing new (1.5 % of
/// variance at most).
const ROW: f64 = 0.1;

/// At this period and above there is time enough for new gains at every measurement.
const UNHURRIED: f64 = 5e-3;

impl Common {
    pub fn new<const N: usize>(config: &DragConfig<N>) -> Result<Self, ConfigError> {
        let control = checked_period("period", config.period)?;
        if config.substeps == 0 {
            return Err(ConfigError::Zero("substeps"));
        }
        if config.substeps > 65_535 {
            return Err(ConfigError::OutOfRange("substeps"));
        }
        let period = checked_period("substeps", control * f64::from(config.substeps))?;
        let decay = config.identifier.decay(period, "identifier.lambda", "identifier.q")?;
        let observer_decay = config.observer.decay(period, "observer.lambda", "observer.q")?;
        let identifier = IdentifierDesign::from_decay(&decay);
        let rate = libm::fmax(config.identifier.lambda, config.identifier.q);
        let row_every = libm::fmax(libm::floor(ROW / (rate * period)), 1.0);
        let row = row_every * period;
        let fading = config.memory.fading(row)?;
        let gains_every = if period < UNHURRIED { 8 } else { 1 };
        let square = |name, value| positive(name, value).map(|x| (x * x) as f32);
        if let Some(k) = config.nominal
            && !(1e-15..=1e15).contains(&positive("nominal", k)?)
        {
            return Err(ConfigError::OutOfRange("nominal"));
        }
        let row_every = (row_every as u32).max(1);
        Ok(Self {
            substeps: config.substeps,
            substep: Substep::new(config.substeps)?,
            substep_share: (1.0 / f64::from(config.substeps)) as f32,
            velocity: VelocityDesign::from_decay(&decay, f64::from(identifier.scale)),
            identifier,
            observer: ObserverDesign::from_decay(&observer_decay),
            observer_stride: WindowDesign::new(&config.observer.plain_decay(period * f64::from(gains_every))),
            gains_every,
            row_every,
            items_per_measurement: items(N as u32).div_ceil(row_every),
            forgetting: -libm::expm1(-fading) as f32,
            colour: (0.79 / (config.identifier.lambda * row)) as f32,
            row_rate2: ((config.identifier.lambda * row) * (config.identifier.lambda * row)) as f32,
            per_scale: 1.0 / identifier.scale,
            per_scale2: 1.0 / identifier.scale2(),
            nominal: config.nominal.map(|k| k as f32),
            rule: config.rule.checked()?,
            excitation2: square("excitation", config.excitation)?,
            drag_variance: square("drag_sd_limit", config.drag_sd_limit)?,
            disturbance_variance: square("disturbance_sd_limit", config.disturbance_sd_limit)?,
            period: period as f32,
            parameter_settle: samples("parameter_settle", config.parameter_settle, period)?,
            state_settle: samples("state_settle", config.state_settle, period)?,
            late_settle: samples("observer.lambda", 8.0 / config.observer.lambda, period)?,
            position_limit: limit("position_limit", config.position_limit)?,
            input_limit: limit("input_limit", config.input_limit)?,
        })
    }
}

/// What there is to do from one row to the next; see [`super::turns`].
pub(super) const fn items(axes: u32) -> u32 {
    3 * axes + 2
}

impl AxisDesign {
    pub fn new(drift: f64, identify: Identify) -> Result<Self, ConfigError> {
        if finite("drift", drift)?.abs() > 1e6 {
            return Err(ConfigError::OutOfRange("drift"));
        }
        Ok(Self { drift: drift as f32, identify })
    }
}
