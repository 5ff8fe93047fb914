//! The regression of a whole log in f64: k, drag and disturbance together (design, section 9), written from its definition.
//!
//! Each row of the identity, (y\[n\] - 2 y\[n-1\] + y\[n-2\])/T² = k S/T² - D (y\[n\] - y\[n-2\])/(2T) + c + d, times the window
//! g\[n-1\], through three stages of x += c1 (u - x). Where a measurement is missing the window starts anew, so that every row holds
//! exactly. Used to find the time offset of the input, and for what is left of a flight when all is identified: the estimates
//! themselves are the core's.

use super::log::{Axis, AxisLog};
use fsb_core::Tuning;

/// One filtered row of one axis \[m/s², and the input's unit\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Which sample of the log.
    pub sample: usize,
    /// ẑ2 without the known drift.
    pub z2: f64,
    /// ẑ0
    pub z0: f64,
    /// ẑv \[m/s\]
    pub zv: f64,
    /// ẑu
    pub zu: f64,
}

impl Row {
    /// ẑ2 - k ẑ0 + D ẑv - d ẑu \[m/s²\].
    #[must_use]
    pub fn residual(&self, k: f64, drag: f64, disturbance: f64) -> f64 {
        self.z2 - k * self.z0 + drag * self.zv - disturbance * self.zu
    }
}

/// The translational axes of `log` as rows.
#[must_use]
pub fn rows(log: &AxisLog, identifier: Tuning, gravity: f64) -> Vec<Vec<Row>> {
    log.axes
        .iter()
        .filter(|axis| axis.axis.is_translation())
        .map(|axis| {
            let drift = if axis.axis == Axis::Z { -gravity } else { 0.0 };
            let (period, mut filter) = (log.period, Filter::new(identifier, log.period));
            let mut found = Vec::with_capacity(log.len());
            for n in 0..axis.position.len() {
                let Some(y0) = axis.position[n] else {
                    filter = Filter::new(identifier, period);
                    continue;
                };
                if let (Some(Some(y1)), Some(Some(y2))) = (
                    n.checked_sub(1).map(|before| axis.position[before]),
                    n.checked_sub(2).map(|before| axis.position[before]),
                ) {
                    let (older, newer) = (axis.moments(n - 2, period), axis.moments(n - 1, period));
                    let s = (newer.j2 - older.j2 + period * older.j1) / (period * period);
                    let second = ((y0 - y1) - (y1 - y2)) / (period * period);
                    let [z2, z0, zv, zu] = filter.step([second, s, (y0 - y2) / (2.0 * period), 1.0]);
                    found.push(Row { sample: n, z2: z2 - drift * zu, z0, zv, zu });
                } else {
                    filter.wait();
                }
            }
            found
        })
        .collect()
}

/// The window and three stages for four signals.
struct Filter {
    stage: f64,
    qt: f64,
    since: f64,
    x: [[f64; 3]; 4],
}

impl Filter {
    fn new(tuning: Tuning, period: f64) -> Self {
        Self { stage: -(-tuning.lambda * period).exp_m1(), qt: tuning.q * period, since: 0.0, x: [[0.0; 3]; 4] }
    }

    fn wait(&mut self) {
        self.since += 1.0;
    }

    fn step(&mut self, signals: [f64; 4]) -> [f64; 4] {
        let opened = |n: f64| -(-self.qt * n).exp_m1();
        let window = opened(self.since - 1.0) * opened(self.since);
        self.since += 1.0;
        for (x, signal) in self.x.iter_mut().zip(signals) {
            x[2] += self.stage * (window * signal - x[2]);
            x[1] += self.stage * (x[2] - x[1]);
            x[0] += self.stage * (x[1] - x[0]);
        }
        self.x.map(|x| x[0])
    }
}

/// What is fitted beside k.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Terms {
    /// D per axis.
    pub drag: bool,
    /// d per axis.
    pub disturbance: bool,
}

/// A least-squares fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// k \[1/kg\].
    pub k: f64,
    /// D \[1/s\] and d \[m/s²\] of each axis; zero where not fitted or not to be told.
    pub terms: Vec<(f64, f64)>,
    /// Root mean square of what is left \[m/s²\].
    pub rms: f64,
}

/// Least squares over all rows; `None` where they do not tell k.
#[must_use]
pub fn fit(rows: &[Vec<Row>], terms: Terms) -> Option<Fit> {
    let size = 1 + 2 * rows.len();
    let mut normal = vec![vec![0.0; size + 1]; size];
    for (axis, rows) in rows.iter().enumerate() {
        for row in rows {
            let mut add = |entries: [(usize, f64); 3]| {
                for (i, a) in entries {
                    for (j, b) in entries {
                        normal[i][j] += a * b;
                    }
                    normal[i][size] += a * row.z2;
                }
            };
            let drag = if terms.drag { -row.zv } else { 0.0 };
            let disturbance = if terms.disturbance { row.zu } else { 0.0 };
            add([(0, row.z0), (1 + 2 * axis, drag), (2 + 2 * axis, disturbance)]);
        }
    }
    let solution = solve(normal)?;
    let k = *solution.first()?;
    let terms: Vec<(f64, f64)> = solution[1..].chunks(2).map(|pair| (pair[0], pair[1])).collect();
    let count = rows.iter().map(Vec::len).sum::<usize>();
    let squares: f64 = rows
        .iter()
        .zip(&terms)
        .flat_map(|(rows, &(drag, disturbance))| rows.iter().map(move |row| row.residual(k, drag, disturbance).powi(2)))
        .sum();
    (k.is_finite() && k != 0.0 && count > 0).then(|| Fit { k, terms, rms: (squares / count as f64).sqrt() })
}

/// Gaussian elimination of a symmetric positive matrix with its right-hand side, from the last unknown to the first; one of
/// which less than 1e-9 is left beside the others is zero. `None` where that is the first, k.
fn solve(mut m: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let size = m.len();
    let diagonal: Vec<f64> = (0..size).map(|i| m[i][i]).collect();
    let mut used = vec![false; size];
    for pivot in (0..size).rev() {
        used[pivot] = m[pivot][pivot] > 1e-9 * diagonal[pivot] && m[pivot][pivot] > 0.0;
        if !used[pivot] {
            continue;
        }
        let row = m[pivot].clone();
        for other in m.iter_mut().take(pivot) {
            let share = other[pivot] / row[pivot];
            for (to, from) in other.iter_mut().zip(&row) {
                *to -= share * from;
            }
        }
    }
    let mut solution = vec![0.0; size];
    for i in 0..size {
        if used[i] {
            let known: f64 = (0..i).map(|j| m[i][j] * solution[j]).sum();
            solution[i] = (m[i][size] - known) / m[i][i];
        }
    }
    used.first().copied().unwrap_or(false).then_some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_system() {
        // x = (1, -2, 0): the third column is zero and counts as not to be told.
        let solution = solve(vec![vec![4.0, 1.0, 0.0, 2.0], vec![1.0, 3.0, 0.0, -5.0], vec![0.0; 4]]).unwrap();
        assert!((solution[0] - 1.0).abs() < 1e-14 && (solution[1] + 2.0).abs() < 1e-14 && solution[2] == 0.0);
        assert!(solve(vec![vec![0.0, 0.0]]).is_none());
    }
}
