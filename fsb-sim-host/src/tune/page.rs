//! The trade-offs drawn.

use super::proposal::{LONGEST, Proposal};
use super::{observer, opening};
use crate::report::chart::{Chart, ChartError, Panel, Role, Series};
use crate::report::html::{Block, HowMade, Page, Section};
use crate::report::table::{Cell, Column, Table};
use fsb_core::Tuning;

/// The proposal as a table.
#[must_use]
pub fn table(of: &Proposal) -> Table {
    let columns = vec![Column::left(""), Column::right("value"), Column::left("unit"), Column::left("")];
    let mut table = Table::new("Proposed", columns);
    let mut row = |name: &str, value: f64, unit: &str, note: &str| {
        table.push(vec![Cell::text(name), Cell::significant(value, 4), Cell::text(unit), Cell::text(note)]);
    };
    row("observer λ", of.observer.lambda, "1/s", "");
    row("observer q", of.observer.q, "1/s", "");
    row("ε of the state", of.state_settle, "s", "the velocity's noise is within twice the steady one");
    row("identifier λ", of.identifier.lambda, "1/s", "");
    row("identifier q", of.identifier.q, "1/s", "");
    let within = format!("two sd of k are {} % of it", 100.0 * of.k_within);
    row("ε of the parameter", of.parameter_settle.unwrap_or(f64::NAN), "s", &within);
    row("velocity, sd", of.velocity_sd, "m/s", "");
    row("position, sd", of.position_sd, "m", "");
    row("bandwidth", of.bandwidth, "Hz", "for what the model does not know");
    row("delay", of.delay, "s", "for what the model does not know");
    let waited =
        if of.parameter_settle.is_some() { String::new() } else { format!(" k is not that good within {LONGEST} s.") };
    table.with_note(&format!(
        "Sensor: {:.4e} m of noise, every {} s. Input: gravity {} m/s², acceleration {} m/s² rms at {} Hz.{waited}",
        of.sensor.noise_sd,
        of.sensor.period,
        of.excitation.gravity,
        of.excitation.acceleration,
        of.excitation.frequency
    ))
}

/// λ of the observer over three decades, within what the core accepts.
fn lambdas(of: &Proposal) -> Vec<f64> {
    let (slowest, fastest) = of.sensor.lambdas();
    let middle = of.observer.lambda;
    (-60..=60).map(|i| middle * 10f64.powf(f64::from(i) / 40.0)).filter(|l| (slowest..=fastest).contains(l)).collect()
}

/// The figures with the names of their files, without extension.
#[must_use]
pub fn figures(of: &Proposal) -> Vec<(&'static str, Chart)> {
    let mut panels = Vec::new();
    let all = lambdas(of);
    let at = of.observer.lambda;
    for (label, value) in [
        ("sd of the velocity [m/s]", observer::velocity_sd as fn(&_, f64) -> f64),
        ("sd of the position [m]", observer::position_sd),
        ("bandwidth [Hz]", observer::bandwidth),
        ("delay [s]", observer::delay),
    ] {
        let line = all.iter().map(|&lambda| (lambda.log10(), value(&of.sensor, lambda)));
        let here = [(at.log10(), value(&of.sensor, at))];
        let series = vec![Series::line("", Role::Core, line), Series::dots("proposed", Role::PaperForm, here)];
        panels.push(Panel { log_y: true, ..Panel::new("log10 of λ [1/s]", label, series) });
    }
    let caption = "What the observer's λ trades: noise against bandwidth and delay for what the model does not know. What the input does is \
                   predicted, and neither late nor damped.";
    let trade = Chart { columns: 2, ..Chart::new("The observer's λ", caption, panels) };

    let seconds = of.parameter_settle.map_or(20.0, |t| (4.0 * t).clamp(5.0, LONGEST));
    let times: Vec<f64> = (1..=400).map(|i| seconds * f64::from(i) / 400.0).collect();
    let mut series = Vec::new();
    let fastest = of.sensor.lambdas().1;
    for (i, lambda) in [0.5, 1.0, 2.0, 4.0, 8.0].into_iter().filter(|&lambda| lambda <= fastest).enumerate() {
        let percent = of.spread(Tuning::from_lambda(lambda), &times).into_iter().map(|(t, sd)| (t, 100.0 * sd));
        let mark = if lambda == of.identifier.lambda { " (proposed)" } else { "" };
        series.push(Series::line(&format!("λ = {lambda}{mark}"), Role::Nth(i), percent));
    }
    if ![0.5, 1.0, 2.0, 4.0, 8.0].contains(&of.identifier.lambda) {
        let percent = of.spread(of.identifier, &times).into_iter().map(|(t, sd)| (t, 100.0 * sd));
        series.push(Series::line(&format!("λ = {} (proposed)", of.identifier.lambda), Role::Nth(5), percent));
    }
    series.push(Series::level("wanted: two sd", Role::Reference, 50.0 * of.k_within));
    let panel = Panel { log_y: true, ..Panel::new("t [s]", "sd of k [%]", series) };
    let caption = "Expected standard deviation of k, from the first measurement on, for the given excitation.";
    let spread = Chart::new("Time to k", caption, vec![panel]);

    let line = opening::velocity_sd(&of.sensor, of.observer, 4.0 * of.state_settle.max(of.sensor.period));
    let series = vec![Series::line("sd", Role::Core, line), Series::level("steady", Role::Reference, of.velocity_sd)];
    let panel = Panel { log_y: true, ..Panel::new("t [s]", "sd of the velocity [m/s]", series) };
    let caption =
        "Noise of the velocity after the first measurement, k being known: no first guess, nothing to swing in.";
    let opening = Chart::new("The first moments", caption, vec![panel]);
    vec![("observer", trade), ("time_to_k", spread), ("opening", opening)]
}

/// The figures as SVG, and `report.html` that holds them.
///
/// # Errors
/// [`ChartError`] of a figure that cannot be drawn.
pub fn files(of: &Proposal, how: HowMade) -> Result<Vec<(String, String)>, ChartError> {
    let mut files = Vec::new();
    let mut blocks = vec![Block::Table(table(of))];
    for (name, chart) in figures(of) {
        files.push((format!("{name}.svg"), chart.to_svg()?));
        blocks.push(Block::Figure(chart));
    }
    let summary = format!(
        "Observer λ = {:.3} 1/s, q = {:.3} 1/s; identifier λ = {} 1/s, q = {} 1/s.",
        of.observer.lambda, of.observer.q, of.identifier.lambda, of.identifier.q
    );
    let sections = vec![Section::new("Tuning", blocks)];
    let page = Page { title: "A tuning and what it gives".to_owned(), summary, sections, how };
    files.push(("report.html".to_owned(), page.to_html()?));
    Ok(files)
}
