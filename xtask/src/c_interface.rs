//! The C interface: header, library, and programs in C on this machine and on the emulated microcontroller.
//!
//! | file | what |
//! |---|---|
//! | `header` | the committed header is the one cbindgen makes |
//! | `build` | the library, and programs in C with it, here and for the microcontroller |
//! | `guide` | the programs that the documentation shows |
//! | `panics` | no panic is reachable, and the check for that can fail |
//! | `size` | what the library adds to a program |

mod build;
mod guide;
mod header;
mod panics;
mod size;

use anyhow::{Result, bail};

use crate::command;
use build::{Build, Machine};

/// Flies on what the whole vehicle's estimator says.
const VEHICLE: &str = "fsb-c/examples/vehicle.c";

/// Whether `--write` was given: then the header is written before it is checked.
fn writing() -> bool {
    std::env::args().any(|argument| argument == "--write")
}

/// Everything about the C interface.
pub fn run() -> Result<()> {
    let root = command::root()?;
    if writing() {
        header::write(&root)?;
    }
    header::check(&root)?;
    let build = Build::new()?;
    build.headers()?;

    let here = build.library(Machine::Host, &[])?;
    let there = build.library(Machine::Target, &[])?;

    let checks = build.run(Machine::Host, &build.checked_program("interface", "fsb-c/tests/interface.c", &here)?)?;
    print!("{checks}");
    guide::run(&build, &here)?;

    let flight = command::output("cargo", &["run", "--quiet", "--release", "--package", "fsb-c", "--example", "fly"])?;
    if flight.lines().count() < 10 {
        bail!("the flight in Rust printed next to nothing:\n{flight}");
    }
    for (machine, library, name) in [(Machine::Host, &here, "fly"), (Machine::Target, &there, "fly.elf")] {
        let program = build.program(machine, name, "fsb-c/examples/fly.c", library)?;
        same(&format!("fly.c on the {machine}"), &flight, &build.run(machine, &program)?)?;
    }
    print!("{flight}");
    println!("the same, to the last bit: fly.rs and fly.c on the host, fly.c on the target");

    let here = build.program(Machine::Host, "vehicle", VEHICLE, &here)?;
    let there = build.program(Machine::Target, "vehicle.elf", VEHICLE, &there)?;
    let flight = build.run(Machine::Host, &here)?;
    same("vehicle.c on the target", &flight, &build.run(Machine::Target, &there)?)?;
    print!("{flight}");
    println!("the same, to the last bit: vehicle.c on the host and on the target");

    let image = panics::run(&build, &header::functions(&root)?)?;
    same("interface.c on the target", &checks, &build.run(Machine::Target, &image)?)?;
    size::check(&build.map("fly.elf"))
}

/// Fails at the first line in which `found` is not what is expected.
fn same(what: &str, expected: &str, found: &str) -> Result<()> {
    if expected == found {
        return Ok(());
    }
    let mut lines = expected.lines().zip(found.lines()).filter(|(a, b)| a != b);
    match lines.next() {
        Some((a, b)) => bail!("{what} differs:\n  expected {a}\n  found    {b}"),
        None => bail!("{what}: {} lines, not {}", found.lines().count(), expected.lines().count()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_the_same_is_shown() {
        assert!(same("a", "1\n2\n", "1\n2\n").is_ok());
        assert!(same("a", "1\n2\n", "1\n3\n").unwrap_err().to_string().contains("found    3"));
        assert!(same("a", "1\n2\n", "").unwrap_err().to_string().contains("0 lines, not 2"));
    }
}
