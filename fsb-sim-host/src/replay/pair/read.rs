//! Two files as a flight.

use super::columns::Columns;
use super::table::Table;
use crate::replay::flight::quaternion::Quaternion;
use crate::replay::flight::{Flight, FlightError, HeldInput, ThrustUnit};
use std::path::Path;

/// The fewest rows either file may have.
const FEWEST: usize = 4;

/// Reads the two files: what both cover.
///
/// A row of the motion file without a position or attitude (an empty cell, or `nan`) is a missed measurement. A row of the
/// input file with an empty cell for an input leaves the one before it held; one with a NaN is refused, as what the motors did
/// then is not known. Rows at the same time as the row before are left out.
///
/// # Errors
/// [`FlightError`], naming the file, the line and the column where there are any.
pub fn read(motion: &Path, input: &Path, columns: &Columns, unit: ThrustUnit) -> Result<Flight, FlightError> {
    let mut flight = Flight { unit, usable: [true; 3], ..Flight::default() };
    let motion = Table::read(motion)?;
    let input = Table::read(input)?;
    read_motion(&motion, columns, &mut flight)?;
    flight.input = read_input(&input, columns)?;
    let too_few = |file: &Table, what, found: usize| {
        (found < FEWEST).then(|| FlightError::TooShort { file: file.file().into(), what, found, expected: FEWEST })
    };
    too_few(&motion, "rows with a position", flight.times.len()).map_or(Ok(()), Err)?;
    too_few(&motion, "rows with an attitude", flight.attitude.times.len()).map_or(Ok(()), Err)?;
    too_few(&input, "rows with an input", flight.input.times.len()).map_or(Ok(()), Err)?;
    if flight.input.force.iter().flatten().all(|&f| f == 0.0) {
        return Err(FlightError::NoFlight { file: input.file().into(), why: "the input is zero throughout".into() });
    }
    flight.keep_common()?;
    too_few(&motion, "positions while there is an input", flight.times.len()).map_or(Ok(()), Err)?;
    Ok(flight)
}

fn read_motion(table: &Table, columns: &Columns, flight: &mut Flight) -> Result<(), FlightError> {
    let header = |role| columns.header(role).unwrap_or(role);
    let (times, rows) = table.time("motion.t", header("motion.t"))?;
    let mut position = Vec::new();
    for role in ["x", "y", "z"] {
        position.push(table.column(role, header(role))?);
    }
    let mut attitude = Vec::new();
    for role in ["qw", "qx", "qy", "qz"] {
        attitude.push(table.column(role, header(role))?);
    }
    let mut references = Vec::new();
    for role in ["vx_ref", "vy_ref", "vz_ref"] {
        references.push(table.optional(header(role))?);
    }
    let compared = references.iter().any(Option::is_some);
    flight.reference = compared.then(Vec::new);
    let all = |columns: &[Vec<Option<f64>>], row: usize| columns.iter().map(|c| c[row]).collect::<Option<Vec<f64>>>();
    for (t, row) in times.into_iter().zip(rows) {
        if let Some(numbers) = all(&attitude, row) {
            let numbers: [f64; 4] = std::array::from_fn(|i| numbers[i]);
            let turn = Quaternion::normalised(numbers).ok_or_else(|| {
                let expected = "a quaternion of length 1, to 10 %";
                table.refuse(row, header("qw"), &format!("{numbers:?}"), expected)
            })?;
            flight.attitude.times.push(t);
            flight.attitude.attitude.push(turn);
        }
        if let Some(numbers) = all(&position, row) {
            flight.times.push(t);
            flight.position.push(std::array::from_fn(|i| numbers[i]));
            if let Some(list) = &mut flight.reference {
                list.push(std::array::from_fn(|i| references[i].as_ref().and_then(|column| column[row])));
            }
        }
    }
    Ok(())
}

fn read_input(table: &Table, columns: &Columns) -> Result<HeldInput, FlightError> {
    let (times, rows) = table.time("input.t", columns.header("input.t").unwrap_or("t"))?;
    let body = ["fx_body", "fy_body", "fz_body"];
    let force: Vec<Vec<Option<f64>>> = if body.iter().any(|role| columns.header(role).is_some()) {
        let mut force = Vec::new();
        for role in body {
            force.push(table.set_points(role, columns.header(role).unwrap_or(role))?);
        }
        force
    } else {
        let thrust = table.set_points("thrust", columns.header("thrust").unwrap_or("thrust_N"))?;
        let none = vec![Some(0.0); thrust.len()];
        vec![none.clone(), none, thrust]
    };
    let mut input = HeldInput::default();
    for (t, row) in times.into_iter().zip(rows) {
        let cells: Option<Vec<f64>> = force.iter().map(|column| column[row]).collect();
        if let Some(cells) = cells {
            input.times.push(t);
            input.force.push(std::array::from_fn(|i| cells[i]));
        }
    }
    Ok(input)
}

impl Flight {
    /// Positions while there are attitudes and inputs: the rest cannot be used.
    fn keep_common(&mut self) -> Result<(), FlightError> {
        let ends = |times: &[f64]| (times.first().copied(), times.last().copied());
        let ((Some(m0), Some(m1)), (Some(i0), Some(i1))) = (ends(&self.attitude.times), ends(&self.input.times)) else {
            return Ok(());
        };
        let (from, to) = (m0.max(i0), m1.min(i1));
        if to - from <= 0.0 {
            let (motion_start, motion_end, input_start, input_end) = (m0, m1, i0, i1);
            return Err(FlightError::NoOverlap { motion_start, motion_end, input_start, input_end });
        }
        self.keep(from, to);
        Ok(())
    }

    /// Positions within these times \[s\].
    pub(in crate::replay) fn keep(&mut self, from: f64, to: f64) {
        let inside: Vec<bool> = self.times.iter().map(|&t| t >= from && t <= to).collect();
        retain(&mut self.times, &inside);
        retain(&mut self.position, &inside);
        if let Some(reference) = &mut self.reference {
            retain(reference, &inside);
        }
    }
}

fn retain<T>(list: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    list.retain(|_| keep.next().copied().unwrap_or(false));
}
