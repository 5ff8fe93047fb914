//! Every number of a value, from its `Debug` form: the estimator's state is private, its `Debug` form shows all of it.

use std::fmt::Debug;

/// How many numbers there are, and of which kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Count {
    pub all: u64,
    pub subnormal: u64,
    pub not_finite: u64,
}

pub(super) fn count(value: &impl Debug) -> Count {
    let text = format!("{value:?}");
    let mut count = Count::default();
    let words = text.split(|c: char| !(c.is_alphanumeric() || matches!(c, '.' | '-' | '+' | '_')));
    // Debug prints the shortest digits that read back as the same f32.
    for number in words.filter_map(|word| word.parse::<f32>().ok()) {
        count.all += 1;
        count.subnormal += u64::from(number.is_subnormal());
        count.not_finite += u64::from(!number.is_finite());
    }
    count
}

#[cfg(test)]
mod tests {
    use super::{Count, count};

    #[derive(Debug)]
    #[allow(dead_code, reason = "read through Debug")]
    struct Sample {
        e: f32,
        inner: [f32; 3],
        k: Option<f32>,
        n: u32,
    }

    #[test]
    fn finds_every_number() {
        let sample = Sample { e: 1e-40, inner: [-1.5e-3, f32::NAN, f32::NEG_INFINITY], k: Some(-1e-45), n: 7 };
        assert_eq!(count(&sample), Count { all: 6, subnormal: 2, not_finite: 2 });
        let sound = Sample { e: 0.0, inner: [f32::MIN_POSITIVE, f32::MAX, -0.0], k: None, n: 0 };
        assert_eq!(count(&sound), Count { all: 5, subnormal: 0, not_finite: 0 });
    }
}
