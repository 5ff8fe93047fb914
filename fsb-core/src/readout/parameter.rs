//! k with its variance, and the rule by which it may be used.

use super::ratio::Ratio;
use crate::accumulator::Accumulator;
use crate::error::{ConfigError, finite, positive};
use core::fmt;

/// An identified parameter: k of (15), 1/m or 1/I.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Parameter {
    /// k̂, in 1/kg or 1/(kg m²), or with the input's unit in place of N or N m.
    pub value: f32,
    /// Variance of k̂.
    pub variance: f32,
}

impl Parameter {
    /// Standard deviation of k̂. Uses a square root: not for the tick.
    pub fn sd(&self) -> f32 {
        libm::sqrtf(self.variance)
    }

    /// m = 1/k, and its standard deviation sd(k)/k².
    pub fn inverse_with_sd(&self) -> (f32, f32) {
        let inverse = 1.0 / self.value;
        (inverse, self.sd() * inverse * inverse)
    }
}

/// Whether k̂ may be used, and why not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ParameterStatus {
    /// Less than the configured time has passed since the last reset.
    #[default]
    Settling,
    /// The input has been zero: nothing can be said.
    Unexcited,
    /// The standard deviation is above the configured share of k̂.
    Uncertain,
    /// k̂ is outside the configured range.
    OutOfRange,
    /// Usable.
    Valid,
}

impl fmt::Display for ParameterStatus {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Settling => "settling",
            Self::Unexcited => "unexcited",
            Self::Uncertain => "uncertain",
            Self::OutOfRange => "out of range",
            Self::Valid => "valid",
        })
    }
}

/// When k̂ counts as valid. Plain data.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ParameterRule {
    /// The smallest k that can be right; positive. A smaller k̂ is reported, never used.
    pub min: f64,
    /// The largest k that can be right.
    pub max: f64,
    /// The largest sd(k̂)/k̂ at which k̂ becomes valid. It stays valid up to twice that (hysteresis).
    pub max_relative_sd: f64,
}

impl Default for ParameterRule {
    /// Any positive k that f32 handles well, known to 5 %.
    fn default() -> Self {
        Self { min: 1e-6, max: 1e9, max_relative_sd: 0.05 }
    }
}

impl CheckedRule {
    /// Accepts nothing.
    pub const NEVER: Self = Self { min: f32::MAX, max: 0.0, relative_variance: 0.0, limit_to_stay: 0.0 };
}

impl ParameterRule {
    pub(crate) fn checked(&self) -> Result<CheckedRule, ConfigError> {
        let min = positive("rule.min", self.min)?;
        if finite("rule.max", self.max)? <= min {
            return Err(ConfigError::InvertedRange("rule.min"));
        }
        let share = positive("rule.max_relative_sd", self.max_relative_sd)?;
        for (name, value) in [("rule.min", min), ("rule.max", self.max)] {
            if !(1e-15..=1e15).contains(&value) {
                return Err(ConfigError::OutOfRange(name));
            }
        }
        if !(1e-15..=1e6).contains(&share) {
            return Err(ConfigError::OutOfRange("rule.max_relative_sd"));
        }
        let relative_variance = (share * share) as f32;
        Ok(CheckedRule {
            min: min as f32,
            max: self.max as f32,
            relative_variance,
            limit_to_stay: HYSTERESIS * relative_variance,
        })
    }
}

/// A [`ParameterRule`] that has been validated.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct CheckedRule {
    pub min: f32,
    pub max: f32,
    pub relative_variance: f32,
    /// The same for a parameter that is valid already.
    pub limit_to_stay: f32,
}

/// One parameter: its sums, pooled over the axes that share it, and what has been read out of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ParameterState {
    pub ratio: Ratio,
    value: f32,
    variance: f32,
    pub status: ParameterStatus,
    read: bool,
    credible: bool,
    /// All its axes have taken a coarse step since the variance was read.
    pub stale: bool,
    /// Axes that take part, and how many of them have taken the present coarse step.
    members: u8,
    stepped: u8,
    /// Σ ω ẑ0 over the coarse steps.
    information: Accumulator,
    pub nominal: Option<f32>,
    rule: CheckedRule,
}

impl ParameterState {
    /// Nothing known, to be read out of so many axes: no quotient, and a variance above any limit.
    pub const fn start(members: u8, nominal: Option<f32>, rule: CheckedRule) -> Self {
        Self {
            ratio: Ratio::EMPTY,
            value: 0.0,
            variance: f32::MAX,
            status: ParameterStatus::Settling,
            read: false,
            credible: false,
            stale: false,
            members,
            stepped: 0,
            information: Accumulator::ZERO,
            nominal,
            rule,
        }
    }

    /// Forgets what is known.
    pub fn restart(&mut self, members: u8) {
        *self = Self::start(members, self.nominal, self.rule);
    }

    /// One of its axes no longer takes part.
    pub fn leave(&mut self) {
        self.members = self.members.saturating_sub(1);
    }

    /// A coarse step of one of its axes: `added` is what it adds to Σ ω ẑ0.
    pub fn step_coarsely(&mut self, added: f32, forgetting: f32) {
        self.information.add_folded(added - forgetting * self.information.value());
        self.stepped = self.stepped.saturating_add(1);
        if self.stepped >= self.members {
            self.stepped = 0;
            self.stale = true;
        }
    }

    /// The newest quotient, where it is in range and its standard deviation is below its value.
    pub fn credible(&self) -> Option<f32> {
        if self.credible { Some(self.value) } else { None }
    }

    /// The parameter, where it is valid.
    pub fn valid(&self) -> Option<Parameter> {
        match self.status {
            ParameterStatus::Valid => Some(Parameter { value: self.value, variance: self.variance }),
            _ => None,
        }
    }

    /// The value, where it is valid.
    #[inline(always)]
    pub fn valid_value(&self) -> Option<f32> {
        match self.status {
            ParameterStatus::Valid => Some(self.value),
            _ => None,
        }
    }

    /// The variance of the quotient from that of its numerator, where that is known. `scale2` is the square of the
    /// identifier's scale.
    pub fn read_variance(&mut self, numerator: Option<f32>, scale2: f32) {
        self.stale = false;
        let information = self.information.value();
        if let Some(variance) = numerator
            && information > 0.0
        {
            let variance = (variance / information) * (scale2 / information);
            // Rounding can take a sum of next to nothing below zero.
            self.variance = if variance >= 0.0 { variance } else { f32::MAX };
        }
    }

    /// The newest quotient; zero before there is any.
    #[inline(always)]
    pub const fn newest_value(&self) -> f32 {
        self.value
    }

    /// The quotient of a parameter that is valid and stays so. False where it has to be [`read`](Self::read) instead.
    #[inline(always)]
    pub fn read_on(&mut self) -> bool {
        let rule = &self.rule;
        self.ratio.fold();
        let value = self.ratio.numerator_total() / self.ratio.denominator_total();
        let limit = rule.limit_to_stay * (value * value);
        let stays =
            self.status == ParameterStatus::Valid && value >= rule.min && value <= rule.max && self.variance <= limit;
        if stays {
            self.value = value;
        }
        stays
    }

    /// The quotient from the sums as they are, and its status.
    pub fn read(&mut self, settled: bool) {
        if self.ratio.denominator() > 0.0 && self.read_on() {
            return;
        }
        if self.ratio.denominator() > 0.0 {
            self.value = self.ratio.numerator() / self.ratio.denominator();
            self.read = true;
        }
        self.judge(settled);
    }

    #[inline(never)]
    fn judge(&mut self, settled: bool) {
        let rule = &self.rule;
        let value2 = self.value * self.value;
        let in_range = self.value >= rule.min && self.value <= rule.max;
        self.credible = self.read && in_range && self.variance <= value2;
        self.status = if !settled {
            ParameterStatus::Settling
        } else if !self.read {
            ParameterStatus::Unexcited
        } else if !in_range {
            ParameterStatus::OutOfRange
        } else if self.variance > rule.relative_variance * value2 {
            ParameterStatus::Uncertain
        } else {
            ParameterStatus::Valid
        };
    }
}

/// Twice the standard deviation at which a parameter becomes valid is the one at which it no longer is.
const HYSTERESIS: f32 = 4.0;
