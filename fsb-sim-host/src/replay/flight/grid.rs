//! Positions at equal distances, and the log that the core is fed with.
//!
//! The core's identity needs positions T apart. A measurement that comes at another time is not moved there as it is, nor
//! along a straight line: between two measurements the vehicle does what the known input makes it do, and that part is known
//! exactly. So the response to the known input, k f + c from rest, is taken away at the measurements (`response`), what is left
//! is interpolated, and the response is put back at the instant of the grid. A straight line is annihilated by the
//! identifier, so it does not matter where the response starts. What is left is straight but for drag, wind and the error
//! of k, all of them smooth: a cubic through four measurements takes it where they are near each other, a straight line
//! elsewhere. With noise-free measurements of a vehicle that obeys y'' = k f + c nothing is lost at all.
//!
//! The instants of the grid lie as far apart as the measurements mostly do, hence nearly each has a measurement of its own.
//! Noise is averaged a little on the way (the variance of an instant half-way between two measurements is 0.64 of that of a
//! measurement), never amplified. Where two measurements are further apart than [`LARGEST_BRACKET`] steps the instants between
//! them are missed measurements, as for the flight controller itself.

use super::response::{HeldInput, Response};
use super::{Flight, FlightError};
use crate::replay::log::{Axis, AxisColumn, AxisLog, FEWEST_SAMPLES};
use crate::twin::Moments;
use std::ops::Range;

/// Measurements further apart than so many steps of the grid have a gap between them.
pub const LARGEST_BRACKET: f64 = 2.5;

/// Of so many instants of the grid at least one must have been measured: a time stamp gone wrong would otherwise make a log of
/// any length.
const SPARSEST: usize = 1000;

/// Of the known input: which k and which drift c.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownMotion {
    /// k \[1/kg, or in the unit of the input\].
    pub k: f64,
    /// g \[m/s²\]; z falls with -g.
    pub gravity: f64,
}

impl Flight {
    /// The mean step from one position to the next \[s\], to the microsecond: of those within half of the median one, so that
    /// lost measurements do not count.
    #[must_use]
    pub fn step(&self) -> f64 {
        let steps = || self.times.windows(2).map(|pair| pair[1] - pair[0]);
        let middle = median(steps());
        let usual = || steps().filter(|step| (step - middle).abs() < middle / 2.0);
        (usual().sum::<f64>() / usual().count() as f64 * 1e6).round() / 1e6
    }

    /// The k that balances gravity on average: a first value for [`on_grid`](Self::on_grid).
    #[must_use]
    pub fn hovering(&self, gravity: f64) -> f64 {
        let (Some(&from), Some(&to)) = (self.times.first(), self.times.last()) else { return 0.0 };
        let [.., up] = self.response(0.0).moments(from, to);
        let mean = up.j1 / (to - from);
        if mean > 0.0 { gravity / mean } else { 0.0 }
    }

    /// The input's force in the world, acting `lag` \[s\] after its stamps.
    #[must_use]
    pub fn response(&self, lag: f64) -> Response {
        if self.attitude.times.is_empty() {
            Response::in_world(&self.input, lag)
        } else {
            Response::in_body(&self.input, &self.attitude, lag)
        }
    }

    /// The flight at equal distances in time: positions interpolated as said above, the input exact.
    ///
    /// # Errors
    /// [`FlightError::TooShort`], naming `file`.
    pub fn on_grid(&self, file: &str, lag: f64, known: KnownMotion) -> Result<AxisLog, FlightError> {
        let (step, found) = (self.step(), self.times.len());
        let too_short = |found| FlightError::TooShort {
            file: file.to_owned(),
            what: "positions in flight",
            found,
            expected: FEWEST_SAMPLES,
        };
        let (Some(&start), Some(&end)) = (self.times.first(), self.times.last()) else {
            return Err(too_short(0));
        };
        let samples = ((end - start) / step + 1e-6).floor() as usize + 1;
        if found < FEWEST_SAMPLES || samples < FEWEST_SAMPLES || step <= 0.0 {
            return Err(too_short(found.min(samples)));
        }
        if samples / SPARSEST > found {
            return Err(FlightError::Sparse { file: file.to_owned(), found, start, end });
        }
        let response = self.response(lag);
        let mut columns = [Axis::X, Axis::Y, Axis::Z].map(|axis| {
            let reference = self.reference.as_ref().map(|_| Vec::with_capacity(samples));
            AxisColumn::with_ramps(axis, reference)
        });
        for n in 0..samples {
            let t = start + n as f64 * step;
            let position = self.position_at(t, step, &response, known);
            let moments = response.moments(t, t + step);
            for (i, column) in columns.iter_mut().enumerate() {
                column.position.push(position.map(|p| p[i]));
                column.push_moments(moments[i], step);
                if let (Some(to), Some(from)) = (&mut column.velocity_reference, &self.reference) {
                    to.push(self.reference_at(t, step, from, i));
                }
            }
        }
        let usable = columns.into_iter().zip(self.usable).filter_map(|(column, usable)| usable.then_some(column));
        Ok(AxisLog::of(start, step, usable.collect(), samples))
    }

    /// The positions around `t`: how many measurements lie before or at it.
    fn before(&self, t: f64) -> usize {
        self.times.partition_point(|&time| time <= t)
    }

    fn position_at(&self, t: f64, step: f64, response: &Response, known: KnownMotion) -> Option<[f64; 3]> {
        let after = self.before(t + 1e-9);
        let last = self.times.get(after.checked_sub(1)?)?;
        if (t - last).abs() <= 1e-9 {
            return self.position.get(after - 1).copied();
        }
        let bracket = self.times.get(after)? - last;
        if bracket > LARGEST_BRACKET * step {
            return None;
        }
        let near = after >= 2
            && after + 1 < self.times.len()
            && self.times[after + 1] - self.times[after - 2] <= 2.0 * LARGEST_BRACKET * step;
        let cubic = near.then(|| self.weights(after - 2..after + 2, t));
        // Measurements nearly at one time would let a cubic amplify their noise.
        let (from, weights) = match cubic.filter(|w| w.iter().map(|w| w * w).sum::<f64>() <= 1.0) {
            Some(weights) => (after - 2, weights),
            None => (after - 1, self.weights(after - 1..after + 1, t)),
        };
        let begin = self.times[from];
        let known_at = |time: f64| known.travel(&response.moments(begin, time), time - begin);
        let mut position = known_at(t);
        for (node, weight) in (from..).zip(weights) {
            let travelled = known_at(self.times[node]);
            for axis in 0..3 {
                position[axis] += weight * (self.position[node][axis] - travelled[axis]);
            }
        }
        Some(position)
    }

    /// Lagrange's weights at `t` of the measurements `nodes`.
    fn weights(&self, nodes: Range<usize>, t: f64) -> Vec<f64> {
        let times = &self.times[nodes];
        let others = |node: usize| times.iter().enumerate().filter(move |&(other, _)| other != node);
        times
            .iter()
            .enumerate()
            .map(|(node, at)| others(node).map(|(_, other)| (t - other) / (at - other)).product())
            .collect()
    }

    fn reference_at(&self, t: f64, step: f64, reference: &[[Option<f64>; 3]], axis: usize) -> Option<f64> {
        let after = self.before(t + 1e-9);
        let last = after.checked_sub(1)?;
        let (from, t0) = (reference.get(last)?[axis]?, self.times[last]);
        if (t - t0).abs() <= 1e-9 {
            return Some(from);
        }
        let (to, t1) = (reference.get(after)?[axis]?, self.times[after]);
        (t1 - t0 <= LARGEST_BRACKET * step).then(|| from + (to - from) * (t - t0) / (t1 - t0))
    }
}

impl KnownMotion {
    /// Travel from rest in `t` \[s\].
    fn travel(&self, moments: &[Moments; 3], t: f64) -> [f64; 3] {
        let [x, y, z] = moments.map(|m| self.k * m.j2);
        [x, y, z - self.gravity * t * t / 2.0]
    }
}

impl AxisLog {
    /// The same log with the input acting `lag` \[s\] later: exact for an input that is held from row to row.
    #[must_use]
    pub fn delayed(&self, lag: f64) -> Self {
        if lag == 0.0 {
            return self.clone();
        }
        let times: Vec<f64> = (0..self.len()).map(|n| self.time(n)).collect();
        let axes = self
            .axes
            .iter()
            .map(|axis| {
                let force = axis.input.iter().map(|&f| [f, 0.0, 0.0]).collect();
                let response = Response::in_world(&HeldInput { times: times.clone(), force }, lag);
                let mut column = AxisColumn::with_ramps(axis.axis, axis.velocity_reference.clone());
                column.position.clone_from(&axis.position);
                for &t in &times {
                    let [along, ..] = response.moments(t, t + self.period);
                    column.push_moments(along, self.period);
                }
                column
            })
            .collect();
        let mut delayed = Self::of(self.start, self.period, axes, self.len());
        delayed.unpaired.clone_from(&self.unpaired);
        delayed
    }

    /// The rows of a log [`delayed`](Self::delayed) by `lag` \[s\] at which the input is known, not held on from its first row or
    /// from its last; `None` where these are too few for a log.
    #[must_use]
    pub fn known(mut self, lag: f64) -> Option<Self> {
        let unknown = ((lag.abs() / self.period - 1e-6).ceil().max(0.0) as usize).min(self.len());
        let left = self.len() - unknown;
        if left < FEWEST_SAMPLES {
            return None;
        }
        let rows = if lag > 0.0 { unknown..self.len() } else { 0..left };
        let start = self.time(rows.start);
        for axis in &mut self.axes {
            *axis = axis.within(rows.clone());
        }
        let mut known = Self::of(start, self.period, self.axes, left);
        known.unpaired = self.unpaired;
        Some(known)
    }
}

/// The middle value; not a number where there is none.
pub(in crate::replay) fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests;
