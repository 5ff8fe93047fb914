//! A configuration validated and turned into constants.

use super::config::EstimatorConfig;
use crate::error::{ConfigError, finite, positive};
use crate::identifier::{BlockDesign, IdentifierDesign};
use crate::observer::ObserverDesign;
use crate::readout::{CheckedRule, CovarianceDesign, NoiseLevel, Readout};
use crate::tuning::checked_period;

/// The immutable part of an [`super::Estimator`]; one may serve several.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EstimatorDesign<const N: usize, const P: usize> {
    /// Control period and half its square.
    pub(super) control_period: f32,
    pub(super) control_half_period2: f32,
    pub(super) substeps: u32,
    pub(super) block_length: u32,
    pub(super) turn: u32,
    pub(super) observer: ObserverDesign,
    pub(super) identifier: IdentifierDesign,
    pub(super) block: BlockDesign,
    pub(super) covariance: CovarianceDesign,
    pub(super) readout: Readout,
    pub(super) forgetting: f32,
    /// 1 - μ² over a coarse step
    pub(super) noise_forgetting: f32,
    pub(super) noise: NoiseLevel,
    pub(super) drift: [f32; N],
    pub(super) any_drift: bool,
    pub(super) nominal: [Option<f32>; P],
    pub(super) rule: [CheckedRule; P],
    /// ε in measurements
    pub(super) parameter_settle: u32,
    pub(super) state_settle: u32,
    /// Measurements after which an observer that started late has forgotten its start
    pub(super) late_settle: u32,
    pub(super) position_limit: f32,
    pub(super) input_limit: f32,
}

impl<const N: usize, const P: usize> EstimatorDesign<N, P> {
    const SHAPE: () = assert!(N >= 1 && (P == 1 || P == N), "P must be 1 (pooled) or N (one parameter per axis)");

    /// Validates `config`.
    ///
    /// # Errors
    /// Names the first parameter that cannot be right. Rates are judged by the period they run at: λ and q of the observer
    /// by the measurement period T, those of the identifier by M T; both products must be within 1e-6..=1.
    pub fn new(config: &EstimatorConfig<N, P>) -> Result<Self, ConfigError> {
        const { Self::SHAPE };
        let control = checked_period("period", config.period)?;
        for (name, count) in [("substeps", config.substeps), ("block", config.block)] {
            if count == 0 {
                return Err(ConfigError::Zero(name));
            }
            if count > 65_536 {
                return Err(ConfigError::OutOfRange(name));
            }
        }
        if config.turn >= config.block {
            return Err(ConfigError::OutOfRange("turn"));
        }
        let period = checked_period("substeps", control * f64::from(config.substeps))?;
        let step = checked_period("block", period * f64::from(config.block))?;
        let decay = config.identifier.decay(step, "identifier.lambda", "identifier.q")?;
        let forgetting = config.memory.forgetting(step)?;
        let covariance = CovarianceDesign::new(config.identifier.lambda, config.identifier.q, step, forgetting);
        let mut drift = [0.0; N];
        for (out, &c) in drift.iter_mut().zip(&config.drift) {
            if finite("drift", c)?.abs() > 1e6 {
                return Err(ConfigError::OutOfRange("drift"));
            }
            *out = c as f32;
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
        let noise = match config.noise_sd {
            None => NoiseLevel::default(),
            Some(sd) if positive("noise_sd", sd)? > 1e6 || sd < 1e-12 => {
                return Err(ConfigError::OutOfRange("noise_sd"));
            }
            Some(sd) => NoiseLevel::expected((sd * sd / f64::from(config.block)) as f32),
        };
        let mut rule = [CheckedRule::NEVER; P];
        for (out, r) in rule.iter_mut().zip(&config.rule) {
            *out = r.checked()?;
        }
        Ok(Self {
            control_period: control as f32,
            control_half_period2: (control * control / 2.0) as f32,
            substeps: config.substeps,
            block_length: config.block,
            turn: config.turn,
            observer: ObserverDesign::named(config.observer, period, "observer.lambda", "observer.q")?,
            identifier: IdentifierDesign::from_decay(&decay),
            block: BlockDesign::new(period, config.block),
            readout: config.readout,
            forgetting: forgetting as f32,
            noise_forgetting: covariance.noise_forgetting(),
            covariance,
            noise,
            drift,
            any_drift: drift.iter().any(|&c| c != 0.0),
            nominal,
            rule,
            parameter_settle: samples("parameter_settle", config.parameter_settle, period)?,
            state_settle: samples("state_settle", config.state_settle, period)?,
            late_settle: samples("observer.lambda", 8.0 / config.observer.lambda, period)?,
            position_limit: limit("position_limit", config.position_limit)?,
            input_limit: limit("input_limit", config.input_limit)?,
        })
    }

    /// The parameter that `axis` shares in.
    pub(super) const fn parameter_of(axis: usize) -> usize {
        if P == 1 { 0 } else { axis }
    }

    /// Blocks after a coarse step of the shared covariance at which the axis takes its own. Where all axes complete their
    /// blocks at once (M = 1) they take turns.
    pub(super) const fn coarse_slot(&self, axis: usize) -> u32 {
        if self.block_length == 1 && self.covariance.steps as usize > N { axis as u32 + 1 } else { 0 }
    }

    /// Measurements by which the axis begins its blocks later than the first one does.
    pub(super) const fn offset(&self, axis: usize) -> u32 {
        axis as u32 % self.block_length
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
