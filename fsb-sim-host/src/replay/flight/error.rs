//! What can be wrong with a recorded flight, and where.

use std::io;

/// Why files are no flight. Lines count from 1, the header's included.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum FlightError {
    /// No such file.
    #[error("{file}: no such file; expected {expected}")]
    NotFound { file: String, expected: &'static str },
    /// The file is there, but reading it failed.
    #[error("{file}: cannot be read: {source}")]
    NotReadable { file: String, source: io::Error },
    /// Nothing in the file.
    #[error("{file}:1: the file is empty; expected a header and rows of numbers")]
    Empty { file: String },
    /// A column that must be there.
    #[error("{file}:{line}: no column `{header}` for {role}; found {found}{}", how_to_name(.role))]
    NoColumn { file: String, line: usize, role: &'static str, header: String, found: String },
    /// A name that stands twice in the header.
    #[error("{file}:{line}: column {header} is there twice, expected once")]
    DuplicateColumn { file: String, line: usize, header: String },
    /// A row that is shorter or longer than the header.
    #[error("{file}:{line}: found {found} fields, expected {expected} as in the header")]
    FieldCount { file: String, line: usize, found: usize, expected: usize },
    /// A cell that is not what it must be.
    #[error("{file}:{line}: column {column}: found {}, expected {expected}", cell(.found))]
    Cell { file: String, line: usize, column: String, found: String, expected: &'static str },
    /// Time that goes back.
    #[error("{file}:{line}: column {column}: found {found} s after {previous} s, expected a rising time")]
    NotIncreasing { file: String, line: usize, column: String, found: f64, previous: f64 },
    /// Too few rows.
    #[error("{file}: {what}: found {found}, expected at least {expected}")]
    TooShort { file: String, what: &'static str, found: usize, expected: usize },
    /// Positions so far apart that most of the time nothing was measured.
    #[error("{file}: only {found} positions from {start} s to {end} s; is a time stamp wrong?")]
    Sparse { file: String, found: usize, start: f64, end: f64 },
    /// A column name given on the command line or in a file of columns.
    #[error("{place}: {what}")]
    Columns { place: String, what: String },
    /// The clocks of the two files do not meet.
    #[error(
        "positions from {motion_start} s to {motion_end} s and inputs from {input_start} s to {input_end} s have no second in \
         common: both files must have one clock"
    )]
    NoOverlap { motion_start: f64, motion_end: f64, input_start: f64, input_end: f64 },
    /// An offset as long as the recording.
    #[error("{file}: with this --lag hardly a position is left at which the input is known")]
    NoInput { file: String },
    /// A ULog file that is none, or that is damaged from its beginning.
    #[error("{file}: not a ULog file, or damaged at its beginning: {cause}")]
    Ulog { file: String, cause: String },
    /// What a ULog file lacks.
    #[error("{file}: no {what} in this log; looked for {wanted}; the log has {found}")]
    NoTopic { file: String, what: &'static str, wanted: String, found: String },
    /// Nothing flew.
    #[error("{file}: no flight in this log: {why}")]
    NoFlight { file: String, why: String },
}

impl FlightError {
    /// Whether the log is a good one in which nothing flies: the exit status of its own.
    #[must_use]
    pub const fn is_no_flight(&self) -> bool {
        matches!(self, Self::NoFlight { .. })
    }
}

fn cell(found: &str) -> String {
    if found.is_empty() { "an empty cell".to_owned() } else { format!("`{found}`") }
}

fn how_to_name(role: &str) -> String {
    format!(" (name it by --column {role}=HEADER)")
}
