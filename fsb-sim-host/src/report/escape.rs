//! Text made safe for XML and HTML.

/// `text` with the five markup characters escaped and characters that XML 1.0 forbids replaced.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in printable(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    out
}

/// `text` on one line: white space controls become spaces, other controls and non-characters become U+FFFD.
/// A terminal escape sequence is thereby harmless too.
pub(super) fn printable(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '\n' | '\r' | '\t' => ' ',
            '\u{FFFE}' | '\u{FFFF}' => '\u{FFFD}',
            other if other.is_control() => '\u{FFFD}',
            other => other,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn markup_becomes_text() {
        assert_eq!(
            escape("<script>alert(\"a\" & 'b')</script>"),
            "&lt;script&gt;alert(&quot;a&quot; &amp; &#39;b&#39;)&lt;/script&gt;"
        );
    }

    #[test]
    fn controls_do_not_reach_a_terminal_or_a_page() {
        assert_eq!(printable("a\u{1b}[2Jb\nc\u{0}"), "a\u{FFFD}[2Jb c\u{FFFD}");
    }

    proptest! {
        /// A parser gives back what was escaped, as text and as an attribute.
        #[test]
        fn a_parser_reads_the_text_back(text in any::<String>()) {
            let xml = format!("<a b=\"{0}\">{0}</a>", escape(&text));
            let parsed = roxmltree::Document::parse(&xml).unwrap();
            prop_assert_eq!(parsed.root_element().text().unwrap_or(""), printable(&text));
            prop_assert_eq!(parsed.root_element().attribute("b").unwrap(), printable(&text));
        }
    }
}
