//! Blocks between marks.

use anyhow::{Context, Result};

const OPEN: &str = "<!-- numbers:";
const OPEN_END: &str = " -->\n";
const CLOSE: &str = "<!-- /numbers -->";

/// What stands between two marks.
#[derive(Debug, PartialEq)]
pub struct Block {
    /// The name in the first mark.
    pub name: String,
    /// The lines between.
    pub content: String,
}

/// All blocks, in order.
pub fn find(text: &str) -> Result<Vec<Block>> {
    let mut blocks = Vec::new();
    let mut rest = text;
    while let Some((_, after)) = rest.split_once(OPEN) {
        let (name, after) = after.split_once(OPEN_END).context("a mark is not ended")?;
        let (content, after) = after.split_once(CLOSE).with_context(|| format!("{name} is not closed"))?;
        blocks.push(Block { name: name.into(), content: content.into() });
        rest = after;
    }
    Ok(blocks)
}

/// The text with another content in the block called `name`.
pub fn replace(text: &str, name: &str, content: &str) -> String {
    let mark = format!("{OPEN}{name}{OPEN_END}");
    match text.split_once(&mark).and_then(|(before, after)| Some((before, after.split_once(CLOSE)?.1))) {
        Some((before, after)) => format!("{before}{mark}{content}{CLOSE}{after}"),
        None => text.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "a\n<!-- numbers:one -->\n1\n<!-- /numbers -->\nb\n<!-- numbers:two -->\n<!-- /numbers -->\n";

    #[test]
    fn found_in_order() {
        let found = find(TEXT).unwrap();
        assert_eq!(found[0], Block { name: "one".into(), content: "1\n".into() });
        assert_eq!(found[1], Block { name: "two".into(), content: String::new() });
        assert_eq!(find("no mark").unwrap(), []);
        assert!(find("<!-- numbers:one -->\n1").is_err());
    }

    #[test]
    fn only_the_content_is_replaced() {
        let text = replace(TEXT, "two", "2\n");
        assert_eq!(find(&text).unwrap()[1].content, "2\n");
        assert_eq!(replace(&text, "two", ""), TEXT);
        assert_eq!(replace(TEXT, "three", "3\n"), TEXT);
    }
}
