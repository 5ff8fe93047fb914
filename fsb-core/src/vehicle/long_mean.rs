//! Means over a long past, hardly moved by what has just begun.

use crate::snapshot::stored;

/// Of each of three axes the mean of a mean, each over the last 1/share values: what began n values ago weighs (n share)²/2.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LongMeans {
    first: [f32; 3],
    means: [f32; 3],
    /// share times the number of values, no more than 1.
    since: f32,
}

impl LongMeans {
    /// They begin as if so many times 1/share values had been nothing: the first ones are not usual yet.
    const BEGIN: f32 = 0.02;
    /// Keeps means of nothing from ending among the subnormal numbers.
    const NOTHING: f32 = 1e-30;

    /// Adds the squares of `values`, which are below 1e15. Cost: 24 operations, at first one of them a division.
    pub fn add_squares(&mut self, values: &[f32; 3], share: f32) {
        let mut gain = share;
        if self.since < 1.0 {
            // At first of all values.
            self.since += share;
            gain = share / (self.since + Self::BEGIN);
        }
        for ((first, mean), value) in self.first.iter_mut().zip(&mut self.means).zip(values) {
            *first += gain * (value * value - *first) + Self::NOTHING;
            *mean += gain * (*first - *mean) + Self::NOTHING;
        }
    }

    /// Zero before the first values.
    pub const fn values(&self) -> &[f32; 3] {
        &self.means
    }

    /// Of a state that was stored: squares within `largest`.
    pub fn are_sound(&self, largest: f32) -> bool {
        let mut all = self.first.iter().chain(&self.means);
        all.all(|square| (0.0..=largest).contains(square)) && (0.0..=2.0).contains(&self.since)
    }
}

stored!(LongMeans { first, means, since });

#[cfg(test)]
mod tests {
    use super::*;

    /// What has been there from the start is half of itself after 0.05/share, (1 - e^(-x) (1 + x)) of a step x/share values ago. Each
    /// axis by itself.
    #[test]
    fn what_has_just_begun_weighs_little() {
        const SHARE: f32 = 1e-3;
        let mut means = LongMeans::default();
        for n in 0..20_000 {
            means.add_squares(&[1.0, 2.0, 0.0], SHARE);
            let (low, high) = match n {
                ..=4 => (0.0, 0.05),
                50 => (0.3, 0.6),
                8_000.. => (0.999, 1.0001),
                _ => continue,
            };
            let [one, four, none] = *means.values();
            assert!((low..high).contains(&one) && four == 4.0 * one && none < 1e-20, "{n}: {means:?}");
        }
        for n in 1..=5_000_u16 {
            means.add_squares(&[1.0, 2.0, 10.0], SHARE);
            let x = f64::from(SHARE) * f64::from(n);
            let truth = 100.0 * (1.0 - libm::exp(-x) * (1.0 + x));
            assert!((f64::from(means.values()[2]) - truth).abs() < 0.1, "{n}: {means:?} {truth}");
        }
        assert!(means.are_sound(200.0) && !means.are_sound(50.0));
    }

    /// After days of nothing they are normal numbers.
    #[test]
    fn nothing() {
        let mut means = LongMeans::default();
        means.add_squares(&[1e-6; 3], 0.01);
        for _ in 0..20_000 {
            means.add_squares(&[0.0; 3], 0.01);
            assert!(means.first.iter().chain(&means.means).all(|mean| mean.is_normal()));
        }
    }
}
