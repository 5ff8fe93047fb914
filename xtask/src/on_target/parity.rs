//! Bit parity: ten seconds of flight put out the same bits on host and target: six axes in three configurations, the vehicle's
//! estimator and the regression with drag in two each.

use anyhow::{Result, bail};

use super::emulator;
use super::programs::TARGET_TESTS;
use crate::command::output;

/// A line a second; six axes: six states, four parameters and two lines of counters.
const SIX: usize = 10 + 6 + 4 + 2;
/// The vehicle: position, velocity and rates, four parameters, and counters.
const VEHICLE: usize = 10 + 3 + 4 + 1;
/// The regression: k, and drag and disturbance of each axis.
const DRAG: usize = 10 + 1 + 6;
const LINES: usize = 3 * SIX + 2 * VEHICLE + 2 * DRAG;

/// Runs `target-tests`' program `parity` on both, and on the host once with the last bit of one sample changed.
pub fn run() -> Result<()> {
    let program = TARGET_TESTS.build("parity")?;
    let target = emulator::output(&program, None)?;
    let host = on_host("0")?;
    let changed = on_host("1")?;
    compare(&host, &target)?;
    for (line, other) in host.iter().zip(&changed).filter(|(line, _)| line.contains(" 10 inputs ")) {
        if outputs(line) == outputs(other) {
            bail!("a changed sample changed no output: this comparison sees nothing in {line}");
        }
    }
    for line in target.iter().filter(|line| line.contains(" parameter ") || line.contains(" 10 inputs ")) {
        println!("  {line}");
    }
    println!("{LINES} lines, equal on host and target; one ulp in one sample changes them");
    Ok(())
}

/// The hash at the end of a line.
fn outputs(line: &str) -> Option<&str> {
    line.rsplit(' ').next()
}

fn on_host(change: &str) -> Result<Vec<String>> {
    let (manifest, folder) = (TARGET_TESTS.manifest(), TARGET_TESTS.target_folder());
    let arguments = ["run", "--quiet", "--release", "--locked", "--manifest-path", &manifest, "--target-dir", &folder];
    let text = output("cargo", &[&arguments[..], &["--bin", "parity", "--", change]].concat())?;
    let mut lines: Vec<String> = text.lines().map(String::from).collect();
    if lines.pop().as_deref() != Some("end") {
        bail!("the host's run has no end");
    }
    Ok(lines)
}

/// Both whole, and equal line by line.
fn compare(host: &[String], target: &[String]) -> Result<()> {
    for (name, lines) in [("host", host), ("target", target)] {
        if lines.len() != LINES {
            bail!("the {name} printed {} lines in place of {LINES}", lines.len());
        }
    }
    match host.iter().zip(target).find(|(a, b)| a != b) {
        Some((host, target)) => bail!("host and target differ first here:\n  host   {host}\n  target {target}"),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_or_different_outputs_are_refused() {
        let lines: Vec<String> = (0..LINES).map(|line| format!("line {line}")).collect();
        assert!(compare(&lines, &lines).is_ok());
        assert!(compare(&lines, &lines[1..]).is_err());
        assert!(compare(&[], &[]).is_err());
        let mut other = lines.clone();
        other[LINES - 1] += "0";
        assert!(compare(&lines, &other).unwrap_err().to_string().contains("target line"));
    }
}
