//! Largest and rms error of a signal.

/// Of all errors added; zero before the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    max: f64,
    squares: f64,
    count: u64,
}

impl Deviation {
    /// Adds an error, of either sign. One that is not finite makes both results infinite.
    pub fn add(&mut self, error: f64) {
        let error = if error.is_finite() { error.abs() } else { f64::INFINITY };
        self.max = self.max.max(error);
        self.squares += error * error;
        self.count += 1;
    }

    /// The largest magnitude.
    pub const fn max(&self) -> f64 {
        self.max
    }

    /// The root of the mean square.
    pub fn rms(&self) -> f64 {
        if self.count == 0 { 0.0 } else { (self.squares / self.count as f64).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::Deviation;

    #[test]
    fn of_known_errors() {
        let mut of = Deviation::default();
        assert_eq!((of.max(), of.rms()), (0.0, 0.0));
        for error in [3.0, -4.0, 0.0, 0.0] {
            of.add(error);
        }
        assert_eq!((of.max(), of.rms()), (4.0, 2.5));
        of.add(f64::NAN);
        assert_eq!((of.max(), of.rms()), (f64::INFINITY, f64::INFINITY));
    }
}
