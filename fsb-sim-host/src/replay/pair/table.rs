//! A CSV file as columns of numbers, each cell's place known.

use crate::replay::flight::FlightError;
use crate::replay::layout;
use csv::ByteRecord;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// A file that has been read.
pub struct Table {
    file: String,
    headers: Vec<String>,
    /// The line of the headers.
    line: usize,
    rows: Vec<(usize, ByteRecord)>,
}

/// What the cells of a column hold.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Content {
    /// Measurements: an empty cell or a NaN is one that was missed.
    Measured,
    /// Set-points: with an empty cell the last one stays, a NaN is a fault of who recorded it.
    Set,
    /// Numbers that must be there.
    Full,
}

impl Content {
    /// What a cell may be, for messages.
    const fn expected(self) -> &'static str {
        match self {
            Self::Measured => "a finite number, nan or an empty cell",
            Self::Set => "a finite number or an empty cell",
            Self::Full => "a finite number",
        }
    }
}

const WITH_POINT: &str = "a number with a decimal point";
const WITHIN_F32: &str = "a number within f32, up to 3.4e38";

/// The numbers of a column; `None` where there is none.
pub type Numbers = Vec<Option<f64>>;

impl Table {
    pub fn read(path: &Path) -> Result<Self, FlightError> {
        let file = path.display().to_string();
        let bytes = fs::read(path).map_err(|source| match source.kind() {
            ErrorKind::NotFound => FlightError::NotFound { file: file.clone(), expected: "a CSV file with a header" },
            _ => FlightError::NotReadable { file: file.clone(), source },
        })?;
        let (mut reader, mut lines) =
            layout::rows(&bytes).map_err(|source| FlightError::NotReadable { file: file.clone(), source })?;
        let mut rows = Vec::new();
        for record in reader.byte_records() {
            let record =
                record.map_err(|error| FlightError::NotReadable { file: file.clone(), source: error.into() })?;
            rows.push((lines.of(&record), record));
        }
        if rows.is_empty() {
            return Err(FlightError::Empty { file });
        }
        let (line, header) = rows.remove(0);
        let headers: Vec<String> = header.iter().map(shown).collect();
        for (line, row) in &rows {
            if row.len() != headers.len() {
                let (found, expected) = (row.len(), headers.len());
                return Err(FlightError::FieldCount { file, line: *line, found, expected });
            }
        }
        Ok(Self { file, headers, line, rows })
    }

    pub fn file(&self) -> &str {
        &self.file
    }

    pub fn line(&self, row: usize) -> usize {
        self.rows.get(row).map_or(self.line, |(line, _)| *line)
    }

    /// The measurements of this header, if the file has it: `None` where the cell is empty or a NaN.
    pub fn optional(&self, header: &str) -> Result<Option<Numbers>, FlightError> {
        self.numbers(header, Content::Measured)
    }

    /// The measurements of this header; `role` is what it is for.
    pub fn column(&self, role: &'static str, header: &str) -> Result<Numbers, FlightError> {
        self.optional(header)?.ok_or_else(|| self.without(role, header))
    }

    /// The set-points of this header: `None` where the cell is empty; a NaN is refused.
    pub fn set_points(&self, role: &'static str, header: &str) -> Result<Numbers, FlightError> {
        self.numbers(header, Content::Set)?.ok_or_else(|| self.without(role, header))
    }

    fn numbers(&self, header: &str, content: Content) -> Result<Option<Numbers>, FlightError> {
        let Some(index) = self.place(header)? else { return Ok(None) };
        let cells = self.rows.iter().map(|(line, row)| self.cell(*line, header, row.get(index), content));
        cells.collect::<Result<Numbers, _>>().map(Some)
    }

    /// The column of this header, a number in every cell.
    pub fn full(&self, role: &'static str, header: &str) -> Result<Vec<f64>, FlightError> {
        let index = self.place(header)?.ok_or_else(|| self.without(role, header))?;
        let number = |(row, (line, cells)): (usize, &(usize, ByteRecord))| {
            let found = self.cell(*line, header, cells.get(index), Content::Full)?;
            found.ok_or_else(|| self.refuse(row, header, "", Content::Full.expected()))
        };
        self.rows.iter().enumerate().map(number).collect()
    }

    /// Where the column of this header is, if the file has it.
    fn place(&self, header: &str) -> Result<Option<usize>, FlightError> {
        let mut found = (0..self.headers.len()).filter(|&index| self.headers[index] == header);
        let (place, again) = (found.next(), found.next());
        if again.is_some() {
            let (file, line, header) = (self.file.clone(), self.line, header.to_owned());
            return Err(FlightError::DuplicateColumn { file, line, header });
        }
        Ok(place)
    }

    fn without(&self, role: &'static str, header: &str) -> FlightError {
        let (file, line, header, found) = (self.file.clone(), self.line, header.to_owned(), self.headers.join(", "));
        FlightError::NoColumn { file, line, role, header, found }
    }

    /// A rising time. Rows at the very same time as the one before are left out: the first of each is kept.
    pub fn time(&self, role: &'static str, header: &str) -> Result<(Vec<f64>, Vec<usize>), FlightError> {
        let (mut times, mut rows) = (Vec::new(), Vec::new());
        for (row, found) in self.full(role, header)?.into_iter().enumerate() {
            match times.last() {
                Some(&previous) if found < previous => {
                    let (file, line, column) = (self.file.clone(), self.line(row), header.to_owned());
                    return Err(FlightError::NotIncreasing { file, line, column, found, previous });
                }
                Some(&previous) if found == previous => {}
                _ => {
                    times.push(found);
                    rows.push(row);
                }
            }
        }
        Ok((times, rows))
    }

    /// The error for a cell.
    pub fn refuse(&self, row: usize, column: &str, found: &str, expected: &'static str) -> FlightError {
        let (file, column, found) = (self.file.clone(), column.to_owned(), found.to_owned());
        FlightError::Cell { file, line: self.line(row), column, found, expected }
    }

    fn cell(
        &self,
        line: usize,
        header: &str,
        field: Option<&[u8]>,
        content: Content,
    ) -> Result<Option<f64>, FlightError> {
        let field = field.unwrap_or_default();
        if field.is_empty() {
            return Ok(None);
        }
        let number = std::str::from_utf8(field).ok().and_then(|field| field.parse::<f64>().ok());
        match number {
            Some(number) if number.abs() <= f64::from(f32::MAX) => Ok(Some(number)),
            Some(number) if number.is_nan() && content == Content::Measured => Ok(None),
            _ => Err(FlightError::Cell {
                file: self.file.clone(),
                line,
                column: header.to_owned(),
                found: shown(field),
                expected: match number {
                    Some(number) if number.is_finite() => WITHIN_F32,
                    None if field.contains(&b',') => WITH_POINT,
                    _ => content.expected(),
                },
            }),
        }
    }
}

/// A cell for a message, long ones cut.
fn shown(field: &[u8]) -> String {
    const LONGEST: usize = 60;
    let whole = String::from_utf8_lossy(field);
    match whole.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &whole[..end]),
        None => whole.into_owned(),
    }
}
