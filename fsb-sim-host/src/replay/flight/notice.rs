//! What a reader of a flight has to be told: gaps, jumps, saturation.

use super::Flight;
use super::grid::{LARGEST_BRACKET, median};
use crate::replay::log::AxisLog;

/// A thrust that stays at its very largest value for so long \[s\] is taken for a saturated motor.
const SATURATED: f64 = 0.05;
/// Positions missing for so long \[s\] are a gap worth a word.
const GAP: f64 = 0.1;
/// Positions that stay the very same for so long \[s\] are worth a word: a sensor of a vehicle in the air has some noise.
const FROZEN: f64 = 1.0;
/// A step of the position is a jump from this on \[m\] …
const JUMP: f64 = 0.1;
/// … where it is so many times what is usual.
const UNUSUAL: f64 = 50.0;

impl Flight {
    /// Gaps, jumps and saturation, a line each.
    #[must_use]
    pub fn noticed(&self) -> Vec<String> {
        let step = self.step();
        let mut words = self.notices.clone();
        words.extend(gaps("position", &self.times, LARGEST_BRACKET * step, "taken as missed measurements"));
        words.extend(gaps("attitude", &self.attitude.times, 5.0 * step, "turned evenly between the ends"));
        words.extend(gaps("input", &self.input.times, 5.0 * step, "the last input is taken as held"));
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let track: Vec<(f64, f64)> = self.times.iter().zip(&self.position).map(|(&t, p)| (t, p[axis])).collect();
            words.extend(jumps(name, &track, GAP.max(LARGEST_BRACKET * step)));
        }
        let places: Vec<(f64, [f64; 3])> = self.times.iter().copied().zip(self.position.iter().copied()).collect();
        words.extend(frozen(&places));
        let size = |f: &[f64; 3]| f.iter().map(|x| x * x).sum::<f64>().sqrt();
        let thrust: Vec<(f64, f64)> =
            self.input.times.iter().zip(&self.input.force).map(|(&t, f)| (t, size(f))).collect();
        words.extend(saturation(&thrust));
        words
    }
}

/// The same for an axis log, whose rows are at equal distances.
#[must_use]
pub fn noticed(log: &AxisLog) -> Vec<String> {
    let mut words = Vec::new();
    for axis in log.axes.iter() {
        let name = axis.axis.name();
        let measured: Vec<(f64, f64)> =
            axis.position.iter().enumerate().filter_map(|(n, y)| y.map(|y| (log.time(n), y))).collect();
        let times: Vec<f64> = measured.iter().map(|&(t, _)| t).collect();
        words.extend(gaps(name, &times, 1.5 * log.period, "taken as missed measurements"));
        if axis.axis.is_translation() {
            words.extend(jumps(name, &measured, GAP.max(1.5 * log.period)));
        }
    }
    let translational: Vec<&[f64]> =
        log.axes.iter().filter(|a| a.axis.is_translation()).map(|a| a.input.as_slice()).collect();
    let positions: Vec<&[Option<f64>]> =
        log.axes.iter().filter(|a| a.axis.is_translation()).map(|a| a.position.as_slice()).collect();
    if !positions.is_empty() {
        let places: Vec<(f64, Vec<Option<f64>>)> = (0..log.len())
            .map(|n| (log.time(n), positions.iter().map(|column| column[n]).collect()))
            .filter(|(_, place): &(f64, Vec<Option<f64>>)| place.iter().all(Option::is_some))
            .collect();
        words.extend(frozen(&places));
    }
    if translational.len() == 3 {
        let size = |n: usize| translational.iter().map(|f| f[n] * f[n]).sum::<f64>().sqrt();
        words.extend(saturation(&(0..log.len()).map(|n| (log.time(n), size(n))).collect::<Vec<_>>()));
    }
    words
}

/// One line for all gaps of a column: how many, and the longest.
fn gaps(what: &str, times: &[f64], usual: f64, consequence: &str) -> Option<String> {
    let limit = usual.max(GAP);
    let found: Vec<(f64, f64)> =
        times.windows(2).filter(|pair| pair[1] - pair[0] > limit).map(|pair| (pair[0], pair[1] - pair[0])).collect();
    let (t, length) = found.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let count = found.len();
    let gaps = if count == 1 { "a gap".to_owned() } else { format!("{count} gaps, the longest") };
    Some(format!("{what}: {gaps} of {length:.2} s at t = {t:.2} s; {consequence}"))
}

/// The longest time in which no coordinate changes by a single bit.
fn frozen<P: PartialEq>(places: &[(f64, P)]) -> Option<String> {
    let (mut longest, mut at, mut since) = (0.0, 0.0, 0);
    for (n, (t, place)) in places.iter().enumerate() {
        if *place != places[since].1 {
            since = n;
        } else if t - places[since].0 > longest {
            (longest, at) = (t - places[since].0, places[since].0);
        }
    }
    (longest >= FROZEN).then(|| {
        format!(
            "the position does not change at all for {longest:.2} s from t = {at:.2} s on: where the vehicle did not stand still, its \
             sensor did, and what is identified is not to be trusted"
        )
    })
}

/// One line for all jumps of a position: a step that is far from what the velocities around it explain. Over a gap longer than
/// `gap` \[s\] there is nothing to compare with.
fn jumps(name: &str, track: &[(f64, f64)], gap: f64) -> Option<String> {
    let velocity: Vec<f64> = track.windows(2).map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).collect();
    // The middle one of five does not see a single step.
    let around = |i: usize| median(velocity[i.saturating_sub(2)..(i + 3).min(velocity.len())].iter().copied());
    let excess: Vec<(f64, f64)> = (0..velocity.len())
        .map(|i| (track[i + 1].0, (velocity[i] - around(i)) * (track[i + 1].0 - track[i].0)))
        .collect();
    let limit = (UNUSUAL * median(excess.iter().map(|(_, e)| e.abs()))).max(JUMP);
    let found: Vec<(f64, f64)> = excess
        .into_iter()
        .zip(track)
        .filter(|((t, excess), (before, _))| excess.abs() > limit && t - before <= gap)
        .map(|(found, _)| found)
        .collect();
    let (t, size) = found.first()?;
    let count = if found.len() == 1 { String::new() } else { format!(", the first of {} such jumps", found.len()) };
    Some(format!(
        "{name} jumps by {size:.2} m at t = {t:.2} s{count}: a reset of the position or a lost track; what is identified from \
         there on is not to be trusted"
    ))
}

/// The longest time at the very largest value.
fn saturation(thrust: &[(f64, f64)]) -> Option<String> {
    let largest = thrust.iter().map(|&(_, f)| f).fold(0.0, f64::max);
    let smallest = thrust.iter().map(|&(_, f)| f).fold(f64::INFINITY, f64::min);
    // A thrust that hardly moves is at its largest value all the time.
    if largest <= 0.0 || smallest > 0.95 * largest {
        return None;
    }
    let (mut longest, mut at, mut began) = (0.0, 0.0, None);
    for &(t, force) in thrust {
        if force >= largest * (1.0 - 1e-6) {
            let since = *began.get_or_insert(t);
            if t - since > longest {
                (longest, at) = (t - since, since);
            }
        } else {
            began = None;
        }
    }
    (longest >= SATURATED).then(|| {
        format!(
            "the thrust stays at its largest value, {largest:.4}, for {longest:.2} s at t = {at:.2} s: where a motor is saturated the \
             real thrust is another one, and k with it"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_a_jump_and_a_saturated_motor_are_told_and_nothing_else() {
        let smooth = |t: f64| (1.3 * t).sin();
        let times: Vec<f64> = (0..500).map(|i| 0.01 * f64::from(i)).collect();
        let track: Vec<(f64, f64)> = times.iter().map(|&t| (t, smooth(t))).collect();
        assert_eq!((gaps("x", &times, 0.025, ""), jumps("x", &track, GAP), saturation(&track)), (None, None, None));
        assert_eq!(frozen(&track), None);

        let mut holed = times.clone();
        holed.drain(200..250);
        assert!(gaps("x", &holed, 0.025, "").is_some_and(|word| word.contains("0.51 s at t = 1.99 s")));
        let reset: Vec<(f64, f64)> = times.iter().map(|&t| (t, smooth(t) + if t > 3.0 { 0.5 } else { 0.0 })).collect();
        assert!(jumps("x", &reset, GAP).is_some_and(|word| word.contains("0.50 m at t = 3.01 s:")));
        // Over a gap the way flown meanwhile is no jump.
        let over: Vec<(f64, f64)> = holed.iter().map(|&t| (t, smooth(t))).collect();
        assert_eq!(jumps("x", &over, GAP), None);
        let stopped: Vec<(f64, f64)> = times.iter().map(|&t| (t, smooth(t.clamp(1.0, 2.5)))).collect();
        assert!(
            frozen(&stopped).is_some_and(|word| word.contains("for 2.49 s from t = 2.50 s on")),
            "{:?}",
            frozen(&stopped)
        );
        let clipped: Vec<(f64, f64)> = times.iter().map(|&t| (t, (10.0 + 4.0 * smooth(t)).min(12.0))).collect();
        assert!(saturation(&clipped).is_some_and(|word| word.contains("12.0000")));
    }
}
