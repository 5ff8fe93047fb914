//! Formatting, lints and documentation.

use anyhow::Result;

use crate::command::{run, run_with};

/// `cargo fmt`, checking only.
pub fn fmt() -> Result<()> {
    run("cargo", &["fmt", "--all", "--check"])
}

/// `cargo clippy` on everything.
pub fn clippy() -> Result<()> {
    run("cargo", &["clippy", "--workspace", "--all-targets", "--all-features", "--", "-D", "warnings"])
}

/// `cargo doc`: broken links and missing documentation are errors.
pub fn doc() -> Result<()> {
    run_with("cargo", &["doc", "--no-deps", "--workspace", "--all-features"], &[("RUSTDOCFLAGS", "-D warnings")])
}
