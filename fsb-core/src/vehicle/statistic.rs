//! κ = Σ r φ/(T² Σ φ²) of [`super::change`], at an instant or over the last ones: whether it shows a change.

use crate::snapshot::stored;

/// Σ r φ, Σ φ², and var Σ r φ by noise and by the disturbance.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Terms {
    pub product: f32,
    pub square: f32,
    pub variance: f32,
    pub disturbed: f32,
}

/// What a change has to exceed.
pub(super) struct Limits {
    pub relative: f32,
    pub sigmas2: f32,
    /// For φ².
    pub least: [f32; 3],
    pub open: bool,
}

/// The terms over a fading memory, and for how many instants they have shown a change.
#[derive(Clone, Copy, Debug)]
pub(super) struct Statistic {
    /// e^(-T/τ), zero for none.
    keep: f32,
    /// Instants over which a disturbance is about the same.
    correlation: f32,
    pub sums: [Terms; 3],
    streaks: [u32; 3],
}

impl Statistic {
    pub fn new(keep: f64, correlation: f64) -> Self {
        Self { keep: keep as f32, correlation: correlation as f32, sums: [Terms::default(); 3], streaks: [0; 3] }
    }

    pub fn reset(&mut self) {
        (self.sums, self.streaks) = Default::default();
    }

    /// The longest streak.
    pub fn add(&mut self, terms: &[Terms; 3], known: &[Option<f32>; 3], limits: &Limits) -> u32 {
        let mut longest = 0;
        let (keep, share) = (self.keep, 1.0 - self.keep);
        let of_parameters = self.sums.iter_mut().zip(&mut self.streaks).zip(terms).zip(known).zip(&limits.least);
        for ((((sum, streak), term), k), least) in of_parameters {
            sum.product = keep * sum.product + term.product;
            sum.square = keep * sum.square + term.square;
            sum.variance = keep * keep * sum.variance + term.variance;
            sum.disturbed = keep * keep * sum.disturbed + term.disturbed;
            // κ beyond both limits, each multiplied by T² Σ φ².
            let shows = k.is_some_and(|k| sum.product.abs() > limits.relative * k * sum.square)
                && sum.product * sum.product > limits.sigmas2 * (sum.variance + self.correlation * sum.disturbed);
            let judged = limits.open && share * sum.square > *least;
            *streak = if judged && shows { streak.saturating_add(1) } else { 0 };
            longest = longest.max(*streak);
        }
        longest
    }
}

stored!(Terms { product, square, variance, disturbed });
stored!(Statistic { sums, streaks });
