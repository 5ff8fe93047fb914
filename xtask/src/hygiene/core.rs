//! Rules for the core: bare metal, safe, and the same bits on every machine.

use super::{File, text::has_word};

const FOLDER: &str = "fsb-core/src/";
const ROOT: &str = "fsb-core/src/lib.rs";

/// Attributes that the crate root has, unconditionally.
const ATTRIBUTES: &[&str] = &["#![no_std]", "#![forbid(unsafe_code)]"];

/// A fused multiply-add rounds once where a multiplication and an addition round twice: target and host would differ.
const FUSED: &[&str] = &["mul_add", "fma", "fmaf"];

pub fn check(file: &File) -> Vec<String> {
    let mut complaints = Vec::new();
    let Some(text) = file.text().filter(|_| file.name.starts_with(FOLDER) && file.is_rust()) else {
        return complaints;
    };
    for (index, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        for word in FUSED.iter().filter(|word| has_word(code, word)) {
            complaints.push(format!("{}:{}: {word} makes target and host differ", file.name, index + 1));
        }
    }
    complaints
}

pub fn check_root(files: &[File]) -> Vec<String> {
    let root = files.iter().find(|file| file.name == ROOT).and_then(File::text).unwrap_or_default();
    let lacking = ATTRIBUTES.iter().filter(|attribute| !root.lines().any(|line| line.trim() == **attribute));
    lacking.map(|attribute| format!("{ROOT}: lacks {attribute}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(name: &str, text: &str) -> File {
        File { name: name.into(), bytes: text.into() }
    }

    #[test]
    fn fused_operations_in_the_core_only() {
        let code = "let y = a.mul_add(b, c);";
        assert_eq!(check(&file("fsb-core/src/a/b.rs", code)).len(), 1);
        assert_eq!(check(&file("fsb-core/src/a.rs", "libm::fmaf(a, b, c)")).len(), 1);
        assert!(check(&file("fsb-core/src/a.rs", "a * b + c // not mul_add: it rounds once")).is_empty());
        assert!(check(&file("fsb-sim-host/src/a.rs", code)).is_empty());
    }

    #[test]
    fn the_root_has_its_attributes() {
        let good = file(ROOT, "//! a\n#![no_std]\n#![forbid(unsafe_code)]\n");
        assert!(check_root(&[good]).is_empty());
        assert_eq!(check_root(&[file(ROOT, "#![cfg_attr(not(test), no_std)]\n// #![forbid(unsafe_code)]")]).len(), 2);
        assert_eq!(check_root(&[]).len(), 2);
    }
}
