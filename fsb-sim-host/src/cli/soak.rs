//! `fsb soak`: hours of simulated flight.

use std::process::ExitCode;

use clap::Parser;
use fsb_sim_host::progress::Progress;
use fsb_sim_host::report::table::{Cell, Column, Table};
use fsb_sim_host::soak::faulty::{self, FaultReport, soak_with_faults};
use fsb_sim_host::soak::{BOUND, K_LIMIT, POSITION_LIMIT, SoakConfig, SoakReport, VELOCITY_LIMIT, soak};
use serde::Serialize;

use super::{Failure, positive, print_json, print_text};

/// Fly for hours beside an f64 twin: no drift, no subnormal numbers, everything bounded.
///
/// Sines, hover and minutes of a silent sensor, in turn, with 1 cm of noise. The twin is given the very same samples. Fails
/// (exit status 1) where k drifts from the twin's by more than 1e-4 of it, a state by more than rounding, any number that the
/// estimator holds is subnormal or not finite, or a signal is not bounded.
///
/// With --faults the estimator stands behind the gate, and what it is given is dropped, not a number, off by metres, has bits
/// flipped, is frozen, jitters and is rounded, while the twin is given the samples as they were: k within 5e-5 of the
/// twin's, position and velocity within 5 cm and 0.2 m/s of the truth, no sensor blamed for a jump.
#[derive(Debug, Parser)]
#[command(allow_negative_numbers = true)]
pub struct Args {
    /// Simulated flight [h], at least a minute
    #[arg(long, value_name = "H", default_value_t = 1.0, value_parser = positive)]
    hours: f64,
    /// Ticks a second [Hz], 25 to 100000; with --faults 1000 to 30000
    #[arg(long, value_name = "HZ", default_value_t = 1000.0, value_parser = positive)]
    rate: f64,
    /// Seed of the noise
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Faults in every signal, through the gate
    #[arg(long)]
    faults: bool,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Json {
    hours: f64,
    rate_hz: f64,
    ticks: u64,
    k_core: f64,
    k_twin: f64,
    k_difference: f64,
    position_difference: f64,
    velocity_difference: f64,
    largest_signal: f64,
    words: u64,
    subnormal: u64,
    not_finite: u64,
    ticks_without_k: u64,
    violations: Vec<String>,
}

/// Flies and prints.
pub fn run(args: &Args) -> Result<ExitCode, Failure> {
    let config = SoakConfig { hours: args.hours, rate: args.rate, seed: args.seed };
    check(&config, args.faults).map_err(Failure::Usage)?;
    let minutes = (config.hours * 60.0).floor() as u64;
    let progress = Progress::new("simulated minutes", minutes, false);
    if args.faults {
        let report = soak_with_faults(&config, || progress.step())?;
        progress.finish();
        return print_faulty(args, &config, &report);
    }
    let report = soak(&config, || progress.step())?;
    progress.finish();
    let violations = report.violations();
    if args.json {
        print_json(&json(&config, &report))?;
    } else {
        print_text(&table(&config, &report).to_text())?;
    }
    if violations.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    Err(anyhow::anyhow!("{}", violations.join("; ")).into())
}

#[derive(Serialize)]
struct JsonFaulty {
    hours: f64,
    rate_hz: f64,
    ticks: u64,
    k_core: f64,
    k_twin: f64,
    k_difference: f64,
    position_error: f64,
    velocity_error: f64,
    largest_signal: f64,
    words: u64,
    subnormal: u64,
    not_finite: u64,
    ticks_not_valid: u64,
    missing: u32,
    rejected_non_finite: u32,
    rejected_beyond_limit: u32,
    rejected_improbable: u32,
    rejected_frozen: u32,
    jumps: u32,
    pushes: u32,
    rejected_inputs: u32,
    violations: Vec<String>,
}

fn print_faulty(args: &Args, config: &SoakConfig, report: &FaultReport) -> Result<ExitCode, Failure> {
    let violations = report.violations();
    let away = report.rejections;
    if args.json {
        print_json(&JsonFaulty {
            hours: config.hours,
            rate_hz: config.rate,
            ticks: report.ticks,
            k_core: report.k_core,
            k_twin: report.k_twin,
            k_difference: report.k_difference,
            position_error: report.position_error,
            velocity_error: report.velocity_error,
            largest_signal: report.largest_signal,
            words: report.words,
            subnormal: report.subnormal,
            not_finite: report.not_finite,
            ticks_not_valid: report.invalid,
            missing: away.missing,
            rejected_non_finite: away.non_finite,
            rejected_beyond_limit: away.beyond_limit,
            rejected_improbable: away.improbable,
            rejected_frozen: away.frozen,
            jumps: away.jumps,
            pushes: away.pushes,
            rejected_inputs: report.rejected_inputs,
            violations: violations.clone(),
        })?;
    } else {
        let title = format!("{} h of flight with faults at {} Hz, seed {}", config.hours, config.rate, config.seed);
        let mut table = Table::new(&title, vec![Column::left(""), Column::right("seen"), Column::right("limit")]);
        let mut row = |name: &str, seen: Cell, limit: Cell| {
            table.push(vec![Cell::text(name), seen, limit]);
        };
        row("k, core [1/kg]", Cell::fixed(report.k_core, 8), Cell::Missing);
        row("k, twin without faults [1/kg]", Cell::fixed(report.k_twin, 8), Cell::Missing);
        for (name, seen, limit) in [
            ("difference of k over k, largest", report.k_difference, faulty::K_LIMIT),
            ("error of a position [m]", report.position_error, faulty::POSITION_LIMIT),
            ("error of a velocity [m/s]", report.velocity_error, faulty::VELOCITY_LIMIT),
            ("largest signal [SI units]", report.largest_signal, BOUND),
        ] {
            row(name, Cell::significant(seen, 3), Cell::significant(limit, 1));
        }
        for (name, seen) in [
            ("numbers looked at", report.words),
            ("measurements that did not come", away.missing.into()),
            ("not finite", away.non_finite.into()),
            ("beyond the limit", away.beyond_limit.into()),
            ("improbable", away.improbable.into()),
            ("frozen", away.frozen.into()),
            ("inputs replaced", report.rejected_inputs.into()),
        ] {
            row(name, Cell::count(seen), Cell::Missing);
        }
        for (name, seen) in [
            ("subnormal among the numbers", report.subnormal),
            ("not finite among them", report.not_finite),
            ("ticks without a valid k or state", report.invalid),
            ("jumps", away.jumps.into()),
            ("pushes", away.pushes.into()),
        ] {
            row(name, Cell::count(seen), Cell::count(0));
        }
        print_text(&table.to_text())?;
    }
    if violations.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    Err(anyhow::anyhow!("{}", violations.join("; ")).into())
}

/// Names the parameter that cannot be right.
fn check(config: &SoakConfig, faults: bool) -> Result<(), String> {
    let rates = if faults { faulty::RATES } else { 25.0..=1e5 };
    if !rates.contains(&config.rate) {
        let when = if faults { "with --faults it " } else { "" };
        return Err(format!("--rate {}: {when}must be between {} and {} Hz", config.rate, rates.start(), rates.end()));
    }
    if config.hours < 1.0 / 60.0 || config.ticks() > 100_000_000_000 {
        return Err(format!("--hours {}: must be at least 1/60, and at most 1e11 ticks", config.hours));
    }
    Ok(())
}

fn json(config: &SoakConfig, report: &SoakReport) -> Json {
    Json {
        hours: config.hours,
        rate_hz: config.rate,
        ticks: report.ticks,
        k_core: report.k_core,
        k_twin: report.k_twin,
        k_difference: report.k_difference,
        position_difference: report.position_difference,
        velocity_difference: report.velocity_difference,
        largest_signal: report.largest_signal,
        words: report.words,
        subnormal: report.subnormal,
        not_finite: report.not_finite,
        ticks_without_k: report.without_k,
        violations: report.violations(),
    }
}

fn table(config: &SoakConfig, report: &SoakReport) -> Table {
    let title = format!("{} h of flight at {} Hz, seed {}", config.hours, config.rate, config.seed);
    let mut table = Table::new(&title, vec![Column::left(""), Column::right("seen"), Column::right("limit")]);
    let mut row = |name: &str, seen: Cell, limit: Cell| {
        table.push(vec![Cell::text(name), seen, limit]);
    };
    row("k, core [1/kg]", Cell::fixed(report.k_core, 8), Cell::Missing);
    row("k, twin [1/kg]", Cell::fixed(report.k_twin, 8), Cell::Missing);
    for (name, seen, limit) in [
        ("difference of k over k, largest", report.k_difference, K_LIMIT),
        ("difference of a position [m]", report.position_difference, POSITION_LIMIT),
        ("difference of a velocity [m/s]", report.velocity_difference, VELOCITY_LIMIT),
        ("largest signal [SI units]", report.largest_signal, BOUND),
    ] {
        row(name, Cell::significant(seen, 3), Cell::significant(limit, 1));
    }
    row("numbers looked at", Cell::count(report.words), Cell::Missing);
    row("subnormal among them", Cell::count(report.subnormal), Cell::count(0));
    row("not finite among them", Cell::count(report.not_finite), Cell::count(0));
    row("ticks without a valid k", Cell::count(report.without_k), Cell::count(0));
    table
}
