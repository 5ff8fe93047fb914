//! An estimator behind the gates.

use super::config::{GuardConfig, GuardDesign};
use super::gate::Gate;
use super::verdict::{Rejections, Verdict};
use crate::error::ConfigError;
use crate::estimator::{AxisState, Estimator, EstimatorConfig, InputShift, Learning, OutOfStep, StateStatus};
use crate::moments::InputMoments;
use core::ops::Deref;

/// Where the state of an axis is put.
#[derive(Clone, Copy, Default)]
struct Shift {
    /// By so much the origin moves (m or rad).
    origin: f32,
    /// By so much more the axis moves in a measurement period (m or rad).
    motion: f32,
}

/// An [`Estimator`] that is shown only what can be true, and that says when its states are stale. What is not here is read
/// from the estimator, by `Deref`.
///
/// Non-finite policy: rejected and counted, see [`Verdict`]. Cost of the gate: about 35 operations an axis and measurement.
#[derive(Clone, Copy, Debug)]
pub struct Guarded<const N: usize, const P: usize> {
    pub(super) estimator: Estimator<N, P>,
    pub(super) design: GuardDesign,
    pub(super) expecting: Gate,
    pub(super) gates: [Gate; N],
    pub(super) verdicts: [Verdict; N],
    pub(super) rejections: Rejections,
    /// Some axis has been stale since the identification began.
    pub(super) interrupted: bool,
    /// Measurement instants since the start; saturates.
    pub(super) instants: u8,
    /// The last input, for periods that were missed.
    pub(super) last: [InputMoments; N],
    pub(super) measurement_period: f32,
}

impl<const N: usize, const P: usize> Guarded<N, P> {
    /// Measurement instants before innovations are judged: the dead-beat start makes the first ones large.
    const FIRST: u8 = 6;

    /// Validates both.
    ///
    /// # Errors
    /// As [`EstimatorDesign::new`](crate::EstimatorDesign::new) and [`GuardDesign::new`].
    pub fn new(config: &EstimatorConfig<N, P>, guard: &GuardConfig) -> Result<Self, ConfigError> {
        let estimator = Estimator::new(config)?;
        let period = config.period * f64::from(config.substeps);
        let design = GuardDesign::new(guard, config.observer, period)?;
        let expecting = Gate::expecting(config.noise_sd.map(|sd| estimator.innovation_step_variance((sd * sd) as f32)));
        Ok(Self {
            estimator,
            design,
            expecting,
            gates: [expecting; N],
            verdicts: [Verdict::Missing; N],
            rejections: Rejections::default(),
            interrupted: false,
            instants: 0,
            last: [InputMoments::ZERO; N],
            measurement_period: period as f32,
        })
    }

    /// As [`Estimator::measure`]; returns what became of each measurement.
    ///
    /// # Errors
    /// As [`Estimator::measure`].
    pub fn measure(&mut self, positions: &[Option<f32>; N]) -> Result<[Verdict; N], OutOfStep> {
        self.estimator.in_step()?;
        if !self.estimator.is_sane() {
            self.reset();
            self.rejections.count_fault();
        }
        let expected = self.estimator.expected();
        let limit = self.estimator.position_limit();
        let settled = self.instants >= Self::FIRST;
        let mut given = [f32::NAN; N];
        let mut moved = [Shift::default(); N];
        let each = self.gates.iter_mut().zip(&mut self.verdicts).zip(&expected).zip(&mut moved);
        for ((((gate, verdict), expected), moved), (position, given)) in each.zip(positions.iter().zip(&mut given)) {
            *verdict = match *position {
                Some(y) => gate.judge(y, *expected, limit, settled, &self.design),
                None => {
                    gate.miss();
                    Verdict::Missing
                }
            };
            self.rejections.count(*verdict);
            if verdict.is_used() {
                *given = position.unwrap_or(f32::NAN);
            }
            match *verdict {
                Verdict::Jumped(by) => moved.origin = by,
                // So that what is expected with the new velocity is what is measured.
                Verdict::Pushed(by) => {
                    moved.motion = by * self.measurement_period;
                    moved.origin = *given - expected.unwrap_or(*given) - moved.motion;
                }
                _ => {}
            }
        }
        let pushed = self.verdicts.iter().any(|v| matches!(v, Verdict::Pushed(_)));
        if pushed || self.verdicts.iter().any(|v| matches!(v, Verdict::Jumped(_))) {
            self.estimator.translate(&moved.map(|by| by.origin));
        }
        if pushed {
            self.estimator.push(&moved.map(|by| by.motion));
        }
        self.estimator.measure_raw(&given)?;
        for (gate, innovation) in self.gates.iter_mut().zip(self.estimator.innovations()) {
            gate.follow(innovation, &self.design);
        }
        if self.instants < Self::FIRST && self.estimator.has_started() {
            self.instants += 1;
        }
        self.bridge();
        Ok(self.verdicts)
    }

    /// Restarts what a gap was too long for.
    fn bridge(&mut self) {
        let stale = self.gates.iter().filter(|gate| gate.gap() > self.design.bridge).count();
        if stale == N && self.estimator.has_started() {
            self.estimator.restart();
            for gate in &mut self.gates {
                gate.restart();
            }
            self.interrupted = false;
            self.instants = 0;
        } else if stale > 0 {
            self.interrupted = true;
        } else if self.interrupted && self.gates.iter().all(|gate| gate.gap() == 0) {
            self.interrupted = false;
            self.estimator.reinitialise_identifier();
        }
    }

    /// As [`Estimator::apply`].
    pub fn apply(&mut self, inputs: &[f32; N]) {
        self.count_late();
        self.remember(&inputs.map(|f| InputMoments { j1: f, j2: 0.5 * f }));
        self.estimator.apply(inputs);
    }

    /// As [`Estimator::apply_ramp`].
    pub fn apply_ramp(&mut self, from: &[f32; N], to: &[f32; N]) {
        self.count_late();
        self.remember(&to.map(|f| InputMoments { j1: f, j2: 0.5 * f }));
        self.estimator.apply_ramp(from, to);
    }

    /// As [`Estimator::apply_moments`].
    pub fn apply_moments(&mut self, moments: &[InputMoments; N]) {
        self.count_late();
        self.remember(moments);
        self.estimator.apply_moments(moments);
    }

    /// The control loop has been late by so many control periods, in which the actuators held their input and nothing was
    /// measured. Gaps longer than the configured bridge restart the windows. Cost: that of as many calls of `apply`, at most
    /// those of twice the bridge.
    pub fn missed(&mut self, periods: u32) {
        for _ in 0..periods.min(self.longest()) {
            let last = self.last;
            self.apply_moments(&last);
        }
    }

    /// Control periods without a measurement after which nothing is known any more.
    pub(crate) fn longest(&self) -> u32 {
        (2 * u32::from(self.design.bridge)).saturating_mul(self.estimator.substeps())
    }

    /// As [`Estimator::states_after`], but for axes that are stale.
    pub(crate) fn states_after(&self, ahead: &[InputMoments; N], periods: u32) -> [Option<AxisState>; N] {
        self.fresh(self.estimator.states_after(ahead, periods))
    }

    /// As [`Estimator::translate`].
    pub(crate) fn translate(&mut self, by: &[f32; N]) {
        self.estimator.translate(by);
    }

    pub(crate) fn shift_input(&mut self, axis: usize, shift: &InputShift) {
        self.estimator.shift_input(axis, shift);
    }

    fn fresh(&self, mut states: [Option<AxisState>; N]) -> [Option<AxisState>; N] {
        let most = 8.0 * self.estimator.position_limit();
        for (state, gate) in states.iter_mut().zip(&self.gates) {
            // What is out of all bounds, or no number, is a fault that the next measurement will find.
            let sane = state.is_some_and(|s| s.position.abs() <= most && s.velocity.is_finite());
            if gate.gap() > self.design.bridge || !sane {
                *state = None;
            }
        }
        states
    }

    #[cfg(test)]
    pub(crate) fn corrupt(&mut self, how: fn(&mut Estimator<N, P>)) {
        how(&mut self.estimator);
    }

    fn remember(&mut self, moments: &[InputMoments; N]) {
        let limit = self.estimator.input_limit();
        for (last, given) in self.last.iter_mut().zip(moments) {
            if given.j1.abs() <= limit && given.j2.abs() <= limit {
                *last = *given;
            }
        }
    }

    /// An input that goes past a measurement instant at which nothing came.
    fn count_late(&mut self) {
        if self.estimator.has_started() && self.estimator.is_due() {
            let _ = self.measure(&[None; N]);
        }
    }

    /// The states that may be used: as [`Estimator::states`], but for an axis that is stale.
    pub fn states(&self) -> [Option<AxisState>; N] {
        self.fresh(self.estimator.states())
    }

    /// As [`Estimator::state_status`].
    pub fn state_status(&self) -> [StateStatus; N] {
        let mut statuses = self.estimator.state_status();
        for (status, gate) in statuses.iter_mut().zip(&self.gates) {
            if gate.gap() > self.design.bridge {
                *status = StateStatus::Stale;
            }
        }
        statuses
    }

    /// Time since the last measurement of each axis that was used (s), up to the last measurement instant.
    pub fn staleness(&self) -> [f32; N] {
        self.gates.each_ref().map(|gate| f32::from(gate.gap()) * self.measurement_period)
    }

    /// As [`Estimator::set_learning`].
    pub fn set_learning(&mut self, learning: Learning) {
        self.estimator.set_learning(learning);
    }

    /// As [`Estimator::restart`]; what was learned of the noise stays.
    pub fn restart(&mut self) {
        self.estimator.restart();
        for gate in &mut self.gates {
            gate.restart();
        }
        self.instants = 0;
        self.interrupted = false;
    }

    /// As [`Estimator::reset`]; what was learned of the noise goes as well. A sensor that has frozen is still frozen.
    pub fn reset(&mut self) {
        self.estimator.reset();
        for gate in &mut self.gates {
            *gate = self.expecting.of_sensor(gate);
        }
        self.verdicts = [Verdict::Missing; N];
        self.last = [InputMoments::ZERO; N];
        self.instants = 0;
        self.interrupted = false;
    }

    /// As [`Estimator::reopen_window`].
    pub(crate) fn reopen_window(&mut self) {
        self.estimator.reopen_window();
    }

    /// As [`Estimator::reinitialise_identifier`].
    pub fn reinitialise_identifier(&mut self) {
        self.estimator.reinitialise_identifier();
    }

    /// As [`Estimator::suspect_disturbance`].
    pub(crate) fn suspect_disturbance(&mut self) {
        self.estimator.suspect_disturbance();
    }

    /// As [`Estimator::reset_identifier`].
    pub fn reset_identifier(&mut self) {
        self.estimator.reset_identifier();
    }

    /// What became of the measurements at the last instant.
    pub const fn verdicts(&self) -> [Verdict; N] {
        self.verdicts
    }

    /// What was not used, and why.
    pub const fn rejections(&self) -> Rejections {
        self.rejections
    }
}

impl<const N: usize, const P: usize> Deref for Guarded<N, P> {
    type Target = Estimator<N, P>;

    fn deref(&self) -> &Estimator<N, P> {
        &self.estimator
    }
}
