//! The header: which column is what.

use csv::ByteRecord;

use super::error::{Place, text};
use super::{Axis, AxisColumn, LogError};

/// Where the columns are, counted from 0.
pub struct Header {
    pub names: Vec<String>,
    pub time: usize,
    pub axes: Vec<AxisHeader>,
    pub unpaired: Vec<&'static str>,
}

/// Where the columns of one axis are.
pub struct AxisHeader {
    pub axis: Axis,
    pub position: usize,
    pub input: usize,
    pub reference: Option<usize>,
}

impl AxisHeader {
    /// The axis, before its first sample.
    pub fn column(&self) -> AxisColumn {
        let velocity_reference = self.reference.map(|_| Vec::new());
        AxisColumn { axis: self.axis, position: Vec::new(), input: Vec::new(), ramps: None, velocity_reference }
    }
}

impl Header {
    pub fn read(place: &Place<'_>, fields: &ByteRecord) -> Result<Self, LogError> {
        let names: Vec<String> = fields.iter().map(text).collect();
        let (file, line) = (place.file.to_string(), place.line);
        if names.iter().all(|name| name.is_empty() || name.parse::<f64>().is_ok()) {
            return Err(LogError::NoHeader { file, line, found: text(names.join(",").as_bytes()) });
        }
        let find = |name: &str| {
            let mut indices = (0..names.len()).filter(|&index| names[index] == name);
            match (indices.next(), indices.next()) {
                (Some(first), Some(second)) => Err(LogError::DuplicateColumn {
                    file: place.file.into(),
                    line,
                    column: name.into(),
                    first: first + 1,
                    second: second + 1,
                }),
                (index, _) => Ok(index),
            }
        };
        let Some(time) = find("t")? else {
            return Err(LogError::NoTime { file, line, found: text(names.join(",").as_bytes()) });
        };

        let mut axes = Vec::new();
        let mut unpaired = Vec::new();
        let mut halves = Vec::new();
        for axis in Axis::ALL {
            let reference = find(axis.reference_name())?;
            match (find(axis.name())?, find(axis.input_name())?) {
                (Some(position), Some(input)) => axes.push(AxisHeader { axis, position, input, reference }),
                (Some(_), None) => {
                    unpaired.push(axis.name());
                    halves.push(format!("{} without {}", axis.name(), axis.input_name()));
                }
                (None, Some(_)) => {
                    unpaired.push(axis.input_name());
                    halves.push(format!("{} without {}", axis.input_name(), axis.name()));
                }
                (None, None) => {}
            }
        }
        if axes.is_empty() {
            let found = if halves.is_empty() { "none of these".into() } else { halves.join(", ") };
            return Err(LogError::NoAxis { file, line, found });
        }
        Ok(Self { names, time, axes, unpaired })
    }
}
