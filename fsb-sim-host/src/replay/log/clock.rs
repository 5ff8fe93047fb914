//! The time column: its period, and whether it is uniform.

use super::error::Place;
use super::{FEWEST_SAMPLES, LogError};

/// Share of the period by which a step, or a time, may be off beyond its written rounding.
const JITTER: f64 = 0.01;
/// Share of the period that is never passed, whatever the rounding: a lost row in the shortest log is 50 % off the mean.
const LARGEST: f64 = 0.45;

/// Times as they come, checked to increase.
pub struct Clock<'a> {
    file: &'a str,
    times: Vec<f64>,
    lines: Vec<usize>,
    /// Most significant digits and most decimals in any time so far.
    digits: i32,
    decimals: i32,
}

impl<'a> Clock<'a> {
    pub fn new(file: &'a str) -> Self {
        Self { file, times: Vec::new(), lines: Vec::new(), digits: 1, decimals: 0 }
    }

    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Appends a time, `field` as written and `time` as a number.
    pub fn push(&mut self, place: &Place<'_>, field: &[u8], time: f64) -> Result<(), LogError> {
        if let Some(&previous) = self.times.last()
            && time <= previous
        {
            let (file, line) = (self.file.into(), place.line);
            return Err(LogError::NotIncreasing { file, line, found: time, previous });
        }
        let (digits, decimals) = written(field);
        self.digits = self.digits.max(digits);
        self.decimals = self.decimals.max(decimals);
        self.times.push(time);
        self.lines.push(place.line);
        Ok(())
    }

    /// The first time and the period \[s\]; `last_line` is the one of the last row.
    pub fn finish(self, last_line: usize) -> Result<(f64, f64), LogError> {
        let file = || self.file.to_string();
        let count = self.times.len();
        if count < FEWEST_SAMPLES {
            return Err(LogError::TooShort { file: file(), line: last_line, found: count, expected: FEWEST_SAMPLES });
        }
        let (first, last) = (self.times[0], self.times[count - 1]);
        let period = (last - first) / (count - 1) as f64;
        if !self.is_uniform(period) {
            let (line, step, median) = self.worst_step();
            return Err(LogError::NonUniform { file: file(), line, step, median });
        }
        // Beyond twelve digits lies the rounding of the subtraction (0.009999999999999998 for 0.01).
        let period = rounded(period, 12);
        if period < f64::from(f32::MIN_POSITIVE) {
            return Err(LogError::Period { file: file(), line: last_line, period });
        }
        Ok((first, period))
    }

    fn is_uniform(&self, period: f64) -> bool {
        let first = self.times[0];
        let ends = self.rounding(first).max(self.rounding(self.times[self.times.len() - 1]));
        let within = |error: f64, rounding: f64| error.abs() <= (JITTER * period + rounding).min(LARGEST * period);
        let steps = self.times.windows(2).all(|pair| {
            let rounding = self.rounding(pair[0]) + self.rounding(pair[1]);
            within(pair[1] - pair[0] - period, rounding)
        });
        let grid = self
            .times
            .iter()
            .enumerate()
            .all(|(index, &time)| within(time - first - index as f64 * period, self.rounding(time) + ends));
        steps && grid
    }

    /// Half a unit in the last place that the column writes: of its decimals, or of its significant digits where these
    /// are the shorter ones (`%g`).
    fn rounding(&self, time: f64) -> f64 {
        let by_decimals = 10_f64.powi(-self.decimals);
        let by_digits =
            if time == 0.0 { 0.0 } else { 10_f64.powi(time.abs().log10().floor() as i32 + 1 - self.digits) };
        0.5 * by_decimals.max(by_digits)
    }

    /// The step furthest from the median one: the line it ends on, its length, the median.
    fn worst_step(&self) -> (usize, f64, f64) {
        let steps: Vec<f64> = self.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut sorted = steps.clone();
        sorted.sort_by(f64::total_cmp);
        let median = sorted[sorted.len() / 2];
        let mut worst = 0;
        for (index, step) in steps.iter().enumerate() {
            if (step - median).abs() > (steps[worst] - median).abs() {
                worst = index;
            }
        }
        (self.lines[worst + 1], rounded(steps[worst], 6), rounded(median, 6))
    }
}

/// A value to so many significant digits.
fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

/// Significant digits and decimals of a number as it is written; a negative count of decimals is a power of ten.
fn written(field: &[u8]) -> (i32, i32) {
    let text = String::from_utf8_lossy(field).to_lowercase();
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let fraction = mantissa.split_once('.').map_or("", |(_, fraction)| fraction);
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let significant = digits.trim_start_matches('0').len() as i32;
    (significant, fraction.len() as i32 - exponent.parse::<i32>().unwrap_or(0).clamp(-400, 400))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_as_written() {
        for (field, expected) in [
            ("0", (0, 0)),
            ("12", (2, 0)),
            ("-0.010", (2, 3)),
            ("123.456", (6, 3)),
            ("1.5e-3", (2, 4)),
            ("2E2", (1, -2)),
            ("0.", (0, 0)),
        ] {
            assert_eq!(written(field.as_bytes()), expected, "{field}");
        }
    }

    #[test]
    fn rounding_to_digits() {
        assert_eq!(rounded(0.009999999999999998, 12), 0.01);
        assert_eq!(rounded(0.0025, 12), 0.0025);
        assert_eq!(rounded(1.0 / 3000.0, 12), 0.000333333333333);
        assert_eq!(rounded(0.019999999, 6), 0.02);
    }
}
