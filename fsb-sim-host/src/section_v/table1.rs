//! Table 1: parameter and states at t_f in the case with noise.

use super::flight::Moment;
use super::scenario::K;

/// A line of Table 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// k, x, y, x_rate or y_rate.
    pub name: &'static str,
    /// As the paper writes it, with its unit.
    pub symbol: &'static str,
    /// The real value here.
    pub real: f64,
    /// The core's estimate; NaN where there is none.
    pub estimated: f64,
    /// The paper's line.
    pub paper: Printed,
}

/// A line of Table 1 as printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// Real value.
    pub real: f64,
    /// Estimated value.
    pub estimated: f64,
    /// Relative error [%].
    pub error_percent: f64,
}

const NAMES: [(&str, &str); 5] =
    [("k", "k [1/kg]"), ("x", "x [m]"), ("y", "y [m]"), ("x_rate", "x' [m/s]"), ("y_rate", "y' [m/s]")];

/// Table 1 of the paper, t_f = 10 s.
pub const PRINTED: [Printed; 5] = [
    Printed { real: 2.0, estimated: 1.9994, error_percent: 0.0319 },
    Printed { real: 7.2197, estimated: 7.2312, error_percent: 0.1592 },
    Printed { real: 3.2375, estimated: 3.2241, error_percent: 0.4133 },
    Printed { real: 6.6683, estimated: 6.6710, error_percent: 0.0410 },
    Printed { real: -14.3529, estimated: -14.3569, error_percent: 0.0277 },
];

impl Row {
    /// |estimated - real| / |real| [%].
    pub fn error_percent(&self) -> f64 {
        100.0 * ((self.estimated - self.real) / self.real).abs()
    }
}

/// The table from the last moment of a flight.
pub fn table1(end: &Moment) -> [Row; 5] {
    let [x, y] = end.truth;
    let state = |axis: usize| end.belief.state[axis].unwrap_or((f64::NAN, f64::NAN));
    let values = [
        (K, end.belief.k.unwrap_or(f64::NAN)),
        (x.position, state(0).0),
        (y.position, state(1).0),
        (x.velocity, state(0).1),
        (y.velocity, state(1).1),
    ];
    std::array::from_fn(|i| {
        let ((name, symbol), (real, estimated)) = (NAMES[i], values[i]);
        Row { name, symbol, real, estimated, paper: PRINTED[i] }
    })
}

#[cfg(test)]
mod tests {
    use super::PRINTED;

    /// The printed errors follow from the printed values to the printed digits.
    #[test]
    fn printed_errors_follow_from_printed_values() {
        for line in PRINTED {
            let error = 100.0 * ((line.estimated - line.real) / line.real).abs();
            let rounding = 100.0 * 1e-4 / line.real.abs();
            assert!((error - line.error_percent).abs() <= rounding, "{line:?}: {error}");
        }
    }
}
