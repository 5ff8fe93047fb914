//! What the other steps need on the machine: installed where that is possible, else named exactly.

use std::path::Path;

use anyhow::{Result, bail};

use crate::command::{self, on_path, output, run_with, succeeds};

/// The compilation targets of the core.
pub const TARGETS: &[&str] = &["thumbv7em-none-eabihf", "thumbv7em-none-eabi"];

/// Debian packages the steps use.
const PACKAGES: &[Package] = &[
    Package { name: "gcc", present: || on_path("gcc") },
    Package { name: "g++", present: || on_path("g++") },
    Package { name: "gcc-arm-none-eabi", present: || on_path("arm-none-eabi-gcc") },
    Package { name: "binutils-arm-none-eabi", present: || on_path("arm-none-eabi-objdump") },
    Package { name: "libnewlib-arm-none-eabi", present: newlib },
    Package { name: "qemu-system-arm", present: || on_path("qemu-system-arm") },
];

/// The cross-compiler answers with a path where it finds a file, with the bare name where it does not.
fn newlib() -> bool {
    let name = "-print-file-name=rdimon.specs";
    on_path("arm-none-eabi-gcc") && output("arm-none-eabi-gcc", &[name]).is_ok_and(|path| path.contains('/'))
}

/// A Debian package, and how to see that what it brings is there.
struct Package {
    name: &'static str,
    present: fn() -> bool,
}

/// Installs what is missing of everything.
pub fn run() -> Result<()> {
    components()?;
    rust_targets()?;
    packages(PACKAGES)
}

/// The cargo subcommands that a minimal toolchain lacks.
fn components() -> Result<()> {
    for (component, subcommand) in [("rustfmt", "fmt"), ("clippy", "clippy")] {
        if !succeeds("cargo", &[subcommand, "--version"]) {
            rustup(&["component", "add", component])?;
        }
    }
    Ok(())
}

/// A compiler for libFuzzer.
pub fn cpp_compiler() -> Result<()> {
    packages(&PACKAGES[..2])
}

/// The core library of each of [`TARGETS`].
pub fn rust_targets() -> Result<()> {
    for target in TARGETS {
        let folder = output("rustc", &["--print", "target-libdir", "--target", target])?;
        if !Path::new(folder.trim()).is_dir() {
            rustup(&["target", "add", target])?;
        }
    }
    Ok(())
}

fn rustup(arguments: &[&str]) -> Result<()> {
    if !on_path("rustup") {
        bail!("rustup is missing (https://rustup.rs); with it: rustup {}", arguments.join(" "));
    }
    command::run("rustup", arguments)
}

/// Installs the packages that are not there, as root on a Debian; elsewhere the error names them.
fn packages(wanted: &[Package]) -> Result<()> {
    let missing = missing(wanted);
    if missing.is_empty() {
        return Ok(());
    }
    if !on_path("apt-get") || output("id", &["-u"])?.trim() != "0" {
        bail!("{}", advice(&missing));
    }
    let quiet = [("DEBIAN_FRONTEND", "noninteractive")];
    run_with("apt-get", &["update"], &quiet)?;
    let mut arguments = vec!["install", "-y", "--no-install-recommends"];
    arguments.extend(&missing);
    run_with("apt-get", &arguments, &quiet)?;
    let still = self::missing(wanted);
    if !still.is_empty() {
        bail!("installed, but not found afterwards: {}", still.join(" "));
    }
    Ok(())
}

fn missing(wanted: &[Package]) -> Vec<&'static str> {
    wanted.iter().filter(|package| !(package.present)()).map(|package| package.name).collect()
}

fn advice(missing: &[&str]) -> String {
    let names = missing.join(" ");
    format!(
        "missing: {names}. On Debian or Ubuntu: sudo apt-get update && sudo apt-get install -y --no-install-recommends {names}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_missing_is_named() {
        let wanted = [Package { name: "here", present: || true }, Package { name: "gone", present: || false }];
        assert_eq!(missing(&wanted), ["gone"]);
        assert!(advice(&missing(&wanted)).ends_with("install -y --no-install-recommends gone"));
        assert!(packages(&wanted[..1]).is_ok());
    }
}
