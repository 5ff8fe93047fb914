//! A configuration validated and turned into constants.

use super::config::{DragConfig, Identify};
use super::gusts::Gusts;
use super::velocity::VelocityDesign;
use crate::checks::{Checks, Range, Rule, rounded_up};
use crate::error::ConfigError;
use crate::identifier::IdentifierDesign;
use crate::moments::Substep;
use crate::observer::ObserverDesign;
use crate::readout::CheckedRule;
use crate::tuning::decayed;
use crate::wide::Wide;
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
    /// One over that.
    pub per_row_every: f32,
    /// T²/12 over the square of the time between two rows: what the trapezoidal rule leaves out is that many squared steps.
    pub trapezoid: f32,
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
    /// Squares of the limits, and of what is taken of D and d before they are told.
    pub excitation2: f32,
    pub drag_variance: f32,
    pub disturbance_variance: f32,
    pub drag_prior: f32,
    pub disturbance_prior: f32,
    pub gusts: Gusts,
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
        let mut checks = Checks::new();
        let substeps = config.substeps.max(1);
        checks.number(&Rule("period", &Range::PERIOD), config.period);
        checks.count("substeps", config.substeps);
        let period = config.period * f64::from(substeps);
        checks.number(&Rule("substeps", &Range::PERIOD), period);
        config.identifier.checked(Wide::new(period), &["identifier.lambda", "identifier.q"], &mut checks);
        config.observer.checked(Wide::new(period), &["observer.lambda", "observer.q"], &mut checks);
        checks.outcome()?;
        let decay = config.identifier.decay(Wide::new(period));
        let identifier = IdentifierDesign::from_decay(&decay);
        let rate = libm::fmax(config.identifier.lambda, config.identifier.q);
        let row_every = libm::fmax(libm::floor(ROW / (rate * period)), 1.0);
        let row = row_every * period;
        let fading = config.memory.fading(row)?;
        let gains_every = if period < UNHURRIED { 8 } else { 1 };
        if let Some(k) = config.nominal {
            checks.number(&Rule("nominal", &Range::PARAMETER), k);
        }
        let rule = config.rule.checked(&mut checks);
        let mut square = |rule: &'static Rule, value| {
            checks.number(rule, value);
            (value * value) as f32
        };
        let excitation2 = square(&Rule("excitation", &Range::POSITIVE), config.excitation);
        let drag_variance = square(&Rule("drag_sd_limit", &Range::POSITIVE), config.drag_sd_limit);
        let disturbance_variance = square(&Rule("disturbance_sd_limit", &Range::POSITIVE), config.disturbance_sd_limit);
        let drag_prior = square(&Rule("drag_prior_sd", &Range::MAGNITUDE), config.drag_prior_sd);
        let disturbance_prior = square(&Rule("disturbance_prior_sd", &Range::MAGNITUDE), config.disturbance_prior_sd);
        let mut gusts = Gusts::default();
        if let Some(sd) = config.disturbance_sd {
            checks.number(&Rule("disturbance_sd", &Range::STANDARD_DEVIATION), sd);
            gusts = Gusts::expected(sd, config.identifier.lambda, row, identifier.scale2());
        }
        let parameter_settle = checks.samples("parameter_settle", config.parameter_settle, Wide::new(period));
        let state_settle = checks.samples("state_settle", config.state_settle, Wide::new(period));
        checks.number(&Rule("position_limit", &Range::LIMIT), config.position_limit);
        checks.number(&Rule("input_limit", &Range::LIMIT), config.input_limit);
        checks.outcome()?;
        let row_every = (row_every as u32).max(1);
        Ok(Self {
            substeps,
            substep: Substep::of(substeps),
            substep_share: 1.0 / substeps as f32,
            velocity: VelocityDesign::from_decay(&decay, f64::from(identifier.scale)),
            identifier,
            observer: ObserverDesign::from_decay(&config.observer.decay(Wide::new(period))),
            observer_stride: WindowDesign::new(&config.observer.decay(Wide::new(period * f64::from(gains_every)))),
            gains_every,
            row_every,
            per_row_every: 1.0 / row_every as f32,
            trapezoid: 1.0 / (12.0 * row_every as f32 * row_every as f32),
            items_per_measurement: items(N as u32).div_ceil(row_every),
            forgetting: decayed(Wide::new(fading)).rounded(),
            colour: (0.79 / (config.identifier.lambda * row)) as f32,
            row_rate2: ((config.identifier.lambda * row) * (config.identifier.lambda * row)) as f32,
            per_scale: 1.0 / identifier.scale,
            per_scale2: 1.0 / identifier.scale2(),
            nominal: config.nominal.map(|k| k as f32),
            rule,
            excitation2,
            drag_variance,
            disturbance_variance,
            drag_prior,
            disturbance_prior,
            gusts,
            period: period as f32,
            parameter_settle,
            state_settle,
            late_settle: rounded_up(Wide::new(8.0 / config.observer.lambda / period)),
            position_limit: config.position_limit as f32,
            input_limit: config.input_limit as f32,
        })
    }
}

/// What there is to do from one row to the next; see [`super::turns`].
pub(super) const fn items(axes: u32) -> u32 {
    3 * axes + 2
}

impl AxisDesign {
    pub fn new(drift: f64, identify: Identify) -> Result<Self, ConfigError> {
        let mut checks = Checks::new();
        let drift = checks.signed(&Rule("drift", &Range::MAGNITUDE), drift);
        checks.outcome()?;
        Ok(Self { drift, identify })
    }
}
