//! The program that the README of the C interface shows: it compiles, runs, and finds the mass it says.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};

use super::build::{Build, Machine};
use crate::command::root;

const README: &str = "fsb-c/README.md";

pub fn run(build: &Build, library: &Path) -> Result<()> {
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
}
