//! The firmware flies on the emulator.

use anyhow::{Result, bail};

use super::emulator;
use super::programs::TARGET;
use crate::command::{root, run as run_command};
use crate::setup;

/// Builds and flies it; its exit status is its own judgement of mass, inertias and course.
pub fn run() -> Result<()> {
    setup::rust_targets()?;
    run_command("cargo", &["build", "--release", "--locked", "--package", "fsb-firmware", "--target", TARGET])?;
    let program = root()?.join("target").join(TARGET).join("release/fsb-firmware");
    let lines = emulator::output(&program, None)?;
    lines.iter().for_each(|line| println!("  {line}"));
    let seconds = lines.iter().filter(|line| line.contains(" s  mass ")).count();
    if seconds != 10 {
        bail!("{seconds} lines in place of one for each of 10 s");
    }
    Ok(())
}
