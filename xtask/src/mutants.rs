//! Mutation testing: does a test fail when the arithmetic of the core is wrong? cargo-mutants changes one operator, value or branch at
//! a time and runs the quick tests. No step of the gate: a mutant takes half a minute, and there are thousands.
//! `FSB_MUTANTS='fsb-core/src/estimator/*'` takes these files instead of the usual ones; `FSB_MUTANTS_SHARD=k/n`
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
    "fsb-core/src/guard/held.rs",
    "fsb-core/src/regression/*",
    "fsb-core/src/vehicle/*",
    "fsb-core/src/attitude/*",
    "fsb-core/src/control/*",
];

/// Quick tests that between them see almost every mutant that any test sees.
const TESTS: &[&str] = &[
    "at_rest",
    "behaviour",
    "body_angles",
    "components",
    "configuration",
    "controller",
    "disturbed",
    "euler",
    "exactness",
    "excitation",
    "fly_controller",
    "guard",
    "held",
    "held_values",
    "noise",
    "readouts",
    "regression",
    "regression_gusts",
    "regression_hover",
    "regression_limits",
    "regression_observer",
    "regression_readings",
    "rejections",
    "seeding",
    "silence",
    "snapshot",
    "trust",
    "vehicle_blocks",
    "vehicle_change",
    "vehicle_doubt",
    "vehicle_exactness",
    "vehicle_fading",
    "vehicle_inertia",
    "vehicle_readings",
    "vehicle_robustness",
    "wandering",
];

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
    match files {
        Some(pattern) => words.extend(["--file", pattern]),
        None => words.extend(FILES.iter().flat_map(|file| ["--file", *file])),
    }
    if let Some(shard) = shard {
        words.extend(["--sharding", "round-robin", "--shard", shard]);
    }
    let mut words: Vec<String> = words.into_iter().map(str::to_owned).collect();
    // For the build as well, which would otherwise be of every test there is.
    words.extend(["--cargo-arg=--package=fsb-tests".into(), "--cargo-arg=--lib".into()]);
    words.extend(TESTS.iter().map(|test| format!("--cargo-arg=--test={test}")));
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_and_test_is_there() {
        let root = crate::command::root().unwrap();
        for file in FILES {
            assert!(root.join(file.trim_end_matches('*')).exists(), "{file}");
        }
        for test in TESTS {
            assert!(root.join(format!("tests/tests/{test}.rs")).is_file(), "{test}");
        }
    }

    #[test]
    fn a_part_of_the_files_and_a_shard() {
        let words = arguments(Some("fsb-core/src/estimator/*"), Some("1/8"));
        let follows = |name: &str, value: &str| words.windows(2).any(|pair| pair == [name, value]);
        assert!(follows("--file", "fsb-core/src/estimator/*") && follows("--shard", "1/8"));
        assert_eq!(words.iter().filter(|word| *word == "--file").count(), 1);
        assert_eq!(arguments(None, None).iter().filter(|word| *word == "--file").count(), FILES.len());
    }
}
