//! Checks and recipes of this workspace. `cargo xtask test` is the whole gate; every step also runs alone.

mod c_interface;
mod command;
mod fuzz;
mod hygiene;
mod licences;
mod lints;
mod metadata;
mod miri;
mod mutants;
mod numbers;
mod on_target;
mod setup;
mod spdx;
mod steps;
mod suite;
mod target;

use std::process::ExitCode;

use steps::{LONG, STEPS, Step};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match select(&arguments) {
        Ok(Some(steps)) if steps::run(&steps) => ExitCode::SUCCESS,
        Ok(Some(_)) => ExitCode::FAILURE,
        Ok(None) => {
            print!("{}", help());
            ExitCode::SUCCESS
        }
        Err(unknown) => {
            eprint!("no step is called `{unknown}`\n\n{}", help());
            ExitCode::from(2)
        }
    }
}

/// The steps the arguments ask for; `None` asks for the help text, `Err` names an unknown step.
fn select(arguments: &[String]) -> Result<Option<Vec<&'static Step>>, String> {
    if arguments.is_empty() || arguments.iter().any(|argument| matches!(argument.as_str(), "-h" | "--help" | "help")) {
        return Ok(None);
    }
    let mut chosen = Vec::new();
    for argument in arguments.iter().filter(|argument| *argument != "--write") {
        match STEPS.iter().chain(LONG).find(|step| step.name == argument) {
            Some(step) => chosen.push(step),
            None if argument == "test" => chosen.extend(STEPS),
            None => return Err(argument.clone()),
        }
    }
    Ok(Some(chosen))
}

fn help() -> String {
    let mut text = String::from("Usage: cargo xtask test | STEP...\n\n  test      every step below, in this order\n\n");
    for step in STEPS {
        text += &format!("  {:<11} {}\n", step.name, step.about);
    }
    text += "\nNot part of `test`:\n\n";
    for step in LONG {
        text += &format!("  {:<11} {}\n", step.name, step.about);
    }
    text += "\n  --write   write what a step would only compare: the C header, the numbers in the documentation\n";
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(arguments: &[&str]) -> Result<Option<Vec<&'static str>>, String> {
        let owned: Vec<String> = arguments.iter().map(|argument| argument.to_string()).collect();
        select(&owned).map(|steps| steps.map(|steps| steps.iter().map(|step| step.name).collect()))
    }

    #[test]
    fn test_is_every_step_and_a_name_is_one() {
        assert_eq!(names(&["test"]).unwrap().unwrap().len(), STEPS.len());
        assert_eq!(names(&["doc", "fmt"]).unwrap().unwrap(), ["doc", "fmt"]);
        assert_eq!(names(&["mutants"]).unwrap().unwrap(), ["mutants"]);
        assert!(!names(&["test"]).unwrap().unwrap().contains(&"mutants"));
        assert_eq!(names(&["c", "--write"]).unwrap().unwrap(), ["c"]);
        assert_eq!(names(&["numbers", "--write"]).unwrap().unwrap(), ["numbers"]);
    }

    #[test]
    fn help_is_asked_for_or_given_with_an_unknown_name() {
        assert_eq!(names(&[]), Ok(None));
        assert_eq!(names(&["fmt", "--help"]), Ok(None));
        assert_eq!(names(&["fmt", "frobnicate"]), Err("frobnicate".into()));
        assert!(STEPS.iter().chain(LONG).all(|step| help().contains(step.about)));
    }
}
