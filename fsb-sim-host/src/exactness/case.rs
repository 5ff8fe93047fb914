//! The ways of sampling.

/// Rates, blocks and axes of one flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Measurements a second [Hz].
    pub rate: f64,
    /// Control ticks to a measurement.
    pub substeps: u32,
    /// Measurements to a step of the identifier.
    pub block: u32,
    /// 1: a vertical axis; 3: x, y and z pooled into one k.
    pub axes: u32,
}

const fn case(rate: f64, substeps: u32, block: u32, axes: u32) -> Case {
    Case { rate, substeps, block, axes }
}

/// 50 Hz, 1 kHz and 8 kHz; the same with ten control ticks to a measurement; block means; three pooled axes.
pub const CASES: [Case; 13] = [
    case(50.0, 1, 1, 1),
    case(1000.0, 1, 1, 1),
    case(8000.0, 1, 1, 1),
    case(50.0, 10, 1, 1),
    case(1000.0, 10, 1, 1),
    case(8000.0, 10, 1, 1),
    case(1000.0, 1, 10, 1),
    case(8000.0, 1, 10, 1),
    case(8000.0, 1, 40, 1),
    case(50.0, 1, 1, 3),
    case(1000.0, 1, 1, 3),
    case(1000.0, 1, 10, 3),
    case(8000.0, 1, 40, 3),
];

impl Case {
    /// Time between control ticks [s].
    pub fn period(&self) -> f64 {
        1.0 / (self.rate * f64::from(self.substeps))
    }

    /// Time between steps of the identifier [s].
    pub fn block_time(&self) -> f64 {
        f64::from(self.block) / self.rate
    }
}
