//! The examples build for the target.

use anyhow::Result;

use super::programs::{EMBASSY, RTIC};
use crate::command::run as run_command;
use crate::setup;

/// Builds each in release.
pub fn run() -> Result<()> {
    setup::rust_targets()?;
    for package in [RTIC, EMBASSY] {
        let arguments = package.build_arguments();
        run_command("cargo", &arguments.iter().map(String::as_str).collect::<Vec<_>>())?;
    }
    Ok(())
}
