//! A configuration validated and turned into constants.

use super::config::EstimatorConfig;
use super::schedule::Schedule;
use crate::error::{ConfigError, finite, positive};
use crate::identifier::{BlockDesign, IdentifierDesign};
use crate::moments::Substep;
use crate::observer::ObserverDesign;
use crate::readout::{CheckedRule, CovarianceDesign, Memory, NoiseLevel, ParameterRule, Readout, innovation_step_gain};
use crate::tuning::{Tuning, checked_period};
use crate::window::WindowDesign;

/// The immutable part of an [`super::Estimator`]; one may serve several.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EstimatorDesign<const N: usize, const P: usize> {
    pub(super) common: Common,
    pub(super) axes: [AxisDesign; N],
    pub(super) parameters: [ParameterDesign; P],
}

/// What differs from axis to axis.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct AxisDesign {
    /// c
    pub drift: f32,
    /// c T²
    pub drift_t2: f32,
}

/// What differs from parameter to parameter.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct ParameterDesign {
    pub nominal: Option<f32>,
    pub rule: CheckedRule,
}

/// What does not depend on the number of axes.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Common {
    /// R
    pub substeps: u32,
    pub substep: Substep,
    /// 1/R
    pub substep_share: f32,
    /// M
    pub block_length: u32,
    pub schedule: Schedule,
    pub observer: ObserverDesign,
    /// The observer's window over `schedule.gains_every` samples.
    pub observer_stride: WindowDesign,
    pub identifier: IdentifierDesign,
    pub block: BlockDesign,
    pub covariance: CovarianceDesign,
    /// What turns the squared step of the innovation into the variance of a block's mean.
    pub innovation_to_mean: f32,
    pub readout: Readout,
    /// Least squares with infinite memory.
    pub plain: bool,
    /// 1 - μ over a block, for one of the axes that share a parameter: together they forget what τ says
    pub forgetting: f32,
    pub noise: NoiseLevel,
    pub any_drift: bool,
    /// T²
    pub period2: f32,
    /// ε in measurements
    pub parameter_settle: u32,
    pub state_settle: u32,
    /// Measurements after which an observer that started late has forgotten its start
    pub late_settle: u32,
    pub position_limit: f32,
    pub input_limit: f32,
    /// As configured, for reports.
    pub observer_tuning: Tuning,
    pub measurement_period: f64,
}

impl<const N: usize, const P: usize> EstimatorDesign<N, P> {
    const SHAPE: () = assert!(
        N >= 1 && N <= 8 && (P == 1 || P == N),
        "at most 8 axes; P must be 1 (pooled) or N (one parameter per axis)"
    );

    /// Validates `config`.
    ///
    /// # Errors
    /// Names the first parameter that cannot be right. Rates are judged by the period they run at: λ and q of the observer
    /// by the measurement period T, those of the identifier by M T; both products must be within 1e-6..=1.
    pub fn new(config: &EstimatorConfig<N, P>) -> Result<Self, ConfigError> {
        const { Self::SHAPE };
        let common = Common::new(&Shapeless {
            axes: N as u32,
            sharing: if P == 1 { N as u32 } else { 1 },
            any_drift: config.drift.iter().any(|&c| c != 0.0),
            period: config.period,
            substeps: config.substeps,
            block: config.block,
            turn: config.turn,
            identifier: config.identifier,
            observer: config.observer,
            noise_sd: config.noise_sd,
            readout: config.readout,
            memory: config.memory,
            parameter_settle: config.parameter_settle,
            state_settle: config.state_settle,
            position_limit: config.position_limit,
            input_limit: config.input_limit,
        })?;
        let period2 = common.measurement_period * common.measurement_period;
        let mut axes = [AxisDesign { drift: 0.0, drift_t2: 0.0 }; N];
        for (axis, &c) in axes.iter_mut().zip(&config.drift) {
            *axis = AxisDesign::new(c, period2)?;
        }
        let mut parameters = [ParameterDesign { nominal: None, rule: CheckedRule::NEVER }; P];
        for (parameter, (&nominal, rule)) in parameters.iter_mut().zip(config.nominal.iter().zip(&config.rule)) {
            *parameter = ParameterDesign::new(nominal, rule)?;
        }
        Ok(Self { common, axes, parameters })
    }
}

impl AxisDesign {
    fn new(drift: f64, period2: f64) -> Result<Self, ConfigError> {
        if finite("drift", drift)?.abs() > 1e6 {
            return Err(ConfigError::OutOfRange("drift"));
        }
        Ok(Self { drift: drift as f32, drift_t2: (drift * period2) as f32 })
    }
}

impl ParameterDesign {
    #[inline(never)]
    fn new(nominal: Option<f64>, rule: &ParameterRule) -> Result<Self, ConfigError> {
        if let Some(k) = nominal
            && !(1e-15..=1e15).contains(&positive("nominal", k)?)
        {
            return Err(ConfigError::OutOfRange("nominal"));
        }
        Ok(Self { nominal: nominal.map(|k| k as f32), rule: rule.checked()? })
    }
}

/// The part of a configuration that does not depend on the number of axes: its code is there once.
struct Shapeless {
    axes: u32,
    /// Axes to a parameter.
    sharing: u32,
    any_drift: bool,
    period: f64,
    substeps: u32,
    block: u32,
    turn: u32,
    identifier: Tuning,
    observer: Tuning,
    noise_sd: Option<f64>,
    readout: Readout,
    memory: Memory,
    parameter_settle: f64,
    state_settle: f64,
    position_limit: f64,
    input_limit: f64,
}

impl Common {
    #[inline(never)]
    fn new(config: &Shapeless) -> Result<Self, ConfigError> {
        let control = checked_period("period", config.period)?;
        for (name, count) in [("substeps", config.substeps), ("block", config.block)] {
            if count == 0 {
                return Err(ConfigError::Zero(name));
            }
            if count > 65_535 {
                return Err(ConfigError::OutOfRange(name));
            }
        }
        if config.turn >= config.block.max(8) {
            return Err(ConfigError::OutOfRange("turn"));
        }
        let period = checked_period("substeps", control * f64::from(config.substeps))?;
        let step = checked_period("block", period * f64::from(config.block))?;
        let decay = config.identifier.decay(step, "identifier.lambda", "identifier.q")?;
        let fading = config.memory.fading(step)?;
        let covariance = CovarianceDesign::new(config.identifier, step, fading, config.sharing);
        let noise = match config.noise_sd {
            None => NoiseLevel::default(),
            Some(sd) if positive("noise_sd", sd)? > 1e6 || sd < 1e-12 => {
                return Err(ConfigError::OutOfRange("noise_sd"));
            }
            Some(sd) => NoiseLevel::expected((sd * sd / f64::from(config.block)) as f32),
        };
        let schedule = Schedule::new(config.axes, config.block, config.turn, period, covariance.steps);
        let observer_decay = config.observer.decay(period, "observer.lambda", "observer.q")?;
        let innovation = innovation_step_gain(observer_decay.p as f32) * config.block as f32;
        Ok(Self {
            substeps: config.substeps,
            substep: Substep::new(config.substeps)?,
            substep_share: (1.0 / f64::from(config.substeps)) as f32,
            block_length: config.block,
            schedule,
            observer: ObserverDesign::from_decay(&observer_decay),
            observer_stride: WindowDesign::new(&config.observer.plain_decay(period * f64::from(schedule.gains_every))),
            identifier: IdentifierDesign::from_decay(&decay),
            block: BlockDesign::new(config.block),
            innovation_to_mean: 1.0 / innovation,
            readout: config.readout,
            plain: config.readout == Readout::LeastSquares && fading == 0.0,
            forgetting: -libm::expm1(-fading / f64::from(config.sharing)) as f32,
            covariance,
            noise,
            any_drift: config.any_drift,
            period2: (period * period) as f32,
            parameter_settle: samples("parameter_settle", config.parameter_settle, period)?,
            state_settle: samples("state_settle", config.state_settle, period)?,
            late_settle: samples("observer.lambda", 8.0 / config.observer.lambda, period)?,
            position_limit: limit("position_limit", config.position_limit)?,
            input_limit: limit("input_limit", config.input_limit)?,
            observer_tuning: config.observer,
            measurement_period: period,
        })
    }
}

/// The number of measurements in `seconds`, rounded up.
pub(crate) fn samples(name: &'static str, seconds: f64, period: f64) -> Result<u32, ConfigError> {
    if finite(name, seconds)? < 0.0 {
        return Err(ConfigError::Negative(name));
    }
    let count = libm::ceil(seconds / period - 1e-6);
    if count > 1e9 { Err(ConfigError::OutOfRange(name)) } else { Ok(libm::fmax(count, 0.0) as u32) }
}

pub(crate) fn limit(name: &'static str, value: f64) -> Result<f32, ConfigError> {
    if positive(name, value)? > 1e6 { Err(ConfigError::OutOfRange(name)) } else { Ok(value as f32) }
}
