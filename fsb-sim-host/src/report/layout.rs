//! Where everything of a chart goes. All lengths in CSS pixels.

use super::{
    axis::Axis,
    chart::{Chart, ChartError, Panel},
    clip::Rect,
    extent,
    legend::{self, Entry},
    measure,
    ticks::{Ticks, ticks},
};

/// Width of every chart.
const WIDTH: f64 = 860.0;
/// Free border of the card.
const BORDER: f64 = 14.0;
/// Between panels, across and down.
const APART: f64 = 14.0;
/// Height of the chart's title, and of a panel's.
const TITLE: f64 = 26.0;
pub(super) const PANEL_TITLE: f64 = 21.0;
/// Room below a plot for the numbers and for the label.
const NUMBERS: f64 = 20.0;
const LABEL: f64 = 19.0;
/// Room above a plot: half a line of text.
const HEAD: f64 = 8.0;
/// Font size of the numbers at the marks.
pub(super) const NUMBER_SIZE: f64 = 11.0;
/// Smallest and largest ratio of width to height of a panel with equal scales.
const SLIMMEST: f64 = 0.5;
const FLATTEST: f64 = 3.0;

/// A panel's place.
#[derive(Debug)]
pub(super) struct PanelLayout {
    /// The rectangle inside the axes.
    pub plot: Rect,
    /// Top of the panel's own heading and legend.
    pub top: f64,
    /// Left edge of the panel with its numbers and label; relative to its cell until the panel is put in place.
    pub left: f64,
    pub x: Axis,
    pub y: Axis,
    pub x_ticks: Ticks,
    pub y_ticks: Ticks,
    /// The panel's own legend.
    pub legend: Vec<Entry>,
}

/// A chart's places.
#[derive(Debug)]
pub(super) struct Layout {
    pub width: f64,
    pub height: f64,
    /// The common legend and its upper left corner; empty when each panel has its own.
    pub legend: (Vec<Entry>, f64, f64),
    pub panels: Vec<PanelLayout>,
    pub titled: bool,
}

impl Layout {
    /// Lays `chart` out, with its title or without.
    ///
    /// # Errors
    /// [`ChartError`] when there is no panel or a range cannot be an axis.
    pub fn of(chart: &Chart, titled: bool) -> Result<Self, ChartError> {
        if chart.panels.is_empty() {
            return Err(ChartError::NoPanel { title: chart.title.clone() });
        }
        let titled = titled && !chart.title.is_empty();
        let columns = chart.columns.clamp(1, chart.panels.len());
        let rows = chart.panels.len().div_ceil(columns);
        let cell = (WIDTH - 2.0 * BORDER - (columns - 1) as f64 * APART) / columns as f64;
        let legends: Vec<Vec<Entry>> = chart.panels.iter().map(legend::entries).collect();
        let shared = legends.len() > 1 && legends.windows(2).all(|pair| pair[0] == pair[1]);

        let mut panels = Vec::with_capacity(chart.panels.len());
        for (index, panel) in chart.panels.iter().enumerate() {
            let (x, y) = extent::axes(chart, index)?;
            let height = usual_height(rows, panel.equal_aspect);
            let legend = if shared { Vec::new() } else { legends[index].clone() };
            panels.push(PanelLayout {
                plot: Rect {
                    left: left_of(panel, &vertical_ticks(&y, height, panel.equal_aspect)),
                    top: 0.0,
                    right: cell,
                    bottom: height,
                },
                top: 0.0,
                left: 0.0,
                x,
                y,
                x_ticks: Ticks::default(),
                y_ticks: Ticks::default(),
                legend,
            });
        }
        // Plots below each other start at the same place.
        for column in 0..columns {
            let of_column = || (column..chart.panels.len()).step_by(columns);
            let left = of_column().map(|i| panels[i].plot.left).fold(0.0, f64::max);
            for i in of_column() {
                panels[i].plot.left = left;
            }
        }

        let mut top = if titled { BORDER + TITLE } else { BORDER };
        let common = if shared { legends[0].clone() } else { Vec::new() };
        let corner = (BORDER + panels[0].plot.left, top);
        top += legend::height(&common, WIDTH - BORDER - corner.0);
        for row in 0..rows {
            let of_row = row * columns..((row + 1) * columns).min(panels.len());
            let mut head = 0.0_f64;
            for i in of_row.clone() {
                panels[i].size(&chart.panels[i], cell);
                head = head.max(panels[i].head(&chart.panels[i]));
            }
            let mut bottom = top;
            for i in of_row {
                let left = BORDER + (i % columns) as f64 * (cell + APART);
                panels[i].shift(left, top, head);
                let below = if chart.panels[i].x_label.is_empty() && panels[i].x_ticks.factor.is_empty() {
                    NUMBERS
                } else {
                    NUMBERS + LABEL
                };
                bottom = bottom.max(panels[i].plot.bottom + below);
            }
            top = bottom + if row + 1 < rows { APART / 2.0 } else { 0.0 };
        }
        Ok(Self {
            width: WIDTH,
            height: (top + BORDER / 2.0).ceil(),
            legend: (common, corner.0, corner.1),
            panels,
            titled,
        })
    }
}

impl PanelLayout {
    /// Settles the size of the plot, the ranges of equal scales and the marks.
    fn size(&mut self, panel: &Panel, cell: f64) {
        let room = (cell - self.plot.left - 16.0).max(40.0);
        let mut height = self.plot.height();
        let mut width = room;
        if panel.equal_aspect {
            widen(&mut self.x, &mut self.y);
            let ratio = (self.x.hi - self.x.lo) / (self.y.hi - self.y.lo);
            width = room.min(height * ratio);
            height = width / ratio;
        }
        self.plot = Rect { right: self.plot.left + width, bottom: height, ..self.plot };
        if panel.equal_aspect {
            // A panel narrower than its room stands in the middle of it.
            self.left = (room - width) / 2.0;
        }
        self.y_ticks = vertical_ticks(&self.y, height, panel.equal_aspect);
        self.x_ticks = (2..=(width / 50.0) as usize)
            .rev()
            .map(|most| ticks(&self.x, most))
            .find(|t| fits(t, &self.x, width))
            .unwrap_or_else(|| ticks(&self.x, 2));
    }

    /// Height above the plot.
    fn head(&self, panel: &Panel) -> f64 {
        let title = if panel.title.is_empty() { 0.0 } else { PANEL_TITLE };
        let factor = if self.y_ticks.factor.is_empty() { 0.0 } else { 10.0 };
        HEAD + (title + legend::height(&self.legend, self.plot.width())).max(factor)
    }

    fn shift(&mut self, left: f64, top: f64, head: f64) {
        let left = left + self.left;
        (self.left, self.top) = (left, top);
        let plot = self.plot;
        self.plot = Rect {
            left: plot.left + left,
            right: plot.right + left,
            top: plot.top + top + head,
            bottom: plot.bottom + top + head,
        };
    }
}

/// Height of a plot when the chart has this many rows.
fn usual_height(rows: usize, equal_aspect: bool) -> f64 {
    match (rows, equal_aspect) {
        (1, true) => 480.0,
        (_, true) => 320.0,
        (1, _) => 300.0,
        (2, _) => 200.0,
        _ => 150.0,
    }
}

/// Marks of a vertical axis; with equal scales as far apart as those of a horizontal one.
fn vertical_ticks(axis: &Axis, height: f64, equal_aspect: bool) -> Ticks {
    ticks(axis, if equal_aspect { height / 60.0 } else { 4.0 + height / 50.0 } as usize)
}

/// Room to the left of a plot for the label and the numbers.
fn left_of(panel: &Panel, y_ticks: &Ticks) -> f64 {
    let label = if panel.y_label.is_empty() { 0.0 } else { 20.0 };
    let numbers = y_ticks.marks.iter().map(|(_, text)| text).chain([&y_ticks.factor]);
    label + 9.0 + numbers.map(|text| measure::width(text, NUMBER_SIZE)).fold(0.0, f64::max)
}

/// Whether no two numbers below the plot come near each other.
fn fits(ticks: &Ticks, axis: &Axis, width: f64) -> bool {
    ticks.marks.windows(2).all(|pair| {
        let apart = (axis.fraction_of_unit(pair[1].0) - axis.fraction_of_unit(pair[0].0)) * width;
        let text = (measure::width(&pair[0].1, NUMBER_SIZE) + measure::width(&pair[1].1, NUMBER_SIZE)) / 2.0;
        apart >= text + 12.0
    })
}

/// Widens the shorter of two equally scaled ranges about its middle so that the panel is no sliver.
fn widen(x: &mut Axis, y: &mut Axis) {
    let (across, up) = (x.hi - x.lo, y.hi - y.lo);
    let grow = |axis: &mut Axis, length: f64| {
        let extra = (length - (axis.hi - axis.lo)) / 2.0;
        if extra > 0.0 {
            (axis.lo, axis.hi) = (axis.lo - extra, axis.hi + extra);
        }
    };
    grow(x, up * SLIMMEST);
    grow(y, across / FLATTEST);
}

#[cfg(test)]
mod tests {
    use super::super::chart::{Role, Series};
    use super::*;

    #[test]
    fn equal_scales_are_equal() {
        for (a, b) in [(3.0, 2.0), (100.0, 1.0), (1.0, 100.0), (2e-7, 1e-7)] {
            let path = Series::line("", Role::Truth, [(0.0, 0.0), (a, b)]);
            let panel = Panel { equal_aspect: true, ..Panel::new("x [m]", "y [m]", vec![path]) };
            let layout = Layout::of(&Chart::new("", "", vec![panel]), true).unwrap();
            let p = &layout.panels[0];
            let (across, up) = (p.plot.width() / (p.x.hi - p.x.lo), p.plot.height() / (p.y.hi - p.y.lo));
            assert!((across / up - 1.0).abs() < 1e-9, "{a} {b}: {across} {up}");
            assert!(p.plot.right <= WIDTH && p.plot.width() > 100.0 && p.plot.height() > 100.0);
        }
    }

    #[test]
    fn panels_do_not_overlap_and_numbers_keep_apart() {
        for (count, columns) in [(1, 1), (2, 1), (3, 2), (6, 3)] {
            let line = |n: usize| Series::line(&format!("s{n}"), Role::Nth(n), [(0.0, -1e-9), (1e5, 12345.678)]);
            let panels = (0..count).map(|n| Panel::new("t [s]", "x [m]", vec![line(n)])).collect();
            let layout = Layout::of(&Chart { columns, ..Chart::new("title", "", panels) }, true).unwrap();
            for (i, a) in layout.panels.iter().enumerate() {
                assert!(a.plot.left >= 0.0 && a.plot.right <= WIDTH && a.plot.bottom + NUMBERS < layout.height);
                assert!(fits(&a.x_ticks, &a.x, a.plot.width()) && a.x_ticks.marks.len() > 1);
                for b in &layout.panels[i + 1..] {
                    assert!(a.plot.right < b.left || a.plot.bottom + NUMBERS < b.top);
                }
            }
        }
    }
}
