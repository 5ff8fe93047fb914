//! Where an axis is marked, and with what text.

use super::axis::Axis;

/// Marks of an axis.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Ticks {
    /// Place in axis units and label.
    pub marks: Vec<(f64, String)>,
    /// Places of short unlabelled marks, in axis units.
    pub minor: Vec<f64>,
    /// Power of ten the labels are to be multiplied with, e.g. `×10⁻⁷`; empty for none.
    pub factor: String,
}

/// Round steps for `axis`, as many as possible up to `most` marks.
pub(super) fn ticks(axis: &Axis, most: usize) -> Ticks {
    if !axis.log {
        return linear(axis.lo, axis.hi, most);
    }
    if axis.hi - axis.lo >= 1.0 && axis.hi.floor() > axis.lo.ceil() {
        return decades(axis, most);
    }
    // Less than two powers of ten in sight: marks at round values are of more use.
    let plain = linear(10f64.powf(axis.lo), 10f64.powf(axis.hi), most);
    let scale = |value: f64| value.log10();
    Ticks { marks: plain.marks.into_iter().map(|(v, label)| (scale(v), label)).collect(), ..plain }
}

fn linear(lo: f64, hi: f64, most: usize) -> Ticks {
    let step = step(lo, hi, most);
    let Some((digit, exponent)) = step else { return Ticks::default() };
    let largest = lo.abs().max(hi.abs());
    let order = largest.log10().floor() as i32;
    let shared = if (-3..5).contains(&order) { 0 } else { order };
    let decimals = usize::try_from(shared - exponent).unwrap_or(0);
    let unit = f64::from(digit) * ten(exponent);
    let first = (lo / unit - 1e-6).ceil();
    let last = (hi / unit + 1e-6).floor();
    let count = (last - first).max(-1.0) as usize + 1;
    let marks = (0..count)
        .map(|i| {
            let n = first + i as f64;
            let label = minus(&format!("{:.decimals$}", n * f64::from(digit) * ten(exponent - shared)));
            ((n * unit).clamp(lo, hi), label)
        })
        .collect();
    let factor = if shared == 0 { String::new() } else { format!("×10{}", superscript(shared)) };
    Ticks { marks, minor: Vec::new(), factor }
}

/// The smallest step 1, 2 or 5 times a power of ten, as (digit, exponent), with at most `most` marks in `lo..=hi`.
fn step(lo: f64, hi: f64, most: usize) -> Option<(u8, i32)> {
    let length = hi - lo;
    let guess = (length / most.max(1) as f64).log10().floor();
    if !guess.is_finite() {
        return None;
    }
    let fits = |unit: f64| (hi / unit + 1e-6).floor() - (lo / unit - 1e-6).ceil() < most.max(2) as f64;
    (guess as i32 - 1..guess as i32 + 3)
        .flat_map(|exponent| [1u8, 2, 5].map(|digit| (digit, exponent)))
        .find(|&(digit, exponent)| fits(f64::from(digit) * ten(exponent)))
}

fn decades(axis: &Axis, most: usize) -> Ticks {
    let (first, last) = (axis.lo.ceil() as i32, axis.hi.floor() as i32);
    let every = (1..).find(|every| (last - first) / every < most.max(2) as i32).unwrap_or(1);
    let marks = (first..=last)
        .filter(|n| n.rem_euclid(every) == 0)
        .map(|n| (f64::from(n), format!("10{}", superscript(n))))
        .collect();
    let minor = if every > 1 {
        (first..=last).filter(|n| n.rem_euclid(every) != 0).map(f64::from).collect()
    } else {
        (first - 1..=last)
            .flat_map(|n| (2..10).map(move |digit| f64::from(n) + f64::from(digit).log10()))
            .filter(|place| (axis.lo..=axis.hi).contains(place))
            .collect()
    };
    Ticks { marks, minor, factor: String::new() }
}

/// 10^`exponent`, the nearest f64.
fn ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// A formatted number with a true minus sign, and none before zero.
pub(super) fn minus(number: &str) -> String {
    match number.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
        Some(rest) => format!("\u{2212}{rest}"),
        None => number.to_owned(),
    }
}

/// `n` in superscript figures.
pub(super) fn superscript(n: i32) -> String {
    const FIGURES: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    n.to_string().bytes().map(|b| if b == b'-' { '⁻' } else { FIGURES[usize::from(b - b'0')] }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(lo: f64, hi: f64, log: bool, most: usize) -> (Vec<String>, String) {
        let ticks = ticks(&Axis { lo, hi, log }, most);
        (ticks.marks.into_iter().map(|m| m.1).collect(), ticks.factor)
    }

    #[test]
    fn round_numbers() {
        assert_eq!(labels(0.0, 10.0, false, 6).0, ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(labels(-0.13, 0.11, false, 4).0, ["−0.1", "0.0", "0.1"]);
        assert_eq!(labels(1.999, 2.001, false, 3).0, ["1.999", "2.000", "2.001"]);
    }

    #[test]
    fn small_and_large_values_share_a_power_of_ten() {
        assert_eq!(labels(0.0, 4e-7, false, 3), (["0", "2", "4"].map(String::from).to_vec(), "×10⁻⁷".into()));
        assert_eq!(labels(0.0, 1.5e6, false, 4).0, ["0.0", "0.5", "1.0", "1.5"]);
    }

    #[test]
    fn logarithmic_axes() {
        assert_eq!(labels(-3.2, 0.1, true, 6).0, ["10⁻³", "10⁻²", "10⁻¹", "10⁰"]);
        assert_eq!(labels(-12.0, 0.0, true, 5).0.len(), 5);
        assert_eq!(labels(2f64.log10(), 5.0_f64.log10(), true, 4).0, ["2", "3", "4", "5"]);
        let minor = ticks(&Axis { lo: 0.0, hi: 1.0, log: true }, 5).minor;
        assert_eq!(minor.len(), 8);
    }

    proptest! {
        /// Each label read as a number is its own place; there are at most as many as asked, and at least one.
        #[test]
        fn labels_say_where_they_are(mid in -1e3..1e3, size in -6i32..6, most in 3usize..12) {
            let half = 10f64.powi(size);
            let (lo, hi) = (mid * half - half, mid * half + half);
            let t = ticks(&Axis { lo, hi, log: false }, most);
            prop_assert!((1..=most).contains(&t.marks.len()));
            let power = (-9..10).find(|&n| t.factor == format!("×10{}", superscript(n))).unwrap_or(0);
            for (place, label) in &t.marks {
                let read: f64 = label.replace('\u{2212}', "-").parse().unwrap();
                prop_assert!((read * ten(power) - place).abs() <= 1e-9 * (hi - lo) + 1e-12 * place.abs());
            }
        }
    }
}
