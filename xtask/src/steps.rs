//! The steps of the gate, and the runner that times them and says which failed.

use std::io::Write;
use std::time::{Duration, Instant};

use anyhow::Result;

use crate::on_target::{cost, disassembly, examples, firmware, panics, parity, size};
use crate::{c_interface, fuzz, hygiene, licences, lints, miri, mutants, numbers, setup, suite, target};

/// One step of the gate.
#[derive(Debug)]
pub struct Step {
    /// The name on the command line.
    pub name: &'static str,
    /// One line for `--help`.
    pub about: &'static str,
    run: fn() -> Result<()>,
}

/// Why a step could not be done on this machine. That is no failure, and it is said.
#[derive(Debug)]
pub struct Skipped(pub &'static str);

impl std::fmt::Display for Skipped {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(self.0)
    }
}

impl std::error::Error for Skipped {}

/// How a step ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    Passed,
    Failed,
    Skipped,
}

impl Outcome {
    fn of(result: &Result<()>) -> Self {
        match result {
            Ok(()) => Self::Passed,
            Err(error) if error.is::<Skipped>() => Self::Skipped,
            Err(_) => Self::Failed,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Passed => "ok",
            Self::Failed => "FAILED",
            Self::Skipped => "skipped",
        }
    }
}

/// In the order of the gate: quick ones first, the tests last, so that their result lines stand above the summary.
pub const STEPS: &[Step] = &[
    Step { name: "setup", about: "install what the other steps use, or say what to install", run: setup::run },
    Step { name: "fmt", about: "formatting", run: lints::fmt },
    Step { name: "hygiene", about: "rules on the text of the repository", run: hygiene::run },
    Step { name: "licences", about: "every dependency under a licence of the allow-list", run: licences::run },
    Step { name: "clippy", about: "lints, all targets and features, warnings denied", run: lints::clippy },
    Step {
        name: "target",
        about: "core and control loop on thumbv7em with every feature combination",
        run: target::run,
    },
    Step { name: "firmware", about: "the control loop flies on the emulator", run: firmware::run },
    Step { name: "parity", about: "the same bits on host and target", run: parity::run },
    Step { name: "cost", about: "instructions and cycles of a tick, within budgets.toml", run: cost::run },
    Step { name: "size", about: "state, code and stack of a tick, within budgets.toml", run: size::run },
    Step { name: "panic", about: "no panic can be reached, by linking without a panic handler", run: panics::run },
    Step { name: "disassembly", about: "no allocation, transcendental or soft float in a tick", run: disassembly::run },
    Step {
        name: "examples",
        about: "the RTIC and the Embassy task build for the target; the first loses its receiver on the emulator",
        run: examples::run,
    },
    Step {
        name: "c",
        about: "the C interface: header, tests, size, the same bits on the target",
        run: c_interface::run,
    },
    Step { name: "fuzz", about: "any calls and any bytes, from the committed corpus on", run: fuzz::run },
    Step { name: "miri", about: "the core's tests and the C interface's pointers under Miri", run: miri::run_tests },
    Step { name: "doc", about: "documentation, warnings denied", run: lints::doc },
    Step { name: "numbers", about: "the numbers and links in the documentation", run: numbers::run },
    Step { name: "suite", about: "cargo test on the whole workspace", run: suite::run },
];

/// What takes hours: asked for by name only.
pub const LONG: &[Step] =
    &[Step { name: "mutants", about: "what no quick test notices, by cargo-mutants: hours", run: mutants::run }];

/// Runs the steps one after the other, the rest too when one fails (except without `setup`); true if none failed.
pub fn run(steps: &[&Step]) -> bool {
    let start = Instant::now();
    let mut summary = Vec::new();
    for step in steps {
        println!("\n=== {}: {}", step.name, step.about);
        let begin = Instant::now();
        let outcome = (step.run)();
        let time = begin.elapsed();
        let ended = Outcome::of(&outcome);
        if let Err(error) = &outcome {
            println!("=== {} {}: {error:#}", step.name, ended.name());
        }
        println!("=== {} took {}", step.name, seconds(time));
        flush();
        summary.push((step.name, time, ended));
        if ended == Outcome::Failed && step.name == "setup" {
            break;
        }
    }

    println!("\n{:<12} {:<7} {:>8}", "step", "result", "time");
    for (name, time, ended) in &summary {
        println!("{name:<12} {:<7} {:>8}", ended.name(), seconds(*time));
    }
    println!("{:<12} {:<7} {:>8}", "total", "", seconds(start.elapsed()));
    let failed: Vec<_> =
        summary.iter().filter(|(.., ended)| *ended == Outcome::Failed).map(|(name, ..)| *name).collect();
    for name in &failed {
        println!("failed: {name}; alone: cargo xtask {name}");
    }
    if summary.len() < steps.len() {
        println!("not run: {} steps, because setup failed", steps.len() - summary.len());
    }
    flush();
    failed.is_empty()
}

fn seconds(time: Duration) -> String {
    format!("{:.1} s", time.as_secs_f64())
}

/// A log that is a pipe keeps its order with what the children print. A closed pipe is nobody's failure.
fn flush() {
    let _ = std::io::stdout().flush();
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::bail;

    static GOOD: Step = Step { name: "good", about: "", run: || Ok(()) };
    static SKIPPED: Step = Step { name: "skipped", about: "", run: || Err(Skipped("as it may be").into()) };
    static BAD: Step = Step { name: "bad", about: "", run: || bail!("as it should") };

    #[test]
    fn one_failure_fails_the_run() {
        assert!(run(&[&GOOD, &GOOD]));
        assert!(!run(&[&BAD, &GOOD]));
        assert!(!run(&[&GOOD, &BAD]));
        assert!(run(&[&SKIPPED, &GOOD]));
        assert!(!run(&[&SKIPPED, &BAD]));
    }

    #[test]
    fn names_are_unique_and_none_hides_the_gate() {
        let steps: Vec<&Step> = STEPS.iter().chain(LONG).collect();
        for (index, step) in steps.iter().enumerate() {
            assert_ne!(step.name, "test");
            assert!(steps[..index].iter().all(|other| other.name != step.name));
        }
    }
}
