//! Tuning: the paper's λ and q at a sampling period, turned once into constants.
//!
//! Design: the two decay factors are rounded to f32 *first* (`c = 1 - e^(-λT)`, `α = 1 - e^(-qT)`), and everything else is
//! computed in f64 from the rounded values. The sampled-data identity holds for any λ and q, so a tuning that is off by
//! half an ulp costs nothing, while constants that disagree among themselves would cost accuracy.

use crate::checks::{Checks, Range, Rule};
use crate::error::ConfigError;
use crate::wide::Wide;
use core::hint::black_box;

/// λ and q of the paper, (17) and (28). Plain data; checked where it is used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct Tuning {
    /// Cut-off λ of the invariant filter G(s) = 1/(s + λ), (28), in 1/s. `1e-6 <= λT <= 1`.
    pub lambda: f64,
    /// Frequency shift q of the difference operator (17), in 1/s: how fast the window `h(t) = 1 - e^(-qt)` opens. `1e-6 <= qT <= 1`.
    pub q: f64,
}

impl Tuning {
    /// The paper's choice q = λ/2 (Section V).
    pub const fn from_lambda(lambda: f64) -> Self {
        Self { lambda, q: lambda / 2.0 }
    }

    /// Validates the tuning at `period`, in s; λ and q go by these names.
    #[inline(never)]
    pub(crate) fn checked(&self, period: Wide, names: &'static [&'static str; 2], checks: &mut Checks) {
        let Self { lambda, q } = *black_box(self);
        checks.rate(names[0], Wide::new(lambda), period);
        checks.rate(names[1], Wide::new(q), period);
    }

    /// The decay over `period`, in s, of a tuning and a period that are called so.
    pub(crate) fn named(&self, period: f64, names: &'static [&'static str; 2]) -> Result<Decay, ConfigError> {
        let mut checks = Checks::new();
        checks.number(&Rule("period", &Range::PERIOD), period);
        let period = Wide::new(period);
        self.checked(period, names, &mut checks);
        checks.outcome()?;
        Ok(self.decay(period))
    }

    /// The decay over `period`, in s.
    #[inline(never)]
    pub(crate) fn decay(&self, period: Wide) -> Decay {
        // By its address: handed over as two numbers it would cost more at every call than it does here.
        let Self { lambda, q } = *black_box(self);
        let rounded = |rate: f64| decayed(Wide::new(rate) * period).as_rounded();
        let (c, alpha) = (rounded(lambda), rounded(q));
        let rho = Wide::ONE - alpha;
        Decay { period, c, p: Wide::ONE - c, alpha, rho, mixed: alpha + alpha.over(rho) }
    }
}

/// `1 - e^(-x)`.
#[inline(never)]
pub(crate) fn decayed(x: Wide) -> Wide {
    Wide::new(-libm::expm1(-x.get()))
}

/// One-period decay factors, consistent with each other: `p = e^(-λT) = 1 - c`, `ρ = e^(-qT) = 1 - α`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decay {
    pub period: Wide,
    pub c: Wide,
    pub p: Wide,
    pub alpha: Wide,
    pub rho: Wide,
    /// α (1+ρ)/ρ
    pub mixed: Wide,
}
