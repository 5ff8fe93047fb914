//! What is wrong with a scenario.

use std::io;
use std::path::PathBuf;

use fsb_core::ConfigError;
use thiserror::Error;

use crate::hexarotor::ParameterError;

/// A parameter of a scenario that cannot be right.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Refused {
    /// Of the vehicle, a sensor, a path or the frame around them.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The f32 core does not take it: part of the file, and what the core said.
    #[error("{}.{}", .0, as_in_the_file(.1))]
    Core(&'static str, ConfigError),
    /// The ring that holds inputs until a late measurement comes has this much room [control periods].
    #[error("estimator: a latency of {0} control periods; up to {1} can be made up for")]
    TooLate(u32, usize),
    /// Latencies of attitude and position [control periods].
    #[error(
        "estimator: an attitude that is {0} control periods late, and a position that is {1}; it must not be later than that"
    )]
    AttitudeLater(u32, u32),
    /// A range from which flights draw, one end of it, and why that cannot be flown.
    #[error("random.{0} = {1:?}: at {2}, {3}")]
    Drawn(&'static str, [f64; 2], f64, Box<Refused>),
}

/// What the core says, with the names of a scenario in place of its own.
fn as_in_the_file(error: &ConfigError) -> String {
    [
        ("identifier.lambda", "lambda"),
        ("identifier.q", "q"),
        ("observer.lambda", "observer_lambda"),
        ("observer.q", "observer_q"),
        ("memory.tau", "fade"),
    ]
    .iter()
    .fold(error.to_string(), |text, (of_core, of_file)| text.replace(of_core, of_file))
}

/// A scenario could not be had.
#[derive(Debug, Error)]
pub enum LoadError {
    /// Neither a built-in nor a file.
    #[error("{name}: neither a built-in scenario (`fsb fly --list`) nor a file that can be read: {cause}")]
    NotThere {
        /// As given.
        name: String,
        /// What the system said.
        cause: io::Error,
    },
    /// No TOML, a key that is unknown or missing, a value of the wrong type.
    #[error("{}: {message}", file.display())]
    Toml {
        /// The file.
        file: PathBuf,
        /// Line, column, key.
        message: String,
    },
    /// `--set`: no KEY=VALUE, or no such key, or a value of the wrong type.
    #[error("--set {given}: {message}")]
    Set {
        /// As given.
        given: String,
        /// What is wrong with it.
        message: String,
    },
    /// A value that cannot be right.
    #[error("{name}: {refused}")]
    Refused {
        /// File or name.
        name: String,
        /// Which.
        refused: Refused,
    },
}
