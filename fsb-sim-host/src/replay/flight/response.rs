//! What the input alone does: its exact moments over any interval.
//!
//! The input is held from its own time stamp to the next one, whatever the measurement does meanwhile; it is turned into
//! the world by the attitude, which is known at its own stamps. Every stamp of either ends a piece. Within a piece the held
//! force is turned by a rotation matrix that goes linearly from one end to the other (the ends by quaternion
//! interpolation), so that the force in the world is linear in it and the moments
//!
//! J1 = ∫ f dτ,   J2 = ∫ (t_end - τ) f dτ
//!
//! are sums of polynomials: nothing is resampled. What is left is the bow of the arc over its chord, (angle turned in a
//! piece)²/8 of the force: 5e-5 of it at 2 rad/s and 10 ms.

use super::quaternion::Quaternion;
use crate::twin::Moments;

/// An input that is held from each of its time stamps to the next.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct HeldInput {
    /// When each value begins to act \[s\], rising.
    pub times: Vec<f64>,
    /// Force \[N, or as a share of the full thrust\].
    pub force: Vec<[f64; 3]>,
}

/// Attitudes at their own time stamps.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct AttitudeTrack {
    /// \[s\], rising.
    pub times: Vec<f64>,
    /// Body to world.
    pub attitude: Vec<Quaternion>,
}

impl AttitudeTrack {
    /// The attitude at `t`, that of the nearer end outside the track; level where there is none at all.
    #[must_use]
    pub fn at(&self, t: f64) -> Quaternion {
        let after = self.times.partition_point(|&time| time <= t);
        match (after.checked_sub(1), self.times.get(after)) {
            (Some(before), Some(&end)) => {
                let share = (t - self.times[before]) / (end - self.times[before]);
                self.attitude[before].towards(self.attitude[after], share)
            }
            (Some(last), None) => self.attitude[last],
            (None, _) => self.attitude.first().copied().unwrap_or(Quaternion::LEVEL),
        }
    }
}

/// A force in the world frame that is linear in each piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Where the pieces begin \[s\]. The first one reaches back for ever, the last one on for ever.
    starts: Vec<f64>,
    /// Force at the beginning of the piece, and its rate of change \[per s\].
    pieces: Vec<([f64; 3], [f64; 3])>,
}

impl Response {
    /// An input in the world frame, acting `lag` \[s\] after its stamps.
    #[must_use]
    pub fn in_world(input: &HeldInput, lag: f64) -> Self {
        let starts = input.times.iter().map(|t| t + lag).collect();
        Self { starts, pieces: input.force.iter().map(|&force| (force, [0.0; 3])).collect() }
    }

    /// An input in the body frame, acting `lag` \[s\] after its stamps; the attitude is that of the time at which it acts.
    #[must_use]
    pub fn in_body(input: &HeldInput, attitude: &AttitudeTrack, lag: f64) -> Self {
        let mut starts: Vec<f64> = input.times.iter().map(|t| t + lag).collect();
        let (first, last) = (starts.first().copied(), starts.last().copied());
        // Before the first input the first one stands in for what is not known.
        starts.extend(attitude.times.iter().copied().filter(|&t| first.is_some_and(|first| t > first)));
        starts.extend(last.into_iter().zip(attitude.times.last()).filter_map(|(f, &a)| (a < f).then_some(a)));
        starts.sort_by(f64::total_cmp);
        starts.dedup();
        let mut held = 0;
        let pieces = starts
            .iter()
            .enumerate()
            .map(|(i, &t)| {
                while input.times.get(held + 1).is_some_and(|next| next + lag <= t) {
                    held += 1;
                }
                let body = input.force.get(held).copied().unwrap_or_default();
                let from = attitude.at(t).turn(body);
                let rate = starts.get(i + 1).map_or([0.0; 3], |&end| {
                    let to = attitude.at(end).turn(body);
                    std::array::from_fn(|axis| (to[axis] - from[axis]) / (end - t))
                });
                (from, rate)
            })
            .collect();
        Self { starts, pieces }
    }

    /// J1 and J2 of each axis over `from..to` \[s\].
    #[must_use]
    pub fn moments(&self, from: f64, to: f64) -> [Moments; 3] {
        let mut sum = [Moments::default(); 3];
        if self.pieces.is_empty() {
            return sum;
        }
        let mut piece = self.starts.partition_point(|&start| start <= from).saturating_sub(1);
        let mut t = from;
        while t < to {
            let end = self.starts.get(piece + 1).map_or(to, |&next| next.min(to));
            let (force, rate) = &self.pieces[piece];
            // The first piece has no slope before it begins, nor has the last one after the others.
            let since = (t - self.starts[piece]).max(0.0);
            let length = end - t;
            for axis in 0..3 {
                let (at, slope) = (force[axis] + rate[axis] * since, rate[axis]);
                let (dv, dy) =
                    (length * (at + slope * length / 2.0), length * length * (at / 2.0 + slope * length / 6.0));
                sum[axis].j2 += sum[axis].j1 * length + dy;
                sum[axis].j1 += dv;
            }
            (t, piece) = (end, piece + 1);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// f = 2 from 0.5 on, 5 from 1.25 on. Over 1..2: J1 = 0.5 + 3.75, J2 = ∫ (2-τ) f.
    #[test]
    fn held_values_are_integrated_between_their_own_stamps() {
        let input = HeldInput { times: vec![0.5, 1.25], force: vec![[2.0; 3], [5.0; 3]] };
        let [Moments { j1, j2 }, ..] = Response::in_world(&input, 0.0).moments(1.0, 2.0);
        assert!((j1 - 4.25).abs() < 1e-15 && (j2 - (2.0 * (1.0 - 0.5625) / 2.0 + 5.0 * 0.5625 / 2.0)).abs() < 1e-15);
        // Later by 0.25: 2 until 1.5.
        let [Moments { j1, .. }, ..] = Response::in_world(&input, 0.25).moments(1.0, 2.0);
        assert!((j1 - 3.5).abs() < 1e-15);
        // Outside the stamps the ends are held.
        let [Moments { j1, .. }, ..] = Response::in_world(&input, 0.0).moments(0.0, 1.0);
        assert!((j1 - 2.0).abs() < 1e-15);
        let [Moments { j1, .. }, ..] = Response::in_world(&input, 0.0).moments(3.0, 4.0);
        assert!((j1 - 5.0).abs() < 1e-15);
    }

    /// A force of 3 along body z, the body rolling at 2 rad/s: f_y = -3 sin 2t, f_z = 3 cos 2t, both integrals known.
    #[test]
    fn a_turning_force_against_its_integral() {
        let rate = 2.0;
        let times: Vec<f64> = (0..200).map(|i| 0.01 * f64::from(i) + 0.002 * f64::from(i % 3)).collect();
        let attitude =
            times.iter().map(|t| Quaternion([(rate * t / 2.0).cos(), (rate * t / 2.0).sin(), 0.0, 0.0])).collect();
        let track = AttitudeTrack { times, attitude };
        let stamps: Vec<f64> = (0..900).map(|i| 0.0021 * f64::from(i)).collect();
        let force = vec![[0.0, 0.0, 3.0]; stamps.len()];
        let response = Response::in_body(&HeldInput { times: stamps, force }, &track, 0.0);
        let (a, b) = (0.3137, 0.9711);
        let [_, y, z] = response.moments(a, b);
        let expected_y = 3.0 * ((rate * b).cos() - (rate * a).cos()) / rate;
        let expected_z = 3.0 * ((rate * b).sin() - (rate * a).sin()) / rate;
        // J2 = ∫ (b - τ) 3 cos 2τ dτ = 3 [ -(b-a) sin(2a)/2 + (cos 2a - cos 2b)/4 ]
        let second = 3.0 * (-(b - a) * (rate * a).sin() / rate + ((rate * a).cos() - (rate * b).cos()) / (rate * rate));
        assert!((y.j1 - expected_y).abs() < 1e-5 && (z.j1 - expected_z).abs() < 1e-5, "{y:?} {z:?}");
        assert!((z.j2 - second).abs() < 1e-5, "{z:?} {second}");
    }
}
