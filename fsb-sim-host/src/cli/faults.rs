//! `fsb faults`: bad input, faults, and what is left of them.

use std::process::ExitCode;

use clap::Parser;
use fsb_sim_host::faults::burst::{self, Aftermath, BURSTS, Burst};
use fsb_sim_host::faults::jitter::{self, Effect};
use fsb_sim_host::faults::recovery::{self, BadValue, Place, Recovery};
use fsb_sim_host::faults::sweep::{self, Row};
use fsb_sim_host::report::table::{Cell, Column, Table};
use serde::Serialize;

use super::{Failure, print_json, print_text};

/// Feed bad values and faults to the estimator, bare and behind the gate, and print what becomes of velocity and k.
///
/// One bad measurement and one bad input among good ones; a second of each kind of fault, then clean samples; sampling
/// instants that jitter; noise, dropout, outliers, jitter and a change of mass together. Fails (exit status 1) where, N ticks
/// after the last bad sample, the velocity's error is larger than promised.
#[derive(Debug, Parser)]
pub struct Args {
    /// Seed of noise and faults
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Print one JSON object instead of tables
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Json {
    bad_measurements: Vec<JsonBad>,
    bad_inputs: Vec<JsonBad>,
    bursts: Vec<JsonBurst>,
    jitter: Vec<JsonJitter>,
    sweep: Vec<JsonRow>,
}

#[derive(Serialize)]
struct JsonBad {
    value: String,
    guarded: JsonRecovery,
    bare: JsonRecovery,
}

#[derive(Serialize)]
struct JsonRecovery {
    used: bool,
    velocity: f64,
    k: Option<f64>,
    ticks: Option<u32>,
}

#[derive(Serialize)]
struct JsonBurst {
    name: &'static str,
    what: &'static str,
    flights: u64,
    unused: f64,
    velocity_during: f64,
    velocity_after: f64,
    k: f64,
    ticks: u32,
    limit: f64,
    holds: bool,
}

#[derive(Serialize)]
struct JsonJitter {
    percent: f64,
    rate_hz: f64,
    noise: f64,
    velocity_rms: f64,
    velocity_worst: f64,
    k: f64,
    rejected: u32,
}

#[derive(Serialize)]
struct JsonRow {
    noise: f64,
    dropout: f64,
    outliers: f64,
    jitter: f64,
    mass_step: f64,
    mass_end: f64,
    mass_worst: f64,
    velocity_end: f64,
    velocity_worst: f64,
    rejected: u32,
    invalid: u32,
}

/// Flies and prints.
pub fn run(args: &Args) -> Result<ExitCode, Failure> {
    let measurements = recovery::table(Place::Measurement, args.seed)?;
    let inputs = recovery::table(Place::Input, args.seed)?;
    let seen = BURSTS.iter().map(|burst| Ok((burst, burst::fly(burst, args.seed)?)));
    let bursts = seen.collect::<Result<Vec<(&Burst, Aftermath)>, Failure>>()?;
    let (jitter, sweep) = (jitter::table(args.seed)?, sweep::table(args.seed)?);
    if args.json {
        print_json(&Json {
            bad_measurements: measurements.iter().map(json_bad).collect(),
            bad_inputs: inputs.iter().map(json_bad).collect(),
            bursts: bursts.iter().map(|(burst, seen)| json_burst(burst, seen)).collect(),
            jitter: jitter.iter().map(json_jitter).collect(),
            sweep: sweep.iter().map(json_row).collect(),
        })?;
    } else {
        let tables = [
            bad_table("One bad measurement", &measurements),
            bad_table("One bad input, motors of at most 32 N", &inputs),
            burst_table(&bursts),
            jitter_table(&jitter),
            sweep_table(&sweep),
        ];
        print_text(&tables.map(|table| table.to_text()).join("\n"))?;
    }
    let broken: Vec<_> =
        bursts.iter().filter(|(burst, seen)| !burst.holds(seen)).map(|(burst, _)| burst.name).collect();
    if broken.is_empty() {
        Ok(ExitCode::SUCCESS)
    } else {
        Err(anyhow::anyhow!("not back in time after {}", broken.join(", ")).into())
    }
}

fn json_bad(of: &BadValue) -> JsonBad {
    let recovery = |of: &Recovery| JsonRecovery { used: of.used, velocity: of.velocity, k: of.k, ticks: of.ticks };
    JsonBad { value: recovery::name(of.value), guarded: recovery(&of.guarded), bare: recovery(&of.bare) }
}

fn json_burst(of: &Burst, seen: &Aftermath) -> JsonBurst {
    JsonBurst {
        name: of.name,
        what: of.what,
        flights: burst::SEEDS,
        unused: seen.unused,
        velocity_during: seen.during,
        velocity_after: seen.after,
        k: seen.k,
        ticks: of.ticks,
        limit: of.limit,
        holds: of.holds(seen),
    }
}

fn json_jitter(of: &Effect) -> JsonJitter {
    JsonJitter {
        percent: 100.0 * short(of.share),
        rate_hz: of.rate,
        noise: of.noise,
        velocity_rms: of.velocity_rms,
        velocity_worst: of.velocity,
        k: of.k,
        rejected: of.rejected,
    }
}

fn json_row(of: &Row) -> JsonRow {
    JsonRow {
        noise: of.case.noise,
        dropout: short(of.case.dropout),
        outliers: short(of.case.outliers),
        jitter: short(of.case.jitter),
        mass_step: of.case.step,
        mass_end: of.mass_end,
        mass_worst: of.mass_worst,
        velocity_end: of.velocity_end,
        velocity_worst: of.velocity_worst,
        rejected: of.rejected,
        invalid: of.invalid,
    }
}

/// A share without what f32 adds to it.
fn short(share: f32) -> f64 {
    (f64::from(share) * 1e6).round() / 1e6
}

fn table(title: &str, words: usize, headers: &[&str]) -> Table {
    let column =
        |(index, header): (usize, &&str)| if index < words { Column::left(header) } else { Column::right(header) };
    Table::new(title, headers.iter().enumerate().map(column).collect())
}

fn bad_table(title: &str, rows: &[BadValue]) -> Table {
    let headers =
        ["value", "gate: used", "v off [m/s]", "k off", "back after", "bare: used", "v off", "k off", "back after"];
    let mut table = table(title, 1, &headers);
    for row in rows {
        let mut cells = vec![Cell::text(&recovery::name(row.value))];
        for of in [&row.guarded, &row.bare] {
            cells.push(Cell::text(if of.used { "yes" } else { "no" }));
            cells.push(Cell::significant(of.velocity, 2));
            cells.push(of.k.map_or(Cell::text("withdrawn"), |k| Cell::significant(k, 2)));
            cells.push(of.ticks.map_or(Cell::text("not in 20 s"), |ticks| Cell::count(ticks.into())));
        }
        table.push(cells);
    }
    table
}

fn burst_table(rows: &[(&Burst, Aftermath)]) -> Table {
    let title = format!("A second of faults, then clean samples; the worst of {} flights", burst::SEEDS);
    let headers = ["fault", "", "unused [%]", "v off in it [m/s]", "N", "v off from then on", "E", "k off"];
    let mut table = table(&title, 2, &headers);
    for (of, seen) in rows {
        table.push(vec![
            Cell::text(of.name),
            Cell::text(of.what),
            Cell::fixed(100.0 * seen.unused, 0),
            Cell::significant(seen.during, 2),
            Cell::count(of.ticks.into()),
            Cell::significant(seen.after, 2),
            Cell::significant(of.limit, 1),
            Cell::significant(seen.k, 2),
        ]);
    }
    table
}

fn jitter_table(rows: &[Effect]) -> Table {
    let headers = ["rate [Hz]", "noise [m]", "± %", "v off, rms [m/s]", "worst", "k off after 60 s", "turned away"];
    let mut table = table("Sampling instants that jitter", 0, &headers);
    for of in rows {
        table.push(vec![
            Cell::fixed(of.rate, 0),
            Cell::fixed(of.noise, 3),
            Cell::fixed(100.0 * short(of.share), 0),
            Cell::significant(of.velocity_rms, 2),
            Cell::significant(of.velocity, 2),
            Cell::significant(of.k, 2),
            Cell::count(of.rejected.into()),
        ]);
    }
    table
}

fn sweep_table(rows: &[Row]) -> Table {
    let headers = [
        "noise [m]",
        "dropout",
        "outliers",
        "jitter",
        "mass step",
        "mass off [%]",
        "worst",
        "v off [m/s]",
        "worst",
        "turned away",
        "not valid",
    ];
    let mut table = table("Together", 0, &headers);
    for of in rows {
        table.push(vec![
            Cell::fixed(of.case.noise, 3),
            Cell::fixed(of.case.dropout.into(), 1),
            Cell::fixed(of.case.outliers.into(), 1),
            Cell::fixed(of.case.jitter.into(), 1),
            Cell::fixed(of.case.step, 1),
            Cell::significant(100.0 * of.mass_end, 3),
            Cell::significant(100.0 * of.mass_worst, 3),
            Cell::significant(of.velocity_end, 3),
            Cell::significant(of.velocity_worst, 3),
            Cell::count(of.rejected.into()),
            Cell::count(of.invalid.into()),
        ]);
    }
    table
}
