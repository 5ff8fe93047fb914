//! The figures of what is identified beside k, of what is left, and of other ways to a velocity.

use super::compare::velocity::Velocities;
use super::compare::whiteness::Whiteness;
use super::figures::grid;
use super::fit::Row;
use super::identified::Identified;
use super::log::{Axis, AxisLog};
use super::recording::Recording;
use super::result::ReplayResult;
use crate::report::chart::{Chart, Panel, Role, Series};
use fsb_core::regression::{AxisTerms, Term};

/// Names of the translational axes present.
fn names(log: &AxisLog) -> Vec<&'static str> {
    log.axes.iter().filter(|axis| axis.axis.is_translation()).map(|axis| axis.axis.name()).collect()
}

/// g/k over time, and the flight controller's own.
pub(super) fn hover(result: &ReplayResult, recording: &Recording, gravity: f64) -> Option<Chart> {
    let (mass, log) = (result.mass.as_ref()?, &recording.log);
    let values: Vec<(f64, f64, f64)> = mass
        .value
        .iter()
        .enumerate()
        .map(|(n, k)| {
            let (value, sd) = k.map_or((f32::NAN, f32::NAN), |k| k.inverse_with_sd());
            (log.time(n), gravity * f64::from(value), gravity * f64::from(sd))
        })
        .collect();
    let band = values.iter().map(|&(t, value, sd)| (t, value - 2.0 * sd, value + 2.0 * sd));
    let mut series = vec![
        Series::band("± 2 sd", Role::Core, band),
        Series::line("g/k", Role::Core, values.iter().map(|&(t, value, _)| (t, value))),
    ];
    let own = |valid: bool| recording.hover.iter().filter(move |h| h.valid == valid).map(|h| (h.t, h.value));
    if !recording.hover.is_empty() {
        series.push(Series::line("PX4, valid", Role::Rival, own(true)));
        series.push(Series::dots("PX4, not valid", Role::Rival, own(false)));
    }
    let mut panel = Panel::new("t [s]", "share of the full thrust", series);
    panel.x_range = Some((log.time(0), log.time(log.len() - 1)));
    let caption =
        "The thrust that hovers, from k; beside it the flight controller's own estimate, where the log has one.";
    Some(Chart::new("Hover thrust", caption, vec![panel]))
}

/// D and d of each axis over time.
pub(super) fn terms(identified: &Identified, log: &AxisLog) -> Option<Chart> {
    let mut panels = Vec::new();
    for (axis, name) in identified.terms.iter().zip(names(log)) {
        for (label, of) in [
            (format!("D of {name} [1/s]"), (|terms: &AxisTerms| terms.drag) as fn(&AxisTerms) -> Term),
            (format!("d of {name} [m/s²]"), |terms| terms.disturbance),
        ] {
            if axis.iter().all(|terms| of(terms) == Term::NotAsked) {
                continue;
            }
            let values: Vec<(f64, f64, f64)> = axis
                .iter()
                .enumerate()
                .map(|(n, terms)| match of(terms) {
                    Term::Known { value, sd } => (log.time(n), f64::from(value), f64::from(sd)),
                    _ => (log.time(n), f64::NAN, f64::NAN),
                })
                .collect();
            let band = values.iter().map(|&(t, value, sd)| (t, value - 2.0 * sd, value + 2.0 * sd));
            let line = values.iter().map(|&(t, value, _)| (t, value));
            let series = vec![Series::band("± 2 sd", Role::Core, band), Series::line("identified", Role::Core, line)];
            let x_range = Some((log.time(0), log.time(log.len() - 1)));
            panels.push(Panel { x_range, ..Panel::new("", &label, series) });
        }
    }
    let caption = "Linear drag and constant disturbance, and two standard deviations to either side. Nothing is drawn where the data \
                   do not tell.";
    (!panels.is_empty()).then(|| grid("Drag and disturbance", caption, panels))
}

/// What the identification leaves of the accelerations.
pub(super) fn residuals(identified: &Identified, log: &AxisLog) -> Chart {
    let panels = identified.residual.iter().zip(names(log)).map(|(residual, name)| {
        let line = residual.iter().enumerate().map(|(n, r)| (log.time(n), r.unwrap_or(f64::NAN)));
        let zero = Series::level("", Role::Reference, 0.0);
        Panel::new("", &format!("{name} [m/s²]"), vec![zero, Series::line("left over", Role::Core, line)])
    });
    let caption = "Windowed and filtered acceleration minus what k, D and d at the end of the flight explain of it. The filter \
                   passes what is slower than λ of the identifier.";
    grid("What is left of the accelerations", caption, panels.collect())
}

/// Autocorrelation of the innovations.
pub(super) fn correlations(judged: &[(Axis, Whiteness)], period: f64) -> Option<Chart> {
    let panels: Vec<Panel> = judged
        .iter()
        .map(|(axis, white)| {
            let at = |values: &[f64]| -> Vec<(f64, f64)> {
                values.iter().enumerate().map(|(i, &r)| ((i + 1) as f64 * period, r)).collect()
            };
            let margin = 2.0 / (white.count as f64).sqrt();
            let band = at(&white.expected).into_iter().map(|(lag, rho)| (lag, rho - margin, rho + margin));
            let series = vec![
                Series::band("measurement noise alone", Role::Reference, band),
                Series::line("innovations", Role::Core, at(&white.correlation)),
            ];
            Panel::new("lag [s]", &format!("autocorrelation of {}", axis.name()), series)
        })
        .collect();
    let caption = "Autocorrelation of the innovations. Where measurement noise is all that is left it lies within the band 19 times \
                   in 20.";
    (!panels.is_empty()).then(|| Chart { columns: panels.len(), ..Chart::new("Are they white?", caption, panels) })
}

/// Errors of three velocities, or the velocities themselves where there is no reference.
pub(super) fn velocities(compared: &[Velocities], result: &ReplayResult, log: &AxisLog) -> Option<Chart> {
    let panels: Vec<Panel> = compared
        .iter()
        .filter_map(|of| {
            let column = log.axes.iter().find(|axis| axis.axis == of.axis)?;
            let axis = result.axes.iter().find(|axis| axis.axis == of.axis)?;
            let reference = column.velocity_reference.as_ref();
            let minus = |n: usize| reference.map_or(Some(0.0), |all| all.get(n).copied().flatten());
            let error =
                |n: usize, v: Option<f64>| (log.time(n), v.zip(minus(n)).map_or(f64::NAN, |(v, truth)| v - truth));
            let ours = |n: usize| axis.trace.state.get(n).copied().flatten().map(|s| f64::from(s.velocity));
            let all = 0..log.len();
            let mut series = vec![
                Series::line("differences", Role::Measured, all.clone().map(|n| error(n, of.differences[n]))),
                Series::line("Kalman filter", Role::Rival, all.clone().map(|n| error(n, of.kalman[n]))),
                Series::line("observer on the way", Role::Core, all.clone().map(|n| error(n, ours(n)))),
            ];
            if !of.informed.is_empty() {
                let knowing = |n: usize| of.informed.get(n).copied().flatten();
                series.push(Series::line(
                    "observer that knows k, D, d",
                    Role::Truth,
                    all.map(|n| error(n, knowing(n))),
                ));
            }
            let what = if reference.is_some() { "error" } else { "velocity" };
            Some(Panel::new("", &format!("{what} of {} [m/s]", of.axis.name()), series))
        })
        .collect();
    let caption = "The observer of the core, a two-state Kalman filter tuned to this log, and finite differences, each minus the reference \
                   of the log where it has one.";
    (!panels.is_empty()).then(|| grid("Other ways to a velocity", caption, panels))
}

/// What the input does to the vehicle, as the identifier sees it.
pub(super) fn excitation(rows: &[Vec<Row>], k: f64, log: &AxisLog) -> Option<Chart> {
    let panels: Vec<Panel> = rows
        .iter()
        .zip(names(log))
        .map(|(rows, name)| {
            // The vertical axis without the thrust that hovers.
            let (sum, count) = rows.iter().fold((0.0, 0.0), |(sum, count), row| (sum + row.z0, count + row.zu));
            let hovering = if count > 0.0 { sum / count } else { 0.0 };
            let line = rows.iter().map(|row| (log.time(row.sample), k * (row.z0 - hovering * row.zu)));
            Panel::new("", &format!("{name} [m/s²]"), vec![Series::line("k ẑ0 about its mean", Role::Core, line)])
        })
        .collect();
    let caption = "The acceleration that the input causes, windowed and filtered, about its mean. k is told by all of it, the hover thrust \
                   included; drag and disturbance only by what is seen here.";
    (!panels.is_empty()).then(|| grid("Excitation", caption, panels))
}
