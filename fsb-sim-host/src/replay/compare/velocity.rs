//! Velocities side by side: the observer's, finite differences, and a tuned Kalman filter's.

use super::kalman::Kalman;
use super::noise::measured;
use crate::replay::log::{Axis, AxisLog};
use crate::replay::result::ReplayResult;

/// One translational axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Velocities {
    /// Which.
    pub axis: Axis,
    /// Standard deviation of its measurements \[m\].
    pub noise_sd: f64,
    /// The filter and its tuning.
    pub filter: Kalman,
    /// What it gives \[m/s\].
    pub kalman: Vec<Option<f64>>,
    /// (y\[n\] - y\[n-1\])/T \[m/s\].
    pub differences: Vec<Option<f64>>,
    /// Root mean square errors against the reference, where there is one: observer, Kalman filter, differences, all at the same
    /// samples \[m/s\].
    pub rms: Option<[f64; 3]>,
}

/// The translational axes that can be compared: those with a known k and some measurements in a row.
#[must_use]
pub fn compare(result: &ReplayResult, log: &AxisLog, gravity: f64) -> Vec<Velocities> {
    let Some(k) = result.mass.as_ref().and_then(|mass| mass.last()).map(|k| f64::from(k.value)) else {
        return Vec::new();
    };
    let axes = result.axes.iter().zip(&log.axes).filter(|(axis, _)| axis.axis.is_translation());
    axes.filter_map(|(axis, column)| {
        let drift = if axis.axis == Axis::Z { -gravity } else { 0.0 };
        let noise_sd = measured(log, column, k, drift)?;
        // Positions from a simulation may have no noise at all; the filter needs some.
        let noise_variance = noise_sd.powi(2).max(1e-14);
        let filter = Kalman { k, drift, noise_variance, process: 1.0 }.tuned(log, column);
        let kalman = filter.filter(log, column).velocity;
        let first = std::iter::once(None);
        let steps = column.position.windows(2).map(|pair| pair[1].zip(pair[0]).map(|(new, old)| (new - old) / log.period));
        let differences: Vec<Option<f64>> = first.chain(steps).collect();
        let mut sums = ([0.0; 3], 0usize);
        for (n, reference) in column.velocity_reference.iter().flatten().enumerate() {
            let ours = axis.trace.state.get(n).copied().flatten().map(|state| f64::from(state.velocity));
            if let (Some(truth), Some(ours), Some(theirs), Some(step)) =
                (*reference, ours, kalman.get(n).copied().flatten(), differences.get(n).copied().flatten())
            {
                for (sum, value) in sums.0.iter_mut().zip([ours, theirs, step]) {
                    *sum += (value - truth).powi(2);
                }
                sums.1 += 1;
            }
        }
        let rms = (sums.1 > 0).then(|| sums.0.map(|sum| (sum / sums.1 as f64).sqrt()));
        Some(Velocities { axis: axis.axis, noise_sd, filter, kalman, differences, rms })
    })
    .collect()
}
