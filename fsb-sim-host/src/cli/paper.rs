//! `fsb paper`: Section V.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use fsb_sim_host::progress::Progress;
use fsb_sim_host::report::write::{check_directory, write_files};
use fsb_sim_host::section_v::figures::Flights;
use fsb_sim_host::section_v::table1::{Row, table1};
use fsb_sim_host::section_v::{LoopStatistics, Scenario, Start, monte_carlo, page};
use serde::Serialize;

use super::{Failure, positive, print_json, print_text};

/// Fly Section V of the paper with the f32 core in the loop: Table 1, Figs. 2-9, many runs.
///
/// Two axes of a multirotor with unknown k follow a spiral on estimates made from noisy positions. Prints Table 1 beside the
/// paper's values and the statistics of all runs, and writes report.html and fig2.svg to fig9.svg.
#[derive(Debug, Parser)]
#[command(allow_negative_numbers = true)]
pub struct Args {
    /// Ticks a second [Hz]: measurement, estimation and control
    #[arg(long, value_name = "HZ", default_value_t = 10_000.0, value_parser = positive)]
    rate: f64,
    /// Standard deviation of the position noise [m]
    #[arg(long, value_name = "S", default_value_t = 0.5)]
    sigma: f64,
    /// Seed of the noise of the first run; the others have the numbers after it
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Number of runs of the Monte Carlo, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    runs: u64,
    /// Length of the flight [s]
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = positive)]
    duration: f64,
    /// λ of identifier and observer [1/s]
    #[arg(long, value_name = "L", default_value_t = 2.0, value_parser = positive)]
    lambda: f64,
    /// q of identifier and observer [1/s] [default: half of λ]
    #[arg(long, value_name = "Q", value_parser = positive)]
    q: Option<f64>,
    /// x at the start [m] [default: 0, on the reference]
    #[arg(long, value_name = "M")]
    start_x: Option<f64>,
    /// y at the start [m] [default: 1, on the reference]
    #[arg(long, value_name = "M")]
    start_y: Option<f64>,
    /// x' at the start [m/s] [default: 0]
    #[arg(long, value_name = "M/S")]
    start_vx: Option<f64>,
    /// y' at the start [m/s] [default: 0]
    #[arg(long, value_name = "M/S")]
    start_vy: Option<f64>,
    /// Directory of the report; made where it is missing
    #[arg(long, value_name = "DIR", default_value = "out/paper")]
    out: PathBuf,
    /// Print one JSON object instead of tables
    #[arg(long)]
    json: bool,
}

impl Default for Args {
    fn default() -> Self {
        Self::parse_from(["fsb paper"])
    }
}

impl Args {
    fn scenario(&self) -> Scenario {
        Scenario {
            rate: self.rate,
            sigma: self.sigma,
            duration: self.duration,
            lambda: self.lambda,
            q: self.q.unwrap_or(self.lambda / 2.0),
            seed: self.seed,
            start: Start { position: [self.start_x, self.start_y], velocity: [self.start_vx, self.start_vy] },
        }
    }

    /// The command that makes the same report again; the directory does not matter to it.
    fn command(&self) -> String {
        let Scenario { rate, sigma, duration, lambda, q, seed, .. } = self.scenario();
        let mut command = format!(
            "fsb paper --rate {rate} --sigma {sigma} --seed {seed} --runs {} --duration {duration} --lambda {lambda} --q {q}",
            self.runs
        );
        let start = [
            ("start-x", self.start_x),
            ("start-y", self.start_y),
            ("start-vx", self.start_vx),
            ("start-vy", self.start_vy),
        ];
        for (name, value) in start {
            if let Some(value) = value {
                command.push_str(&format!(" --{name} {value}"));
            }
        }
        command
    }
}

#[derive(Serialize)]
struct Json {
    runs: u64,
    rate_hz: f64,
    table1: Vec<JsonRow>,
    core: JsonLoop,
    paper_form: JsonLoop,
}

#[derive(Serialize)]
struct JsonRow {
    name: &'static str,
    #[serde(rename = "true")]
    real: f64,
    estimated: f64,
    error_percent: f64,
    paper_error_percent: f64,
}

#[derive(Serialize)]
struct JsonLoop {
    k_error_mean: f64,
    k_error_sd: f64,
    position_rms: f64,
    velocity_rms: f64,
}

impl From<&Row> for JsonRow {
    fn from(row: &Row) -> Self {
        Self {
            name: row.name,
            real: row.real,
            estimated: row.estimated,
            error_percent: row.error_percent(),
            paper_error_percent: row.paper.error_percent,
        }
    }
}

impl From<&LoopStatistics> for JsonLoop {
    fn from(of: &LoopStatistics) -> Self {
        Self {
            k_error_mean: of.k_error.mean,
            k_error_sd: of.k_error.sd,
            position_rms: of.position_rms,
            velocity_rms: of.velocity_rms,
        }
    }
}

/// Flies, prints, writes.
pub fn run(args: &Args) -> Result<ExitCode, Failure> {
    let scenario = args.scenario();
    scenario.check().map_err(|error| Failure::Usage(error.to_string()))?;
    check_directory(&args.out)?;
    let progress = Progress::new("Monte Carlo", args.runs, false);
    let result = monte_carlo(&scenario, args.runs, || progress.step())?;
    progress.finish();
    let flights = Flights::fly(&scenario)?;

    // Nothing is written before all is there.
    let files = page::files(&scenario, &result, &flights, &args.command())?;
    write_files(&args.out, &files)?;
    let report = args.out.join("report.html");
    if args.json {
        print_json(&Json {
            runs: result.runs,
            rate_hz: scenario.rate,
            table1: flights.end().map(table1).iter().flatten().map(JsonRow::from).collect(),
            core: JsonLoop::from(&result.core),
            paper_form: JsonLoop::from(&result.paper_form),
        })?;
        tell!("report: {}", report.display());
        return Ok(ExitCode::SUCCESS);
    }
    let tables = page::tables(&scenario, &result, flights.end());
    let text: String = tables.iter().map(|table| table.to_text() + "\n").collect();
    print_text(&format!("{text}report: {}, figures beside it", report.display()))?;
    Ok(ExitCode::SUCCESS)
}
