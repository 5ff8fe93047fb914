//! Tuning: the paper's λ and q at a sampling period, turned once into constants.
//!
//! Design: the two decay factors are rounded to f32 *first* (`c = 1 - e^(-λT)`, `α = 1 - e^(-qT)`), and everything else is
//! computed in f64 from the rounded values. The sampled-data identity holds for any λ and q, so a tuning that is off by
//! half an ulp costs nothing, while constants that disagree among themselves would cost accuracy.

use crate::error::{ConfigError, positive};

/// λ and q of the paper, (17) and (28). Plain data; checked where it is used.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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

    /// Validates the tuning at `period`, in s.
    pub(crate) fn decay(
        &self,
        period: f64,
        lambda_name: &'static str,
        q_name: &'static str,
    ) -> Result<Decay, ConfigError> {
        let c = rounded_decay(positive(lambda_name, self.lambda)? * period, lambda_name)?;
        let alpha = rounded_decay(positive(q_name, self.q)? * period, q_name)?;
        Ok(Decay { period, c, p: 1.0 - c, alpha, rho: 1.0 - alpha })
    }
}

impl Decay {
    /// The same decay over `steps` periods.
    pub(crate) fn over(&self, steps: u32) -> Self {
        let (p, rho) = (libm::pow(self.p, f64::from(steps)), libm::pow(self.rho, f64::from(steps)));
        Self { period: self.period * f64::from(steps), c: 1.0 - p, p, alpha: 1.0 - rho, rho }
    }
}

/// `1 - e^(-x)`, rounded to f32, in f64.
fn rounded_decay(x: f64, name: &'static str) -> Result<f64, ConfigError> {
    if x > 1.0 {
        return Err(ConfigError::TooFastForPeriod(name));
    }
    if x < 1e-6 {
        return Err(ConfigError::TooSlowForPeriod(name));
    }
    Ok(f64::from(-libm::expm1(-x) as f32))
}

/// The period, in s, must keep T² and 1/T² far from the ends of f32: `1e-6 <= T <= 1e3`.
pub(crate) fn checked_period(name: &'static str, period: f64) -> Result<f64, ConfigError> {
    if (1e-6..=1e3).contains(&positive(name, period)?) { Ok(period) } else { Err(ConfigError::OutOfRange(name)) }
}

/// One-period decay factors in f64, consistent with each other: `p = e^(-λT) = 1 - c`, `ρ = e^(-qT) = 1 - α`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decay {
    pub period: f64,
    pub c: f64,
    pub p: f64,
    pub alpha: f64,
    pub rho: f64,
}
