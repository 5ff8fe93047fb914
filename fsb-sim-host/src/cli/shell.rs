//! Words of a command line that is shown, such that a shell gives them back as they were.

/// `word` as it is where a shell reads it so, else in quotes.
pub(super) fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "_@%+=:,./-".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// A file as an argument: one whose name begins like an option is given by its folder.
pub(super) fn quoted_file(name: &str) -> String {
    if name.starts_with('-') { quoted(&format!("./{name}")) } else { quoted(name) }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::process::Command;

    /// Asked of a shell itself.
    #[test]
    fn a_shell_reads_the_words_back() {
        let words = [
            "log.csv",
            "my log.csv",
            "it's",
            "a\"b$HOME`ls`\\",
            "*",
            "",
            "~",
            "#x",
            "a;b|c&d<e>f(g)",
            "!x",
            "λ=2 µ",
            "-a",
        ];
        for word in words {
            let output =
                Command::new("sh").arg("-c").arg(format!("printf '%s|' {} end", quoted(word))).output().unwrap();
            assert_eq!(String::from_utf8(output.stdout).unwrap(), format!("{word}|end|"));
        }
        assert_eq!((quoted("plant.mass=3.1"), quoted_file("-a b")), ("plant.mass=3.1".into(), "'./-a b'".into()));
    }
}
