//! What a run prints: parameters over time, tracking beside the yardstick, events, many flights.

use super::able;
use super::many::{Flights, Spread};
use super::record::{Errors, Flight, NAMES, Sample, TRACKING_FROM, truths};
use super::scenario::Scenario;
use crate::report::table::{Cell, Column, Table};

/// Rows of the table over time, at most.
const ROWS: usize = 14;
/// Events printed, at most.
const EVENTS: usize = 40;

/// All tables, in order.
pub fn tables(scenario: &Scenario, flights: &Flights) -> Vec<Table> {
    let first = &flights.first;
    let mut tables = vec![over_time(scenario, first), at_times(scenario, first), tracking(first), events(first)];
    if flights.runs.len() > 1 {
        tables.push(spread(flights));
    }
    let ability = flights.runs.first().and_then(|run| able::of(scenario, run.seed));
    tables.extend(ability.as_ref().map(able::table));
    tables
}

/// Estimates ± 2 sd beside the truth.
fn over_time(scenario: &Scenario, flight: &Flight) -> Table {
    let headers = ["m [kg]", "± 2 sd", "I_x [g m²]", "± 2 sd", "I_y [g m²]", "± 2 sd", "I_z [g m²]", "± 2 sd"];
    let columns = std::iter::once(Column::right("t [s]")).chain(headers.map(Column::right)).collect();
    let mut table = Table::new(&format!("{}: what is estimated", scenario.name), columns);
    for sample in spaced(&flight.samples) {
        let mut row = vec![Cell::fixed(sample.moment.t, 1)];
        for (i, estimate) in sample.belief.parameters.iter().enumerate() {
            let (scale, decimals) = if i == 0 { (1.0, 4) } else { (1e3, 3) };
            let cell =
                |value: Option<f32>| value.map_or(Cell::Missing, |v| Cell::fixed(scale * f64::from(v), decimals));
            row.extend([cell(estimate.map(|p| p.value)), cell(estimate.map(|p| 2.0 * p.sd()))]);
        }
        table.push(row);
    }
    if let Some(last) = flight.samples.last() {
        let [m, x, y, z] = truths(&last.moment);
        let mut row = vec![Cell::text("true")];
        for (value, decimals) in [(m, 4), (1e3 * x, 3), (1e3 * y, 3), (1e3 * z, 3)] {
            row.extend([Cell::fixed(value, decimals), Cell::Missing]);
        }
        table.push(row);
    }
    table.note = "First flight. A dash: not valid yet, so not handed out.".to_owned();
    table
}

/// Errors in percent of the truth at the time, with those of the small-angle model.
fn at_times(scenario: &Scenario, flight: &Flight) -> Table {
    let mut headers = vec!["m [%]", "I_x [%]", "I_y [%]", "I_z [%]"];
    if flight.small_angle.is_some() {
        headers.extend(["small angles: I_x [%]", "I_y [%]", "I_z [%]"]);
    }
    let columns = std::iter::once("t [s]").chain(headers).map(Column::right).collect();
    let mut table = Table::new(&format!("{}: errors", scenario.name), columns);
    let times = [0.3, 0.6, 1.2, 2.0, 3.0, 5.0, 8.0, 10.0, 15.0, 20.0];
    for t in times.into_iter().filter(|t| *t < flight.flown - 0.05).chain([flight.flown]) {
        // The nearest, for at some rates no tick is just there.
        let at = |errors: &[Errors]| errors.iter().copied().min_by(|a, b| (a.t - t).abs().total_cmp(&(b.t - t).abs()));
        let Some(errors) = at(&flight.errors).filter(|e| (t - e.t).abs() < 0.099) else {
            continue;
        };
        let cell = |value: Option<f64>| value.map_or(Cell::Missing, |v| Cell::fixed(v, 3));
        let mut row = vec![Cell::fixed(errors.t, 1)];
        row.extend(errors.all().map(cell));
        if let Some(errors) = flight.small_angle.as_deref().and_then(at) {
            row.extend(errors.all().into_iter().skip(1).map(cell));
        }
        table.push(row);
    }
    if flight.small_angle.is_some() {
        table.note =
            "Small angles: the paper's (10), Euler angles as positions and no gyroscopic term, on the same flight."
                .to_owned();
    }
    table
}

/// Tracking beside the yardstick.
fn tracking(flight: &Flight) -> Table {
    let title = format!("Tracking from {TRACKING_FROM} s on");
    let columns = vec![Column::left(""), Column::right("on the estimates"), Column::right("yardstick")];
    let mut table = Table::new(&title, columns);
    let of = &flight.tracking;
    let rows = [
        ("distance from the reference, rms [mm]", of.position_rms, of.yardstick_position_rms),
        ("distance, largest [mm]", of.position_error_max, of.yardstick_position_error_max),
        ("height error, largest [mm]", of.height_error_max, of.yardstick_height_error_max),
        ("angle from the reference, rms [mrad]", of.attitude_rms, of.yardstick_attitude_rms),
        ("position estimate, rms error [mm]", flight.state.position_rms, f64::NAN),
        ("velocity estimate, rms error [mm/s]", flight.state.velocity_rms, f64::NAN),
        ("rates estimate, rms error [mrad/s]", flight.state.rates_rms, f64::NAN),
    ];
    for (name, ours, theirs) in rows {
        table.push(vec![Cell::text(name), number(1e3 * ours), number(1e3 * theirs)]);
    }
    table.note = "The yardstick flies the same law on the true parameters and the true state.".to_owned();
    table
}

fn number(value: f64) -> Cell {
    if value.is_finite() { Cell::significant(value, 3) } else { Cell::Missing }
}

/// What happened.
fn events(flight: &Flight) -> Table {
    let mut table = Table::new("Events", vec![Column::right("t [s]"), Column::left("what")]);
    for event in flight.events.iter().take(EVENTS) {
        table.push(vec![Cell::fixed(event.t, 3), Cell::text(&event.what)]);
    }
    if flight.events.len() > EVENTS {
        table.note = format!("and {} more", flight.events.len() - EVENTS);
    }
    table
}

/// The errors at the end of many flights.
fn spread(flights: &Flights) -> Table {
    let headers = ["flights with it", "median", "5 %", "95 %", "least", "most"];
    let columns = std::iter::once(Column::left("")).chain(headers.map(Column::right)).collect();
    let mut table = Table::new(&format!("{} flights", flights.runs.len()), columns);
    let mut push = |name: &str, scale: f64, spread: Option<Spread>| {
        let Some(s) = spread else { return };
        let values = [s.median, s.p05, s.p95, s.min, s.max].map(|value| Cell::significant(scale * value, 3));
        let mut row = vec![Cell::text(name), Cell::count(s.flights as u64)];
        row.extend(values);
        table.push(row);
    };
    for (i, name) in NAMES.iter().enumerate() {
        push(&format!("{name}, error at the end [%]"), 1.0, flights.errors(i));
    }
    push("distance from the reference, rms [mm]", 1e3, Spread::of(flights.runs.iter().map(|run| run.tracking[0])));
    push("angle from the reference, rms [mrad]", 1e3, Spread::of(flights.runs.iter().map(|run| run.tracking[1])));
    push("velocity estimate, rms error [mm/s]", 1e3, Spread::of(flights.runs.iter().map(|run| run.velocity)));
    table.note = format!("{} of {} flights diverged.", flights.diverged(), flights.runs.len());
    table
}

/// Early ones close together, then evenly.
fn spaced(samples: &[Sample]) -> Vec<&Sample> {
    let Some(end) = samples.last().map(|sample| sample.moment.t) else { return Vec::new() };
    let early = [0.2, 0.5, 1.0, 1.5, 2.0, 3.0].into_iter().filter(|t| *t < end);
    let from = 4.0_f64.min(end);
    let step = ((end - from) / (ROWS - 7) as f64).max(1.0);
    let late = (0..ROWS - 7).map(|i| (from + step * i as f64).round()).filter(|t| *t < end);
    let at = |t: f64| samples.iter().find(|sample| sample.moment.t >= t - 1e-9);
    let mut rows: Vec<&Sample> = early.chain(late).filter_map(at).collect();
    rows.extend(samples.last());
    rows
}
