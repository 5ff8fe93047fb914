//! The time offset between the input and the position.
//!
//! An input that acts τ later than its time stamp says (a motor, a filter, two clocks) leaves what the regression cannot
//! explain: about τ k f' of the acceleration. The offset is the one that leaves least: the residual of k, drag and disturbance
//! together (drag alone would look like an offset) over trial offsets, the best of a coarse scan refined by golden sections and, at
//! the end, a parabola. The input is not resampled for it: its stamps move, and its moments are integrated anew.
//!
//! An offset shows in what is quick, and what the model lacks (a thrust curve, a swinging load) in what is slow: the
//! regression has a λ of its own, [`LAMBDA`], ten times that of the identifier. On the recorded flights that this was tried on, offsets
//! found with λ = 2 scatter over 70 ms, with λ = 20 over 4 ms.

use super::fit::{Terms, fit, rows};
use super::log::AxisLog;
use fsb_core::Tuning;

/// Offsets are searched for within this to either side \[s\].
pub const RANGE: f64 = 0.2;
/// λ of the regression \[1/s\], or half of what one step of the log allows where that is less.
pub const LAMBDA: f64 = 20.0;
/// λT is at most this.
const LARGEST_STEP: f64 = 0.5;
/// Step of the scan \[s\]: below the width of the valley, 1/λ or so.
const STEP: f64 = 0.02;
/// The sections end at this width \[s\].
const FINEST: f64 = 2e-4;

/// What the time offset is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lag {
    /// As given \[s\]: positive where the input acts later than its time stamp says.
    Given(f64),
    /// The one that leaves least.
    Auto,
}

impl Default for Lag {
    fn default() -> Self {
        Self::Given(0.0)
    }
}

/// An offset that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundLag {
    /// \[s\]
    pub lag: f64,
    /// Trial offsets \[s\] and the residual that each leaves \[m/s²\], rising.
    pub scan: Vec<(f64, f64)>,
    /// The best offset is at an end of the range: the true one may lie beyond.
    pub at_the_end: bool,
}

/// Finds the offset. `delayed` is the log with the input so much later; `tried` is called after each trial.
///
/// `None` where k cannot be told at any offset.
pub fn find(delayed: impl Fn(f64) -> AxisLog, gravity: f64, tried: impl Fn()) -> Option<FoundLag> {
    let left = |lag: f64| {
        let log = delayed(lag);
        let tuning = Tuning::from_lambda(LAMBDA.min(LARGEST_STEP / log.period));
        let residual = fit(&rows(&log, tuning, gravity), Terms { drag: true, disturbance: true });
        tried();
        residual.map_or(f64::INFINITY, |fit| fit.rms)
    };
    let count = (RANGE / STEP).round() as i32;
    let mut scan: Vec<(f64, f64)> = (-count..=count).map(|i| f64::from(i) * STEP).map(|lag| (lag, left(lag))).collect();
    let best = scan.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).filter(|best| best.1.is_finite())?;
    let at_the_end = best.0.abs() > RANGE - STEP / 2.0;
    let (mut low, mut high) = ((best.0 - STEP).max(-RANGE), (best.0 + STEP).min(RANGE));
    const SECTION: f64 = 0.618_033_988_749_894_9;
    let mut inner = [high - SECTION * (high - low), low + SECTION * (high - low)].map(|lag| (lag, left(lag)));
    scan.extend(inner);
    while high - low > FINEST {
        if inner[0].1 < inner[1].1 {
            high = inner[1].0;
            let lag = high - SECTION * (high - low);
            inner = [(lag, left(lag)), inner[0]];
            scan.push(inner[0]);
        } else {
            low = inner[0].0;
            let lag = low + SECTION * (high - low);
            inner = [inner[1], (lag, left(lag))];
            scan.push(inner[1]);
        }
    }
    scan.sort_by(|a, b| a.0.total_cmp(&b.0));
    Some(FoundLag { lag: parabola(&scan), scan, at_the_end })
}

/// How often [`find`] tries, for a progress bar.
#[must_use]
pub fn trials() -> u64 {
    let sections = ((FINEST / (2.0 * STEP)).ln() / 0.618_034_f64.ln()).ceil();
    2 * (RANGE / STEP).round() as u64 + 3 + sections as u64
}

/// The lowest point of a parabola through the squares of the best trial and one some milliseconds to either side of it: near its
/// bottom the valley is flat, and neighbours too near tell its rounding only.
fn parabola(scan: &[(f64, f64)]) -> f64 {
    const WIDE: f64 = 2e-3;
    let Some(best) = (0..scan.len()).min_by(|&a, &b| scan[a].1.total_cmp(&scan[b].1)) else { return 0.0 };
    let (at, bottom) = scan[best];
    let before = scan[..best].iter().rev().find(|(lag, _)| at - lag >= WIDE);
    let after = scan[best..].iter().find(|(lag, _)| lag - at >= WIDE);
    let (Some(before), Some(after)) = (before, after) else { return at };
    let (a, b) = (before.0 - at, after.0 - at);
    let (ya, yb) = (before.1.powi(2) - bottom.powi(2), after.1.powi(2) - bottom.powi(2));
    let curvature = (ya / a - yb / b) / (a - b);
    let slope = ya / a - curvature * a;
    if curvature > 0.0 { (at - slope / (2.0 * curvature)).clamp(before.0, after.0) } else { at }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A log that holds the acceleration of the beginning of each step where the mean is meant has its input half a step late: it is found to
    /// act half a step before its stamps. Two sines on the axis, for with one alone an offset is the same as a drag.
    #[test]
    fn half_a_step_of_an_axis_log() {
        for (period, rounding) in [(0.01, 1e-12), (0.01, 1e-4), (0.002, 1e-4)] {
            let mut text = String::from("t,x,fx\n");
            for n in 0..(20.0 / period) as usize {
                let t = n as f64 * period;
                let y = -1.2 * (1.1 * t).cos() - 0.1 * (3.0 * t).sin();
                let acceleration = 1.2 * 1.21 * (1.1 * t).cos() + 0.9 * (3.0 * t).sin();
                text += &format!("{t},{},{}\n", (y / rounding).round() * rounding, 0.7 * acceleration);
            }
            let log = AxisLog::from_reader("log", text.as_bytes()).unwrap();
            let found = find(|lag| log.delayed(lag), 9.81, || {}).unwrap();
            assert!((found.lag + period / 2.0).abs() < 1e-4 && !found.at_the_end, "{} at {period} s", found.lag);
        }
    }

    #[test]
    fn the_bottom_of_a_valley() {
        let scan: Vec<(f64, f64)> = (-20..=20)
            .map(|i| 0.001 * f64::from(i))
            .map(|x| (x, (2.0 + 300.0 * (x - 0.0034).powi(2)).sqrt()))
            .collect();
        assert!((parabola(&scan) - 0.0034).abs() < 1e-9);
        assert_eq!(parabola(&[(0.0, 1.0), (0.1, 2.0)]), 0.0);
    }
}
