//! No panic is reachable from any function of the header, and the check for that can fail.
//!
//! The library is built with a panic handler that does not link (panic-never) and linked into a program that calls every
//! function. With a function that can panic added, the same link must fail.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use anyhow::{Result, bail};

use super::build::{Build, Machine};
use crate::command;

const FEATURES: &[&str] = &["panic-never"];
const SOURCE: &str = "fsb-c/tests/interface.c";

/// Returns the program that calls every function.
pub fn run(build: &Build, functions: &[String]) -> Result<PathBuf> {
    let library = build.library_in(&build.file("panic-never"), Machine::Target, FEATURES, &[])?;
    let program = build.program(Machine::Target, "interface.elf", SOURCE, &library)?;
    let symbols = command::output("arm-none-eabi-nm", &["--defined-only", &program.to_string_lossy()])?;
    let missing = missing(functions, &symbols);
    if !missing.is_empty() {
        bail!("{SOURCE} does not call {}", missing.join(", "));
    }
    println!("{} functions, no panic reachable from any", functions.len());

    let with_panic =
        build.library_in(&build.file("reachable-panic"), Machine::Target, FEATURES, &["--cfg", "reachable_panic"])?;
    let mut arguments = build.target_arguments("reachable-panic.elf", SOURCE, &with_panic)?;
    arguments.push("-Wl,--undefined=fsb_reachable_panic".into());
    let link = Command::new("arm-none-eabi-gcc")
        .args(&arguments)
        .current_dir(command::root()?)
        .stdin(Stdio::null())
        .output()?;
    let said = String::from_utf8_lossy(&link.stderr);
    if link.status.success() || !said.contains("panic-never") {
        bail!("a library with a reachable panic should not have linked because of it, but:\n{said}");
    }
    println!("a function that can panic was added: the link failed, as it must");
    Ok(program)
}

/// The functions that are no symbol of the program.
fn missing<'a>(functions: &'a [String], symbols: &str) -> Vec<&'a str> {
    let there: Vec<&str> = symbols.lines().filter_map(|line| line.split_whitespace().last()).collect();
    functions.iter().map(String::as_str).filter(|function| !there.contains(function)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_that_are_not_linked_are_missing() {
        let functions = ["fsb_a".to_string(), "fsb_b".to_string()];
        assert_eq!(missing(&functions, "0800 T fsb_a\n0804 T fsb_bc\n"), ["fsb_b"]);
    }
}
