//! How wide a text will be. The reader's sans-serif font is not known here and plotters without a font library
//! counts bytes, so the widths are those of the widest common font (DejaVu Sans), rounded up.

/// Width of `text` at font size `size`, same unit as `size`.
pub(super) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size
}

/// `text`, cut short with an ellipsis when it is wider than `room`.
pub(super) fn fit(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut left = room - width("…", size);
    let mut out: String = text
        .chars()
        .take_while(|&c| {
            left -= advance(c) * size;
            left >= 0.0
        })
        .collect();
    out.push('…');
    out
}

fn advance(c: char) -> f64 {
    match c {
        '\u{300}'..='\u{36F}' => 0.0,
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | ' ' => 0.33,
        'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '-' | '/' => 0.41,
        '⁰'..='⁻' | '²' | '³' | '¹' => 0.43,
        'm' | 'w' | 'M' | 'W' | '%' | '@' | '…' => 0.98,
        'A'..='Z' => 0.74,
        '−' | '×' | '±' | '+' | '=' | '<' | '>' => 0.84,
        c if c >= '\u{1100}' && !('\u{2000}'..'\u{2E80}').contains(&c) => 1.0,
        _ => 0.64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_text_fits() {
        let long = "a name that is much too long to stand above a panel";
        assert_eq!(fit(long, 12.0, 1000.0), long);
        for room in [20.0, 50.0, 120.0] {
            let cut = fit(long, 12.0, room);
            assert!(cut.ends_with('…') && width(&cut, 12.0) <= room);
        }
    }

    #[test]
    fn a_character_of_several_bytes_counts_once() {
        assert_eq!(width("ŷŷ", 10.0), width("yy", 10.0));
        assert_eq!(width("k\u{302}", 10.0), width("k", 10.0));
    }
}
