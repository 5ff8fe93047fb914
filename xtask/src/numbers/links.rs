//! Files that the documents refer to.

use std::fs;
use std::path::Path;

use anyhow::Result;

use crate::command::{output, root};

/// Links in Markdown files of the repository that lead nowhere.
pub fn check() -> Result<Vec<String>> {
    let root = root()?;
    let names = output("git", &["ls-files", "--cached", "--others", "--exclude-standard", "*.md"])?;
    let mut complaints = Vec::new();
    for name in names.lines() {
        let path = root.join(name);
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let folder = path.parent().unwrap_or(Path::new(""));
        for target in targets(&text) {
            if !folder.join(target).exists() {
                complaints.push(format!("{name}: a link to {target}, which is not there"));
            }
        }
    }
    Ok(complaints)
}

/// Relative targets of links and pictures, without what follows a `#`.
fn targets(text: &str) -> Vec<&str> {
    let of = |mark: &str, end: char| -> Vec<&str> {
        text.match_indices(mark).filter_map(|(at, _)| text[at + mark.len()..].split(end).next()).collect()
    };
    let mut all = of("](", ')');
    all.extend(of("src=\"", '"'));
    all.retain(|target| !target.contains("://") && !target.starts_with('#') && !target.contains(char::is_whitespace));
    all.into_iter().filter_map(|target| target.split('#').next()).filter(|target| !target.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_ones_only() {
        let text = "[a](docs/a.md#b) ![p](p.svg) [w](https://example.org/x) [h](#here) <img src=\"q.svg\"> f(x)](a b)";
        assert_eq!(targets(text), ["docs/a.md", "p.svg", "q.svg"]);
    }
}
