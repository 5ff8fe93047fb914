//! What is wrong with a configuration, by parameter.

use core::fmt;

/// A configuration was refused. Every variant carries the name of the parameter, as it is written in the configuration.
///
/// Nothing is clamped: a constructor either takes the values as they are or returns this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ConfigError {
    /// NaN or infinite.
    NonFinite(&'static str),
    /// Zero or negative where a positive value is needed.
    NonPositive(&'static str),
    /// Negative where zero or more is needed.
    Negative(&'static str),
    /// Outside the range in which f32 arithmetic keeps its accuracy; the documentation of the parameter states the range.
    OutOfRange(&'static str),
    /// A rate [1/s] times the period it runs at exceeds 1: the filter would have no memory. Lower the rate or sample faster.
    TooFastForPeriod(&'static str),
    /// A rate [1/s] times the period it runs at is below 1e-6: f32 cannot tell the filter from an integrator.
    TooSlowForPeriod(&'static str),
    /// The lower limit of a pair is not below the upper one.
    InvertedRange(&'static str),
    /// A count that must be at least one is zero.
    Zero(&'static str),
}

impl ConfigError {
    /// The name of the parameter at fault.
    pub const fn parameter(self) -> &'static str {
        match self {
            Self::NonFinite(name)
            | Self::NonPositive(name)
            | Self::Negative(name)
            | Self::OutOfRange(name)
            | Self::TooFastForPeriod(name)
            | Self::TooSlowForPeriod(name)
            | Self::InvertedRange(name)
            | Self::Zero(name) => name,
        }
    }

    /// The same about a parameter that is called `name` where the caller stands.
    pub(crate) const fn renamed(self, name: &'static str) -> Self {
        match self {
            Self::NonFinite(_) => Self::NonFinite(name),
            Self::NonPositive(_) => Self::NonPositive(name),
            Self::Negative(_) => Self::Negative(name),
            Self::OutOfRange(_) => Self::OutOfRange(name),
            Self::TooFastForPeriod(_) => Self::TooFastForPeriod(name),
            Self::TooSlowForPeriod(_) => Self::TooSlowForPeriod(name),
            Self::InvertedRange(_) => Self::InvertedRange(name),
            Self::Zero(_) => Self::Zero(name),
        }
    }
}

impl fmt::Display for ConfigError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.parameter())?;
        out.write_str(match self {
            Self::NonFinite(_) => " is not finite",
            Self::NonPositive(_) => " must be positive",
            Self::Negative(_) => " must not be negative",
            Self::OutOfRange(_) => " is out of range",
            Self::TooFastForPeriod(_) => " times the period it runs at must not exceed 1",
            Self::TooSlowForPeriod(_) => " times the period it runs at must be at least 1e-6",
            Self::InvertedRange(_) => ": the lower limit must be below the upper one",
            Self::Zero(_) => " must be at least 1",
        })
    }
}

impl core::error::Error for ConfigError {}

const TEXT: &str = concat!(
    "period\0substeps\0block\0turn\0readout\0identifier.lambda\0identifier.q\0observer.lambda\0observer.q\0noise_sd\0",
    "disturbance_sd\0memory.tau\0=memory_tau\0drift\0nominal\0rule.min\0rule.max\0rule.max_relative_sd\0max_misfit\0",
    "parameter_settle\0state_settle\0position_limit\0input_limit\0",
    "kp\0kd\0parameter_min\0=k_min\0parameter_max\0=k_max\0",
);

/// The names of the parameters of an estimator and of a tracking controller, in one text with a zero behind each: where an error
/// carries one of these it is a part of this text, and so is a text of C as well. Where a parameter goes by another name in
/// C that one follows, after an equals sign.
///
/// The text itself and no reference to it: a static has one address, a text that is only referred to may be there several times.
pub static NAMES: [u8; TEXT.len()] = {
    let mut names = [0; TEXT.len()];
    names.copy_from_slice(TEXT.as_bytes());
    names
};

/// The part of [`NAMES`] that says `name`. For constants: where there is none it fails to compile.
pub(crate) const fn name(name: &str) -> &'static str {
    let (all, wanted) = (&NAMES, name.as_bytes());
    let (mut start, mut at) = (0, 0);
    loop {
        if all[at] != 0 {
            at += 1;
            continue;
        }
        let mut same = 0;
        while same < wanted.len() && all[start + same] == wanted[same] {
            same += 1;
        }
        if same == wanted.len() && start + same == at {
            let found = all.split_at(start).1.split_at(wanted.len()).0;
            return match core::str::from_utf8(found) {
                Ok(found) => found,
                Err(_) => panic!(),
            };
        }
        at += 1;
        start = at;
    }
}

pub(crate) fn finite(name: &'static str, value: f64) -> Result<f64, ConfigError> {
    if value.is_finite() { Ok(value) } else { Err(ConfigError::NonFinite(name)) }
}

pub(crate) fn positive(name: &'static str, value: f64) -> Result<f64, ConfigError> {
    if finite(name, value)? > 0.0 { Ok(value) } else { Err(ConfigError::NonPositive(name)) }
}
