//! Accelerations that nobody told, all the time: of standard deviation g, correlated over 1/λ.
//!
//! The sum of what a slow regressor makes of them grows with time as 2 g²/λ, the spectrum at its top: a row counts with the variance
//! 2 g²/(λ T_row), which residuals do not show before they have seen enough of them, if at all: what is as slow as d or D v
//! is fitted.
//!
//! Two regressors are not independent of them. The velocity is their integral, E(v g) = g²/λ; D is pulled by that over what
//! is left of ẑv². A controller answers them, at the worst with all of -g, of which 3/8 g² come through the three stages; k is
//! pulled by that over what is left of k ẑ0². The squares count as variances: no time makes them smaller, more motion does.

/// What gusts of a configured standard deviation do; zeros where there are none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Gusts {
    /// The variance of a row, scaled: 2 g²/(λ T_row).
    pub row: f32,
    /// 3/8 g²
    pub answered: f32,
    /// g²/λ
    pub carried: f32,
}

impl Gusts {
    /// Of standard deviation `sd` (m/s²), for the identifier's `lambda` (1/s), rows every `row` (s) and the square of their scale.
    pub fn expected(sd: f64, lambda: f64, row: f64, scale2: f32) -> Self {
        let square = sd * sd;
        Self {
            row: (2.0 * square / (lambda * row) * f64::from(scale2)) as f32,
            answered: (0.375 * square) as f32,
            carried: (square / lambda) as f32,
        }
    }
}
