//! The estimator's two calls a tick: [`Estimator::measure`] and [`Estimator::apply`].

use super::axis::{Axis, BlockPosition, Source};
use super::config::EstimatorConfig;
use super::design::EstimatorDesign;
use super::output::{AxisDiagnostics, AxisState, Counters, OutOfStep, StateStatus};
use super::shared::{IdentifierClock, ObserverClock};
use crate::error::ConfigError;
use crate::moments::InputMoments;
use crate::readout::{Parameter, ParameterState, ParameterStatus};

/// k of N axes (P parameters), their positions and velocities, from positions and known inputs alone.
///
/// Model (15): `y'' = k f + c` per axis, c known. At a measurement instant call [`measure`](Self::measure) with the
/// positions; compute the control; call [`apply`](Self::apply) with the input that is held until the next control instant.
/// A measurement instant comes every `substeps` control periods, the first with the first call of `measure`. Where
/// `measure` is not called at such an instant, or an axis gives `None`, the axis is predicted and not corrected.
///
/// Non-finite policy: a measurement or an input that is not finite, or larger than its limit, is rejected and counted; a
/// rejected measurement counts as missed, a rejected input is replaced by the axis's last good one.
/// What is not valid is not handed out: see [`parameters`](Self::parameters) and [`states`](Self::states).
/// No allocation, no panic, no transcendental, bounded work a call.
#[derive(Clone, Copy, Debug)]
pub struct Estimator<const N: usize, const P: usize> {
    design: EstimatorDesign<N, P>,
    observer: ObserverClock,
    identifier: IdentifierClock,
    axes: [Axis; N],
    parameters: [ParameterState; P],
    /// Control periods since the last measurement instant.
    substep: u32,
    started: bool,
    counters: Counters,
}

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// Validates `config` and starts empty.
    ///
    /// # Errors
    /// As [`EstimatorDesign::new`].
    pub fn new(config: &EstimatorConfig<N, P>) -> Result<Self, ConfigError> {
        Ok(Self::with_design(EstimatorDesign::new(config)?))
    }

    /// Starts empty on a design made before.
    pub fn with_design(design: EstimatorDesign<N, P>) -> Self {
        Self {
            observer: ObserverClock::START,
            identifier: IdentifierClock::start(design.turn),
            axes: [Axis::start(design.noise); N],
            parameters: [ParameterState::START; P],
            substep: 0,
            started: false,
            counters: Counters::default(),
            design,
        }
    }

    /// Forgets everything but the design and the counters.
    pub fn reset(&mut self) {
        *self = Self { counters: self.counters, ..Self::with_design(self.design) };
    }

    /// Starts the identification anew (section III of the paper: "each reinitialization"), the observer going on. Until
    /// the new k̂ is valid the observer predicts with the nominal parameter, if there is one.
    pub fn reset_identifier(&mut self) {
        self.identifier = IdentifierClock::start(self.design.turn);
        self.parameters = [ParameterState::START; P];
        for axis in &mut self.axes {
            axis.reset_identifier(self.design.noise);
            axis.seeded = false;
        }
    }

    /// The positions at the present measurement instant; `None` for an axis whose measurement is missing.
    ///
    /// # Errors
    /// [`OutOfStep`] where fewer than `substeps` inputs were applied since the last instant; nothing has changed then.
    pub fn measure(&mut self, positions: &[Option<f32>; N]) -> Result<(), OutOfStep> {
        if self.started {
            let missing = self.design.substeps.saturating_sub(self.substep);
            if missing > 0 {
                return Err(OutOfStep { missing });
            }
        }
        self.advance(positions);
        Ok(())
    }

    /// The inputs held over the control period that begins now. Before the first measurement nothing happens.
    pub fn apply(&mut self, inputs: &[f32; N]) {
        if !self.started {
            return;
        }
        if self.substep >= self.design.substeps {
            self.advance(&[None; N]);
        }
        let (dt, half_dt2) = (self.design.control_period, self.design.control_half_period2);
        for (axis, &input) in self.axes.iter_mut().zip(inputs) {
            // Written so that NaN fails it.
            if input.abs() <= self.design.input_limit {
                axis.input = input;
            } else {
                self.counters.rejected_inputs = self.counters.rejected_inputs.saturating_add(1);
            }
            axis.moments.hold(axis.input, dt, half_dt2);
        }
        self.substep += 1;
    }

    /// As [`apply`](Self::apply), for inputs that go linearly from `from` to `to` over the control period.
    pub fn apply_ramp(&mut self, from: &[f32; N], to: &[f32; N]) {
        if !self.started {
            return;
        }
        if self.substep >= self.design.substeps {
            self.advance(&[None; N]);
        }
        let (dt, half_dt2) = (self.design.control_period, self.design.control_half_period2);
        let limit = self.design.input_limit;
        for (axis, (&from, &to)) in self.axes.iter_mut().zip(from.iter().zip(to)) {
            if from.abs() <= limit && to.abs() <= limit {
                axis.moments.ramp(from, to, dt, half_dt2);
                axis.input = to;
            } else {
                self.counters.rejected_inputs = self.counters.rejected_inputs.saturating_add(1);
                axis.moments.hold(axis.input, dt, half_dt2);
            }
        }
        self.substep += 1;
    }

    fn advance(&mut self, positions: &[Option<f32>; N]) {
        let design = &self.design;
        if self.started {
            self.observer.step(design);
        }
        self.started = true;
        self.substep = 0;
        let clock = &mut self.identifier;
        let identifying = clock.delay == 0;
        if !identifying {
            clock.delay -= 1;
        }
        let length = design.block_length;
        let position = clock.position;
        if identifying {
            clock.age = clock.age.saturating_add(1);
            if position + 1 == length {
                clock.step(design);
                clock.position = 0;
            } else {
                clock.position = position + 1;
            }
        }
        let mut completed = [false; N];
        for (index, ((axis, &sample), done)) in
            self.axes.iter_mut().zip(positions).zip(completed.iter_mut()).enumerate()
        {
            let parameter_index = EstimatorDesign::<N, P>::parameter_of(index);
            let Some(parameter) = self.parameters.get_mut(parameter_index) else { continue };
            let nominal = design.nominal.get(parameter_index).copied().flatten();
            let accepted = sample.filter(|y| y.abs() <= design.position_limit);
            if accepted.is_none() {
                self.counters.missed = self.counters.missed.saturating_add(1);
                if sample.is_some() {
                    self.counters.rejected_measurements = self.counters.rejected_measurements.saturating_add(1);
                }
            }
            let moments = core::mem::replace(&mut axis.moments, InputMoments::ZERO);
            let by = axis.predict_with(index, parameter, nominal, design);
            let y = axis.observe(accepted, moments, &by, &self.observer, design);
            if identifying {
                let offset = design.offset(index);
                let local = if position >= offset { position - offset } else { position + length - offset };
                let at = BlockPosition { first: local == 0, last: local + 1 == length };
                if axis.identify(y, moments, at, design) {
                    axis.complete_block(index, clock, parameter, design);
                    *done = true;
                }
            }
        }
        self.read_parameters(&completed);
    }

    /// Quotients of the parameters that have new samples, and the seed of at most one observer.
    fn read_parameters(&mut self, completed: &[bool; N]) {
        let design = &self.design;
        let settled = self.identifier.age > design.parameter_settle;
        for (index, (parameter, rule)) in self.parameters.iter_mut().zip(&design.rule).enumerate() {
            let fresh =
                if P == 1 { completed.iter().any(|&c| c) } else { completed.get(index).copied().unwrap_or(false) };
            if fresh {
                parameter.read(settled, rule);
            }
        }
        for (index, (axis, &done)) in self.axes.iter_mut().zip(completed).enumerate() {
            let Some(parameter) = self.parameters.get(EstimatorDesign::<N, P>::parameter_of(index)) else { continue };
            match parameter.valid() {
                Some(known) if done && !axis.seeded => {
                    let y = axis.observer.measurement();
                    axis.seed(index, known.value, y, &self.identifier, &self.observer, design);
                    break;
                }
                Some(_) => {}
                None => axis.seeded = false,
            }
        }
    }

    /// The parameters that are valid.
    pub fn parameters(&self) -> [Option<Parameter>; P] {
        self.parameters.map(|p| p.valid())
    }

    /// Why a parameter is valid or not.
    pub fn parameter_status(&self) -> [ParameterStatus; P] {
        self.parameters.map(|p| p.status)
    }

    /// The states at the present control instant that may be used: predicted from the last measurement instant with what
    /// was applied since.
    pub fn states(&self) -> [Option<AxisState>; N] {
        core::array::from_fn(|index| match self.status_and_state(index) {
            Some((StateStatus::Identified | StateStatus::Nominal, state)) => Some(state),
            _ => None,
        })
    }

    /// Why a state may be used or not.
    pub fn state_status(&self) -> [StateStatus; N] {
        core::array::from_fn(|index| {
            self.status_and_state(index).map_or(StateStatus::NotMeasured, |(status, _)| status)
        })
    }

    fn status_and_state(&self, index: usize) -> Option<(StateStatus, AxisState)> {
        let axis = self.axes.get(index)?;
        let parameter_index = EstimatorDesign::<N, P>::parameter_of(index);
        let parameter = self.parameters.get(parameter_index)?;
        let nominal = self.design.nominal.get(parameter_index).copied().flatten();
        let by = axis.predict_with(index, parameter, nominal, &self.design);
        let settle = if axis.late && by.source != Source::Identified {
            self.design.late_settle.max(self.design.state_settle)
        } else {
            self.design.state_settle
        };
        let status = match by.source {
            _ if !axis.measured => StateStatus::NotMeasured,
            _ if axis.age < settle => StateStatus::Settling,
            Source::Identified => StateStatus::Identified,
            Source::Nominal if axis.age >= 1 => StateStatus::Nominal,
            Source::Nominal => StateStatus::Settling,
            Source::Provisional | Source::Nothing => StateStatus::NoParameter,
        };
        let t = self.substep as f32 * self.design.control_period;
        let velocity = axis.observer.velocity();
        let ahead = t * velocity + by.model.k * axis.moments.j2 + by.model.drift * (0.5 * t * t);
        let state = AxisState {
            position: axis.observer.position(ahead, &self.observer.gains),
            velocity: velocity + (by.model.k * axis.moments.j1 + by.model.drift * t),
        };
        Some((status, state))
    }

    /// Standard deviations of the states at the last measurement instant that measurement noise causes, where the noise
    /// level is known. The parameter's own uncertainty is not in them. Uses a square root: not for the tick.
    pub fn state_sd(&self) -> [Option<AxisState>; N] {
        self.axes.map(|axis| {
            // Means over M samples have an M-th of the variance.
            let variance = axis.noise.measurement_variance() * self.design.block_length as f32;
            let gain = &self.observer.noise_gain;
            axis.noise.is_known().then(|| AxisState {
                position: libm::sqrtf(variance * gain.position()),
                velocity: libm::sqrtf(variance * gain.velocity(&self.design.observer)),
            })
        })
    }

    /// The identifier's inner signals: for logs and tests, not for control.
    pub fn diagnostics(&self) -> [AxisDiagnostics; N] {
        core::array::from_fn(|index| {
            let axis = self.axes.get(index).copied().unwrap_or_default();
            let drift = self.design.drift.get(index).copied().unwrap_or(0.0);
            let ratio = self.parameters.get(EstimatorDesign::<N, P>::parameter_of(index)).map(|p| p.ratio);
            let zu = self.identifier.unit.zu();
            let scale = self.design.identifier.scale;
            AxisDiagnostics {
                z2: (axis.cascade.z2() - drift * zu) / scale,
                z0: axis.cascade.z0() / scale,
                zu: zu / scale,
                innovation: axis.observer.innovation(),
                noise_variance: axis.noise.variances(),
                numerator: ratio.map_or(0.0, |r| r.numerator()),
                denominator: ratio.map_or(0.0, |r| r.denominator()),
            }
        })
    }

    /// What has been missed or rejected.
    pub const fn counters(&self) -> Counters {
        self.counters
    }
}
