//! Logs of the exact plant: y'' = k f + c with f held from row to row, stepped in f64 without discretisation error.

use std::fmt::Write as _;

/// One axis: its columns, its truth, its input.
pub struct Motion {
    pub axis: &'static str,
    pub input: &'static str,
    /// 1/m or 1/I as a function of time; held from row to row.
    pub k: fn(f64) -> f64,
    pub drift: f64,
    pub start: (f64, f64),
    pub force: fn(f64) -> f64,
}

/// A log to write, with rates for reference.
pub struct Flight {
    pub period: f64,
    pub samples: usize,
    pub motions: Vec<Motion>,
}

/// The mass of [`Flight::in_space`].
pub const MASS: f64 = 1.3;
/// Its gravity.
pub const GRAVITY: f64 = 9.81;
/// The moments of inertia of [`Flight::turning`] about x, y, z.
pub const INERTIA: [f64; 3] = [0.03, 0.035, 0.055];

impl Flight {
    /// 1.3 kg on a path of a few metres, 3 m away from the origin.
    pub fn in_space(rate: f64, seconds: f64) -> Self {
        let k = |_| 1.0 / MASS;
        let axis = |axis, input, drift, start, force| Motion { axis, input, k, drift, start, force };
        Self {
            period: 1.0 / rate,
            samples: (rate * seconds) as usize,
            motions: vec![
                axis("x", "fx", 0.0, (3.0, -0.4), |t| 1.5 * (1.1 * t).cos()),
                axis("y", "fy", 0.0, (-3.0, 0.7), |t| -2.0 * (1.7 * t).sin()),
                axis("z", "fz", -GRAVITY, (3.0, 0.1), |t| MASS * GRAVITY + 0.8 * (2.3 * t).cos()),
            ],
        }
    }

    /// Roll, pitch and yaw within a radian.
    pub fn turning(rate: f64, seconds: f64) -> Self {
        let start = (0.2, -0.1);
        let axis = |axis, input, k, force| Motion { axis, input, k, drift: 0.0, start, force };
        Self {
            period: 1.0 / rate,
            samples: (rate * seconds) as usize,
            motions: vec![
                axis("roll", "taux", |_| 1.0 / INERTIA[0], |t| 0.02 * (2.0 * t).cos()),
                axis("pitch", "tauy", |_| 1.0 / INERTIA[1], |t| 0.02 * (2.6 * t).sin()),
                axis("yaw", "tauz", |_| 1.0 / INERTIA[2], |t| -0.03 * (1.9 * t).cos()),
            ],
        }
    }

    /// With these axes only.
    pub fn only(mut self, axes: &[&str]) -> Self {
        self.motions.retain(|m| axes.contains(&m.axis));
        self
    }

    /// The log, positions left out where `missing(row, axis)`.
    pub fn csv(&self, missing: impl Fn(usize, &str) -> bool) -> String {
        let mut out = String::from("t");
        for m in &self.motions {
            write!(out, ",{},{},v{}_ref", m.axis, m.input, m.axis).unwrap();
        }
        let mut states: Vec<(f64, f64)> = self.motions.iter().map(|m| m.start).collect();
        for row in 0..self.samples {
            let t = row as f64 * self.period;
            write!(out, "\n{t}").unwrap();
            for (m, (y, v)) in self.motions.iter().zip(&mut states) {
                // The core is fed with f32: the plant gets the input that the core sees.
                let force = f64::from((m.force)(t + self.period / 2.0) as f32);
                let position = if missing(row, m.axis) { String::new() } else { y.to_string() };
                write!(out, ",{position},{force},{v}").unwrap();
                let acceleration = (m.k)(t) * force + m.drift;
                *y += self.period * *v + self.period * self.period / 2.0 * acceleration;
                *v += self.period * acceleration;
            }
        }
        out.push('\n');
        out
    }
}
