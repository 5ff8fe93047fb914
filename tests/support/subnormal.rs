//! Subnormal numbers in a value, by its `Debug` form, which shows all of a private state.

use std::fmt::Debug;

/// Each with the name of the field that it follows.
pub fn subnormal(value: &impl Debug) -> Vec<String> {
    let text = format!("{value:?}");
    let mut field = "";
    let mut found = Vec::new();
    for word in text.split(|c: char| !(c.is_alphanumeric() || matches!(c, '.' | '-' | '+' | '_'))) {
        // Debug prints the shortest digits that read back as the same f32.
        match word.parse::<f32>() {
            Ok(number) if number.is_subnormal() => found.push(format!("{field} {number:e}")),
            Ok(_) => {}
            Err(_) if word.is_empty() => {}
            Err(_) => field = word,
        }
    }
    found
}
