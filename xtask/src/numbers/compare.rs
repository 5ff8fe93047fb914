//! Texts that are the same but for what the machine does to the last digit.
//!
//! Seeds are fixed and no result depends on the number of threads; but the sine of one machine is not that of another to the
//! last bit, and a number at the edge may be rounded the other way.
//!
//! | class | apart by |
//! |---|---|
//! | what the f32 core makes of forces and positions that are f32 themselves | nothing: a last bit of an f64 sine is gone there |
//! | the same in flights simulated in f64, with noise | one in the last digit |
//! | counts, instructions, bytes, programs | nothing |
//! | figures | two pixels |
//! | times | not shown |
//!
//! With every third result of `sin`, `cos`, `exp`, `log`, `pow`, `atan2`, `tan` and `hypot` moved to a neighbouring f64, no number of the
//! documents changed by a digit.

/// How far two numbers may be apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Not at all.
    None,
    /// By one in the last digit.
    LastDigit,
    /// By sixteen, which is two pixels of a figure.
    Drawing,
}

/// Words, and numbers with the weight of their last digit.
#[derive(Debug, PartialEq)]
enum Piece<'a> {
    Words(&'a str),
    Number { value: f64, unit: f64 },
}

/// The differences line by line, `None` if the texts are the same.
pub fn same(written: &str, fresh: &str, tolerance: Tolerance) -> Option<String> {
    let (old, new): (Vec<_>, Vec<_>) = (written.lines().collect(), fresh.lines().collect());
    let mut difference = String::new();
    for index in 0..old.len().max(new.len()) {
        let (before, after) = (old.get(index), new.get(index));
        if before.zip(after).is_some_and(|(a, b)| same_line(a, b, tolerance)) {
            continue;
        }
        difference.extend(before.map(|line| format!("  - {line}\n")));
        difference.extend(after.map(|line| format!("  + {line}\n")));
    }
    if difference.is_empty() { None } else { Some(difference) }
}

fn same_line(a: &str, b: &str, tolerance: Tolerance) -> bool {
    if a == b || tolerance == Tolerance::None {
        return a == b;
    }
    let (a, b) = (pieces(a), pieces(b));
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| match (a, b) {
            (Piece::Number { value: a, unit: ua }, Piece::Number { value: b, unit: ub }) => {
                let allowed = match tolerance {
                    Tolerance::Drawing => 16.0,
                    // Whole numbers are counts.
                    _ if *ua >= 1.0 => 0.0,
                    _ => 1.001 * ua.max(*ub),
                };
                (a - b).abs() <= allowed
            }
            _ => a == b,
        })
}

/// Splits at numbers: digits, with a point and digits, with an exponent. A sign is words; whole numbers have the unit 1 and
/// are counts.
fn pieces(line: &str) -> Vec<Piece<'_>> {
    let bytes = line.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let at = |index: usize| bytes.get(index).copied().unwrap_or(0);
    let mut pieces = Vec::new();
    let (mut index, mut words) = (0, 0);
    while index < bytes.len() {
        let mut end = index + digits(index);
        if end == index {
            index += 1;
            continue;
        }
        let mut decimals = 0;
        if at(end) == b'.' {
            decimals = digits(end + 1);
            end += if decimals > 0 { 1 + decimals } else { 0 };
        }
        let mut exponent = 0;
        let sign = usize::from(at(end + 1) == b'-');
        if at(end) == b'e' && digits((end + 1 + sign).min(bytes.len())) > 0 {
            let from = end + 1;
            end = from + sign + digits(from + sign);
            exponent = line[from..end].parse().unwrap_or(0);
        }
        if words < index {
            pieces.push(Piece::Words(&line[words..index]));
        }
        let value = line[index..end].parse().unwrap_or(f64::NAN);
        pieces.push(Piece::Number { value, unit: 10f64.powi(exponent - decimals as i32) });
        (index, words) = (end, end);
    }
    if words < bytes.len() {
        pieces.push(Piece::Words(&line[words..]));
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn equal(a: &str, b: &str, tolerance: Tolerance) -> bool {
        same(a, b, tolerance).is_none()
    }

    #[test]
    fn the_last_digit_may_differ_by_one() {
        use Tolerance::{LastDigit, None};
        assert!(equal("| x | 1.234 |", "| x | 1.235 |", LastDigit));
        assert!(!equal("| x | 1.234 |", "| x | 1.236 |", LastDigit));
        assert!(!equal("| x | 1.234 |", "| y | 1.234 |", LastDigit));
        assert!(!equal("| x | 1.234 |", "| x | -1.234 |", LastDigit));
        assert!(!equal("1.234", "1.235", None));
        assert!(equal("2.1e-7 and 10.00", "2.2e-7 and 9.99", LastDigit));
        assert!(!equal("2.1e-7", "2.1e-6", LastDigit));
        assert!(!equal("100 runs", "101 runs", LastDigit));
    }

    #[test]
    fn a_drawing_may_move_by_two_pixels() {
        assert!(equal("<p points=\"542,564 734,564\"/>", "<p points=\"542,580 735,564\"/>", Tolerance::Drawing));
        assert!(!equal("<p points=\"542,564\"/>", "<p points=\"542,581\"/>", Tolerance::Drawing));
    }

    #[test]
    fn lines_that_came_or_went_are_shown() {
        assert_eq!(same("a\nb\n", "a\nc\nd\n", Tolerance::LastDigit).unwrap(), "  - b\n  + c\n  + d\n");
        assert!(!equal("a\n", "", Tolerance::LastDigit));
    }

    #[test]
    fn pieces_keep_everything() {
        use Piece::{Number, Words};
        let expected =
            [Words("é "), Number { value: 1.5e-3, unit: 1e-4 }, Words("e, x"), Number { value: 2.0, unit: 1.0 }];
        assert_eq!(pieces("é 1.5e-3e, x2"), expected);
        assert_eq!(pieces("7."), [Number { value: 7.0, unit: 1.0 }, Words(".")]);
        assert_eq!(pieces("7e"), [Number { value: 7.0, unit: 1.0 }, Words("e")]);
    }
}
