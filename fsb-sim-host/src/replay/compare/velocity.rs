//! Velocities side by side: the observer's, finite differences, and a tuned Kalman filter's.

use super::kalman::Kalman;
use super::noise::measured;
use crate::replay::log::{Axis, AxisLog};
use crate::replay::result::{OPENED, ReplayResult};

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
    /// What the observer gives that knows from the first sample on what the whole flight tells \[m/s\]; none where only k is
    /// identified.
    pub informed: Vec<Option<f64>>,
    /// Root mean square errors against the reference, where there is one, all at the same samples \[m/s\], from
    /// [`OPENED`]/λ of the observer on: the observer on the way,
    /// the informed one (or again the first), Kalman filter, differences.
    pub rms: Option<[f64; 4]>,
}

/// The translational axes that can be compared: those with a known k and some measurements in a row.
#[must_use]
pub fn compare(result: &ReplayResult, log: &AxisLog, gravity: f64, observer_lambda: f64) -> Vec<Velocities> {
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
        let steps =
            column.position.windows(2).map(|pair| pair[1].zip(pair[0]).map(|(new, old)| (new - old) / log.period));
        let differences: Vec<Option<f64>> = first.chain(steps).collect();
        let of_axis = result.axes.iter().position(|other| other.axis == axis.axis);
        let told = axis.velocity_rms_error_on_the_way.and(result.identified.as_ref());
        let informed: Vec<Option<f64>> = of_axis
            .and_then(|index| told?.informed.get(index))
            .map(|trace| trace.state.iter().map(|state| state.map(|state| f64::from(state.velocity))).collect())
            .unwrap_or_default();
        let mut sums = ([0.0; 4], 0usize);
        let opened = (OPENED / (observer_lambda * log.period)).ceil() as usize;
        for (n, reference) in column.velocity_reference.iter().flatten().enumerate().skip(opened) {
            let ours = axis.trace.state.get(n).copied().flatten().map(|state| f64::from(state.velocity));
            if let (Some(truth), Some(ours), Some(theirs), Some(step)) =
                (*reference, ours, kalman.get(n).copied().flatten(), differences.get(n).copied().flatten())
            {
                let knowing = informed.get(n).copied().flatten().unwrap_or(ours);
                for (sum, value) in sums.0.iter_mut().zip([ours, knowing, theirs, step]) {
                    *sum += (value - truth).powi(2);
                }
                sums.1 += 1;
            }
        }
        let rms = (sums.1 > 0).then(|| sums.0.map(|sum| (sum / sums.1 as f64).sqrt()));
        Some(Velocities { axis: axis.axis, noise_sd, filter, kalman, differences, informed, rms })
    })
    .collect()
}
