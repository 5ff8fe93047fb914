//! One table, for the terminal and for the page.

use super::{
    escape::{escape, printable},
    ticks::{minus, superscript},
};
use unicode_width::UnicodeWidthStr;

/// Shown where there is no value.
const MISSING: &str = "\u{2013}";

/// Which side of a column its cells keep to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Left,
    /// Marks and short codes.
    Center,
    /// Numbers.
    Right,
}

/// Heading and alignment of a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Heading with the unit, e.g. `rms [m]`.
    pub header: String,
    /// Side the cells and the heading keep to.
    pub align: Align,
}

impl Column {
    /// A column of words.
    pub fn left(header: &str) -> Self {
        Self { header: header.to_owned(), align: Align::Left }
    }

    /// A column of numbers.
    pub fn right(header: &str) -> Self {
        Self { header: header.to_owned(), align: Align::Right }
    }

    /// A column of marks.
    pub fn center(header: &str) -> Self {
        Self { header: header.to_owned(), align: Align::Center }
    }
}

/// What stands in one place of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cell {
    /// Words, as they are.
    Text(String),
    /// A formatted number with an ASCII minus sign; made by [`Cell::fixed`], [`Cell::significant`] or [`Cell::count`].
    Number(String),
    /// No value: an en dash.
    Missing,
}

impl Cell {
    /// Words.
    pub fn text(text: &str) -> Self {
        Self::Text(text.to_owned())
    }

    /// `value` with this many digits after the point; missing when it is not finite.
    pub fn fixed(value: f64, decimals: usize) -> Self {
        if !value.is_finite() {
            return Self::Missing;
        }
        Self::Number(unsigned_zero(format!("{value:.decimals$}")))
    }

    /// `value` with this many significant digits (at least one), written `1.23×10⁻⁷` where that is shorter to read:
    /// below 1e-4 and from 1e6 on in magnitude. Missing when it is not finite.
    pub fn significant(value: f64, digits: usize) -> Self {
        if !value.is_finite() {
            return Self::Missing;
        }
        let digits = digits.max(1);
        if value == 0.0 {
            return Self::fixed(0.0, digits - 1);
        }
        // Rounding first: 9.996 with three digits is 10.0, not 10.00.
        let rounded = format!("{value:.*e}", digits - 1);
        let Some((figures, Ok(exponent))) = rounded.split_once('e').map(|(f, e)| (f, e.parse::<i32>())) else {
            return Self::Missing;
        };
        if (-4..6).contains(&exponent) {
            let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
            Self::fixed(value, decimals)
        } else {
            Self::Number(format!("{figures}×10{}", superscript(exponent)))
        }
    }

    /// [`Cell::fixed`] of a value that may be absent.
    pub fn maybe(value: Option<f64>, decimals: usize) -> Self {
        value.map_or(Self::Missing, |value| Self::fixed(value, decimals))
    }

    /// A whole number.
    pub fn count(value: u64) -> Self {
        Self::Number(value.to_string())
    }

    fn plain(&self) -> String {
        match self {
            Self::Text(text) | Self::Number(text) => printable(text),
            Self::Missing => MISSING.to_owned(),
        }
    }

    fn html(&self) -> String {
        match self {
            Self::Number(number) => escape(&minus(number)),
            other => escape(&other.plain()),
        }
    }
}

fn unsigned_zero(number: String) -> String {
    match number.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
        _ => number,
    }
}

/// A heading, rows of cells and a note.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// Heading, e.g. `Table 1. Steady estimates`; empty for none.
    pub title: String,
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows. A short row is filled up with missing cells; cells beyond the last column are not shown.
    pub rows: Vec<Vec<Cell>>,
    /// Printed below; empty for none.
    pub note: String,
}

impl Table {
    /// A table without rows and note.
    pub fn new(title: &str, columns: Vec<Column>) -> Self {
        Self { title: title.to_owned(), columns, rows: Vec::new(), note: String::new() }
    }

    /// Adds a row.
    pub fn push(&mut self, row: Vec<Cell>) -> &mut Self {
        self.rows.push(row);
        self
    }

    /// The table with this note below.
    #[must_use]
    pub fn with_note(mut self, note: &str) -> Self {
        note.clone_into(&mut self.note);
        self
    }

    /// The table as aligned lines for a terminal, each ended by a line feed and none by a space.
    pub fn to_text(&self) -> String {
        let mut lines = vec![self.columns.iter().map(|column| printable(&column.header)).collect::<Vec<_>>()];
        for row in &self.rows {
            lines.push((0..self.columns.len()).map(|i| row.get(i).unwrap_or(&Cell::Missing).plain()).collect());
        }
        let widths: Vec<usize> =
            (0..self.columns.len()).map(|i| lines.iter().map(|line| line[i].width()).max().unwrap_or(0)).collect();
        let mut out = String::new();
        let mut put = |line: &str| {
            out.push_str(line.trim_end());
            out.push('\n');
        };
        if !self.title.is_empty() {
            put(&printable(&self.title));
        }
        for (number, line) in lines.iter().enumerate() {
            let cells: Vec<String> = (0..widths.len())
                .map(|i| {
                    let room = widths[i] - line[i].width();
                    let before = match self.columns[i].align {
                        Align::Left => 0,
                        Align::Center => room / 2,
                        Align::Right => room,
                    };
                    format!("{}{}{}", " ".repeat(before), line[i], " ".repeat(room - before))
                })
                .collect();
            put(&cells.join("  "));
            if number == 0 {
                put(&widths.iter().map(|&width| "─".repeat(width)).collect::<Vec<_>>().join("  "));
            }
        }
        if !self.note.is_empty() {
            put(&printable(&self.note));
        }
        out
    }

    /// The table as an HTML fragment, every text escaped.
    pub fn to_html(&self) -> String {
        let class = |column: &Column| match column.align {
            Align::Left => "l",
            Align::Center => "c",
            Align::Right => "r",
        };
        let mut out = String::from("<div class=\"table\">\n<table>\n");
        if !self.title.is_empty() {
            out.push_str(&format!("<caption>{}</caption>\n", escape(&self.title)));
        }
        out.push_str("<thead><tr>");
        for column in &self.columns {
            out.push_str(&format!("<th scope=\"col\" class=\"{}\">{}</th>", class(column), escape(&column.header)));
        }
        out.push_str("</tr></thead>\n<tbody>\n");
        for row in &self.rows {
            out.push_str("<tr>");
            for (i, column) in self.columns.iter().enumerate() {
                let cell = row.get(i).unwrap_or(&Cell::Missing).html();
                out.push_str(&format!("<td class=\"{}\">{cell}</td>", class(column)));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</tbody>\n</table>\n");
        if !self.note.is_empty() {
            out.push_str(&format!("<p class=\"note\">{}</p>\n", escape(&self.note)));
        }
        out.push_str("</div>\n");
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(cell: Cell) -> String {
        cell.plain()
    }

    #[test]
    fn digits() {
        let fixed = [(1.23456, 2), (-0.001, 2), (1e-9, 3), (2.0, 0), (f64::NAN, 2), (f64::INFINITY, 2)];
        assert_eq!(fixed.map(|(v, n)| number(Cell::fixed(v, n))), ["1.23", "0.00", "0.000", "2", "–", "–"]);
        let significant = [(9.996, 3), (0.00123456, 3), (123456.0, 2), (1.234e-7, 3), (-6.02e23, 3), (0.0, 3)];
        assert_eq!(
            significant.map(|(v, n)| number(Cell::significant(v, n))),
            ["10.0", "0.00123", "123456", "1.23×10⁻⁷", "-6.02×10²³", "0.00"]
        );
        assert_eq!(Cell::maybe(None, 3), Cell::Missing);
        assert_eq!(Cell::maybe(Some(0.25), 1), Cell::Number("0.2".into()));
    }

    #[test]
    fn columns_line_up_whatever_the_characters_take() {
        let columns = vec![Column::left("name"), Column::center("ok"), Column::right("ẏ̂ [m/s]")];
        let mut table = Table::new("Table 1. Estimates", columns).with_note("± is one sd");
        table.push(vec![Cell::text("ŷ̂"), Cell::text("y"), Cell::fixed(-1.5, 2)]);
        table.push(vec![Cell::text("質量"), Cell::text("y"), Cell::fixed(12.25, 2)]);
        table.push(vec![Cell::text("k"), Cell::Missing]);
        assert_eq!(
            table.to_text(),
            "Table 1. Estimates\n\
             name  ok  ẏ̂ [m/s]\n\
             ────  ──  ───────\n\
             ŷ̂     y     -1.50\n\
             質量  y     12.25\n\
             k     –         –\n\
             ± is one sd\n"
        );
    }

    #[test]
    fn html_is_escaped_and_keeps_the_sides() {
        let mut table = Table::new("a < b", vec![Column::left("<i>"), Column::right("n")]).with_note("x & y");
        table.push(vec![Cell::text("<b>"), Cell::fixed(-1.0, 1)]);
        table.push(vec![Cell::text("only one")]);
        let html = table.to_html();
        let document = roxmltree::Document::parse(&html).unwrap();
        let texts = |tag: &str| -> Vec<String> {
            let found = document.descendants().filter(|n| n.has_tag_name(tag));
            found.map(|n| format!("{} {}", n.attribute("class").unwrap_or(""), n.text().unwrap_or(""))).collect()
        };
        assert_eq!(texts("th"), ["l <i>", "r n"]);
        assert_eq!(texts("td"), ["l <b>", "r −1.0", "l only one", "r –"]);
        assert_eq!((texts("caption"), texts("p")), (vec![" a < b".into()], vec!["note x & y".into()]));
    }
}
