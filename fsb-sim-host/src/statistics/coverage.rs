//! How often an interval holds the truth.

/// Counts of intervals that held the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    /// Intervals that were given and held it.
    pub covered: u64,
    /// Intervals that were given.
    pub given: u64,
    /// Runs, with or without an interval.
    pub runs: u64,
}

impl Coverage {
    /// One run: `None` where no estimate was handed out, else whether its interval held the truth.
    pub fn add(&mut self, held: Option<bool>) {
        self.runs += 1;
        self.given += u64::from(held.is_some());
        self.covered += u64::from(held == Some(true));
    }

    /// The share of the given intervals that held the truth; NaN where none was given.
    pub fn share(&self) -> f64 {
        self.covered as f64 / self.given as f64
    }

    /// Wilson's score interval of the share at 95 % confidence (z = 1.96).
    pub fn interval(&self) -> (f64, f64) {
        let (n, p, z) = (self.given as f64, self.share(), 1.959_963_984_540_054_f64);
        let scale = 1.0 / (1.0 + z * z / n);
        let centre = scale * (p + z * z / (2.0 * n));
        let half = scale * z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
        (centre - half, centre + half)
    }
}

#[cfg(test)]
mod tests {
    use super::Coverage;

    /// The ends of Wilson's interval are the shares p0 at which |p - p0| is 1.96 standard deviations of p0.
    #[test]
    fn interval_ends_are_where_the_score_says() {
        for (covered, given) in [(90, 100), (1, 30), (400, 400)] {
            let coverage = Coverage { covered, given, runs: given };
            let (low, high) = coverage.interval();
            for end in [low, high] {
                let score = (coverage.share() - end).abs() / (end * (1.0 - end) / given as f64).sqrt();
                assert!((score - 1.96).abs() < 1e-3 || end > 1.0 - 1e-12, "{end}: {score}");
            }
        }
    }

    #[test]
    fn a_run_without_an_estimate_counts_as_a_run() {
        let mut coverage = Coverage::default();
        for held in [None, Some(true), Some(false), Some(true)] {
            coverage.add(held);
        }
        assert_eq!(coverage, Coverage { covered: 2, given: 3, runs: 4 });
    }
}
