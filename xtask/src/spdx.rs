//! SPDX licence expressions: may this be used under licences of a list?

use anyhow::{Result, bail};

/// Whether the expression can be satisfied with `allowed` licences alone: one side of an `OR`, both sides of an `AND`.
/// `WITH` and its exception belong to the licence's name; the old `MIT/Apache-2.0` is an `OR`.
///
/// # Errors
/// Text that is not such an expression.
pub fn satisfied(expression: &str, allowed: &[&str]) -> Result<bool> {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let mut parser = Parser { words: spaced.split_whitespace().collect(), next: 0, allowed };
    let value = parser.or();
    match value {
        Some(value) if parser.next == parser.words.len() => Ok(value),
        _ => bail!("not a licence expression: `{expression}`"),
    }
}

struct Parser<'a> {
    words: Vec<&'a str>,
    next: usize,
    allowed: &'a [&'a str],
}

impl Parser<'_> {
    fn or(&mut self) -> Option<bool> {
        let mut value = self.and()?;
        while self.take("OR") {
            value |= self.and()?;
        }
        Some(value)
    }

    fn and(&mut self) -> Option<bool> {
        let mut value = self.one()?;
        while self.take("AND") {
            value &= self.one()?;
        }
        Some(value)
    }

    fn one(&mut self) -> Option<bool> {
        if self.take("(") {
            let value = self.or()?;
            return self.take(")").then_some(value);
        }
        let mut name = self.name()?.to_string();
        if self.take("WITH") {
            name = format!("{name} WITH {}", self.name()?);
        }
        Some(self.allowed.contains(&name.as_str()))
    }

    fn name(&mut self) -> Option<&str> {
        let word = self.words.get(self.next).filter(|word| !["OR", "AND", "WITH", "(", ")"].contains(word))?;
        self.next += 1;
        Some(word)
    }

    fn take(&mut self, word: &str) -> bool {
        let found = self.words.get(self.next) == Some(&word);
        self.next += usize::from(found);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALLOWED: &[&str] = &["MIT", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "Unicode-3.0"];

    #[test]
    fn expressions() {
        for (expression, expected) in [
            ("MIT", true),
            ("GPL-3.0-only", false),
            ("GPL-3.0-only OR MIT", true),
            ("MIT/GPL-2.0", true),
            ("MIT AND GPL-2.0", false),
            ("(MIT OR GPL-2.0) AND Unicode-3.0", true),
            ("(MIT OR Apache-2.0) AND OpenSSL", false),
            ("GPL-2.0 AND MIT OR MIT", true),
            ("MIT OR MIT AND GPL-2.0", true),
            ("GPL-2.0 AND (MIT OR MIT)", false),
            ("Apache-2.0 WITH LLVM-exception", true),
            ("GPL-2.0 WITH LLVM-exception", false),
            ("MIT WITH something", false),
        ] {
            assert_eq!(satisfied(expression, ALLOWED).unwrap(), expected, "{expression}");
        }
    }

    #[test]
    fn what_is_no_expression() {
        for expression in ["", "MIT OR", "OR MIT", "(MIT", "MIT)", "MIT MIT", "MIT WITH", "MIT AND (", "()"] {
            assert!(satisfied(expression, ALLOWED).is_err(), "{expression}");
        }
    }
}
