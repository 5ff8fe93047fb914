//! How large: the state of the six-axis estimator, the code of a tick, and the stack it uses; the same of the vehicle's estimator.

use std::path::Path;

use anyhow::{Context, Result};

use super::budgets::{self, Measured};
use super::emulator;
use super::listing::Listing;
use super::programs::TARGET_TESTS;

/// The functions a tick consists of.
pub const TICK: &[&str] = &["six_measure", "six_apply", "six_states", "six_parameters"];

/// Measures, compares with `budgets.toml`.
pub fn run() -> Result<()> {
    let program = TARGET_TESTS.build("tick")?;
    let mut measured = Measured::new();
    for line in emulator::output(&program, Some("size"))? {
        measured.push(pair(&line, "bytes_of_")?);
    }
    let listing = Listing::of(&program)?;
    let mut code = 0;
    for function in listing.reachable(TICK)? {
        let body = listing.functions.get(&function).context("a function without a body")?;
        println!("  {:>6} bytes {}", body.size, body.name);
        code += body.size;
    }
    measured.push(("bytes_of_code".into(), f64::from(code)));
    measured.push(("bytes_of_stack".into(), deepest(&program)?));
    let vehicle = TARGET_TESTS.build("vehicle")?;
    for line in emulator::output(&vehicle, Some("size"))? {
        measured.push(pair(&line, "bytes_of_")?);
    }
    measured.push(("bytes_of_vehicle_stack".into(), deepest(&vehicle)?));
    budgets::check("size", &measured)
}

/// The most stack that any of the program's calls uses.
fn deepest(program: &Path) -> Result<f64> {
    let parts: Measured =
        emulator::output(program, Some("stack"))?.iter().map(|line| pair(line, "stack of ")).collect::<Result<_>>()?;
    for (name, bytes) in &parts {
        println!("  {bytes:>6} bytes {name}");
    }
    Ok(parts.iter().map(|(_, bytes)| *bytes).fold(0.0, f64::max))
}

/// `name 123`
fn pair(line: &str, prefix: &str) -> Result<(String, f64)> {
    let (name, number) = line.split_once(' ').with_context(|| format!("not understood: {line}"))?;
    Ok((format!("{prefix}{name}"), number.parse().with_context(|| format!("no number in: {line}"))?))
}
