//! The legend: rows of samples and names above a panel, or above all panels when they share it.

use plotters::style::text_anchor::{HPos, VPos};
use std::io;

use super::{
    chart::{Panel, Role, Shape},
    clip::Rect,
    draw::{Canvas, TextSpec},
    measure,
    palette::INK,
};

/// Height of a row.
pub(super) const ROW: f64 = 19.0;
const SIZE: f64 = 12.0;
const SAMPLE: f64 = 24.0;
const GAP: f64 = 6.0;
const APART: f64 = 20.0;

/// How the sample of an entry looks.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Look {
    Line,
    Dashed,
    Dots,
    Band,
}

/// A name and its sample.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    name: String,
    role: Role,
    look: Look,
}

/// Entries of a panel, in the order of its series; names that repeat with the same look once.
pub(super) fn entries(panel: &Panel) -> Vec<Entry> {
    let mut all: Vec<Entry> = Vec::new();
    for series in panel.series.iter().filter(|series| !series.name.is_empty()) {
        let look = match series.shape {
            Shape::Line(_) => Look::Line,
            Shape::Dashed(_) | Shape::Level(_) => Look::Dashed,
            Shape::Dots(_) => Look::Dots,
            Shape::Band(_) => Look::Band,
        };
        let entry = Entry { name: series.name.clone(), role: series.role, look };
        if !all.contains(&entry) {
            all.push(entry);
        }
    }
    all
}

/// Entries set in rows no wider than `room`: distance from the left end, row, entry.
pub(super) fn rows(entries: &[Entry], room: f64) -> Vec<(f64, usize, Entry)> {
    let (mut x, mut row) = (0.0, 0);
    entries
        .iter()
        .map(|entry| {
            let name = measure::fit(&entry.name, SIZE, room - SAMPLE - GAP);
            let wide = SAMPLE + GAP + measure::width(&name, SIZE);
            if x > 0.0 && x + wide > room {
                (x, row) = (0.0, row + 1);
            }
            let at = x;
            x += wide + APART;
            (at, row, Entry { name, ..entry.clone() })
        })
        .collect()
}

/// Height of the legend set in `room`.
pub(super) fn height(entries: &[Entry], room: f64) -> f64 {
    rows(entries, room).last().map_or(0.0, |&(_, row, _)| (row + 1) as f64 * ROW)
}

/// Draws the legend with its upper left corner at `(left, top)`.
pub(super) fn draw(canvas: &mut Canvas, entries: &[Entry], left: f64, top: f64, room: f64) -> Result<(), io::Error> {
    for (x, row, entry) in rows(entries, room) {
        let (x, y) = (left + x, top + (row as f64 + 0.5) * ROW);
        let (color, weight) = (entry.role.color(), entry.role.weight().max(1.5));
        match entry.look {
            Look::Line => canvas.line(&[(x, y), (x + SAMPLE, y)], color, weight)?,
            Look::Dashed => {
                for dash in super::dash::dashes(&[(x, y), (x + SAMPLE, y)], 6.0, 3.0, 9).into_iter().flatten() {
                    canvas.line(&dash, color, weight)?;
                }
            }
            Look::Dots => {
                for n in [0.2, 0.5, 0.8] {
                    canvas.dot((x + n * SAMPLE, y), 2.0, color)?;
                }
            }
            Look::Band => {
                canvas.fill(
                    Rect { left: x, top: y - 5.0, right: x + SAMPLE, bottom: y + 5.0 },
                    color,
                    super::plot::BAND_OPACITY,
                )?;
            }
        }
        let spec =
            TextSpec { size: SIZE, bold: false, upwards: false, across: HPos::Left, along: VPos::Center, color: INK };
        canvas.text(&entry.name, (x + SAMPLE + GAP, y), spec)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::chart::Series;
    use super::*;

    #[test]
    fn entries_do_not_overlap_and_stay_in_the_room() {
        let names = ["truth", "FSB observer, f32 core", "FSB observer, paper form", "derivative-based observer"];
        let series = names.iter().enumerate().map(|(n, name)| Series::line(name, Role::Nth(n), [])).collect();
        let entries = entries(&Panel::new("", "", series));
        for room in [150.0, 300.0, 800.0] {
            let set = rows(&entries, room);
            assert_eq!(set.len(), 4);
            let end = |x: f64, e: &Entry| x + SAMPLE + GAP + measure::width(&e.name, SIZE);
            assert!(set.iter().all(|(x, _, e)| end(*x, e) <= room + 1e-9));
            for pair in set.windows(2) {
                assert!(pair[1].1 > pair[0].1 || pair[1].0 >= end(pair[0].0, &pair[0].2));
            }
        }
    }

    #[test]
    fn unnamed_series_stay_out() {
        let band = Series::band("", Role::Core, []);
        let line = Series::line("k", Role::Core, []);
        assert_eq!(entries(&Panel::new("", "", vec![band, line.clone(), line])).len(), 1);
    }
}
