//! The programs that the README shows: each is a copy of one that is compiled and run elsewhere.

use std::fs;

use anyhow::{Context, Result};

use crate::command::root;

/// The documentation of the core, whose examples are run as its tests.
const CORE: &str = "fsb-core/README.md";
/// The guide to the C interface, whose program is compiled and run by the checks of that interface.
const C_GUIDE: &str = "fsb-c/README.md";

/// The first program in the documentation of the core.
pub fn rust() -> Result<String> {
    let text = fs::read_to_string(root()?.join(CORE)).with_context(|| format!("cannot read {CORE}"))?;
    first(&text, "rust").with_context(|| format!("{CORE} shows no program"))
}

/// The first program in the guide to the C interface, where there is one.
pub fn c() -> Result<Option<String>> {
    let path = root()?.join(C_GUIDE);
    if !path.is_file() {
        return Ok(None);
    }
    first(&fs::read_to_string(&path)?, "c").with_context(|| format!("{C_GUIDE} shows no program")).map(Some)
}

/// The first fenced block of a language, with its fences.
fn first(text: &str, language: &str) -> Option<String> {
    let fence = format!("```{language}\n");
    let begin = if text.starts_with(&fence) { 0 } else { text.find(&format!("\n{fence}"))? + 1 };
    let end = text[begin..].find("\n```\n")?;
    Some(format!("{}\n```\n", &text[begin..begin + end]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_its_language() {
        let text = "a\n```c\nint x;\n```\n```rust\nlet a;\n```\n```rust\nlet b;\n```\n";
        assert_eq!(first(text, "rust").unwrap(), "```rust\nlet a;\n```\n");
        assert_eq!(first(text, "c").unwrap(), "```c\nint x;\n```\n");
        assert_eq!(first(text, "sh"), None);
    }
}
