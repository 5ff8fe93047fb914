//! k, drag and disturbance identified together by the core, sample by sample.

use super::feed::{AxisTrace, Column, ParameterTrace, Watch, f32_line};
use super::informed::observe;
use super::options::{LIMIT, ReplayOptions};
use fsb_core::ConfigError;
use fsb_core::regression::{AxisTerms, DragConfig, DragEstimator, Identify};

/// What came out of a group of axes that share k.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified {
    /// k̂.
    pub parameter: ParameterTrace,
    /// D and d of each axis, per sample.
    pub terms: Vec<Vec<AxisTerms>>,
    /// Positions and velocities that the observer hands out: predicted with what is identified.
    pub axes: Vec<AxisTrace>,
    /// The same by an observer that knows from the first sample on what the whole flight tells; empty where k is not valid at
    /// the end.
    pub informed: Vec<AxisTrace>,
    /// ẑ2 - k ẑ0 + D ẑv - d ẑu of each axis with the values at the end \[m/s²\]; `None` before the identifier has started.
    pub residual: Vec<Vec<Option<f64>>>,
}

impl Identified {
    /// D and d of an axis at the end.
    #[must_use]
    pub fn last(&self, axis: usize) -> AxisTerms {
        self.terms.get(axis).and_then(|terms| terms.last()).copied().unwrap_or_default()
    }

    /// Root mean square of the residuals over all axes \[m/s²\]; `None` where there are none.
    #[must_use]
    pub fn residual_rms(&self) -> Option<f64> {
        let all = || self.residual.iter().flatten().flatten();
        let count = all().count();
        (count > 0).then(|| (all().map(|r| r * r).sum::<f64>() / count as f64).sqrt())
    }
}

impl ReplayOptions {
    fn drag_config<const N: usize>(&self, period: f64, drift: [f64; N]) -> DragConfig<N> {
        DragConfig {
            identifier: self.identifier,
            observer: self.observer,
            identify: [self.identify.unwrap_or(Identify::NOTHING_ELSE); N],
            memory: self.memory,
            drift,
            rule: Self::rule(),
            position_limit: LIMIT,
            input_limit: LIMIT,
            ..DragConfig::new(period)
        }
    }
}

/// Replays `columns` (all of one length) from sample `start` on.
pub(super) fn identify<const N: usize>(
    options: &ReplayOptions,
    period: f64,
    drift: [f64; N],
    columns: &[Column<'_>; N],
    start: usize,
    watch: Watch<'_>,
) -> Result<Identified, ConfigError> {
    let mut estimator = DragEstimator::new(&options.drag_config(period, drift))?;
    let samples = columns.iter().map(|c| c.position.len().min(c.input.len())).min().unwrap_or(0);
    let mut found = Identified {
        parameter: ParameterTrace { value: vec![None; samples], ..ParameterTrace::default() },
        terms: vec![vec![AxisTerms::default(); samples]; N],
        axes: vec![AxisTrace { state: vec![None; samples], innovation: vec![None; samples] }; N],
        informed: Vec::new(),
        residual: vec![vec![None; samples]; N],
    };
    let mut signals = Vec::with_capacity(samples);
    for n in start..samples {
        watch.sample(n);
        let positions = columns.map(|c| c.position[n].map(|y| y as f32));
        if estimator.measure(&positions).is_err() {
            continue;
        }
        let (states, diagnostics, terms) = (estimator.states(), estimator.diagnostics(), estimator.terms());
        for (i, trace) in found.axes.iter_mut().enumerate() {
            trace.state[n] = states[i];
            trace.innovation[n] = states[i].and(positions[i]).map(|_| diagnostics[i].innovation);
            found.terms[i][n] = terms[i];
        }
        found.parameter.value[n] = estimator.parameter();
        signals.push((n, diagnostics));
        let (from, to) = f32_line(columns, n);
        estimator.apply_ramp(&from, &to);
    }
    found.parameter.status = estimator.parameter_status();
    if let Some(k) = found.parameter.last() {
        for i in 0..N {
            let last = found.last(i);
            found.informed.push(observe(options.observer, period, &columns[i], start, (k.value, last, drift[i]))?);
            let value = |term: Option<f32>| term.map_or(0.0, f64::from);
            let (drag, disturbance) = (value(last.drag.value()), value(last.disturbance.value()));
            // The window is shut in the first two samples.
            for (n, at) in signals.iter().skip(2) {
                let at = at[i];
                let rest = f64::from(at.z2) - f64::from(k.value) * f64::from(at.z0) + drag * f64::from(at.zv);
                found.residual[i][*n] = Some(rest - disturbance * f64::from(at.zu));
            }
        }
    }
    Ok(found)
}
