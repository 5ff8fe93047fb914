//! `fsb efficiency`: what the estimate of k is worth.

use std::process::ExitCode;

use clap::Parser;
use fsb_sim_host::progress::Progress;
use fsb_sim_host::report::table::{Cell, Column, Table};
use fsb_sim_host::section_v::Scenario;
use fsb_sim_host::section_v::open_loop::{Row, open_loop, open_loop_config};
use serde::Serialize;

use super::{Failure, positive, print_json, print_text};

/// Compare the spread of the estimated k with the Cramér-Rao bound, and the reported deviation with the truth.
///
/// Open loop: the positions and forces of the noise-free Section V, new noise in every run. The bound is that of a batch fit
/// of the initial state of both axes and k to all raw positions so far. Also prints how often two reported standard
/// deviations hold the truth.
#[derive(Debug, Parser)]
#[command(allow_negative_numbers = true)]
pub struct Args {
    /// Number of runs, 2 to 10000000
    #[arg(long, value_name = "N", default_value_t = 4000, value_parser = clap::value_parser!(u64).range(2..=10_000_000))]
    runs: u64,
    /// Ticks a second [Hz]
    #[arg(long, value_name = "HZ", default_value_t = 10_000.0, value_parser = positive)]
    rate: f64,
    /// Standard deviation of the position noise [m]
    #[arg(long, value_name = "S", default_value_t = 0.5, value_parser = positive)]
    sigma: f64,
    /// Seed of the noise of the first run; the others have the numbers after it
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Json {
    runs: u64,
    rate_hz: f64,
    sigma: f64,
    times: Vec<JsonRow>,
}

#[derive(Serialize)]
struct JsonRow {
    t: f64,
    runs_with_k: u64,
    k_error_mean: f64,
    k_error_sd: f64,
    cramer_rao_sd: f64,
    ratio: f64,
    ratio_standard_error: f64,
    reported_sd: f64,
    coverage: f64,
    coverage_low: f64,
    coverage_high: f64,
}

impl From<&Row> for JsonRow {
    fn from(row: &Row) -> Self {
        let (coverage_low, coverage_high) = row.coverage.interval();
        Self {
            t: row.t,
            runs_with_k: row.coverage.given,
            k_error_mean: row.error.mean,
            k_error_sd: row.error.sd,
            cramer_rao_sd: row.bound,
            ratio: row.ratio(),
            ratio_standard_error: row.ratio() * row.error.sd_relative_error(),
            reported_sd: row.reported_sd,
            coverage: row.coverage.share(),
            coverage_low,
            coverage_high,
        }
    }
}

/// Runs and prints.
pub fn run(args: &Args) -> Result<ExitCode, Failure> {
    let scenario = Scenario { rate: args.rate, sigma: args.sigma, seed: args.seed, ..Scenario::default() };
    scenario.check().map_err(|error| Failure::Usage(error.to_string()))?;
    let progress = Progress::new("runs", args.runs, false);
    let rows = open_loop(&scenario, &open_loop_config(&scenario), args.runs, || progress.step())?;
    progress.finish();
    if args.json {
        let times = rows.iter().map(JsonRow::from).collect();
        print_json(&Json { runs: args.runs, rate_hz: args.rate, sigma: args.sigma, times })?;
    } else {
        print_text(&table(args, &rows).to_text())?;
    }
    Ok(ExitCode::SUCCESS)
}

fn table(args: &Args, rows: &[Row]) -> Table {
    let headers = [
        "t [s]",
        "runs with k",
        "sd of k [1/kg]",
        "Cramér-Rao [1/kg]",
        "ratio",
        "± 1 s.e.",
        "reported sd [1/kg]",
        "2 sd hold [%]",
    ];
    let title = format!("Spread of k over {} runs at {} Hz, {} m of noise", args.runs, args.rate, args.sigma);
    let mut table = Table::new(&title, headers.map(Column::right).to_vec());
    for row in rows {
        table.push(vec![
            Cell::fixed(row.t, 1),
            Cell::count(row.coverage.given),
            Cell::significant(row.error.sd, 3),
            Cell::significant(row.bound, 3),
            Cell::fixed(row.ratio(), 3),
            Cell::fixed(row.ratio() * row.error.sd_relative_error(), 3),
            Cell::significant(row.reported_sd, 3),
            Cell::fixed(100.0 * row.coverage.share(), 1),
        ]);
    }
    table
}
