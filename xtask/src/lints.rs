//! Formatting, lints and documentation.

use anyhow::Result;

use crate::command::{run, run_with};
use crate::on_target::programs::{OUTSIDE, TARGET};
use crate::setup;

/// `cargo fmt`, checking only.
pub fn fmt() -> Result<()> {
    run("cargo", &["fmt", "--all", "--check"])?;
    OUTSIDE.iter().try_for_each(|package| run("cargo", &["fmt", "--check", "--manifest-path", &package.manifest()]))
}

/// `cargo clippy` on everything; on what is outside the workspace for the microcontroller.
pub fn clippy() -> Result<()> {
    run("cargo", &["clippy", "--workspace", "--all-targets", "--all-features", "--", "-D", "warnings"])?;
    setup::rust_targets()?;
    for package in OUTSIDE {
        let (manifest, folder) = (package.manifest(), package.target_folder());
        let what = ["clippy", "--release", "--locked", "--bins", "--manifest-path", &manifest, "--target-dir", &folder];
        run("cargo", &[&what[..], &["--target", TARGET, "--", "-D", "warnings"]].concat())?;
    }
    Ok(())
}

/// `cargo doc`: broken links and missing documentation are errors.
pub fn doc() -> Result<()> {
    run_with("cargo", &["doc", "--no-deps", "--workspace", "--all-features"], &[("RUSTDOCFLAGS", "-D warnings")])
}
