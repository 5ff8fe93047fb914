//! The report: tables for the terminal and the page, figures, and how it was made.

use super::figures::Flights;
use super::flight::Moment;
use super::monte_carlo::{COVERAGE_TIMES, LoopStatistics, MonteCarlo};
use super::scenario::{K, Scenario};
use super::table1::{Row, table1};
use crate::report::chart::ChartError;
use crate::report::html::{Block, HowMade, Page, Section};
use crate::report::table::{Cell, Column, Table};

/// Table 1 beside the paper's.
fn table_one(rows: &[Row; 5], duration: f64) -> Table {
    let headers = ["real", "estimated", "error %", "paper: real", "estimated", "error %"];
    let mut table = Table::new(&format!("Table 1. Parameter and states at t = {duration} s"), columns(&headers));
    for row in rows {
        table.push(vec![
            Cell::text(row.symbol),
            Cell::fixed(row.real, 4),
            Cell::fixed(row.estimated, 4),
            Cell::fixed(row.error_percent(), 4),
            Cell::fixed(row.paper.real, 4),
            Cell::fixed(row.paper.estimated, 4),
            Cell::fixed(row.paper.error_percent, 4),
        ]);
    }
    table.note = "First run, f32 core. The paper's values are those of its own noise, at its t = 10 s.".to_owned();
    table
}

/// The paper's errors in the spread of the core's.
fn table_spread(rows: &[Row; 5], core: &LoopStatistics, duration: f64) -> Table {
    let headers = ["core: mean error", "sd", "paper: error", "in sd of the core"];
    let mut table = Table::new(&format!("Errors at t = {duration} s over the runs"), columns(&headers));
    let [x, y, vx, vy] = core.state_error;
    for (row, error) in rows.iter().zip([core.k_error, x, y, vx, vy]) {
        let of_paper = row.paper.estimated - row.paper.real;
        table.push(vec![
            Cell::text(row.symbol),
            Cell::fixed(error.mean, 5),
            Cell::fixed(error.sd, 5),
            Cell::fixed(of_paper, 4),
            Cell::fixed(of_paper / error.sd, 1),
        ]);
    }
    table
}

/// A column of words without a heading, then columns of numbers.
fn columns(headers: &[&str]) -> Vec<Column> {
    std::iter::once(Column::left("")).chain(headers.iter().map(|header| Column::right(header))).collect()
}

/// Both loops over all runs.
fn table_runs(scenario: &Scenario, result: &MonteCarlo) -> Table {
    let headers = ["k error, mean", "k error, sd", "position rms [m]", "velocity rms [m/s]"];
    let mut table = Table::new(&format!("{} runs, seeds from {}", result.runs, scenario.seed), columns(&headers));
    for (name, of) in [("f32 core", &result.core), ("paper form, f64", &result.paper_form)] {
        table.push(vec![
            Cell::text(name),
            Cell::significant(of.k_error.mean, 3),
            Cell::significant(of.k_error.sd, 3),
            Cell::significant(of.position_rms, 3),
            Cell::significant(of.velocity_rms, 3),
        ]);
    }
    table.note = "Each flies its own loop on the same noise. k at the end [1/kg]; rms of the error vectors in the plane, 2 s to \
                  the end, all runs."
        .to_owned();
    table
}

/// Coverage of the core's reported standard deviation in its own closed loop.
fn table_coverage(core: &LoopStatistics) -> Table {
    let headers = ["t [s]", "runs with k", "2 sd hold the truth [%]", "95 % interval from [%]", "to [%]"];
    let mut table = Table::new("Reported standard deviation of k", headers.map(Column::right).to_vec());
    for (t, coverage) in COVERAGE_TIMES.iter().zip(&core.coverage).filter(|(_, coverage)| coverage.runs > 0) {
        let (low, high) = coverage.interval();
        table.push(vec![
            Cell::fixed(*t, 0),
            Cell::count(coverage.given),
            Cell::fixed(100.0 * coverage.share(), 1),
            Cell::fixed(100.0 * low, 1),
            Cell::fixed(100.0 * high, 1),
        ]);
    }
    table
}

/// The settings behind the page, as name and value.
fn parameters(scenario: &Scenario, runs: u64) -> Vec<(String, String)> {
    let [(x, vx), (y, vy)] = scenario.initial_state();
    [
        ("tick rate", format!("{} Hz", scenario.rate)),
        ("position noise, standard deviation", format!("{} m", scenario.sigma)),
        ("duration", format!("{} s", scenario.duration)),
        ("runs", runs.to_string()),
        ("λ", format!("{} 1/s", scenario.lambda)),
        ("q", format!("{} 1/s", scenario.q)),
        ("samples to a block of the core's identifier", scenario.block().to_string()),
        ("real k", format!("{K} 1/kg")),
        ("k0, until ε = 1 s", format!("{} 1/kg", super::scenario::K0)),
        ("K_P, K_D", format!("{} 1/s², {} 1/s", super::KP, super::KD)),
        ("start", format!("({x}, {y}) m, ({vx}, {vy}) m/s")),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}

/// The tables, in order; those of t_f come from the last moment of the first run.
pub fn tables(scenario: &Scenario, result: &MonteCarlo, end: Option<&Moment>) -> Vec<Table> {
    let mut tables = vec![table_runs(scenario, result), table_coverage(&result.core)];
    if let Some(rows) = end.map(table1) {
        tables.insert(0, table_spread(&rows, &result.core, scenario.duration));
        tables.insert(0, table_one(&rows, scenario.duration));
    }
    tables
}

/// All files of the report: `report.html`, `fig2.svg` … `fig9.svg`.
///
/// # Errors
/// [`ChartError`] of a figure that cannot be drawn.
pub fn files(
    scenario: &Scenario,
    result: &MonteCarlo,
    flights: &Flights,
    command: &str,
) -> Result<Vec<(String, String)>, ChartError> {
    let figures = flights.figures();
    let mut files = Vec::with_capacity(figures.len() + 1);
    for (name, chart) in &figures {
        files.push(((*name).to_owned(), chart.to_svg()?));
    }
    let results = tables(scenario, result, flights.end()).into_iter().map(Block::Table).collect();
    let page = Page {
        title: "FSB: Section V of the paper, reproduced".to_owned(),
        summary: format!(
            "k is read as {} from positions with {} m of noise, and the loop flies on the estimates: {} runs, f32 core.",
            flights.end().and_then(|end| end.belief.k).map_or("not valid".to_owned(), |k| format!("{k:.4}/kg")),
            scenario.sigma,
            result.runs
        ),
        sections: vec![
            Section::new("Results", results),
            Section::new("Figures", figures.into_iter().map(|(_, chart)| Block::Figure(chart)).collect()),
        ],
        how: HowMade {
            command: command.to_owned(),
            version: concat!("fsb ", env!("CARGO_PKG_VERSION")).to_owned(),
            parameters: parameters(scenario, result.runs),
            seed: Some(scenario.seed),
        },
    };
    files.push(("report.html".to_owned(), page.to_html()?));
    Ok(files)
}
