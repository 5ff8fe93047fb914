//! No panic can be reached: with `panic-never` as the panic handler a program that could panic does not link.

use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use super::programs::TARGET_TESTS;
use crate::command::root;
use crate::setup;

/// What the linker says about the symbol that `panic-never` leaves undefined.
const REASON: &str = "error(panic-never): your program contains at least one panicking branch";

/// Links the program that calls every entry point; and the same with an index that can be out of bounds, which must fail,
/// and for this reason.
pub fn run() -> Result<()> {
    setup::rust_targets()?;
    let (linked, said) = link(&[])?;
    if !linked {
        print!("{said}");
        bail!("a panic can be reached, or the program does not build");
    }
    println!(
        "every entry point of estimators, vehicle, regression, controllers and control loop links without a panic handler"
    );
    let (linked, said) = link(&["--features", "demonstrate"])?;
    if linked {
        bail!("an index that can be out of bounds linked: this check sees nothing");
    }
    if !said.contains(REASON) {
        print!("{said}");
        bail!("the demonstration failed to build, but not because of a panic");
    }
    println!("with an index that can be out of bounds the linker says: {REASON}");
    Ok(())
}

fn link(features: &[&str]) -> Result<(bool, String)> {
    let mut arguments = TARGET_TESTS.build_arguments();
    arguments.extend(["--bin", "panic_free", "--no-default-features", "--features", "never"].map(String::from));
    arguments.extend(features.iter().map(|feature| feature.to_string()));
    println!("$ cargo {}", arguments.join(" "));
    let output = Command::new("cargo")
        .args(&arguments)
        .current_dir(root()?)
        .stdin(Stdio::null())
        .output()
        .context("cannot start cargo")?;
    Ok((output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned()))
}
