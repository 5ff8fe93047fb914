//! Fuzzing: the targets of `fuzz/`, built as cargo-fuzz builds them but with the toolchain that is there, run from the
//! committed corpus. `FSB_FUZZ_RUNS=N` runs N executions of each instead of the short default.

use anyhow::{Context, Result, bail};

use crate::command::{self, output, run_with};
use crate::setup;

/// A target, its executions in the gate, and the longest input (bytes).
const TARGETS: &[(&str, u64, u32)] = &[
    ("estimator", 100_000, 512),
    ("snapshot", 100_000, 512),
    ("c_interface", 200_000, 512),
    ("vehicle", 20_000, 512),
    ("axis_log", 20_000, 512),
    ("ulog", 10_000, 8192),
    ("scenario", 10_000, 2048),
];

/// Counters at every edge and comparisons traced: what libFuzzer steers by. All of it is stable.
const INSTRUMENTED: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares --cfg fuzzing -Ccodegen-units=1";

/// Builds and runs every target.
pub fn run() -> Result<()> {
    setup::cpp_compiler()?;
    let host = host()?;
    let mut build = vec!["build", "--release", "--locked", "--manifest-path", "fuzz/Cargo.toml"];
    build.extend(["--target-dir", "target/fuzz", "--target", &host]);
    run_with("cargo", &build, &[("RUSTFLAGS", INSTRUMENTED)])?;
    let asked = match std::env::var("FSB_FUZZ_RUNS") {
        Ok(text) => Some(text.parse::<u64>().context("FSB_FUZZ_RUNS is not a number")?),
        Err(_) => None,
    };
    let mut total = 0;
    for (target, default, longest) in TARGETS {
        let runs = asked.unwrap_or(*default);
        fuzz(target, &host, runs, *longest)?;
        total += runs;
    }
    println!("{total} executions without a finding");
    Ok(())
}

/// New inputs go to `fuzz/corpus-found`, which is not committed; a finding to `fuzz/artifacts`.
fn fuzz(target: &str, host: &str, runs: u64, longest: u32) -> Result<()> {
    let root = command::root()?;
    let found = format!("fuzz/corpus-found/{target}");
    let artifacts = format!("fuzz/artifacts/{target}");
    for folder in [&found, &artifacts] {
        std::fs::create_dir_all(root.join(folder)).with_context(|| format!("cannot make {folder}"))?;
    }
    let program = format!("target/fuzz/{host}/release/{target}");
    let (runs, prefix) = (format!("-runs={runs}"), format!("-artifact_prefix={artifacts}/"));
    let longest = format!("-max_len={longest}");
    let corpus = format!("fuzz/corpus/{target}");
    let arguments = [runs.as_str(), "-seed=1", &longest, "-verbosity=0", "-print_final_stats=1", &prefix];
    if run_with(&program, &[&arguments[..], &[&found, &corpus]].concat(), &[]).is_err() {
        bail!("{target}: a finding, kept in {artifacts}; again: {program} {artifacts}/crash-...");
    }
    Ok(())
}

/// The machine's own target triple.
fn host() -> Result<String> {
    let version = output("rustc", &["-vV"])?;
    let line = version.lines().find_map(|line| line.strip_prefix("host: "));
    Ok(line.context("rustc -vV names no host")?.to_owned())
}
