//! Rules on the text of the repository, which no compiler knows.

mod core;
mod data;
mod promises;
mod text;

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::command::{output, root};

/// A file of the repository, named from the root with `/`.
struct File {
    name: String,
    bytes: Vec<u8>,
}

impl File {
    /// The text; `None` for a binary file.
    fn text(&self) -> Option<&str> {
        std::str::from_utf8(&self.bytes).ok()
    }

    fn is_rust(&self) -> bool {
        self.name.ends_with(".rs")
    }
}

/// Checks every file that is, or is about to be, in the repository.
pub fn run() -> Result<()> {
    let files = files(&root()?)?;
    let mut complaints = Vec::new();
    for file in &files {
        complaints.extend(text::check(file));
        complaints.extend(core::check(file));
    }
    complaints.extend(core::check_root(&files));
    complaints.extend(promises::check(&files));
    complaints.extend(data::check(&files, std::env::var_os("FSB_FLIGHT_DATA").as_deref().map(Path::new))?);
    for complaint in &complaints {
        println!("{complaint}");
    }
    if !complaints.is_empty() {
        bail!("{} complaints", complaints.len());
    }
    println!("{} files, nothing to complain about", files.len());
    Ok(())
}

/// What git tracks or would add.
fn files(root: &Path) -> Result<Vec<File>> {
    let names = output("git", &["ls-files", "-z", "--cached", "--others", "--exclude-standard"])?;
    let mut files = Vec::new();
    for name in names.split_terminator('\0') {
        let path = root.join(name);
        if path.is_file() {
            let bytes = fs::read(&path).with_context(|| format!("cannot read {name}"))?;
            files.push(File { name: name.into(), bytes });
        }
    }
    Ok(files)
}
