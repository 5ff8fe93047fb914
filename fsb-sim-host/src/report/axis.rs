//! One axis: from a value to its place between the ends.

/// Length below which a range around zero counts as none.
pub(super) const SHORTEST: f64 = 1e-300;
/// Magnitude beyond which a value is a gap; differences of two kept values stay finite.
const LIMIT: f64 = 1e300;

/// Range of an axis, in axis units: the value itself, or its decimal logarithm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    pub lo: f64,
    pub hi: f64,
    pub log: bool,
}

impl Axis {
    /// `value` in axis units; NaN when it cannot be drawn.
    pub fn unit(log: bool, value: f64) -> f64 {
        let unit = if !log {
            value
        } else if value > 0.0 {
            value.log10()
        } else {
            f64::NAN
        };
        if unit.abs() <= LIMIT { unit } else { f64::NAN }
    }

    /// Place of `value`: 0 at the low end, 1 at the high end, NaN for a gap; far outside it is held at ±1e6.
    pub fn fraction(&self, value: f64) -> f64 {
        self.fraction_of_unit(Self::unit(self.log, value))
    }

    /// The same for a value already in axis units.
    pub fn fraction_of_unit(&self, unit: f64) -> f64 {
        ((unit - self.lo) / (self.hi - self.lo)).clamp(-1e6, 1e6)
    }

    /// An axis over `lo..=hi` (axis units) widened by `margin` of its length at both ends, and widened further when it
    /// has no length worth the name; 0 to 1 (log: one decade) without data.
    pub fn around(lo: f64, hi: f64, margin: f64, log: bool) -> Self {
        if lo > hi {
            return Self { lo: 0.0, hi: 1.0, log };
        }
        let size = lo.abs().max(hi.abs());
        let (lo, hi) = if hi - lo > (1e-11 * size).max(SHORTEST) {
            (lo, hi)
        } else if log {
            (lo - 0.5, hi + 0.5)
        } else if size <= 10.0 * SHORTEST {
            (-1.0, 1.0)
        } else {
            (lo - 0.1 * size, hi + 0.1 * size)
        };
        let extra = margin * (hi - lo);
        Self { lo: lo - extra, hi: hi + extra, log }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middle() {
        let axis = Axis { lo: -1.0, hi: 3.0, log: false };
        assert_eq!([-1.0, 1.0, 3.0].map(|v| axis.fraction(v)), [0.0, 0.5, 1.0]);
        let decades = Axis { lo: -2.0, hi: 2.0, log: true };
        assert_eq!([0.01, 1.0, 100.0].map(|v| decades.fraction(v)), [0.0, 0.5, 1.0]);
    }

    #[test]
    fn what_cannot_be_drawn_is_a_gap() {
        let axis = Axis { lo: 0.0, hi: 1.0, log: false };
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e301] {
            assert!(axis.fraction(bad).is_nan());
        }
        let decades = Axis { log: true, ..axis };
        assert!(decades.fraction(0.0).is_nan() && decades.fraction(-1.0).is_nan());
        assert_eq!(axis.fraction(1e299), 1e6);
    }

    #[test]
    fn an_axis_always_has_length() {
        for (lo, hi) in [(0.0, 0.0), (2.0, 2.0), (-3e299, 3e299), (1.0, 1.0 + 1e-15), (1.0, 0.0), (5e-324, 5e-324)] {
            for log in [false, true] {
                let axis = Axis::around(lo, hi, 0.05, log);
                assert!(axis.hi > axis.lo && (axis.hi - axis.lo).is_finite(), "{lo} {hi} {log}");
            }
        }
    }
}
