//! The axis log: a CSV file of positions and inputs, read and checked.
//!
//! A header, then one row per sample, separated by commas, semicolons or tabs:
//!
//! | column | content |
//! |---|---|
//! | `t` | time \[s\], uniform |
//! | `x` `y` `z` `roll` `pitch` `yaw` | measured position \[m\] or angle \[rad\]; empty or `nan`: a missed measurement |
//! | `fx` `fy` `fz` `taux` `tauy` `tauz` | its mean input over \[tₙ, tₙ₊₁): force \[N\] (world frame, z up) or torque \[N m\] |
//! | `vx_ref` … `vyaw_ref` | optional velocity to compare with \[m/s, rad/s\]; empty or `nan`: none at this sample |
//!
//! An axis is read when both its position and its input are there. Columns of other names are not looked at. A byte order
//! mark, CRLF line ends and spaces around names and numbers are accepted. Every number must be finite and within f32: a
//! measurement that is not a number is one that was missed, an input that is none is a fault of who recorded it.
//!
//! # Uniform time
//! The period is the mean step, (t_last − t_first)/(N − 1): the rounding of written times does not accumulate in it, as it
//! would in any single step. Each step may then differ from the period, and each time from its place on the grid
//! t_first + n·period, by 1 % of the period plus the rounding that the written digits explain (half a unit in the last place
//! of the longest number in the column, so that 2.5 ms steps written in whole milliseconds pass), and by never more than
//! 45 % (a lost row makes its step 100 % longer).

mod axis;
mod clock;
mod error;
mod header;
#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;

use csv::ByteRecord;

pub use axis::Axis;
pub use error::LogError;

use clock::Clock;
use error::Place;
use header::{AxisHeader, Header};

use super::layout;
use super::lines::Lines;
use crate::twin::Moments;

/// The fewest samples a log may have.
pub const FEWEST_SAMPLES: usize = 4;

/// One axis of a log: every column has a value per sample.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct AxisColumn {
    /// Which axis.
    pub axis: Axis,
    /// Measured position \[m\] or angle \[rad\]; `None` is a missed measurement.
    pub position: Vec<Option<f64>>,
    /// Mean force \[N\] or torque \[N m\] from this sample to the next.
    pub input: Vec<f64>,
    /// The input as the line, from its value at this sample to that at the next, which has the moments J1 and J2 of what was
    /// recorded; `None`: `input` is held.
    pub ramps: Option<Vec<(f64, f64)>>,
    /// Velocity to compare with \[m/s\] or \[rad/s\], if the log has the column; `None` inside: none at this sample.
    pub velocity_reference: Option<Vec<Option<f64>>>,
}

impl AxisColumn {
    /// Nothing yet, to be filled with positions and moments.
    pub(super) fn with_ramps(axis: Axis, velocity_reference: Option<Vec<Option<f64>>>) -> Self {
        Self { axis, position: Vec::new(), input: Vec::new(), ramps: Some(Vec::new()), velocity_reference }
    }

    /// Appends the input of an interval of `period` \[s\]. With j1 = J1/T = (f0 + f1)/2 and j2 = J2/T² = (2 f0 + f1)/6 the line
    /// is f0 = 6 j2 - 2 j1, f1 = 4 j1 - 6 j2.
    pub(super) fn push_moments(&mut self, moments: Moments, period: f64) {
        let (j1, j2) = (moments.j1 / period, moments.j2 / (period * period));
        self.input.push(j1);
        self.ramps.get_or_insert_default().push((6.0 * j2 - 2.0 * j1, 4.0 * j1 - 6.0 * j2));
    }

    /// These rows of it.
    pub(super) fn within(&self, rows: Range<usize>) -> Self {
        Self {
            axis: self.axis,
            position: self.position[rows.clone()].to_vec(),
            input: self.input[rows.clone()].to_vec(),
            ramps: self.ramps.as_ref().map(|ramps| ramps[rows.clone()].to_vec()),
            velocity_reference: self.velocity_reference.as_ref().map(|reference| reference[rows].to_vec()),
        }
    }

    /// J1 and J2 of the interval that begins at `sample`.
    pub(super) fn moments(&self, sample: usize, period: f64) -> Moments {
        match &self.ramps {
            Some(ramps) => Moments::linear(ramps[sample].0, ramps[sample].1, period),
            None => Moments::held(self.input[sample], period),
        }
    }
}

/// A log that passed every check.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct AxisLog {
    /// Time of the first sample \[s\].
    pub start: f64,
    /// Time from one sample to the next \[s\], > 0.
    pub period: f64,
    /// The axes, at least one, in the order of [`Axis::ALL`].
    pub axes: Vec<AxisColumn>,
    /// Position and input columns without their other half, which are not read.
    pub unpaired: Vec<&'static str>,
    samples: usize,
}

impl AxisLog {
    /// Reads a file.
    ///
    /// # Errors
    /// [`LogError`], which names the file as `path` does, and the line and the column where there are any.
    pub fn read(path: &Path) -> Result<Self, LogError> {
        let name = path.display().to_string();
        match File::open(path) {
            Ok(file) => Self::from_reader(&name, file),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Err(LogError::NotFound { file: name }),
            Err(source) => Err(LogError::NotReadable { file: name, source }),
        }
    }

    /// Reads anything; `name` stands for the file in error messages.
    ///
    /// # Errors
    /// As [`AxisLog::read`].
    pub fn from_reader(name: &str, mut reader: impl Read) -> Result<Self, LogError> {
        let mut bytes = Vec::new();
        if let Err(source) = reader.read_to_end(&mut bytes) {
            return Err(LogError::NotReadable { file: name.into(), source });
        }
        parse(name, &bytes)
    }

    /// Columns of one length.
    pub(super) const fn of(start: f64, period: f64, axes: Vec<AxisColumn>, samples: usize) -> Self {
        Self { start, period, axes, unpaired: Vec::new(), samples }
    }

    /// Number of samples, at least [`FEWEST_SAMPLES`].
    #[must_use]
    #[allow(clippy::len_without_is_empty, reason = "a log is never empty")]
    pub fn len(&self) -> usize {
        self.samples
    }

    /// Time of a sample \[s\] on the uniform grid.
    #[must_use]
    pub fn time(&self, sample: usize) -> f64 {
        self.start + sample as f64 * self.period
    }
}

fn parse(file: &str, bytes: &[u8]) -> Result<AxisLog, LogError> {
    let mut rows = Rows::new(file, bytes)?;
    let Some((place, fields)) = rows.next()? else { return Err(LogError::Empty { file: file.into() }) };
    let header = Header::read(&place, &fields)?;
    let mut clock = Clock::new(file);
    let mut axes: Vec<AxisColumn> = header.axes.iter().map(AxisHeader::column).collect();

    while let Some((place, fields)) = rows.next()? {
        if fields.len() != header.names.len() {
            return Err(place.field_count(fields.len(), &header.names));
        }
        let time = &fields[header.time];
        clock.push(&place, time, place.number("t", time)?)?;
        for (columns, axis) in header.axes.iter().zip(&mut axes) {
            axis.position.push(place.optional(columns.axis.name(), &fields[columns.position])?);
            axis.input.push(place.number(columns.axis.input_name(), &fields[columns.input])?);
            if let (Some(index), Some(reference)) = (columns.reference, &mut axis.velocity_reference) {
                reference.push(place.optional(columns.axis.reference_name(), &fields[index])?);
            }
        }
    }
    let last = rows.last_line();
    let samples = clock.len();
    let (start, period) = clock.finish(last)?;
    Ok(AxisLog { start, period, axes, unpaired: header.unpaired, samples })
}

/// The rows of a CSV text, each with the line it starts on.
struct Rows<'a> {
    file: &'a str,
    reader: csv::Reader<&'a [u8]>,
    lines: Lines<'a>,
    /// The one that the last row begins on.
    line: usize,
}

impl<'a> Rows<'a> {
    fn new(file: &'a str, bytes: &'a [u8]) -> Result<Self, LogError> {
        match layout::rows(bytes) {
            Ok((reader, lines)) => Ok(Self { file, reader, lines, line: 1 }),
            Err(source) => Err(LogError::NotReadable { file: file.into(), source }),
        }
    }

    fn next(&mut self) -> Result<Option<(Place<'a>, ByteRecord)>, LogError> {
        let mut record = ByteRecord::new();
        let found = self
            .reader
            .read_byte_record(&mut record)
            .map_err(|error| LogError::NotReadable { file: self.file.into(), source: io::Error::other(error) })?;
        if !found {
            return Ok(None);
        }
        self.line = self.lines.of(&record);
        Ok(Some((Place { file: self.file, line: self.line }, record)))
    }

    /// The line of the last row.
    fn last_line(&self) -> usize {
        self.line
    }
}
