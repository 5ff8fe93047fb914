//! How a CSV text is laid out: in which characters, and what stands between its fields.

use csv::{Reader, ReaderBuilder, Trim};
use std::io::{Error, ErrorKind};

use super::lines::Lines;

/// Rows with spaces around their fields taken away, and the lines that they begin on.
///
/// # Errors
/// A text in UTF-16, as some shells redirect it.
pub(super) fn rows(bytes: &[u8]) -> Result<(Reader<&[u8]>, Lines<'_>), Error> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(Error::new(ErrorKind::InvalidData, "it is in UTF-16, expected UTF-8"));
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut builder = ReaderBuilder::new();
    builder.has_headers(false).flexible(true).trim(Trim::All).delimiter(separator(text));
    Ok((builder.from_reader(text), Lines::of_text(text)))
}

/// Comma, semicolon or tab, whichever stands most often in the first line that holds anything; a comma where none does. What is
/// in quotation marks does not count.
fn separator(text: &[u8]) -> u8 {
    let begin = text.iter().position(|byte| !b"\r\n".contains(byte)).unwrap_or(text.len());
    let (mut counts, mut quoted) = ([0_usize; 3], false);
    let separators = b",;\t";
    for byte in text.iter().skip(begin).take_while(|byte| !b"\r\n".contains(byte)) {
        quoted ^= *byte == b'"';
        if let Some(index) = separators.iter().position(|separator| separator == byte && !quoted) {
            counts[index] += 1;
        }
    }
    let most = counts.iter().max().copied().unwrap_or(0);
    counts.iter().position(|&count| count == most).map_or(b',', |index| separators[index])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_between_the_fields() {
        for (text, expected) in [
            ("", b','),
            ("t", b','),
            ("t,x,fx\n0;1;2;3", b','),
            ("\r\n\nt;x;fx\n1,2;3,4;5,6\n", b';'),
            ("t\tx\tfx;fy\n", b'\t'),
            ("t,\"a;b;c;d\",fx", b','),
            ("t;\"a,b,c,d\"", b';'),
        ] {
            assert_eq!(char::from(separator(text.as_bytes())), char::from(expected), "{text:?}");
        }
    }

    #[test]
    fn another_encoding_is_named() {
        let text: Vec<u8> = "\u{feff}t,x".encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert!(rows(&text).err().unwrap().to_string().contains("UTF-16"));
    }
}
