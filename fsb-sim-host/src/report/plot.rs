//! Draws a laid-out chart: titles, axes, series.

use plotters::style::text_anchor::{HPos, VPos};
use std::io;

use super::{
    chart::{Chart, Panel, Series, Shape},
    clip::Rect,
    dash, decimate,
    draw::{Canvas, Point, TextSpec},
    layout::{Layout, NUMBER_SIZE, PANEL_TITLE, PanelLayout},
    legend, measure,
    palette::{GRID, INK},
};

/// Opacity of a band, so that grid and lines show through.
pub(super) const BAND_OPACITY: f64 = 0.22;
/// A line may miss a point by this many pixels.
const TOLERANCE: f64 = 0.12;
/// Dots and dashes of one series, at most: beyond that they cannot be told apart.
const MOST_DOTS: usize = 1500;
const MOST_DASHES: usize = 400;
/// Radius of a dot among many; a few are drawn larger.
const DOT: f64 = 1.25;
const LARGE_DOT: f64 = 2.5;
const FEW: usize = 200;
const LABEL_SIZE: f64 = 12.5;

const NUMBER: TextSpec =
    TextSpec { size: NUMBER_SIZE, bold: false, upwards: false, across: HPos::Center, along: VPos::Top, color: INK };
const NAME: TextSpec = TextSpec { size: LABEL_SIZE, ..NUMBER };

/// Draws `chart` as `layout` says.
pub(super) fn draw(chart: &Chart, layout: &Layout, canvas: &mut Canvas) -> Result<(), io::Error> {
    let (entries, left, top) = &layout.legend;
    if layout.titled {
        let spec = TextSpec { size: 15.0, bold: true, across: HPos::Left, ..NUMBER };
        let title = measure::fit(&chart.title, 15.0 * 1.1, layout.width - 28.0);
        canvas.text(&title, (14.0, 14.0), spec)?;
    }
    legend::draw(canvas, entries, *left, *top, layout.width - 14.0 - left)?;
    for (panel, place) in chart.panels.iter().zip(&layout.panels) {
        heading(panel, place, canvas)?;
        grid(place, canvas)?;
        let mut drawn = false;
        for series in &panel.series {
            drawn |= self::series(series, place, canvas)?;
        }
        frame(panel, place, canvas)?;
        if !drawn {
            let plot = place.plot;
            let middle = ((plot.left + plot.right) / 2.0, (plot.top + plot.bottom) / 2.0);
            canvas.text("no data", middle, TextSpec { along: VPos::Center, ..NAME })?;
        }
    }
    Ok(())
}

fn heading(panel: &Panel, place: &PanelLayout, canvas: &mut Canvas) -> Result<(), io::Error> {
    let (plot, mut top) = (place.plot, place.top);
    if !panel.title.is_empty() {
        let title = measure::fit(&panel.title, LABEL_SIZE * 1.1, plot.width());
        canvas.text(&title, (plot.left, top + 2.0), TextSpec { bold: true, across: HPos::Left, ..NAME })?;
        top += PANEL_TITLE;
    }
    legend::draw(canvas, &place.legend, plot.left, top, plot.width())
}

fn grid(place: &PanelLayout, canvas: &mut Canvas) -> Result<(), io::Error> {
    let plot = place.plot;
    for (at, _) in &place.x_ticks.marks {
        let x = plot.left + place.x.fraction_of_unit(*at) * plot.width();
        canvas.line(&[(x, plot.top), (x, plot.bottom)], GRID, 0.75)?;
    }
    for (at, _) in &place.y_ticks.marks {
        let y = plot.bottom - place.y.fraction_of_unit(*at) * plot.height();
        canvas.line(&[(plot.left, y), (plot.right, y)], GRID, 0.75)?;
    }
    Ok(())
}

/// Axes with marks, numbers, powers of ten and labels.
fn frame(panel: &Panel, place: &PanelLayout, canvas: &mut Canvas) -> Result<(), io::Error> {
    let plot = place.plot;
    canvas.line(&[(plot.left, plot.top), (plot.left, plot.bottom), (plot.right, plot.bottom)], INK, 1.0)?;
    for (at, text) in &place.x_ticks.marks {
        let x = plot.left + place.x.fraction_of_unit(*at) * plot.width();
        canvas.line(&[(x, plot.bottom), (x, plot.bottom + 4.0)], INK, 1.0)?;
        canvas.text(text, (x, plot.bottom + 7.0), NUMBER)?;
    }
    let beside = TextSpec { across: HPos::Right, along: VPos::Center, ..NUMBER };
    for (at, text) in &place.y_ticks.marks {
        let y = plot.bottom - place.y.fraction_of_unit(*at) * plot.height();
        canvas.line(&[(plot.left - 4.0, y), (plot.left, y)], INK, 1.0)?;
        canvas.text(text, (plot.left - 7.0, y), beside)?;
    }
    for at in &place.y_ticks.minor {
        let y = plot.bottom - place.y.fraction_of_unit(*at) * plot.height();
        canvas.line(&[(plot.left - 2.0, y), (plot.left, y)], INK, 0.75)?;
    }
    let below = plot.bottom + 22.0;
    canvas.text(&place.y_ticks.factor, (plot.left - 7.0, plot.top - 15.0), beside)?;
    canvas.text(&place.x_ticks.factor, (plot.right, below), TextSpec { across: HPos::Right, ..NUMBER })?;
    let x_label = measure::fit(&panel.x_label, LABEL_SIZE, plot.width());
    canvas.text(&x_label, ((plot.left + plot.right) / 2.0, below), NAME)?;
    let y_label = measure::fit(&panel.y_label, LABEL_SIZE, plot.bottom - place.top);
    let middle = (plot.top + plot.bottom) / 2.0;
    canvas.text(&y_label, (place.left, middle), TextSpec { upwards: true, ..NAME })
}

/// Draws one series; false when nothing of it is inside the plot.
fn series(series: &Series, place: &PanelLayout, canvas: &mut Canvas) -> Result<bool, io::Error> {
    let plot = place.plot;
    let (color, weight) = (series.role.color(), series.role.weight());
    let at = |x: f64, y: f64| {
        (plot.left + place.x.fraction(x) * plot.width(), plot.bottom - place.y.fraction(y) * plot.height())
    };
    let on_plot = |points: &[(f64, f64)]| points.iter().map(|&(x, y)| at(x, y)).collect::<Vec<Point>>();
    match &series.shape {
        Shape::Line(points) => {
            let (pieces, lone) = pieces(&on_plot(points), plot);
            for piece in &pieces {
                canvas.line(piece, color, weight)?;
            }
            for &dot in &lone {
                canvas.dot(dot, DOT, color)?;
            }
            Ok(!pieces.is_empty() || !lone.is_empty())
        }
        Shape::Dashed(points) => {
            let (pieces, _) = pieces(&on_plot(points), plot);
            for piece in &pieces {
                dashed(piece, series, canvas)?;
            }
            Ok(!pieces.is_empty())
        }
        Shape::Level(value) => {
            let y = at(0.0, *value).1;
            let line = [(plot.left, y), (plot.right, y)];
            let inside = y.is_finite() && plot.contains(line[0]);
            if inside {
                dashed(&line, series, canvas)?;
            }
            Ok(inside)
        }
        Shape::Dots(points) => {
            let inside: Vec<Point> = on_plot(points).into_iter().filter(|&p| plot.contains(p)).collect();
            let radius = if inside.len() <= FEW { LARGE_DOT } else { DOT };
            for dot in decimate::thin(&inside, MOST_DOTS) {
                canvas.dot(dot, radius, color)?;
            }
            Ok(!inside.is_empty())
        }
        Shape::Band(points) => {
            let edges: Vec<(Point, Point)> = points.iter().map(|&(x, low, high)| (at(x, low), at(x, high))).collect();
            let mut drawn = false;
            let gap = |(a, b): &(Point, Point)| !(a.0.is_finite() && a.1.is_finite() && b.1.is_finite());
            for run in edges.split(gap).filter(|run| run.len() > 1) {
                let edge = |pick: fn(&(Point, Point)) -> Point| {
                    let all: Vec<Point> = run.iter().map(pick).collect();
                    decimate::simplify(&decimate::per_column(&all), TOLERANCE)
                };
                let mut outline = edge(|pair| pair.1);
                outline.extend(edge(|pair| pair.0).into_iter().rev());
                let inside = plot.area(&outline);
                if inside.len() > 2 {
                    canvas.area(&inside, color, BAND_OPACITY)?;
                    drawn = true;
                }
            }
            Ok(drawn)
        }
    }
}

/// A line as it is drawn: thinned, cut at gaps and at the edge of the plot; and the points alone between two gaps.
fn pieces(points: &[Point], plot: Rect) -> (Vec<Vec<Point>>, Vec<Point>) {
    let (mut lines, mut lone) = (Vec::new(), Vec::new());
    for run in decimate::runs(points) {
        if let [only] = run {
            lone.extend(Some(*only).filter(|&p| plot.contains(p)));
        } else {
            lines.extend(plot.line(&decimate::simplify(&decimate::per_column(run), TOLERANCE)));
        }
    }
    (lines, lone)
}

fn dashed(line: &[Point], series: &Series, canvas: &mut Canvas) -> Result<(), io::Error> {
    let (color, weight) = (series.role.color(), series.role.weight());
    match dash::dashes(line, 6.0, 4.0, MOST_DASHES) {
        Some(dashes) => dashes.iter().try_for_each(|dash| canvas.line(dash, color, weight)),
        None => canvas.line(line, color, weight),
    }
}
