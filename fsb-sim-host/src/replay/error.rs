//! Why a replay was refused.

use super::options::ReplayOptions;
use fsb_core::ConfigError;
use fsb_core::readout::Memory;
use thiserror::Error;

/// A log cannot be replayed with these options.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ReplayError {
    /// The core refuses a parameter.
    #[error("{}: {}", subject(*.cause, .options), explain(*.cause, .options, *.period))]
    Parameter {
        /// What the core says.
        cause: ConfigError,
        /// The options refused.
        options: Box<ReplayOptions>,
        /// The time step of the log \[s\].
        period: f64,
    },
    /// g is not a finite number.
    #[error("--gravity {0}: not a finite number")]
    Gravity(f64),
    /// The estimator of a group of axes starts where all of them are measured, and there is no such row.
    #[error("no row holds a position of at most 1e6 in magnitude in every one of the columns {columns}")]
    NeverMeasured {
        /// The columns, separated by commas.
        columns: String,
    },
}

impl ReplayError {
    /// Whether the log is at fault, and not an option.
    pub fn concerns_log(&self) -> bool {
        match self {
            Self::Parameter { cause, options, .. } => option(*cause, options).is_none(),
            Self::Gravity(_) => false,
            Self::NeverMeasured { .. } => true,
        }
    }
}

/// What is at fault: a command-line option with its value, or the column that the time step comes from.
fn subject(cause: ConfigError, options: &ReplayOptions) -> String {
    option(cause, options).map_or_else(|| "column t".to_owned(), |(name, value)| format!("{name} {value}"))
}

/// The option that sets the parameter at fault; `None` for those that depend on the time step alone.
fn option(cause: ConfigError, options: &ReplayOptions) -> Option<(&'static str, f64)> {
    match cause.parameter() {
        "identifier.lambda" => Some(("--lambda", options.identifier.lambda)),
        "identifier.q" => Some(("--q", options.identifier.q)),
        "observer.lambda" => Some(("--observer-lambda", options.observer.lambda)),
        "observer.q" => Some(("--observer-q", options.observer.q)),
        "memory.tau" => match options.memory {
            Memory::Fading { tau } => Some(("--fade", tau)),
            _ => None,
        },
        "drift" => Some(("--gravity", options.gravity)),
        _ => None,
    }
}

fn explain(cause: ConfigError, options: &ReplayOptions, period: f64) -> String {
    match cause {
        ConfigError::NonFinite(_) => "not a finite number".to_owned(),
        ConfigError::NonPositive(_) => "must be positive".to_owned(),
        ConfigError::TooFastForPeriod(_) => {
            let unit = if period >= 1.0 { "; is t in seconds?" } else { "" };
            format!("too large for the time step of {period} s: the product of the two must not exceed 1{unit}")
        }
        ConfigError::TooSlowForPeriod(_) => {
            format!("too small for the time step of {period} s: the product of the two must be at least 1e-6")
        }
        ConfigError::OutOfRange("memory.tau") => {
            format!("must be at least one step of what is read out, {} s", rounded_up(options.step(period)))
        }
        ConfigError::OutOfRange("drift") => "must not exceed 1e6 in magnitude".to_owned(),
        ConfigError::OutOfRange("period" | "substeps" | "block") => {
            format!("a time step of {period} s is outside the range 1e-6 s to 1000 s; is t in seconds?")
        }
        other => other.to_string(),
    }
}

/// To four digits: a number that is at least this one.
fn rounded_up(value: f64) -> f64 {
    let decimals = 3 - value.log10().floor() as i32;
    let digits = (value * 10_f64.powi(decimals) * (1.0 - 1e-9)).ceil();
    format!("{digits}e{}", -decimals).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_up() {
        for (value, expected) in [(0.01, 0.01), (0.049425, 0.04943), (12345.0, 12350.0), (0.1 + 0.2, 0.3)] {
            assert_eq!(rounded_up(value), expected);
        }
    }
}
