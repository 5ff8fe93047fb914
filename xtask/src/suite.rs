//! The tests themselves.

use anyhow::Result;

use crate::command;

/// `cargo test` on the workspace, in the (optimised) dev profile; all test programs run, also after one failed.
pub fn run() -> Result<()> {
    if std::env::var_os("FSB_FLIGHT_DATA").is_none() {
        println!("FSB_FLIGHT_DATA is not set: the tests on recorded flights will be reported as ignored");
    }
    command::run("cargo", &["test", "--workspace", "--no-fail-fast"])
}
