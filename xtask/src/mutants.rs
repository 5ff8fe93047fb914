//! Mutation testing: does a test fail when the arithmetic of the core is wrong? cargo-mutants changes one operator, value or branch at
//! a time and runs the quick tests. No step of the gate: a mutant takes some ten seconds, and there are thousands.
//! `FSB_MUTANTS=estimator` takes the files whose path contains that instead of the usual ones; `FSB_MUTANTS_SHARD=k/n`
//! takes every n-th mutant, from the k-th on, k < n. docs/robustness.md says what is left.

use anyhow::{Result, bail};

use crate::command::{run_with, succeeds};

/// Where the arithmetic is.
const FILES: &[&str] = &[
    "fsb-core/src/accumulator.rs",
    "fsb-core/src/window.rs",
    "fsb-core/src/moments.rs",
    "fsb-core/src/identifier/*",
    "fsb-core/src/observer/*",
    "fsb-core/src/readout/*",
    "fsb-core/src/guard/gate.rs",
    "fsb-core/src/regression/*",
    "fsb-core/src/vehicle/*",
    "fsb-core/src/attitude/*",
    "fsb-core/src/control/*",
];

/// Quick tests that between them see almost every mutant that any test sees.
const TESTS: &[&str] = &["components"];

/// What an interrupted or failed test leaves behind must not steer the next mutant's.
const QUIET: &[(&str, &str)] = &[
    ("CARGO_PROFILE_DEV_DEBUG", "0"),
    ("CARGO_PROFILE_DEV_OPT_LEVEL", "1"),
    ("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true"),
];

/// Runs cargo-mutants on a copy of the workspace; what it found is in `target/mutants`.
pub fn run() -> Result<()> {
    if !succeeds("cargo", &["mutants", "--version"]) {
        bail!("cargo-mutants is missing: cargo install --locked cargo-mutants@27.1.0");
    }
    let (files, shard) = (std::env::var("FSB_MUTANTS").ok(), std::env::var("FSB_MUTANTS_SHARD").ok());
    let arguments = arguments(files.as_deref(), shard.as_deref());
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    run_with("cargo", &arguments, QUIET)
}

fn arguments(files: Option<&str>, shard: Option<&str>) -> Vec<String> {
    let mut words = vec!["mutants", "--package", "fsb-core", "--test-package", "fsb-core,fsb-tests"];
    words.extend(["--timeout", "120", "--output", "target/mutants", "--colors", "never"]);
    let asked = files.map(|part| format!("**/fsb-core/src/**/*{part}*"));
    match &asked {
        Some(pattern) => words.extend(["--file", pattern]),
        None => words.extend(FILES.iter().flat_map(|file| ["--file", *file])),
    }
    if let Some(shard) = shard {
        words.extend(["--sharding", "round-robin", "--shard", shard]);
    }
    words.extend(["--", "--lib"]);
    words.extend(TESTS.iter().flat_map(|test| ["--test", *test]));
    words.into_iter().map(str::to_owned).collect()
}
