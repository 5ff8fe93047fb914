//! `fsb exactness`: what rounding to f32 leaves.

use std::process::ExitCode;

use clap::Parser;
use fsb_sim_host::exactness::{
    CASES, Deviation, Exactness, K_LIMIT, K_LIMIT_LATE, POSITION_LIMIT, VELOCITY_LIMIT, fly,
};
use fsb_sim_host::report::table::{Cell, Column, Table};
use rayon::prelude::*;
use serde::Serialize;

use super::{Failure, print_json, print_text};

/// Fly exact plants without noise and print what is left of k, position and velocity errors in f32.
///
/// Gravity, 3 m away from the origin, swings of 1 or 2 m, 10 s, λ = 2, q = 1, observer λ = 10, q = 5. k: relative, from 0.1 s
/// and from 1 s on. Position from 0.1 s on. Velocity on the identified k from 0.5 s on, with k known from 0.1 s on. Fails
/// (exit status 1) where an error is beyond its limit.
#[derive(Debug, Parser)]
pub struct Args {
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Json {
    k_limit: f64,
    k_limit_late: f64,
    position_limit: f64,
    velocity_limit: f64,
    cases: Vec<JsonCase>,
}

#[derive(Serialize)]
struct JsonCase {
    measurement_hz: f64,
    control_hz: f64,
    block: u32,
    axes: u32,
    k: JsonDeviation,
    k_late: JsonDeviation,
    position: JsonDeviation,
    velocity: JsonDeviation,
    position_known_k: JsonDeviation,
    velocity_known_k: JsonDeviation,
    holds: bool,
}

#[derive(Serialize)]
struct JsonDeviation {
    max: f64,
    rms: f64,
}

impl From<Deviation> for JsonDeviation {
    fn from(of: Deviation) -> Self {
        Self { max: of.max(), rms: of.rms() }
    }
}

impl From<&Exactness> for JsonCase {
    fn from(of: &Exactness) -> Self {
        Self {
            measurement_hz: of.case.rate,
            control_hz: of.case.rate * f64::from(of.case.substeps),
            block: of.case.block,
            axes: of.case.axes,
            k: of.k.into(),
            k_late: of.k_late.into(),
            position: of.position.into(),
            velocity: of.velocity.into(),
            position_known_k: of.position_known.into(),
            velocity_known_k: of.velocity_known.into(),
            holds: of.holds(),
        }
    }
}

/// Flies and prints.
pub fn run(args: &Args) -> Result<ExitCode, Failure> {
    let results = CASES.par_iter().map(fly).collect::<Result<Vec<_>, _>>()?;
    if args.json {
        print_json(&Json {
            k_limit: K_LIMIT,
            k_limit_late: K_LIMIT_LATE,
            position_limit: POSITION_LIMIT,
            velocity_limit: VELOCITY_LIMIT,
            cases: results.iter().map(JsonCase::from).collect(),
        })?;
    } else {
        print_text(&table(&results).to_text())?;
    }
    let beyond = results.iter().filter(|of| !of.holds()).count();
    if beyond == 0 { Ok(ExitCode::SUCCESS) } else { Err(anyhow::anyhow!("{beyond} cases are beyond a limit").into()) }
}

fn table(results: &[Exactness]) -> Table {
    let headers = [
        "measured [Hz]",
        "control [Hz]",
        "block",
        "axes",
        "k from 0.1 s",
        "k from 1 s",
        "position [m]",
        "velocity [m/s]",
        "k known: position",
        "velocity",
    ];
    let mut table = Table::new("Largest errors without noise, f32 core", headers.map(Column::right).to_vec());
    for of in results {
        let mut row = vec![
            Cell::fixed(of.case.rate, 0),
            Cell::fixed(of.case.rate * f64::from(of.case.substeps), 0),
            Cell::count(of.case.block.into()),
            Cell::count(of.case.axes.into()),
        ];
        let errors = [of.k, of.k_late, of.position, of.velocity, of.position_known, of.velocity_known];
        row.extend(errors.map(|error| Cell::significant(error.max(), 2)));
        table.push(row);
    }
    let mut limits = vec![Cell::text("limit"), Cell::Missing, Cell::Missing, Cell::Missing];
    let values = [K_LIMIT, K_LIMIT_LATE, POSITION_LIMIT, VELOCITY_LIMIT, POSITION_LIMIT, VELOCITY_LIMIT];
    limits.extend(values.map(|limit| Cell::significant(limit, 1)));
    table.push(limits);
    table
}
