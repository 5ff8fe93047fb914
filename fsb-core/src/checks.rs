//! Checking a configuration: every value in turn, asking for the outcome once.
//!
//! A configuration is read once, its code stays in flash for good. So that little of it is needed, the first thing found
//! wrong is noted down in place of a way out at every value, and numbers are compared in f32, or by their bits, without
//! double-precision arithmetic that a small processor has to do in software.

use crate::error::ConfigError;
use crate::wide::Wide;

/// The variants of [`ConfigError`], without the name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    NonFinite,
    NonPositive,
    Negative,
    OutOfRange,
    TooFastForPeriod,
    TooSlowForPeriod,
    InvertedRange,
    Zero,
}

impl Fault {
    /// The fault of the parameter `name`.
    pub const fn of(self, name: &'static str) -> ConfigError {
        match self {
            Self::NonFinite => ConfigError::NonFinite(name),
            Self::NonPositive => ConfigError::NonPositive(name),
            Self::Negative => ConfigError::Negative(name),
            Self::OutOfRange => ConfigError::OutOfRange(name),
            Self::TooFastForPeriod => ConfigError::TooFastForPeriod(name),
            Self::TooSlowForPeriod => ConfigError::TooSlowForPeriod(name),
            Self::InvertedRange => ConfigError::InvertedRange(name),
            Self::Zero => ConfigError::Zero(name),
        }
    }
}

/// The numbers that are right, ends included, and what the others are. Zero has no sign.
///
/// To the precision of f32, in which a number is kept: one that is rounded to an end is right.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    low: f32,
    high: f32,
    not_finite: Fault,
    /// Negative numbers; and zero, unless these are called negative.
    not_positive: Fault,
    below: Fault,
    above: Fault,
}

impl Range {
    /// Positive numbers.
    pub const fn positive(low: f32, high: f32) -> Self {
        Self {
            low,
            high,
            not_finite: Fault::NonFinite,
            not_positive: Fault::NonPositive,
            below: Fault::OutOfRange,
            above: Fault::OutOfRange,
        }
    }

    /// Zero, and positive numbers.
    pub const fn from_zero(high: f32) -> Self {
        Self { not_positive: Fault::Negative, ..Self::positive(0.0, high) }
    }

    /// Any positive number.
    pub const POSITIVE: Self = Self::positive(0.0, f32::INFINITY);
    /// A limit of what is measured or applied, and the like.
    pub const LIMIT: Self = Self::positive(0.0, 1e6);
    /// A standard deviation that need not be known.
    pub const STANDARD_DEVIATION: Self = Self::positive(1e-12, 1e6);
    /// The magnitude of a drift, and the like.
    pub const MAGNITUDE: Self = Self::from_zero(1e6);
    /// A period over the time constant of what fades.
    pub const FADING: Self = Self { not_finite: Fault::OutOfRange, ..Self::from_zero(1.0) };
    /// A share of what there is.
    pub const SHARE: Self = Self::positive(0.0, 1.0);
    /// What f32 handles well, squares included.
    pub const PARAMETER: Self = Self::positive(1e-15, 1e15);
    /// A period (s) must keep T² and 1/T² far from the ends of f32.
    pub const PERIOD: Self = Self::positive(1e-6, 1e3);
    /// A rate times the period it runs at.
    pub const RATE: Self = Self {
        not_finite: Fault::TooFastForPeriod,
        not_positive: Fault::TooSlowForPeriod,
        below: Fault::TooSlowForPeriod,
        above: Fault::TooFastForPeriod,
        ..Self::positive(1e-6, 1.0)
    };

    /// What is wrong with `value`, which is `rounded` in f32.
    fn fault(&self, value: Wide, rounded: f32) -> Option<Fault> {
        if !value.is_finite() {
            Some(self.not_finite)
        } else if value.magnitude() == Wide::ZERO || value.is_negative() {
            let right = matches!(self.not_positive, Fault::Negative) && value.magnitude() == Wide::ZERO;
            if right { None } else { Some(self.not_positive) }
        } else if rounded < self.low {
            Some(self.below)
        } else if rounded > self.high {
            Some(self.above)
        } else {
            None
        }
    }
}

/// A parameter by its name, and what is right for it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rule(pub &'static str, pub &'static Range);

/// A [`Rule`] for one of [`NAMES`](crate::error::NAMES).
macro_rules! rule {
    ($name:literal, $range:expr) => {
        const { &$crate::checks::Rule($crate::error::name($name), &$range) }
    };
}
pub(crate) use rule;

/// What has been found so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Checks {
    first: Result<(), ConfigError>,
}

impl Checks {
    /// Nothing wrong.
    pub const fn new() -> Self {
        Self { first: Ok(()) }
    }

    /// The first thing found wrong.
    pub const fn outcome(&self) -> Result<(), ConfigError> {
        self.first
    }

    /// Notes down a fault of the parameter `name`, unless there is one already.
    #[inline(never)]
    pub fn note(&mut self, name: &'static str, fault: Fault) {
        if self.first.is_ok() {
            self.first = Err(fault.of(name));
        }
    }

    /// A number; hands it back in f32.
    #[inline(never)]
    pub fn within(&mut self, rule: &Rule, value: Wide) -> f32 {
        let rounded = value.rounded();
        if let Some(fault) = rule.1.fault(value, rounded) {
            self.note(rule.0, fault);
        }
        rounded
    }

    /// The same for a number as it is written in a configuration.
    pub fn number(&mut self, rule: &'static Rule, value: f64) -> f32 {
        self.within(rule, Wide::new(value))
    }

    /// A number of either sign, by its magnitude.
    #[inline(never)]
    pub fn signed(&mut self, rule: &'static Rule, value: f64) -> f32 {
        let value = Wide::new(value);
        self.within(rule, value.magnitude());
        value.rounded()
    }

    /// A pair of limits: the lower one below the upper one, or equal to it where `may_be_equal`.
    #[inline(never)]
    pub fn limits(&mut self, rules: &'static [Rule; 2], limits: [f64; 2], may_be_equal: bool) -> (f32, f32) {
        let [low, high] = limits.map(Wide::new);
        let least = self.within(&rules[0], low);
        // Negative numbers have negative bits here, zero with a sign the least of all, and are below any lower limit that is right.
        let from = (low.bits() as i64).wrapping_add(i64::from(!may_be_equal));
        if (high.bits() as i64) < from && high.is_finite() {
            self.note(rules[0].0, Fault::InvertedRange);
        }
        (least, self.within(&rules[1], high))
    }

    /// A rate (1/s), and what it makes of the period it runs at.
    #[inline(never)]
    pub fn rate(&mut self, name: &'static str, rate: Wide, period: Wide) {
        self.within(&Rule(name, &Range::POSITIVE), rate);
        self.within(&Rule(name, &Range::RATE), rate * period);
    }

    /// A number that need not be known: NaN where it is not.
    #[inline(never)]
    pub fn if_known(&mut self, rule: &'static Rule, value: f64) -> Option<f32> {
        let value = Wide::new(value);
        if value.is_nan() { None } else { Some(self.within(rule, value)) }
    }

    /// A number of control periods or measurements.
    #[inline(never)]
    pub fn count(&mut self, name: &'static str, count: u32) {
        if count == 0 {
            self.note(name, Fault::Zero);
        } else if count > 65_535 {
            self.note(name, Fault::OutOfRange);
        }
    }

    /// A time (s), in measurements, rounded up.
    #[inline(never)]
    pub fn samples(&mut self, name: &'static str, seconds: f64, period: Wide) -> u32 {
        const TIME: Range = Range::from_zero(f32::INFINITY);
        const COUNT: Range = Range { not_finite: Fault::OutOfRange, ..Range::from_zero(1e9) };
        let seconds = Wide::new(seconds);
        let samples = seconds.over(period);
        self.within(&Rule(name, &TIME), seconds);
        self.within(&Rule(name, &COUNT), samples);
        rounded_up(samples)
    }
}

/// The whole number at or above `x`, which is not negative and at most 1e9; 1e-6 above a whole number counts as that number.
#[inline(never)]
pub(crate) fn rounded_up(x: Wide) -> u32 {
    // In the numbers from 2^52 on the last bit is worth one: adding rounds to the nearest, and the low bits are the number.
    const TO_INTEGER: Wide = Wide::new(4_503_599_627_370_496.0);
    (x + Wide::new(0.5 - 1e-6) + TO_INTEGER).bits() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(value: f64, range: &'static Range) -> Option<ConfigError> {
        let mut checks = Checks::new();
        checks.within(&Rule("x", range), Wide::new(value));
        checks.outcome().err()
    }

    /// Both ends are right, the numbers next to them are not; zero has no sign, and what is no number has none either.
    #[test]
    fn the_ends_of_a_range() {
        const RANGE: Range = Range::positive(1e-6, 1e3);
        const FROM_ZERO: Range = Range::from_zero(1.0);
        for value in [1e-6, 1e-6 * (1.0 - 1e-8), 1.0, 1e3, 1e3 * (1.0 + 1e-8)] {
            assert_eq!(fault(value, &RANGE), None, "{value}");
        }
        for value in [f64::from_bits(1), 1e-6 * (1.0 - 1e-7), 1e3 * (1.0 + 1e-7), f64::MAX] {
            assert_eq!(fault(value, &RANGE), Some(ConfigError::OutOfRange("x")), "{value}");
        }
        for value in [0.0, -0.0, -1e-300, -1.0, -1e9] {
            assert_eq!(fault(value, &RANGE), Some(ConfigError::NonPositive("x")), "{value}");
            let expected = if value == 0.0 { None } else { Some(ConfigError::Negative("x")) };
            assert_eq!(fault(value, &FROM_ZERO), expected, "{value}");
        }
        for value in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(fault(value, &RANGE), Some(ConfigError::NonFinite("x")), "{value}");
            assert_eq!(fault(value, &FROM_ZERO), Some(ConfigError::NonFinite("x")), "{value}");
        }
        assert_eq!(fault(f64::from_bits(1), &Range::POSITIVE), None);
        assert_eq!(fault(f64::MAX, &Range::POSITIVE), None);
    }

    /// Any bits: no panic, zero has no sign, and what is wrong with the lower limit comes first.
    #[test]
    fn a_pair_of_limits() {
        const LIMITS: [Rule; 2] = [Rule("low", &Range::PARAMETER), Rule("high", &Range::PARAMETER)];
        let fault = |limits, may_be_equal| {
            let mut checks = Checks::new();
            checks.limits(&LIMITS, limits, may_be_equal);
            checks.outcome().err()
        };
        let (inverted, above) = (Some(ConfigError::InvertedRange("low")), 1.0 + f64::EPSILON);
        for may_be_equal in [false, true] {
            assert_eq!(fault([1.0, above], may_be_equal), None);
            assert_eq!(fault([1.0, 1.0], may_be_equal), if may_be_equal { None } else { inverted });
            assert_eq!(fault([above, 1.0], may_be_equal), inverted);
            for high in [0.0, -0.0, -1.0, -f64::MAX, -f64::from_bits(1)] {
                assert_eq!(fault([1.0, high], may_be_equal), inverted, "{high}");
            }
            for none in [f64::NAN, -f64::NAN, f64::from_bits(u64::MAX >> 1), f64::from_bits(u64::MAX), f64::INFINITY] {
                for high in [-0.0, 1.0, none] {
                    assert_eq!(fault([none, high], may_be_equal), Some(ConfigError::NonFinite("low")), "{high}");
                }
                assert_eq!(fault([1.0, none], may_be_equal), Some(ConfigError::NonFinite("high")));
            }
        }
    }

    /// The first thing found stays.
    #[test]
    fn the_first_one_counts() {
        let mut checks = Checks::new();
        checks.count("a", 1);
        assert_eq!(checks.outcome(), Ok(()));
        checks.count("b", 0);
        checks.count("c", 65_536);
        checks.number(&Rule("d", &Range::POSITIVE), f64::NAN);
        assert_eq!(checks.outcome(), Err(ConfigError::Zero("b")));
    }

    /// Against `ceil`, over the whole range.
    #[test]
    fn rounding_up() {
        for whole in [0.0, 1.0, 2.0, 7.0, 8.0, 4_097.0, 1e6, 999_999_999.0, 1e9] {
            for part in [0.0, 0.5e-6, 2e-6, 0.3, 0.5, 0.7, 0.999] {
                let x = whole + part;
                if x <= 1e9 {
                    assert_eq!(f64::from(rounded_up(Wide::new(x))), (x - 1e-6).ceil(), "{x}");
                }
            }
        }
    }
}
