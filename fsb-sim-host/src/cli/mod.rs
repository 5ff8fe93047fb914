//! The command line.
//!
//! | file | what |
//! |---|---|
//! | `paper` | Section V with its table, figures and statistics; runs without arguments too |
//! | `fly` | the hexarotor in six degrees of freedom; its `spiral` runs without arguments too |
//! | `replay` | a recorded flight through the core |
//! | `source` | the files of a recorded flight |
//! | `shell` | names in a command line that is shown |
//! | `tune` | λ, q and ε from what is known and wanted |
//! | `efficiency` | the spread of k̂ against the Cramér-Rao bound |
//! | `exactness` | what rounding to f32 leaves of the errors |
//! | `faults` | bad input and faults, and what is left of them |
//! | `soak` | hours of simulated flight beside the f64 twin |
//!
//! Results go to stdout, everything else to stderr. With `--json` stdout holds one JSON object and nothing else.

// Documentation of arguments is help text, and units stand in brackets there.
#![allow(rustdoc::broken_intra_doc_links)]

/// Prints a line to stderr. Where nobody takes it there is nobody left to tell, and the command goes on.
macro_rules! tell {
    ($($line:tt)*) => {
        $crate::cli::print_line_to_stderr(format_args!($($line)*))
    };
}

mod efficiency;
mod exactness;
mod faults;
mod fly;
mod paper;
mod replay;
mod shell;
mod soak;
mod source;
mod tune;

use std::fmt;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use serde::Serialize;

const EXIT_STATUS: &str = "Exit status: 0 done; 1 it failed, or what the command checks does not hold; 2 a parameter or an \
                           input is wrong, and nothing was written; 3 there is no flight in the log.";

/// k and the state of a multirotor from noisy positions: the paper reproduced, and what the f32 core is worth.
///
/// Without a command: `fsb paper` and `fsb fly`, each with its defaults.
#[derive(Debug, Parser)]
#[command(name = "fsb", version, after_help = EXIT_STATUS)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    #[command(after_help = EXIT_STATUS)]
    Paper(paper::Args),
    #[command(after_help = EXIT_STATUS)]
    Fly(fly::Args),
    #[command(after_help = EXIT_STATUS)]
    Replay(replay::Args),
    #[command(after_help = EXIT_STATUS)]
    Tune(tune::Args),
    #[command(after_help = EXIT_STATUS)]
    Efficiency(efficiency::Args),
    #[command(after_help = EXIT_STATUS)]
    Exactness(exactness::Args),
    #[command(after_help = EXIT_STATUS)]
    Faults(faults::Args),
    #[command(after_help = EXIT_STATUS)]
    Soak(soak::Args),
}

/// Why a command ended without its result.
#[derive(Debug)]
enum Failure {
    /// A parameter or an input is wrong: exit status 2.
    Usage(String),
    /// The log is a good one, but nothing flies in it: exit status 3.
    NoFlight(String),
    /// Something else: exit status 1.
    Other(anyhow::Error),
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Other(error.into())
    }
}

/// Runs the command of this process.
pub fn run() -> ExitCode {
    let done = match Cli::try_parse() {
        Ok(Cli { command: None }) => both(),
        Ok(Cli { command: Some(command) }) => run_command(&command),
        Err(answer) => say(&answer),
    };
    match done {
        Ok(status) => status,
        Err(Failure::Usage(message)) => {
            tell!("error: {message}");
            ExitCode::from(2)
        }
        Err(Failure::NoFlight(message)) => {
            tell!("error: {message}");
            ExitCode::from(3)
        }
        Err(Failure::Other(error)) => {
            tell!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Help and version are results like any other; what is wrong with the arguments goes to stderr.
fn say(answer: &clap::Error) -> Result<ExitCode, Failure> {
    let said = answer.print().and_then(|()| io::stdout().flush());
    match said {
        Err(error) if !answer.use_stderr() && error.kind() != io::ErrorKind::BrokenPipe => Err(unprinted(&error)),
        _ => Ok(ExitCode::from(u8::try_from(answer.exit_code()).unwrap_or(2))),
    }
}

/// The paper, then the vehicle; the first that is not well ends it.
fn both() -> Result<ExitCode, Failure> {
    let status = paper::run(&paper::Args::default())?;
    if status == ExitCode::SUCCESS { fly::run(&fly::Args::default()) } else { Ok(status) }
}

fn run_command(command: &Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Paper(args) => paper::run(args),
        Command::Fly(args) => fly::run(args),
        Command::Replay(args) => replay::run(args).map(|()| ExitCode::SUCCESS),
        Command::Tune(args) => tune::run(args),
        Command::Efficiency(args) => efficiency::run(args),
        Command::Exactness(args) => exactness::run(args),
        Command::Faults(args) => faults::run(args),
        Command::Soak(args) => soak::run(args),
    }
}

/// What a log holds may stand in a message: nothing in it steers a terminal.
fn print_line_to_stderr(line: fmt::Arguments<'_>) {
    let harmless = |c: char| if c.is_control() && c != '\n' { char::REPLACEMENT_CHARACTER } else { c };
    let line: String = line.to_string().chars().map(harmless).collect();
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Prints `value` as one JSON object; numbers that are not finite become null.
fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    print_text(&serde_json::to_string_pretty(value)?)
}

/// Prints `text` and a line feed to stdout. A reader that has gone away is no failure.
fn print_text(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{}", text.trim_end()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(unprinted(&error)),
        _ => Ok(()),
    }
}

fn unprinted(error: &io::Error) -> Failure {
    Failure::Other(anyhow::anyhow!("cannot write to stdout: {error}"))
}

/// A positive finite number, for clap.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        Ok(_) => Err("must be a positive finite number".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}
