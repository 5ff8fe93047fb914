//! Mean, standard deviation, root mean square.

/// Mean and standard deviation of a set of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// How many values.
    pub count: usize,
    /// Mean; NaN of no values.
    pub mean: f64,
    /// Standard deviation with n - 1 below; NaN of fewer than two values.
    pub sd: f64,
}

impl Summary {
    /// Of `values`. A NaN among them makes the result NaN: a run without a result is not passed over.
    pub fn of(values: &[f64]) -> Self {
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let sd = if count < 2 { f64::NAN } else { (squares / (count - 1) as f64).sqrt() };
        Self { count, mean, sd }
    }

    /// Relative standard error of `sd` for normal values: 1/√(2 (n - 1)).
    pub fn sd_relative_error(&self) -> f64 {
        1.0 / (2.0 * (self.count as f64 - 1.0)).sqrt()
    }
}

/// A sum of squares and how many are in it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Squares {
    sum: f64,
    count: u64,
}

impl Squares {
    /// Adds the square of `value`.
    pub fn add(&mut self, value: f64) {
        self.sum += value * value;
        self.count += 1;
    }

    /// Adds what another has collected.
    pub fn append(&mut self, other: &Self) {
        self.sum += other.sum;
        self.count += other.count;
    }

    /// Root mean square; NaN of nothing.
    pub fn rms(&self) -> f64 {
        (self.sum / self.count as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::{Squares, Summary};

    /// 2, 4, 4, 4, 5, 5, 7, 9: mean 5, Σ (x - 5)² = 32.
    #[test]
    fn mean_and_deviation() {
        let summary = Summary::of(&[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]);
        assert_eq!((summary.count, summary.mean), (8, 5.0));
        assert!((summary.sd - (32.0f64 / 7.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn too_little_is_no_number() {
        assert!(Summary::of(&[]).mean.is_nan() && Summary::of(&[1.0]).sd.is_nan());
        assert!(Summary::of(&[1.0, f64::NAN]).mean.is_nan() && Squares::default().rms().is_nan());
    }

    #[test]
    fn rms_of_parts() {
        let (mut whole, mut part) = (Squares::default(), Squares::default());
        whole.add(3.0);
        part.add(4.0);
        part.add(-5.0);
        whole.append(&part);
        assert!((whole.rms() - (50.0f64 / 3.0).sqrt()).abs() < 1e-15);
    }
}
