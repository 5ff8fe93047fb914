//! Miri on tests that need no operating system: the core's own, and the C interface through raw pointers. It sees accesses that
//! the language does not define, and arithmetic that overflows. It needs a nightly toolchain; where none can be had the step says
//! so, and the summary counts it as skipped.

use anyhow::Result;

use crate::command::{on_path, run, succeeds};
use crate::steps::Skipped;

/// 32 bits, as the microcontroller; where the square root is Rust code, not an instruction that Miri does not know.
const TARGET: &str = "armv7-unknown-linux-gnueabihf";

/// What is run, after `cargo +nightly miri test --locked --target ...`. Of the core's tests those that do not fly or draw for
/// long: the others take Miri minutes each and reach no code that the C interface's do not.
const TESTS: &[&[&str]] = &[
    &["--manifest-path", "fuzz/Cargo.toml", "--target-dir", "target/miri", "--package", "fsb-c-in-rust"],
    &["--package", "fsb-core", "--lib", "--", "accumulator", "attitude", "moments", "snapshot"],
];

/// Installs Miri where that is possible, and runs the tests.
pub fn run_tests() -> Result<()> {
    if !is_there() {
        install();
    }
    if !is_there() {
        return Err(Skipped(
            "no nightly toolchain with the components miri and rust-src, and none could be installed; \
                            by hand: rustup toolchain install nightly --profile minimal --component miri,rust-src",
        )
        .into());
    }
    for tests in TESTS {
        run("cargo", &[&["+nightly", "miri", "test", "--locked", "--target", TARGET], *tests].concat())?;
    }
    Ok(())
}

fn is_there() -> bool {
    // Setting up builds the standard library from its sources, once.
    succeeds("cargo", &["+nightly", "miri", "setup", "--target", TARGET])
}

/// Whether it worked is seen afterwards.
fn install() {
    if on_path("rustup") {
        let what = ["toolchain", "install", "nightly", "--profile", "minimal", "--component", "miri,rust-src"];
        let _ = run("rustup", &what);
    }
}
