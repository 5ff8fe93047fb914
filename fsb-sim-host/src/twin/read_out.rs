//! k from ẑ2 - c ẑu and ẑ0, several axes pooled, by plain sums with or without fading.

/// How much of a sum is kept per addition: 1, or μ = e^(-T/τ).
fn kept(tau: Option<f64>, period: f64) -> f64 {
    tau.map_or(1.0, |tau| (-period / tau).exp())
}

/// Least squares: k = Σ ẑ2 ẑ0 / Σ ẑ0². Keeps the sign.
#[derive(Clone, Copy, Debug)]
pub struct TwinLeastSquares {
    kept: f64,
    numerator: f64,
    denominator: f64,
}

impl TwinLeastSquares {
    /// Memory that fades with the time constant `tau` [s], positive, or never; `period` [s] from one addition to the next.
    pub fn new(tau: Option<f64>, period: f64) -> Self {
        Self { kept: kept(tau, period), numerator: 0.0, denominator: 0.0 }
    }

    /// Adds (ẑ2 - c ẑu, ẑ0) [m/s², N] of every axis that shares k, at one time.
    pub fn add(&mut self, axes: &[(f64, f64)]) {
        let sum = |term: fn(&(f64, f64)) -> f64| axes.iter().map(term).sum::<f64>();
        self.numerator = self.kept * self.numerator + sum(|(z2, z0)| z2 * z0);
        self.denominator = self.kept * self.denominator + sum(|(_, z0)| z0 * z0);
    }

    /// k; `None` while no input has passed the filter.
    pub fn k(&self) -> Option<f64> {
        (self.denominator > 0.0).then(|| self.numerator / self.denominator)
    }

    /// (Σ ẑ2 ẑ0, Σ ẑ0²).
    pub const fn sums(&self) -> (f64, f64) {
        (self.numerator, self.denominator)
    }
}

/// (44), the paper's: k = Σ|ẑ2| / Σ|ẑ0|. Loses the sign.
#[derive(Clone, Copy, Debug)]
pub struct TwinAbsoluteRatio {
    kept: f64,
    numerator: f64,
    denominator: f64,
}

impl TwinAbsoluteRatio {
    /// As [`TwinLeastSquares::new`].
    pub fn new(tau: Option<f64>, period: f64) -> Self {
        Self { kept: kept(tau, period), numerator: 0.0, denominator: 0.0 }
    }

    /// As [`TwinLeastSquares::add`].
    pub fn add(&mut self, axes: &[(f64, f64)]) {
        self.numerator = self.kept * self.numerator + axes.iter().map(|(z2, _)| z2.abs()).sum::<f64>();
        self.denominator = self.kept * self.denominator + axes.iter().map(|(_, z0)| z0.abs()).sum::<f64>();
    }

    /// |k|; `None` while no input has passed the filter.
    pub fn k(&self) -> Option<f64> {
        (self.denominator > 0.0).then(|| self.numerator / self.denominator)
    }

    /// (Σ|ẑ2|, Σ|ẑ0|).
    pub const fn sums(&self) -> (f64, f64) {
        (self.numerator, self.denominator)
    }
}

#[cfg(test)]
mod tests {
    use super::{TwinAbsoluteRatio, TwinLeastSquares};

    /// Two axes, k = -1.5: least squares keeps the sign, the absolute ratio does not; nothing in, nothing out.
    #[test]
    fn sign_and_emptiness() {
        let (mut squares, mut ratio) = (TwinLeastSquares::new(None, 1.0), TwinAbsoluteRatio::new(None, 1.0));
        assert_eq!((squares.k(), ratio.k()), (None, None));
        for z0 in [2.0, -3.0, 0.0] {
            squares.add(&[(-1.5 * z0, z0), (-3.0, 2.0)]);
            ratio.add(&[(-1.5 * z0, z0), (-3.0, 2.0)]);
        }
        assert_eq!((squares.k(), ratio.k()), (Some(-1.5), Some(1.5)));
    }

    /// k steps from 1 to 2 under a constant input: t after the step the fading estimate is 2 - e^(-t/τ).
    #[test]
    fn fading_forgets_with_its_time_constant() {
        let (tau, period) = (0.5, 0.01);
        let (mut squares, mut ratio) =
            (TwinLeastSquares::new(Some(tau), period), TwinAbsoluteRatio::new(Some(tau), period));
        for n in 0..2100 {
            let z2 = if n < 2000 { 1.0 } else { 2.0 };
            squares.add(&[(z2, 1.0)]);
            ratio.add(&[(z2, 1.0)]);
        }
        let expected = 2.0 - (-1.0_f64 / tau).exp();
        assert!((squares.k().unwrap() - expected).abs() < 1e-12 && (ratio.k().unwrap() - expected).abs() < 1e-12);
    }
}
