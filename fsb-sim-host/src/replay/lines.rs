//! The line of a CSV text that a row begins on.

use csv::ByteRecord;

/// Counts lines, whether they end in LF, CRLF or CR.
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    /// The line that the byte at `counted` is on.
    line: usize,
    counted: usize,
}

impl<'a> Lines<'a> {
    pub fn of_text(bytes: &'a [u8]) -> Self {
        Self { bytes, line: 1, counted: 0 }
    }

    /// The line that `record` begins on, counted from 1; records are asked for in order.
    pub fn of(&mut self, record: &ByteRecord) -> usize {
        // The position that comes with a record lies before the rest of a CRLF and before empty lines.
        let mut begin = record.position().map_or(0, |position| position.byte() as usize);
        while matches!(self.bytes.get(begin), Some(b'\r' | b'\n')) {
            begin += 1;
        }
        for at in self.counted..begin {
            let after_return = at > 0 && self.bytes[at - 1] == b'\r';
            match self.bytes[at] {
                b'\n' if !after_return => self.line += 1,
                b'\r' => self.line += 1,
                _ => {}
            }
        }
        self.counted = begin;
        self.line
    }
}
