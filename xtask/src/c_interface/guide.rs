//! The programs that the documentation shows. That of the README compiles, runs, and finds the mass it says; those of the
//! guide compile against declarations of the flight controllers' interfaces (`fsb-c/tests/guide`).

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};

use super::build::{Build, Machine};
use crate::command::{self, root};

const README: &str = "fsb-c/README.md";
const GUIDE: &str = "docs/flight-controllers.md";

/// A program of the guide: name, compiler, language of the block, standard it is built with.
const CONTROLLERS: &[(&str, &str, &str, &str)] = &[
    ("vehicle", "gcc", "c", "-std=c99"),
    ("px4", "g++", "cpp", "-std=c++14"),
    ("ardupilot", "g++", "cpp", "-std=c++11"),
    ("crazyflie", "gcc", "c", "-std=c11"),
];

/// Both documents.
pub fn run(build: &Build, library: &Path) -> Result<()> {
    readme(build, library)?;
    let text = fs::read_to_string(root()?.join(GUIDE)).with_context(|| format!("cannot read {GUIDE}"))?;
    for (name, compiler, language, standard) in CONTROLLERS {
        let program = named_block(&text, language, name)
            .with_context(|| format!("{GUIDE} has no {language} block that begins with a comment `{name}`"))?;
        let source = build.file(&format!("{name}.{language}"));
        fs::write(&source, without_foreign_headers(program))?;
        let stand_in = format!("fsb-c/tests/guide/{name}/all.h");
        let source = source.to_string_lossy();
        let mut arguments = vec![*standard, "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-Ifsb-c/include"];
        arguments.extend(["-include", &stand_in, &source]);
        command::run(compiler, &arguments)?;
    }
    Ok(())
}

/// The block of a language whose first line is a comment with that name alone.
fn named_block<'a>(text: &'a str, language: &str, name: &str) -> Option<&'a str> {
    let fence = format!("\n```{language}\n");
    let comments = [format!("// {name}\n"), format!("/* {name} */\n")];
    text.match_indices(&fence).find_map(|(at, _)| {
        let program = block(&text[at..], language)?;
        comments.iter().any(|comment| program.starts_with(comment)).then_some(program)
    })
}

/// The program with only those `#include`s that are there without the flight controller.
fn without_foreign_headers(program: &str) -> String {
    let known = ["fsb.h", "math.h", "stdbool.h"];
    let keep = |line: &&str| match line.strip_prefix("#include ") {
        Some(header) => known.contains(&header.trim_matches(['<', '>', '"'])),
        None => true,
    };
    program.lines().filter(keep).map(|line| format!("{line}\n")).collect()
}

fn readme(build: &Build, library: &Path) -> Result<()> {
    let text = fs::read_to_string(root()?.join(README)).with_context(|| format!("cannot read {README}"))?;
    let program = block(&text, "c").with_context(|| format!("{README} shows no program in C"))?;
    let expected = block(&text, "text").with_context(|| format!("{README} does not show what the program prints"))?;
    let source = build.file("readme.c");
    fs::write(&source, program)?;
    let program = build.program(Machine::Host, "readme", &source.to_string_lossy(), library)?;
    super::same("the program in the README", expected, &build.run(Machine::Host, &program)?)?;
    if !expected.contains("mass") {
        bail!("the program in {README} should print a mass");
    }
    Ok(())
}

/// The first block of a language between fences.
fn block<'a>(text: &'a str, language: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(&format!("\n```{language}\n"))?;
    rest.find("\n```").map(|end| &rest[..end + 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_found_by_language() {
        let text = "a\n```sh\nx\n```\n```c\nint a;\nint b;\n```\nend";
        assert_eq!(block(text, "c"), Some("int a;\nint b;\n"));
        assert_eq!(block(text, "sh"), Some("x\n"));
        assert_eq!(block(text, "text"), None);
    }

    #[test]
    fn blocks_are_found_by_name() {
        let text = "\n```c\n/* a */\nint a;\n```\n\n```c\n/* b */\nint b;\n```\n";
        assert_eq!(named_block(text, "c", "b"), Some("/* b */\nint b;\n"));
        assert_eq!(named_block(text, "c", "c"), None);
    }

    #[test]
    fn headers_of_the_flight_controller_go() {
        assert_eq!(
            without_foreign_headers("#include <fsb.h>\n#include \"log.h\"\nint a;\n"),
            "#include <fsb.h>\nint a;\n"
        );
    }
}
