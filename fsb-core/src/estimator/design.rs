//! A configuration validated and turned into constants.

use super::axis::Own;
use super::config::EstimatorConfig;
use super::schedule::Schedule;
use crate::error::{ConfigError, finite, positive};
use crate::identifier::{BlockDesign, IdentifierDesign};
use crate::moments::Substep;
use crate::observer::ObserverDesign;
use crate::readout::{CheckedRule, CovarianceDesign, NoiseLevel, Readout, innovation_step_gain};
use crate::tuning::{Tuning, checked_period};
use crate::window::WindowDesign;

/// The immutable part of an [`super::Estimator`]; one may serve several.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EstimatorDesign<const N: usize, const P: usize> {
    pub(super) common: Common,
    /// c
    pub(super) drift: [f32; N],
    /// c T²
    pub(super) drift_t2: [f32; N],
    pub(super) nominal: [Option<f32>; P],
    pub(super) rule: [CheckedRule; P],
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
        let common = Common::new(config)?;
        let period2 = common.measurement_period * common.measurement_period;
        let mut drift = [0.0; N];
        let mut drift_t2 = [0.0; N];
        for ((out, out_t2), &c) in drift.iter_mut().zip(drift_t2.iter_mut()).zip(&config.drift) {
            if finite("drift", c)?.abs() > 1e6 {
                return Err(ConfigError::OutOfRange("drift"));
            }
            *out = c as f32;
            *out_t2 = (c * period2) as f32;
        }
        let mut nominal = [None; P];
        for (out, k) in nominal.iter_mut().zip(config.nominal) {
            if let Some(k) = k {
                if !(1e-15..=1e15).contains(&positive("nominal", k)?) {
                    return Err(ConfigError::OutOfRange("nominal"));
                }
                *out = Some(k as f32);
            }
        }
        let mut rule = [CheckedRule::NEVER; P];
        for (out, r) in rule.iter_mut().zip(&config.rule) {
            *out = r.checked()?;
        }
        Ok(Self { common, drift, drift_t2, nominal, rule })
    }

    /// What is particular to an axis.
    #[inline(always)]
    pub(super) fn own(&self, axis: usize) -> Option<Own<'_>> {
        let parameter = Self::parameter_of(axis);
        Some(Own {
            drift: *self.drift.get(axis)?,
            drift_t2: *self.drift_t2.get(axis)?,
            nominal: *self.nominal.get(parameter)?,
            rule: self.rule.get(parameter)?,
            coarse_slot: self.common.schedule.coarse_slot(axis),
        })
    }

    /// The parameter that `axis` shares in.
    #[inline(always)]
    pub(super) const fn parameter_of(axis: usize) -> usize {
        if P == 1 { 0 } else { axis }
    }
}

impl Common {
    fn new<const N: usize, const P: usize>(config: &EstimatorConfig<N, P>) -> Result<Self, ConfigError> {
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
        let forgetting = config.memory.forgetting(step)?;
        let sharing = if P == 1 { N as u32 } else { 1 };
        let covariance =
            CovarianceDesign::new(config.identifier.lambda, config.identifier.q, step, forgetting, sharing);
        let noise = match config.noise_sd {
            None => NoiseLevel::default(),
            Some(sd) if positive("noise_sd", sd)? > 1e6 || sd < 1e-12 => {
                return Err(ConfigError::OutOfRange("noise_sd"));
            }
            Some(sd) => NoiseLevel::expected((sd * sd / f64::from(config.block)) as f32),
        };
        let schedule = Schedule::new(N as u32, config.block, config.turn, period, covariance.steps);
        let observer_decay = config.observer.decay(period, "observer.lambda", "observer.q")?;
        let innovation = innovation_step_gain(observer_decay.p) * f64::from(config.block);
        Ok(Self {
            substeps: config.substeps,
            substep: Substep::new(config.substeps)?,
            substep_share: (1.0 / f64::from(config.substeps)) as f32,
            block_length: config.block,
            schedule,
            observer: ObserverDesign::from_decay(&observer_decay),
            observer_stride: WindowDesign::new(&observer_decay.over(schedule.gains_every)),
            identifier: IdentifierDesign::from_decay(&decay),
            block: BlockDesign::new(config.block),
            innovation_to_mean: (1.0 / innovation) as f32,
            readout: config.readout,
            forgetting: (1.0 - libm::pow(1.0 - forgetting, 1.0 / f64::from(sharing))) as f32,
            covariance,
            noise,
            any_drift: config.drift.iter().any(|&c| c != 0.0),
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
fn samples(name: &'static str, seconds: f64, period: f64) -> Result<u32, ConfigError> {
    if finite(name, seconds)? < 0.0 {
        return Err(ConfigError::Negative(name));
    }
    let count = libm::ceil(seconds / period - 1e-6);
    if count > 1e9 { Err(ConfigError::OutOfRange(name)) } else { Ok(libm::fmax(count, 0.0) as u32) }
}

fn limit(name: &'static str, value: f64) -> Result<f32, ConfigError> {
    if positive(name, value)? > 1e6 { Err(ConfigError::OutOfRange(name)) } else { Ok(value as f32) }
}
