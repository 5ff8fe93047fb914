//! A group of axes through one estimator of the f32 core, sample by sample.

use fsb_core::estimator::AxisState;
use fsb_core::readout::{Parameter, ParameterStatus};
use fsb_core::{ConfigError, Estimator, EstimatorConfig};

/// What one axis measured and was driven by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column<'a> {
    /// Position at each sample \[m or rad\]; `None` where it is missing.
    pub position: &'a [Option<f64>],
    /// Mean input from each sample to the next \[N or N m\].
    pub input: &'a [f64],
    /// The line with the input's moments from each sample to the next, where the input is not held.
    pub ramps: Option<&'a [(f64, f64)]>,
}

/// What an axis's observer handed out, per sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisTrace {
    /// Position \[m or rad\] and velocity; `None` where no state may be used.
    pub state: Vec<Option<AxisState>>,
    /// Innovation y - ŷ⁻ \[m or rad\]; `None` where nothing was measured or no state may be used.
    pub innovation: Vec<Option<f32>>,
}

impl AxisTrace {
    /// Without the states of the first `samples` from the first one on.
    pub(super) fn after(&self, samples: usize) -> Self {
        let from = self.state.iter().position(Option::is_some).unwrap_or(0) + samples;
        let state = self.state.iter().enumerate().map(|(n, state)| state.filter(|_| n >= from)).collect();
        Self { state, innovation: self.innovation.clone() }
    }
}

/// What was read out for one parameter, per sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterTrace {
    /// k̂ with its variance; `None` where it is not valid.
    pub value: Vec<Option<Parameter>>,
    /// Why it is valid or not at the last sample.
    pub status: ParameterStatus,
}

impl ParameterTrace {
    /// k̂ at the last sample, where it is valid there.
    pub fn last(&self) -> Option<Parameter> {
        self.value.last().copied().flatten()
    }
}

/// Told now and then how many more samples have been gone through.
#[derive(Clone, Copy)]
pub struct Watch<'a>(pub &'a dyn Fn(u64));

impl Watch<'_> {
    const EVERY: usize = 4096;

    pub(super) fn sample(self, n: usize) {
        if n % Self::EVERY == Self::EVERY - 1 {
            (self.0)(Self::EVERY as u64);
        }
    }
}

/// A group of axes, replayed.
#[derive(Clone, Debug, Default)]
pub(super) struct Trace {
    pub axes: Vec<AxisTrace>,
    pub parameters: Vec<ParameterTrace>,
    /// Measurements beyond the limit of the core, taken as missed.
    pub rejected_measurements: u32,
    /// Inputs beyond the limit of the core, replaced by the axis's mean input of late.
    pub rejected_inputs: u32,
}

/// Replays `columns` (all of one length) from sample `start` on; nothing is handed out before.
pub(super) fn feed<const N: usize, const P: usize>(
    config: &EstimatorConfig<N, P>,
    columns: &[Column<'_>; N],
    start: usize,
    watch: Watch<'_>,
) -> Result<Trace, ConfigError> {
    let mut estimator = Estimator::new(config)?;
    let samples = columns.iter().map(|c| c.position.len().min(c.input.len())).min().unwrap_or(0);
    let mut axes = vec![AxisTrace { state: vec![None; samples], innovation: vec![None; samples] }; N];
    let mut parameters = vec![ParameterTrace { value: vec![None; samples], status: ParameterStatus::default() }; P];
    for n in start..samples {
        watch.sample(n);
        let positions = columns.map(|c| c.position[n].map(|y| y as f32));
        // One input follows each measurement, so that the next one is always due.
        if estimator.measure(&positions).is_err() {
            continue;
        }
        let (states, diagnostics) = (estimator.states(), estimator.diagnostics());
        for (i, trace) in axes.iter_mut().enumerate() {
            trace.state[n] = states[i];
            trace.innovation[n] = states[i].and(positions[i]).map(|_| diagnostics[i].innovation);
        }
        for (trace, value) in parameters.iter_mut().zip(estimator.parameters()) {
            trace.value[n] = value;
        }
        if columns.iter().any(|c| c.ramps.is_some()) {
            let (from, to) = f32_line(columns, n);
            estimator.apply_ramp(&from, &to);
        } else {
            estimator.apply(&columns.map(|c| c.input[n] as f32));
        }
    }
    for (trace, status) in parameters.iter_mut().zip(estimator.parameter_status()) {
        trace.status = status;
    }
    let counters = estimator.counters();
    Ok(Trace {
        axes,
        parameters,
        rejected_measurements: counters.rejected_measurements,
        rejected_inputs: counters.rejected_inputs,
    })
}

/// The input from sample `n` to the next, as the lines that it is or as what it is held at.
pub(super) fn f32_line<const N: usize>(columns: &[Column<'_>; N], n: usize) -> ([f32; N], [f32; N]) {
    let line = columns.map(|c| match c.ramps.and_then(|ramps| ramps.get(n)) {
        Some(&(from, to)) => (from as f32, to as f32),
        None => (c.input[n] as f32, c.input[n] as f32),
    });
    (line.map(|(from, _)| from), line.map(|(_, to)| to))
}
