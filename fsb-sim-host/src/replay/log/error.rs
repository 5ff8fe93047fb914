//! What can be wrong with a log, and where.

use std::io;

/// Why a file is no axis log. Lines count from 1, the header's included.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum LogError {
    /// No such file.
    #[error("{file}: no such file; expected an axis log (CSV)")]
    NotFound { file: String },
    /// The file is there, but reading it failed.
    #[error("{file}: cannot be read: {source}")]
    NotReadable { file: String, source: io::Error },
    /// Nothing in the file.
    #[error("{file}:1: the file is empty; expected a header such as t,x,fx")]
    Empty { file: String },
    /// Numbers where names belong.
    #[error("{file}:{line}: found `{found}`, expected a header such as t,x,fx")]
    NoHeader { file: String, line: usize, found: String },
    /// No time column.
    #[error(
        "{file}:{line}: column t is missing; found `{found}`, expected names separated by commas, \
         semicolons or tabs, t [s] among them"
    )]
    NoTime { file: String, line: usize, found: String },
    /// A name that stands twice in the header.
    #[error("{file}:{line}: column {column} is there twice (columns {first} and {second}), expected once")]
    DuplicateColumn { file: String, line: usize, column: String, first: usize, second: usize },
    /// No axis with both its position and its input.
    #[error(
        "{file}:{line}: no usable axis; found {found}, expected a position and its input: x and fx, y and fy, z and fz, \
         roll and taux, pitch and tauy, or yaw and tauz"
    )]
    NoAxis { file: String, line: usize, found: String },
    /// A row that is shorter or longer than the header.
    #[error("{file}:{line}: found {found} fields, expected {expected} as in the header{}", first_missing(.column))]
    FieldCount {
        file: String,
        line: usize,
        found: usize,
        expected: usize,
        /// The first column that the row lacks.
        column: Option<String>,
    },
    /// Text where a number belongs.
    #[error("{file}:{line}: column {column}: found `{found}`, expected a number{}{}", with_point(.found), or_empty(column))]
    NotANumber { file: String, line: usize, column: &'static str, found: String },
    /// An infinity, a NaN, or a number too large even for f64.
    #[error("{file}:{line}: column {column}: found `{found}`, expected a finite number{}", or_empty(column))]
    NotFinite { file: String, line: usize, column: &'static str, found: String },
    /// A number that f32 cannot hold.
    #[error("{file}:{line}: column {column}: found `{found}`, expected a number within f32, up to 3.4e38")]
    OutOfRange { file: String, line: usize, column: &'static str, found: String },
    /// Nothing where every row must have a number.
    #[error("{file}:{line}: column {column}: found an empty cell, expected a number")]
    EmptyCell { file: String, line: usize, column: &'static str },
    /// Too few rows.
    #[error("{file}:{line}: the log ends after {found} sample{}, expected at least {expected}", if *.found == 1 { "" } else { "s" })]
    TooShort { file: String, line: usize, found: usize, expected: usize },
    /// Time that stands still or goes back.
    #[error("{file}:{line}: column t: found {found} s after {previous} s, expected an increasing time")]
    NotIncreasing { file: String, line: usize, found: f64, previous: f64 },
    /// Samples that are not equally far apart.
    #[error(
        "{file}:{line}: column t: found a step of {step} s, expected {median} s as most steps: the time step must be \
         uniform to 1 % (is a row missing? resample the log; positions with attitudes, in --motion and --input, may have any times)"
    )]
    NonUniform { file: String, line: usize, step: f64, median: f64 },
    /// A time step that f32 cannot hold.
    #[error("{file}:{line}: column t: found a time step of {period:e} s, expected at least 1.2e-38 s")]
    Period { file: String, line: usize, period: f64 },
}

fn first_missing(column: &Option<String>) -> String {
    column.as_ref().map(|name| format!("; the first one missing is {name}")).unwrap_or_default()
}

/// Where numbers are written with a decimal comma.
fn with_point(found: &str) -> &'static str {
    if found.contains(',') { " with a decimal point" } else { "" }
}

/// Positions and references may be missing.
fn or_empty(column: &str) -> &'static str {
    let required = column == "t" || super::Axis::ALL.iter().any(|axis| axis.input_name() == column);
    if required { "" } else { ", nan or an empty cell" }
}

/// A row of a file.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a> {
    pub file: &'a str,
    pub line: usize,
}

impl Place<'_> {
    /// A number that must be there.
    pub fn number(&self, column: &'static str, field: &[u8]) -> Result<f64, LogError> {
        let (file, line) = (self.file.into(), self.line);
        if field.is_empty() {
            return Err(LogError::EmptyCell { file, line, column });
        }
        self.optional(column, field)?.ok_or_else(|| LogError::NotFinite { file, line, column, found: text(field) })
    }

    /// A number, or `None` for an empty cell or a NaN: what was not measured is written as either.
    pub fn optional(&self, column: &'static str, field: &[u8]) -> Result<Option<f64>, LogError> {
        if field.is_empty() {
            return Ok(None);
        }
        let (file, line) = (self.file.to_string(), self.line);
        let parsed = std::str::from_utf8(field).ok().and_then(|field| field.parse::<f64>().ok());
        match parsed {
            None => Err(LogError::NotANumber { file, line, column, found: text(field) }),
            Some(value) if value.is_nan() => Ok(None),
            Some(value) if value.is_infinite() => Err(LogError::NotFinite { file, line, column, found: text(field) }),
            Some(value) if value.abs() > f64::from(f32::MAX) => {
                Err(LogError::OutOfRange { file, line, column, found: text(field) })
            }
            Some(value) => Ok(Some(value)),
        }
    }

    /// The error for a row of `found` fields under a header of these names.
    pub fn field_count(&self, found: usize, names: &[String]) -> LogError {
        let (file, line) = (self.file.into(), self.line);
        LogError::FieldCount { file, line, found, expected: names.len(), column: names.get(found).cloned() }
    }
}

/// Bytes of a file for a message or a name: long ones cut, so that a binary file does not fill the terminal.
pub fn text(field: &[u8]) -> String {
    const LONGEST: usize = 60;
    let whole = String::from_utf8_lossy(field);
    match whole.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &whole[..end]),
        None => whole.into_owned(),
    }
}
