//! Recorded flights stay out of the repository: they belong to others, not all of whom gave a licence.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::File;

/// Files named as recordings are, and files equal to one of the recordings in `folder`.
pub fn check(files: &[File], folder: Option<&Path>) -> Result<Vec<String>> {
    let recordings = match folder {
        Some(folder) => paths(folder).with_context(|| format!("FSB_FLIGHT_DATA={}", folder.display()))?,
        None => Vec::new(),
    };
    let mut complaints = Vec::new();
    for file in files {
        if named_as_recording(&file.name) {
            complaints.push(format!("{}: named as a recorded flight", file.name));
        }
        for path in &recordings {
            let same_size = fs::metadata(path)?.len() == file.bytes.len() as u64;
            if same_size && !file.bytes.is_empty() && fs::read(path)? == file.bytes {
                complaints.push(format!("{}: is the recording {}", file.name, path.display()));
            }
        }
    }
    Ok(complaints)
}

fn named_as_recording(path: &str) -> bool {
    let name = path.rsplit('/').next().unwrap_or_default().to_lowercase();
    let vehicle = ["crazyflie", "nanobench", "imrclab"].iter().any(|word| name.contains(word));
    name.ends_with(".ulg") || (name.ends_with(".csv") && vehicle)
}

fn paths(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            found.extend(paths(&path)?);
        } else {
            found.push(path);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_recordings() {
        assert!(named_as_recording("tests/data/sample.ulg"));
        assert!(named_as_recording("a/Crazyflie_brushed.csv"));
        assert!(!named_as_recording("tests/fixtures/parity.csv"));
        assert!(!named_as_recording("docs/crazyflie.md"));
    }

    #[test]
    fn copies_under_another_name() {
        // Any folder will do for recordings: this one holds the file itself.
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/hygiene");
        let copy = File { name: "other.csv".into(), bytes: fs::read(folder.join("data.rs")).unwrap() };
        let found = check(&[copy, File { name: "else.csv".into(), bytes: b"t,x".into() }], Some(&folder)).unwrap();
        assert_eq!(found.len(), 1);
        assert!(found[0].starts_with("other.csv"));
        assert!(check(&[], Some(Path::new("no/such/folder"))).is_err());
    }
}
