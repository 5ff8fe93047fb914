//! Names as C texts, a number of them in one text with a zero behind each: pointers to texts of their own would take as much
//! again, and so would the code that compares one after the other.

use core::ffi::c_char;

/// A text of `all` for C: a zero stands behind it.
fn for_c(text: &'static [u8]) -> *const c_char {
    text.as_ptr().cast()
}

/// What is behind the next zero, a byte at a time.
#[inline(never)]
fn behind_zero(text: &'static [u8]) -> &'static [u8] {
    let mut rest = text;
    while let [byte, behind @ ..] = rest {
        rest = behind;
        if *byte == 0 {
            break;
        }
    }
    rest
}

/// The text of `all` that says `name`, or the one behind it where that begins with an equals sign, without the sign;
/// "configuration" where there is none.
#[inline(never)]
pub(crate) fn named(all: &'static str, name: &str) -> *const c_char {
    let mut text = all.as_bytes();
    while !text.is_empty() {
        let next = behind_zero(text);
        if says(text, name.as_bytes()) {
            return for_c(if let [b'=', other @ ..] = next { other } else { text });
        }
        text = next;
    }
    for_c(b"configuration\0")
}

/// Whether `text` is `name` up to its first zero.
#[inline(never)]
fn says(text: &[u8], name: &[u8]) -> bool {
    let mut text = text.iter();
    for byte in name {
        if text.next() != Some(byte) {
            return false;
        }
    }
    text.next() == Some(&0)
}

/// The text of `all` at `index`, not counting the first one, which stands for those that are not there or empty.
#[inline(never)]
pub(crate) fn at(all: &'static str, index: i32) -> *const c_char {
    let mut text = behind_zero(all.as_bytes());
    let mut left = index;
    while left != 0 && !text.is_empty() {
        text = behind_zero(text);
        left -= 1;
    }
    for_c(if let [0, ..] | [] = text { all.as_bytes() } else { text })
}
