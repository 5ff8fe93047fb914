//! The firmware flies on the emulator, and tells its events to defmt.

use std::path::PathBuf;

use anyhow::{Result, bail};

use super::emulator;
use super::programs::TARGET;
use crate::command::{root, run_with};
use crate::setup;

/// Builds and flies it; its exit status is its own judgement of mass, inertias and course. With defmt it flies the same, and
/// each event must come as a frame.
pub fn run() -> Result<()> {
    setup::rust_targets()?;
    let lines = emulator::output(&build(&[])?, None)?;
    lines.iter().for_each(|line| println!("  {line}"));
    let seconds = lines.iter().filter(|line| line.contains(" s  mass ")).count();
    if seconds != 10 {
        bail!("{seconds} lines in place of one for each of 10 s");
    }
    let events = lines.iter().filter(|line| line.trim_start().starts_with("tick ")).count();
    let frames = frames(&emulator::bytes(&build(&["--features", "defmt"])?)?);
    if events == 0 || frames != events {
        bail!("{events} events, and {frames} frames of defmt");
    }
    println!("{frames} frames of defmt for {events} events");
    Ok(())
}

fn build(features: &[&str]) -> Result<PathBuf> {
    let arguments = ["build", "--release", "--locked", "--package", "fsb-firmware", "--bins", "--target", TARGET];
    run_with("cargo", &[&arguments[..], features].concat(), &[("DEFMT_LOG", "info")])?;
    Ok(root()?.join("target").join(TARGET).join("release/fsb-firmware"))
}

/// Frames of defmt's encoding (rzCOBS): each ends with a zero, and has none within.
fn frames(bytes: &[u8]) -> usize {
    bytes.split(|&byte| byte == 0).filter(|frame| !frame.is_empty()).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_end_with_a_zero() {
        assert_eq!(frames(&[]), 0);
        assert_eq!(frames(&[1, 2, 0, 3, 0, 0]), 2);
    }
}
