//! The figures of a replay.

use super::feed::ParameterTrace;
use super::log::{AxisColumn, AxisLog};
use super::result::{AxisResult, ReplayResult};
use super::summary::about;
use crate::report::chart::{Chart, Panel, Role, Series};

/// Samples within this share of the end set the vertical range of a parameter: the first ones are known to a few percent only
/// and would flatten all that follows.
const SETTLED: f64 = 0.9;

/// The figures with the names of their files, without extension.
pub(super) fn figures(result: &ReplayResult, log: &AxisLog) -> Vec<(&'static str, Chart)> {
    let mut all = Vec::new();
    if let Some(mass) = &result.mass {
        let caption = "m = 1/k with k pooled over the translational axes; the band is two standard deviations to either \
                       side, as far as measurement noise causes them. Nothing is drawn where k is not valid.";
        all.push(("mass", grid("Mass", caption, vec![inverse("m [kg]", mass, log)])));
    }
    let inertias: Vec<Panel> =
        result.rotational().map(|a| inverse(&format!("I{} [kg m²]", about(a)), &a.own, log)).collect();
    if !inertias.is_empty() {
        let caption = "I = 1/k of each rotational axis, and two standard deviations to either side. Nothing is drawn where \
                       k is not valid.";
        all.push(("inertia", grid("Moments of inertia", caption, inertias)));
    }
    let axes = || result.axes.iter().zip(&log.axes);
    let caption = "What was measured, and what the observer makes of it.";
    all.push(("positions", grid("Positions", caption, axes().map(|(a, column)| position(a, column, log)).collect())));
    let caption = "What the observer hands out, against the reference of the log where it has one.";
    all.push(("velocities", grid("Velocities", caption, axes().map(|(a, column)| velocity(a, column, log)).collect())));
    let caption = "Measured position minus the one predicted. White about zero where the model holds; drag, a wrong thrust \
                   curve or a misaligned clock show as slow waves.";
    all.push(("innovations", grid("Innovations", caption, result.axes.iter().map(|a| innovation(a, log)).collect())));
    all
}

/// Stacked, or two abreast where there are too many to read in one stack.
pub(super) fn grid(title: &str, caption: &str, mut panels: Vec<Panel>) -> Chart {
    let columns = if panels.len() > 3 { 2 } else { 1 };
    let last_row = panels.len() - columns.min(panels.len());
    for panel in panels.iter_mut().skip(last_row) {
        panel.x_label = "t [s]".to_owned();
    }
    Chart { columns, ..Chart::new(title, caption, panels) }
}

fn inverse(label: &str, trace: &ParameterTrace, log: &AxisLog) -> Panel {
    let values: Vec<(f64, Option<(f64, f64)>)> = trace
        .value
        .iter()
        .enumerate()
        .map(|(n, k)| {
            let value = k.map(|k| k.inverse_with_sd());
            (log.time(n), value.map(|(value, sd)| (f64::from(value), f64::from(sd))))
        })
        .collect();
    let gap = (f64::NAN, f64::NAN);
    let band = values.iter().map(|&(t, v)| {
        let (value, sd) = v.unwrap_or(gap);
        (t, value - 2.0 * sd, value + 2.0 * sd)
    });
    let line = values.iter().map(|&(t, v)| (t, v.unwrap_or(gap).0));
    let mut panel = Panel::new(
        "",
        label,
        vec![Series::band("± 2 sd", Role::Core, band), Series::line("identified", Role::Core, line)],
    );
    panel.x_range = whole(log);
    panel.y_range = settled_range(&values);
    panel
}

fn whole(log: &AxisLog) -> Option<(f64, f64)> {
    Some((log.time(0), log.time(log.len() - 1)))
}

/// The extent of the bands of the last samples, and a good deal more.
fn settled_range(values: &[(f64, Option<(f64, f64)>)]) -> Option<(f64, f64)> {
    let valid: Vec<(f64, f64)> = values.iter().filter_map(|&(_, v)| v).filter(|(_, sd)| sd.is_finite()).collect();
    let from = (valid.len() as f64 * (1.0 - SETTLED)) as usize;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (value, sd) in valid.into_iter().skip(from) {
        (low, high) = (low.min(value - 2.0 * sd), high.max(value + 2.0 * sd));
    }
    let middle = (low + high) / 2.0;
    let half = ((high - low) / 2.0).max(0.005 * middle.abs()) * 1.2;
    (half > 0.0 && half.is_finite()).then_some((middle - half, middle + half))
}

fn units(axis: &AxisResult) -> (&'static str, &'static str) {
    if axis.axis.is_translation() { ("m", "m/s") } else { ("rad", "rad/s") }
}

fn position(axis: &AxisResult, column: &AxisColumn, log: &AxisLog) -> Panel {
    let measured = column.position.iter().enumerate().map(|(n, y)| (log.time(n), y.unwrap_or(f64::NAN)));
    let estimated =
        axis.trace.state.iter().enumerate().map(|(n, s)| (log.time(n), s.map_or(f64::NAN, |s| f64::from(s.position))));
    let mut panel = Panel::new(
        "",
        &format!("{} [{}]", axis.axis.name(), units(axis).0),
        vec![Series::dots("measured", Role::Measured, measured), Series::line("estimated", Role::Core, estimated)],
    );
    panel.x_range = whole(log);
    panel
}

fn velocity(axis: &AxisResult, column: &AxisColumn, log: &AxisLog) -> Panel {
    let mut series = Vec::new();
    if let Some(reference) = &column.velocity_reference {
        let points = reference.iter().enumerate().map(|(n, v)| (log.time(n), v.unwrap_or(f64::NAN)));
        series.push(Series::line("reference", Role::Reference, points));
    }
    let points =
        axis.trace.state.iter().enumerate().map(|(n, s)| (log.time(n), s.map_or(f64::NAN, |s| f64::from(s.velocity))));
    series.push(Series::line("estimated", Role::Core, points));
    let mut panel = Panel::new("", &format!("{} rate [{}]", axis.axis.name(), units(axis).1), series);
    panel.x_range = whole(log);
    panel
}

fn innovation(axis: &AxisResult, log: &AxisLog) -> Panel {
    let points = axis.trace.innovation.iter().enumerate().map(|(n, r)| (log.time(n), r.map_or(f64::NAN, f64::from)));
    let zero = Series::level("", Role::Reference, 0.0);
    let line = Series::line("y - predicted", Role::Core, points);
    let mut panel = Panel::new("", &format!("{} [{}]", axis.axis.name(), units(axis).0), vec![zero, line]);
    panel.x_range = whole(log);
    panel
}
