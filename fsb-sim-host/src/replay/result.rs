//! The whole replay, and what came out.

use super::error::ReplayError;
use super::feed::{AxisTrace, Column, ParameterTrace, Trace, Watch, feed};
use super::identified::{Identified, identify};
use super::log::{Axis, AxisColumn, AxisLog};
use super::options::{LIMIT, ReplayOptions};
use fsb_core::ConfigError;
use fsb_core::regression::Identify;

/// What a replay gave. Every trace has one entry per sample of the log.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayResult {
    /// Time step \[s\].
    pub period: f64,
    /// Rows of the log.
    pub samples: usize,
    /// Empty positions, over all axes.
    pub missed: usize,
    /// Measurements and inputs that the core rejected because they are beyond 1e6 in magnitude.
    pub rejected: usize,
    /// k = 1/m \[1/kg\], shared by the translational axes; `None` where the log has none.
    pub mass: Option<ParameterTrace>,
    /// The axes present, in the order x, y, z, roll, pitch, yaw.
    pub axes: Vec<AxisResult>,
    /// k, drag and disturbance together, where [`ReplayOptions::identify`] asks for it.
    pub identified: Option<Identified>,
}

/// The window of an observer has opened after this over its λ: its noise is that of the steady state by then.
pub const OPENED: f64 = 10.0;

/// One axis of a replay.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisResult {
    /// Which.
    pub axis: Axis,
    /// What the observer handed out: with the pooled k̂ on a translational axis, with the axis's own on a rotational one.
    pub trace: AxisTrace,
    /// k̂ from this axis alone \[1/kg or 1/(kg m²)\].
    pub own: ParameterTrace,
    /// Root mean square of v̂ minus the log's reference where both exist \[m/s or rad/s\]; `None` where they never do. Where
    /// drag or disturbance is identified it is that of the observer that knows from the first sample on what the whole flight tells, from
    /// [`OPENED`]/λ of the observer after its first measurement on.
    pub velocity_rms_error: Option<f64>,
    /// The same of `trace`, where drag or disturbance is identified on the way.
    pub velocity_rms_error_on_the_way: Option<f64>,
}

impl ReplayResult {
    /// The rotational axes.
    pub fn rotational(&self) -> impl Iterator<Item = &AxisResult> {
        self.axes.iter().filter(|a| !a.axis.is_translation())
    }
}

/// Replays `log` through the f32 core.
///
/// The estimator of a group of axes (translational, rotational) starts at the first row that has a position of each.
///
/// # Errors
/// [`ReplayError`] with the option at fault, or the columns that are never measured together.
pub fn run(options: &ReplayOptions, log: &AxisLog) -> Result<ReplayResult, ReplayError> {
    run_watched(options, log, Watch(&|_| {}))
}

/// As [`run`], `watch` being told how many more samples have been gone through, of [`passes`] times the log in all.
///
/// # Errors
/// As [`run`].
pub fn run_watched(options: &ReplayOptions, log: &AxisLog, watch: Watch<'_>) -> Result<ReplayResult, ReplayError> {
    options.check_gravity()?;
    let (rotational, translational): (Vec<&AxisColumn>, Vec<&AxisColumn>) =
        log.axes.iter().partition(|a| !a.axis.is_translation());
    let mut result = ReplayResult {
        period: log.period,
        samples: log.len(),
        missed: log.axes.iter().flat_map(|a| &a.position).filter(|y| y.is_none()).count(),
        rejected: 0,
        mass: None,
        axes: Vec::with_capacity(log.axes.len()),
        identified: None,
    };
    if !translational.is_empty() {
        let mut pooled = replay_group(options, log.period, &translational, true, watch)?;
        let own = replay_group(options, log.period, &translational, false, watch)?;
        result.mass = pooled.parameters.pop();
        let mut informed = false;
        if let Some(identify) = options.identify {
            let identified = identify_group(options, log.period, &translational, watch)?;
            // The model with more in it has the say, of k as of the velocities.
            if identify != Identify::NOTHING_ELSE {
                result.mass = Some(identified.parameter.clone());
                pooled.axes.clone_from(&identified.axes);
                informed = true;
            }
            result.identified = Some(identified);
        }
        result.take(&translational, pooled, own.parameters);
        if let Some(identified) = result.identified.as_ref().filter(|_| informed) {
            let opened = (OPENED / (options.observer.lambda * log.period)).ceil() as usize;
            let of_axes = result.axes.iter_mut().zip(&translational).zip(&identified.informed);
            for ((axis, column), informed) in of_axes {
                axis.velocity_rms_error_on_the_way = axis.velocity_rms_error;
                let reference = column.velocity_reference.as_deref();
                axis.velocity_rms_error = velocity_rms_error(&informed.after(opened), reference);
            }
        }
    }
    if !rotational.is_empty() {
        let mut each = replay_group(options, log.period, &rotational, false, watch)?;
        let own = std::mem::take(&mut each.parameters);
        result.take(&rotational, each, own);
    }
    Ok(result)
}

impl ReplayResult {
    fn take(&mut self, axes: &[&AxisColumn], trace: Trace, own: Vec<ParameterTrace>) {
        self.rejected += trace.rejected_measurements as usize + trace.rejected_inputs as usize;
        for ((axis, trace), own) in axes.iter().zip(trace.axes).zip(own) {
            let velocity_rms_error = velocity_rms_error(&trace, axis.velocity_reference.as_deref());
            self.axes.push(AxisResult {
                axis: axis.axis,
                trace,
                own,
                velocity_rms_error,
                velocity_rms_error_on_the_way: None,
            });
        }
    }
}

/// How often [`run_watched`] goes through `log`.
#[must_use]
pub fn passes(options: &ReplayOptions, log: &AxisLog) -> u64 {
    let rotational = log.axes.iter().any(|a| !a.axis.is_translation());
    let translational = log.axes.iter().any(|a| a.axis.is_translation());
    u64::from(rotational) + u64::from(translational) * (2 + u64::from(options.identify.is_some()))
}

fn replay_group(
    options: &ReplayOptions,
    period: f64,
    axes: &[&AxisColumn],
    pooled: bool,
    watch: Watch<'_>,
) -> Result<Trace, ReplayError> {
    let group = Group::new(options, period, axes, watch)?;
    match (axes.len(), pooled) {
        (1, _) => group.feed::<1, 1>(),
        (2, true) => group.feed::<2, 1>(),
        (2, false) => group.feed::<2, 2>(),
        (_, true) => group.feed::<3, 1>(),
        (_, false) => group.feed::<3, 3>(),
    }
    .map_err(|cause| group.refuse(cause))
}

fn identify_group(
    options: &ReplayOptions,
    period: f64,
    axes: &[&AxisColumn],
    watch: Watch<'_>,
) -> Result<Identified, ReplayError> {
    let group = Group::new(options, period, axes, watch)?;
    match axes.len() {
        1 => group.identify::<1>(),
        2 => group.identify::<2>(),
        _ => group.identify::<3>(),
    }
    .map_err(|cause| group.refuse(cause))
}

struct Group<'a> {
    options: &'a ReplayOptions,
    period: f64,
    axes: &'a [&'a AxisColumn],
    start: usize,
    watch: Watch<'a>,
}

impl<'a> Group<'a> {
    fn new(
        options: &'a ReplayOptions,
        period: f64,
        axes: &'a [&'a AxisColumn],
        watch: Watch<'a>,
    ) -> Result<Self, ReplayError> {
        let samples = axes.iter().map(|a| a.position.len()).min().unwrap_or(0);
        let start = (0..samples)
            .find(|&n| axes.iter().all(|a| a.position[n].is_some_and(|y| y.abs() <= LIMIT)))
            .ok_or_else(|| {
                let names: Vec<&str> = axes.iter().map(|a| a.axis.name()).collect();
                ReplayError::NeverMeasured { columns: names.join(", ") }
            })?;
        Ok(Self { options, period, axes, start, watch })
    }

    fn refuse(&self, cause: ConfigError) -> ReplayError {
        ReplayError::Parameter { cause, options: Box::new(*self.options), period: self.period }
    }

    fn columns<const N: usize>(&self) -> [Column<'a>; N] {
        std::array::from_fn(|i| {
            let axis = self.axes[i];
            Column { position: &axis.position, input: &axis.input, ramps: axis.ramps.as_deref() }
        })
    }

    fn drift<const N: usize>(&self) -> [f64; N] {
        std::array::from_fn(|i| if self.axes[i].axis == Axis::Z { -self.options.gravity } else { 0.0 })
    }

    /// `N` is the number of axes.
    fn feed<const N: usize, const P: usize>(&self) -> Result<Trace, ConfigError> {
        feed(&self.options.config::<N, P>(self.period, self.drift()), &self.columns(), self.start, self.watch)
    }

    fn identify<const N: usize>(&self) -> Result<Identified, ConfigError> {
        identify(self.options, self.period, self.drift::<N>(), &self.columns(), self.start, self.watch)
    }
}

fn velocity_rms_error(trace: &AxisTrace, reference: Option<&[Option<f64>]>) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0usize);
    for (state, reference) in trace.state.iter().zip(reference?) {
        if let (Some(state), Some(reference)) = (state, reference) {
            sum += (f64::from(state.velocity) - reference).powi(2);
            count += 1;
        }
    }
    (count > 0).then(|| (sum / count as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use fsb_core::estimator::AxisState;

    #[test]
    fn velocity_error_counts_samples_where_both_exist() {
        let v = |velocity| Some(AxisState { position: 0.0, velocity });
        let trace = AxisTrace { state: vec![v(9.0), None, v(3.0), v(1.0)], innovation: vec![None; 4] };
        let rms = velocity_rms_error(&trace, Some(&[None, Some(5.0), Some(0.0), Some(5.0)]));
        assert_eq!(rms, Some(12.5f64.sqrt()));
        assert_eq!(velocity_rms_error(&trace, Some(&[None, Some(1.0), None, None])), None);
        assert_eq!(velocity_rms_error(&trace, None), None);
    }
}
