//! What came out, as a table.

use super::feed::ParameterTrace;
use super::flight::ThrustUnit;
use super::result::{AxisResult, ReplayResult};
use super::summary::{Summary, about};
use crate::report::table::{Cell, Column, Table};
use fsb_core::readout::ParameterStatus;

/// The parameters and axes of a replay, one a row, for the terminal and for the page. `hovering` is the gravity g \[m/s²\] where the
/// input is a share of the full thrust: then k tells no mass but the hover thrust g/k.
pub fn table(result: &ReplayResult, hovering: Option<f64>) -> Table {
    let columns = vec![
        Column::left("parameter"),
        Column::left("from"),
        Column::right("value"),
        Column::right("sd"),
        Column::left("unit"),
        Column::right("velocity rms error"),
        Column::left("status at the end"),
    ];
    let mut table = Table::new("Parameters and axes", columns);
    if let Some(mass) = &result.mass {
        let names: Vec<&str> = result.axes.iter().filter(|a| a.axis.is_translation()).map(|a| a.axis.name()).collect();
        let kind = match hovering {
            Some(gravity) => Kind { parameter: "hover thrust", unit: "of full thrust", factor: gravity },
            None => Kind { parameter: "mass", unit: "kg", factor: 1.0 },
        };
        table.push(row(kind, &names.join(", "), mass, None));
        for axis in result.axes.iter().filter(|a| a.axis.is_translation()) {
            table.push(row(kind, &format!("{} alone", axis.axis.name()), &axis.own, Some(axis)));
        }
    }
    for axis in result.rotational() {
        let parameter = format!("inertia {}", about(axis));
        let kind = Kind { parameter: &parameter, unit: "kg m²", factor: 1.0 };
        table.push(row(kind, axis.axis.name(), &axis.own, Some(axis)));
    }
    let informed = match result.axes.iter().any(|axis| axis.velocity_rms_error_on_the_way.is_some()) {
        true => {
            " It is that of an observer that knows from the first sample on what is identified at the end, its window open."
        }
        false => "",
    };
    table.with_note(&format!(
        "{} samples {} s apart, {} positions missing. sd: as far as measurement noise causes it. Velocity [m/s or rad/s]: of the estimate (x, y, z with the pooled mass) \
         against the reference of the log.{informed}",
        result.samples, result.period, result.missed
    ))
}

/// The tables of a replay for the terminal: parameters and axes, what was identified beside k, and the offset of the input.
pub fn text(result: &ReplayResult, summary: &Summary, gravity: f64) -> String {
    let mut text = table(result, summary.hover_thrust.map(|_| gravity)).to_text();
    if result.identified.is_some() {
        text.push_str(&format!("\n{}", terms(summary).to_text()));
    }
    if let Some(hover) = &summary.hover_thrust {
        let known = |value: Option<f64>| value.map_or_else(|| "none".to_owned(), |value| format!("{value:.4}"));
        let (value, sd, own) = (known(hover.value), known(hover.sd), known(hover.px4));
        text.push_str(&format!(
            "\nhover thrust g/k {value} of the full thrust, sd {sd}; the flight controller's own: {own}\n"
        ));
    }
    text
}

/// What was identified beside k.
pub fn terms(summary: &Summary) -> Table {
    let columns = vec![
        Column::left("axis"),
        Column::right("drag D [1/s]"),
        Column::right("sd"),
        Column::right("disturbance d [m/s²]"),
        Column::right("sd"),
    ];
    let mut table = Table::new("Drag and disturbance, y'' = k f - D y' + c + d", columns);
    for (name, axis) in &summary.axes.0 {
        let Some(terms) = axis.terms else { continue };
        let cell = |value: Option<f32>| value.map_or(Cell::Missing, |value| Cell::fixed(f64::from(value), 3));
        let cells = [terms.drag, terms.drag_sd, terms.disturbance, terms.disturbance_sd].map(cell);
        table.push([vec![Cell::text(name)], cells.into()].concat());
    }
    let left = summary.residual_rms.flatten().map_or_else(String::new, |rms| format!(" Left over: {rms:.4} m/s² rms."));
    let lag = summary
        .lag_s
        .map_or_else(String::new, |lag| format!(" The input acts {:.1} ms after its time stamps.", 1e3 * lag));
    table.with_note(&format!("No value: not asked for, or the data do not tell.{left}{lag}"))
}

/// Why each parameter that is not valid at the end is not, a line each: the pooled mass, or hover thrust of a `unit` that
/// tells no mass, and the moments of inertia.
pub fn invalid(result: &ReplayResult, unit: ThrustUnit) -> Vec<String> {
    let name = if unit == ThrustUnit::Normalised { "hover thrust" } else { "mass" };
    let mass = result.mass.iter().map(|trace| (name.to_owned(), trace));
    let inertia = result.rotational().map(|a| (format!("inertia {}", about(a)), &a.own));
    mass.chain(inertia)
        .filter(|(_, trace)| trace.last().is_none())
        .map(|(name, trace)| format!("{name} is not valid: {}{}", trace.status, reason(trace.status)))
        .collect()
}

/// The status in more words.
fn reason(status: ParameterStatus) -> &'static str {
    match status {
        ParameterStatus::Settling => " (the log is too short for this λ)",
        ParameterStatus::Unexcited => {
            " (no input that tells anything: zero, beyond 1e6, or in a log too short for this λ)"
        }
        ParameterStatus::Uncertain => " (the standard deviation of k is above 5 % of k, or the log too short to tell)",
        ParameterStatus::BelowRange => " (k is negative, or below 1e-6)",
        ParameterStatus::AboveRange => " (k is above 1e9)",
        _ => "",
    }
}

/// What 1/k̂, times a factor, is.
#[derive(Clone, Copy)]
struct Kind<'a> {
    parameter: &'a str,
    unit: &'a str,
    factor: f64,
}

fn row(kind: Kind<'_>, from: &str, trace: &ParameterTrace, axis: Option<&AxisResult>) -> Vec<Cell> {
    let (value, sd) = trace.last().map_or((f64::NAN, f64::NAN), |k| {
        let (value, sd) = k.inverse_with_sd();
        (kind.factor * f64::from(value), kind.factor * f64::from(sd))
    });
    let error = axis.and_then(|a| a.velocity_rms_error);
    vec![
        Cell::text(kind.parameter),
        Cell::text(from),
        Cell::significant(value, 5),
        Cell::significant(sd, 2),
        Cell::text(kind.unit),
        error.map_or(Cell::Missing, |e| Cell::significant(e, 3)),
        Cell::text(&trace.status.to_string()),
    ]
}
