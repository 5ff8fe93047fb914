//! k as a quotient of two running sums.

use crate::accumulator::Accumulator;
use crate::error::{ConfigError, positive};
use crate::snapshot::stored;

/// How k is read out of ẑ2 = k ẑ0 (ẑ2 with the known drift removed).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Readout {
    /// k = Σ ẑ2 ẑ0 / Σ ẑ0². Keeps the sign of k; unbiased by noise in ẑ2; close to the Cramér-Rao bound.
    #[default]
    LeastSquares,
    /// k = Σ|ẑ2| / Σ|ẑ0|, (44), the paper's. Loses the sign; reads too high where the excitation is weak against the noise. Neither this (up
    /// to 9 standard deviations in random flights that swing across zero) nor what disturbs the motion is in its standard
    /// deviation, which is that of white measurement noise.
    AbsoluteRatio,
}

/// How long the sums remember.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Memory {
    /// All samples weigh the same, for ever.
    #[default]
    Infinite,
    /// S ← e^(-T/τ) S + new.
    Fading {
        /// τ in s, at least one identifier period.
        tau: f64,
    },
}

impl Memory {
    /// T/τ; zero for infinite memory.
    pub(crate) fn fading(self, period: f64) -> Result<f64, ConfigError> {
        match self {
            Self::Infinite => Ok(0.0),
            Self::Fading { tau } => {
                let x = period / positive("memory.tau", tau)?;
                if x > 1.0 { Err(ConfigError::OutOfRange("memory.tau")) } else { Ok(x) }
            }
        }
    }
}

/// The weight ω of a sample in both sums: k = Σ ω ẑ2 / Σ ω ẑ0.
#[inline(always)]
pub(crate) fn weight(readout: Readout, z2: f32, z0: f32) -> (f32, f32) {
    match readout {
        Readout::LeastSquares => (z0, z0),
        Readout::AbsoluteRatio => (if z2 < 0.0 { -1.0 } else { 1.0 }, if z0 < 0.0 { -1.0 } else { 1.0 }),
    }
}

/// The two sums. Accumulators, so that they go on absorbing new samples for days.
#[derive(Clone, Copy, Debug)]
pub struct Ratio {
    numerator: Accumulator,
    denominator: Accumulator,
}

impl Ratio {
    /// No samples yet.
    pub const EMPTY: Self = Self { numerator: Accumulator::ZERO, denominator: Accumulator::ZERO };

    /// A ẑ0² below this holds no information (the input has been zero): the sums are left alone, and do not fade.
    const NOTHING: f32 = 1e-30;

    /// Whether a sample with this ẑ0 joins the sums, and they fade.
    #[inline(always)]
    pub(crate) fn is_informative(z0: f32) -> bool {
        z0 * z0 >= Self::NOTHING
    }

    /// Adds a sample of ẑ2 (known drift removed) and ẑ0, and returns whether it held any information. `forgetting` is
    /// 1 - e^(-T/τ). Cost: 9 operations; [`fold`](Self::fold) is due now and then.
    #[inline(always)]
    pub fn add(&mut self, readout: Readout, z2: f32, z0: f32, forgetting: f32) -> bool {
        let (up, down) = weight(readout, z2, z0);
        let informative = Self::is_informative(z0);
        if informative {
            self.numerator.add(up * z2 - forgetting * self.numerator.value());
            self.denominator.add(down * z0 - forgetting * self.denominator.value());
        }
        informative
    }

    /// [`add`](Self::add) for least squares over all samples alike. Cost: 5 operations.
    #[inline(always)]
    pub(crate) fn add_plain(&mut self, z2: f32, z0: f32) -> bool {
        let square = z0 * z0;
        let informative = square >= Self::NOTHING;
        if informative {
            self.numerator.add(z0 * z2);
            self.denominator.add(square);
        }
        informative
    }

    /// Moves collected steps into totals.
    #[inline(always)]
    pub fn fold(&mut self) {
        self.numerator.fold();
        self.denominator.fold();
    }

    /// Adds to the denominator alone.
    pub(crate) fn shift_denominator(&mut self, by: f32) {
        self.denominator.add_folded(by);
    }

    /// Σ ω ẑ2 / Σ ω ẑ0; not finite before there is information.
    pub fn quotient(&self) -> f32 {
        self.numerator.value() / self.denominator.value()
    }

    /// Σ ω ẑ2, right after folding.
    #[inline(always)]
    pub(crate) const fn numerator_total(&self) -> f32 {
        self.numerator.total()
    }

    /// Σ ω ẑ0, right after folding.
    #[inline(always)]
    pub(crate) const fn denominator_total(&self) -> f32 {
        self.denominator.total()
    }

    /// Σ ω ẑ2.
    pub const fn numerator(&self) -> f32 {
        self.numerator.value()
    }

    /// Σ ω ẑ0, the information collected; zero before there is any.
    pub const fn denominator(&self) -> f32 {
        self.denominator.value()
    }
}

stored!(Ratio { numerator, denominator });
