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

/// `1 - e^(-x)` for x >= 0, to 1e-15 of itself or two.
///
/// s/(1 + s) with s = e^x - 1 = x + x²/2 + x³/6 + ..., in which nothing cancels. Slow, and a seventh of the size of
/// `libm::expm1`.
#[inline(never)]
pub(crate) fn decayed(x: Wide) -> Wide {
    // What is negative or no number has larger bits, too.
    let most = Wide::new(64.0);
    let x = if x.bits() > most.bits() { most } else { x };
    let (mut n, mut term, mut sum) = (Wide::ONE, x, x);
    loop {
        n = n + Wide::ONE;
        term = (term * x).over(n);
        let next = sum + term;
        if next == sum {
            return sum.over(Wide::ONE + sum);
        }
        sum = next;
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Against `libm`: to 2e-15, and in f32 to the last bit.
    #[test]
    fn the_share_that_decays() {
        for n in 0..=20_000 {
            let x = 1e-7 * libm::pow(10.0, f64::from(n) * 9.0 / 20_000.0);
            let (own, exact) = (decayed(Wide::new(x)).get(), -libm::expm1(-x));
            assert!((own / exact - 1.0).abs() < 2e-15, "{x}: {own} for {exact}");
            assert_eq!(own as f32, exact as f32, "{x}");
        }
        assert_eq!(decayed(Wide::ZERO), Wide::ZERO);
        for x in [64.0, 1e3, 1e30, f64::INFINITY, f64::NAN, -1.0] {
            assert_eq!(decayed(Wide::new(x)), Wide::ONE, "{x}");
        }
    }
}
