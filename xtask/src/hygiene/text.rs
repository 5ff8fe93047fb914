//! Rules for every text file: no path of somebody's machine, nothing left for later, Rust files of a readable length.

use super::File;

const LONGEST_RUST_FILE: usize = 500;

/// Top-level folders that exist on a machine, not in a project.
const MACHINE_FOLDERS: &[&str] = &["home", "root", "work", "tmp", "Users"];

/// Words and macros of unfinished work, in halves so that this file does not complain about itself.
const MARKERS: &[(&str, &str)] = &[("TO", "DO"), ("FIX", "ME"), ("XX", "X")];
const MACROS: &[(&str, &str)] = &[("to", "do!"), ("unimple", "mented!")];

pub fn check(file: &File) -> Vec<String> {
    let Some(text) = file.text() else { return Vec::new() };
    let mut complaints = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let mut complain = |what: String| complaints.push(format!("{}:{}: {what}", file.name, index + 1));
        if let Some(path) = machine_path(line) {
            complain(format!("a path of a machine, {path}"));
        }
        for (start, end) in MARKERS {
            let marker = [*start, *end].concat();
            if has_word(line, &marker) {
                complain(format!("unfinished: {marker}"));
            }
        }
        for (start, end) in MACROS {
            let marker = [*start, *end].concat();
            if file.is_rust() && line.contains(&marker) {
                complain(format!("unfinished: {marker}"));
            }
        }
    }
    let length = text.lines().count();
    if file.is_rust() && length > LONGEST_RUST_FILE {
        complaints.push(format!("{}: {length} lines, more than {LONGEST_RUST_FILE}: split it", file.name));
    }
    complaints
}

/// A machine's folder at the start of an absolute path. Part of a longer path (`../work/`, `$HOME/work/`,
/// `https://example.org/home/`, `target/tmp/`) it is none.
fn machine_path(line: &str) -> Option<String> {
    MACHINE_FOLDERS.iter().map(|folder| format!("/{folder}/")).find(|path| {
        line.match_indices(path.as_str()).any(|(at, _)| {
            let before = line[..at].chars().next_back();
            !before.is_some_and(|c| c.is_alphanumeric() || "./_-~})>*".contains(c))
        })
    })
}

/// Whether `word` stands in the line, not as a part of a longer word.
pub fn has_word(line: &str, word: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(at, _)| {
        !line[..at].chars().next_back().is_some_and(part) && !line[at + word.len()..].chars().next().is_some_and(part)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complaints(name: &str, text: &str) -> usize {
        check(&File { name: name.into(), bytes: text.into() }).len()
    }

    #[test]
    fn machine_paths() {
        let path = |folder: &str| format!("/{folder}/a");
        assert_eq!(complaints("a.md", &path("home")), 1);
        assert_eq!(complaints("a.md", &format!("good\nsee `{}`", path("work"))), 1);
        assert_eq!(complaints("a.toml", &format!("x=\"{}\"", path("tmp"))), 1);
        let part_of = |before: &str, folder: &str| format!("{before}{}", path(folder));
        for fine in [
            part_of("https://example.org", "home"),
            part_of("..", "work"),
            part_of("$HOME", "work"),
            part_of("target", "tmp"),
            path("homes"),
            "home/a".into(),
        ] {
            assert_eq!(complaints("a.md", &fine), 0, "{fine}");
        }
    }

    #[test]
    fn unfinished_work() {
        let marker = ["FIX", "ME"].concat();
        assert_eq!(complaints("a.md", &format!("a {marker}: b")), 1);
        assert_eq!(complaints("a.md", &format!("a{marker}b")), 0);
        let call = ["to", "do!()"].concat();
        assert_eq!(complaints("a.rs", &call), 1);
        assert_eq!(complaints("a.md", &call), 0);
    }

    #[test]
    fn long_rust_files() {
        assert_eq!(complaints("a.rs", &"\n".repeat(LONGEST_RUST_FILE)), 0);
        assert_eq!(complaints("a.rs", &"\n".repeat(LONGEST_RUST_FILE + 1)), 1);
        assert_eq!(complaints("a.csv", &"\n".repeat(LONGEST_RUST_FILE + 1)), 0);
    }
}
