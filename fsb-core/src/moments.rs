//! The two moments of the input over a measurement interval of length T, section 2 of the design, in units of the input:
//!
//! j1 = J1/T = (1/T) ∫ f(τ) dτ,   j2 = J2/T² = (1/T²) ∫ (T - τ) f(τ) dτ,
//!
//! the velocity and the position that the input alone gives a unit mass at rest, the interval being the unit of time. They
//! are all the estimator ever needs to know of the input, and exact for an input held, linear, or held piecewise (control
//! faster than measurement). Held over the whole interval: j1 = f, j2 = f/2.

use crate::error::ConfigError;

/// (j1, j2) over the part of the interval so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct InputMoments {
    /// The mean input: the unit response's velocity over T.
    pub j1: f32,
    /// The unit response's position over T².
    pub j2: f32,
}

/// The part of an interval that one control period is: 1/R.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Substep {
    /// 1/R
    share: f32,
    /// 1/R²
    share2: f32,
    /// 1/(2R²)
    half_share2: f32,
    /// 1/(6R²)
    sixth_share2: f32,
}

impl Substep {
    pub(crate) const BLANK: Self = Self { share: 0.0, share2: 0.0, half_share2: 0.0, sixth_share2: 0.0 };

    /// `substeps` control periods to an interval.
    ///
    /// # Errors
    /// Names `substeps` if it is zero.
    pub fn new(substeps: u32) -> Result<Self, ConfigError> {
        if substeps == 0 {
            return Err(ConfigError::Zero("substeps"));
        }
        Ok(Self::of(substeps))
    }

    /// The same, the number being known to be at least 1. Up to 1672 the divisors are exact in f32.
    pub(crate) fn of(substeps: u32) -> Self {
        let count = substeps as f32;
        let square = count * count;
        Self { share: 1.0 / count, share2: 1.0 / square, half_share2: 0.5 / square, sixth_share2: 1.0 / (6.0 * square) }
    }
}

impl InputMoments {
    /// An interval that has just begun.
    pub const ZERO: Self = Self { j1: 0.0, j2: 0.0 };

    /// The first control period of an interval, the input held at `f`.
    #[inline(always)]
    pub(crate) fn held(f: f32, step: &Substep) -> Self {
        Self { j1: f * step.share, j2: f * step.half_share2 }
    }

    /// Appends a control period of an input held at `f`: j2 += j1/R + f/(2R²), j1 += f/R.
    #[inline(always)]
    pub fn hold(&mut self, f: f32, step: &Substep) {
        self.j2 += self.j1 * step.share + f * step.half_share2;
        self.j1 += f * step.share;
    }

    /// Appends a control period of an input going linearly from `f0` to `f1`: j2 += j1/R + (2 f0 + f1)/(6R²),
    /// j1 += (f0 + f1)/(2R).
    #[inline(always)]
    pub fn ramp(&mut self, f0: f32, f1: f32, step: &Substep) {
        self.j2 += self.j1 * step.share + (f0 + f0 + f1) * step.sixth_share2;
        self.j1 += (f0 + f1) * (0.5 * step.share);
    }

    /// Appends a control period of an input with the moments `part`, that period being their unit of time:
    /// j2 += j1/R + part.j2/R², j1 += part.j1/R. [`hold`](Self::hold) is (f, f/2), [`ramp`](Self::ramp) is
    /// ((f0 + f1)/2, (2 f0 + f1)/6).
    #[inline(always)]
    pub fn append(&mut self, part: &Self, step: &Substep) {
        self.j2 += self.j1 * step.share + part.j2 * step.share2;
        self.j1 += part.j1 * step.share;
    }

    /// Appends a part in the same unit of time as what is there: j2 += j1 + part.j2, j1 += part.j1. What results are the sums
    /// over so many periods, not their means.
    #[inline(always)]
    pub(crate) fn extend(&mut self, part: &Self) {
        self.j2 += self.j1 + part.j2;
        self.j1 += part.j1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (J1, J2) of f(t) = t² over 0..1 is (1/3, 1/12); in three parts, each with its own moments, the same. And what is held or
    /// goes linearly is a part like any other.
    #[test]
    fn parts_of_an_interval() {
        let step = Substep::new(3).unwrap();
        let (mut square, mut held, mut ramp) = (InputMoments::ZERO, InputMoments::ZERO, InputMoments::ZERO);
        let (mut held_parts, mut ramp_parts) = (held, ramp);
        for part in [0.0_f32, 1.0, 2.0] {
            // (a + s)²/9 over s in 0..1.
            let a = part;
            square.append(
                &InputMoments { j1: (a * a + a + 1.0 / 3.0) / 9.0, j2: (a * a / 2.0 + a / 3.0 + 1.0 / 12.0) / 9.0 },
                &step,
            );
            let (f0, f1) = (1.0 + a, 2.5 - 3.0 * a);
            held.hold(f0, &step);
            held_parts.append(&InputMoments { j1: f0, j2: f0 / 2.0 }, &step);
            ramp.ramp(f0, f1, &step);
            ramp_parts.append(&InputMoments { j1: (f0 + f1) / 2.0, j2: (2.0 * f0 + f1) / 6.0 }, &step);
        }
        let close = |a: InputMoments, b: InputMoments| (a.j1 - b.j1).abs() < 3e-7 && (a.j2 - b.j2).abs() < 3e-7;
        assert!(close(square, InputMoments { j1: 1.0 / 3.0, j2: 1.0 / 12.0 }), "{square:?}");
        assert!(close(held, held_parts) && close(ramp, ramp_parts), "{held:?} {held_parts:?} {ramp:?} {ramp_parts:?}");
        // Held at 1, 2, 3: J1 = 2, J2 = (1 (5/6) + 2 (3/6) + 3 (1/6))/3.
        assert!(close(held, InputMoments { j1: 2.0, j2: 7.0 / 9.0 }), "{held:?}");
    }

    /// f(t) = 1 + t over 0..3 in parts of one unit of time each: J1 = 15/2, J2 = ∫ (3 - t)(1 + t) dt = 9.
    #[test]
    fn parts_in_the_same_unit_of_time() {
        let mut sum = InputMoments::ZERO;
        for a in [1.0_f32, 2.0, 3.0] {
            sum.extend(&InputMoments { j1: a + 0.5, j2: a / 2.0 + 1.0 / 6.0 });
        }
        assert!((sum.j1 - 7.5).abs() < 1e-6 && (sum.j2 - 9.0).abs() < 1e-6, "{sum:?}");
    }
}
