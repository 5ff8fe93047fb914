//! The README's promises name the tests and steps that show them: they exist.

use super::File;
use crate::steps::STEPS;

const README: &str = "README.md";
const SECTION: &str = "## What it promises\n";

/// Names in that section that lead nowhere, and its absence.
pub fn check(files: &[File]) -> Vec<String> {
    let text = |name: &str| files.iter().find(|file| file.name == name).and_then(File::text);
    let section = text(README).and_then(|readme| readme.split_once(SECTION)).map(|(_, after)| after);
    let Some(section) = section.map(|after| after.split("\n## ").next().unwrap_or(after)) else {
        return vec![format!("{README}: no section on what it promises")];
    };
    let mut complaints = Vec::new();
    for name in section.split('`').skip(1).step_by(2) {
        let found = if let Some((file, test)) = name.split_once("::") {
            text(&format!("tests/tests/{file}.rs")).is_some_and(|text| is_test(text, test))
        } else if let Some(step) = name.strip_prefix("cargo xtask ") {
            STEPS.iter().any(|known| known.name == step)
        } else {
            true
        };
        if !found {
            complaints.push(format!("{README}: a promise is shown by `{name}`, which there is not"));
        }
    }
    complaints
}

/// Also within `proptest!`, where lines are indented and tests take arguments.
fn is_test(text: &str, name: &str) -> bool {
    let head = format!("fn {name}(");
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    lines.windows(2).any(|pair| pair[1].starts_with(&head) && (pair[0] == "#[test]" || pair[0].starts_with("#[ignore")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(name: &str, text: &str) -> File {
        File { name: name.into(), bytes: text.into() }
    }

    #[test]
    fn what_is_named_must_be_there() {
        let tests = file("tests/tests/a.rs", "#[test]\nfn one() {}\nfn helper() {}\n");
        let readme = |line: &str| file(README, &format!("# x\n{SECTION}\n{line}\n## Next\n`a::not_looked_at`\n"));
        let complaints = |line: &str| check(&[readme(line), file("tests/tests/a.rs", tests.text().unwrap())]).len();
        assert_eq!(complaints("| `a::one` | `cargo xtask panic` | `k` |"), 0);
        assert_eq!(complaints("`a::two`, `b::one`, `a::helper` and `cargo xtask nothing`"), 4);
        assert_eq!(check(&[]).len(), 1);
    }
}
