//! `fsb-c/include/fsb.h`: made by cbindgen, committed, and held against what cbindgen makes now.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};

/// From the workspace root.
pub const HEADER: &str = "fsb-c/include/fsb.h";

/// What cbindgen makes of the crate as it is.
fn made(root: &Path) -> Result<String> {
    let folder = root.join("fsb-c");
    let config = match cbindgen::Config::from_file(folder.join("cbindgen.toml")) {
        Ok(config) => config,
        Err(error) => bail!("fsb-c/cbindgen.toml: {error}"),
    };
    let mut text = Vec::new();
    cbindgen::generate_with_config(&folder, config).context("cbindgen")?.write(&mut text);
    Ok(String::from_utf8(text)?)
}

/// Writes the header.
pub fn write(root: &Path) -> Result<()> {
    let text = made(root)?;
    fs::write(root.join(HEADER), text).with_context(|| format!("cannot write {HEADER}"))?;
    println!("wrote {HEADER}");
    Ok(())
}

/// The committed header is the one that would be written.
pub fn check(root: &Path) -> Result<()> {
    let committed = fs::read_to_string(root.join(HEADER)).with_context(|| format!("cannot read {HEADER}"))?;
    match first_difference(&committed, &made(root)?) {
        None => {
            println!("{HEADER} is what cbindgen makes");
            Ok(())
        }
        Some((line, old, new)) => bail!(
            "{HEADER} is not current, first in line {line}:\n  there:    {old}\n  should be: {new}\nto refresh it: cargo xtask c --write"
        ),
    }
}

fn first_difference(old: &str, new: &str) -> Option<(usize, String, String)> {
    if old == new {
        return None;
    }
    let (mut old, mut new) = (old.lines(), new.lines());
    let mut line = 0;
    loop {
        line += 1;
        match (old.next(), new.next()) {
            (None, None) => return Some((line, "(end)".into(), "(end, with or without a line break)".into())),
            (a, b) if a == b => {}
            (a, b) => return Some((line, a.unwrap_or("(end)").into(), b.unwrap_or("(end)").into())),
        }
    }
}

/// The functions that the header declares.
pub fn functions(root: &Path) -> Result<Vec<String>> {
    let text = fs::read_to_string(root.join(HEADER)).with_context(|| format!("cannot read {HEADER}"))?;
    let found = declared(&text);
    if found.is_empty() {
        bail!("{HEADER} declares no function");
    }
    Ok(found)
}

/// Names that begin with `fsb_`, stand before an opening bracket and not in a comment.
fn declared(text: &str) -> Vec<String> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.filter_map(|line| {
        let (before, _) = line.split_once('(')?;
        let name = before.rsplit(|c: char| !c.is_alphanumeric() && c != '_').next()?;
        name.starts_with("fsb_").then(|| name.to_string())
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_found_where_they_are() {
        assert_eq!(first_difference("a\nb\n", "a\nb\n"), None);
        assert_eq!(first_difference("a\nb\n", "a\nc\n").unwrap().0, 2);
        assert_eq!(first_difference("a\n", "a\nb\n").unwrap().0, 2);
        assert!(first_difference("a\n", "a").is_some());
    }

    #[test]
    fn declarations_are_found() {
        let text = "// fsb_no(\nconst char *fsb_a(int b);\nfsb_c_t fsb_c(void);\n  int fsb_long(\n int x);\n";
        assert_eq!(declared(text), ["fsb_a", "fsb_c", "fsb_long"]);
    }
}
