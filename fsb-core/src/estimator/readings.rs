//! What an estimator hands out.

use super::Estimator;
use super::axis::Source;
use super::output::{AxisDiagnostics, AxisState, Counters, IdentifierView, InnovationView, InputShift, StateStatus};
use super::parts::Frame;
use crate::moments::InputMoments;
use crate::observer::{Model, NoiseGain};
use crate::readout::{Parameter, ParameterStatus};

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// The parameters that are valid, or held through a re-initialisation.
    pub fn parameters(&self) -> [Option<Parameter>; P] {
        self.parameters.each_ref().map(|p| p.valid())
    }

    /// Why a parameter is valid or not.
    pub fn parameter_status(&self) -> [ParameterStatus; P] {
        self.parameters.each_ref().map(|p| p.status)
    }

    /// The states at the present control instant that may be used: predicted from the last measurement instant with what
    /// was applied since.
    pub fn states(&self) -> [Option<AxisState>; N] {
        let (gains, count) = (self.frame.progress.observer.gains, self.frame.progress.observer.count);
        let per_period = self.frame.common.observer.per_period;
        if self.frame.progress.substep == 0 {
            return self.frame.axes.each_ref().map(|axis| {
                (count >= axis.usable_at).then(|| AxisState {
                    position: axis.observer.corrected(&gains),
                    velocity: axis.observer.t_velocity() * per_period,
                })
            });
        }
        // Time since the last measurement instant over T.
        let t = self.frame.progress.substep as f32 * self.frame.common.substep_share;
        let half_t2 = 0.5 * t * t;
        self.frame.axes.each_ref().map(|axis| {
            (count >= axis.usable_at).then(|| {
                let (w, model, input) = (axis.observer.t_velocity(), &axis.model, &axis.moments);
                AxisState {
                    position: axis.observer.position(t * w + model.k_t2 * input.j2 + model.c_t2 * half_t2, &gains),
                    velocity: (w + model.k_t2 * input.j1 + model.c_t2 * t) * per_period,
                }
            })
        })
    }

    /// Velocities as of [`states`](Self::states), as soon as two measurements have told them, whether they may be used or not.
    pub(crate) fn velocities(&self) -> Option<[f32; N]> {
        let Frame { common, progress, axes } = &self.frame;
        let count = progress.observer.count;
        if !axes.iter().all(|axis| axis.measured && count > u32::from(axis.gap)) {
            return None;
        }
        let t = progress.substep as f32 * common.substep_share;
        Some(axes.each_ref().map(|axis| {
            let (w, model) = (axis.observer.t_velocity(), &axis.model);
            let ahead = if progress.substep == 0 { 0.0 } else { model.k_t2 * axis.moments.j1 + model.c_t2 * t };
            (w + ahead) * common.observer.per_period
        }))
    }

    /// The parameters that the states are predicted with: identified, else held, else nominal.
    pub fn prediction_parameters(&self) -> [Option<f32>; P] {
        self.parameters.each_ref().map(|p| p.valid().map(|k| k.value).or(p.nominal))
    }

    /// Whether a measurement is due: the next call may be one of [`measure`](Self::measure).
    pub const fn is_due(&self) -> bool {
        !self.frame.progress.started || self.frame.progress.substep >= self.frame.common.substeps
    }

    /// [`states`](Self::states), so many control `periods` later, `ahead` being the moments of the inputs until then summed
    /// up in control periods: y + v t + k J2 + c t²/2 and v + k J1 + c t.
    pub(crate) fn states_after(&self, ahead: &[InputMoments; N], periods: u32) -> [Option<AxisState>; N] {
        let common = &self.frame.common;
        let (share, per_period) = (common.substep_share, common.observer.per_period);
        let share2 = share * share;
        let t = periods as f32 * share;
        let mut states = self.states();
        for ((state, axis), input) in states.iter_mut().zip(&self.frame.axes).zip(ahead) {
            if let Some(state) = state {
                let Model { k_t2, c_t2 } = axis.model;
                state.position +=
                    t * (state.velocity * common.observer.period) + (k_t2 * share2 * input.j2 + c_t2 * (0.5 * t * t));
                state.velocity += (k_t2 * share * input.j1 + c_t2 * t) * per_period;
            }
        }
        states
    }

    /// The observer's last step.
    pub(crate) fn innovation_view(&self) -> InnovationView<N> {
        let Frame { common, progress, axes } = &self.frame;
        let gains = &progress.observer.gains;
        InnovationView {
            innovations: axes.each_ref().map(|axis| axis.observer.innovation()),
            moments: axes.each_ref().map(|axis| axis.moments),
            // Means over M samples have an M-th of the variance.
            noise_variances: axes.each_ref().map(|axis| {
                axis.noise.is_known().then(|| axis.noise.measurement_variance() * common.block_length as f32)
            }),
            measured: progress.all_measured,
            m1: gains.m1(),
            t_l2: gains.t_l2(),
        }
    }

    /// Blocks that the identifier has gone through in its window.
    pub(crate) const fn identifier_blocks(&self) -> u32 {
        self.frame.progress.identifier.blocks
    }

    /// Whether all axes have taken the step of [`identifier_blocks`](Self::identifier_blocks): where blocks are of several samples each ends its own
    /// a sample after the one before, and the unit chain is a step ahead of those whose block has not ended.
    pub(crate) fn identifier_rests(&self) -> bool {
        let Frame { common, progress, .. } = &self.frame;
        let last = (N as u32).min(common.block_length).saturating_sub(1);
        let between = last..=u32::from(common.schedule.weights_at);
        common.block_length == 1 || between.contains(&progress.identifier.position)
    }

    /// The identifier's last step.
    pub(crate) fn identifier_view(&self) -> IdentifierView<N> {
        let Frame { common, progress, axes } = &self.frame;
        let clock = &progress.identifier;
        IdentifierView {
            blocks: clock.blocks,
            weight: clock.at.g,
            c: common.identifier.c,
            per_length: common.block.per_length,
            forgetting: common.forgetting,
            z0: axes.each_ref().map(|axis| axis.cascade.z0()),
            z2: axes.each_ref().map(|axis| axis.cascade.z2() - axis.own.drift * clock.unit.zu()),
            variances: axes.each_ref().map(|axis| axis.variance(clock, common)),
            // The window is zero in the first two steps; a block of predictions says nothing.
            counts: axes
                .each_ref()
                .map(|axis| axis.present && clock.blocks > 2 && u32::from(axis.gap) < common.block_length),
            denominators: core::array::from_fn(|index| {
                self.parameters.get(if P == 1 { 0 } else { index }).map_or(0.0, |p| p.ratio.denominator())
            }),
        }
    }

    /// Adds to an axis's input cascade (x4, x5, x6), and to the denominator of its parameter: what the input turns out to have
    /// been beyond what was applied.
    pub(crate) fn shift_input(&mut self, axis: usize, shift: &InputShift) {
        let parameter = if P == 1 { 0 } else { axis };
        if let (Some(axis), Some(parameter)) = (self.frame.axes.get_mut(axis), self.parameters.get_mut(parameter)) {
            let [x4, x5, x6] = shift.cascade;
            axis.cascade.x4.add(x4);
            axis.cascade.x5.add(x5);
            axis.cascade.x6.add(x6);
            parameter.ratio.shift_denominator(shift.denominator);
            parameter.set_doubt(shift.doubt);
            axis.tolerance = shift.tolerance;
        }
    }

    /// The newest quotient of each parameter, valid or not, where it can be right: in range, and known to four times
    /// the standard deviation at which it becomes valid.
    pub(crate) fn rough_parameters(&self) -> [Option<Parameter>; P] {
        self.parameters.each_ref().map(|p| p.rough())
    }

    /// Why a state may be used or not.
    pub fn state_status(&self) -> [StateStatus; N] {
        self.frame.axes.each_ref().map(|axis| match axis.source {
            _ if !axis.measured => StateStatus::NotMeasured,
            _ if self.frame.progress.observer.count < axis.settled_at => StateStatus::Settling,
            Source::Identified => StateStatus::Identified,
            Source::Nominal => StateStatus::Nominal,
            Source::Held => StateStatus::Held,
            Source::Provisional | Source::Nothing => StateStatus::NoParameter,
        })
    }

    /// Standard deviations of the states at the last measurement instant, where the noise level is known: what measurement noise
    /// causes, and what the identifier's residuals show beyond it or `disturbance_sd` expects, as position noise that wanders would.
    /// The parameter's own uncertainty is not in them, nor is how far off measurements are that wander together.
    ///
    /// Where some of the first measurements were missed, on any axis, and others came after them there is none until those that came
    /// make up 8/λ of the observer: what the start leaves in the state depends on which of them came. For white noise otherwise good
    /// to a few per cent, and to 15 % with up to seven of ten missing at random. Velocities in noise that wanders or in gusts are
    /// within a factor of 2 of it in the end, and farther off in the first 4/λ of the identifier. For reports, not for the tick.
    pub fn state_sd(&self) -> [Option<AxisState>; N] {
        let Frame { common, progress, axes } = &self.frame;
        let (tuning, period, clock) = (common.observer_tuning, common.measurement_period, &progress.observer);
        let at_present = NoiseGain::at_sample(clock.count, tuning, period);
        let share = common.wander_at_observer(progress.identifier.blocks);
        let expected =
            if progress.identifier.is_shaped(common) { common.expected_misfit(&progress.identifier) } else { 0.0 };
        axes.each_ref().map(|axis| {
            // Nothing has been averaged since the last measurement.
            let gain = match u32::from(axis.gap) {
                0 => at_present,
                gap => NoiseGain::at_sample(clock.count.saturating_sub(gap), tuning, period),
            };
            // Means over M samples have an M-th of the variance.
            let variance = axis.noise.variance_beside(share, expected) * common.block_length as f32;
            let forgotten = clock.early == 0 || clock.came(axis.gap) >= common.late_settle;
            (axis.noise.is_known() && axis.measured && forgotten).then(|| AxisState {
                position: libm::sqrtf(variance * gain.position_after(axis.gap)),
                velocity: libm::sqrtf(variance * gain.velocity(&common.observer)),
            })
        })
    }

    /// The identifier's inner signals: for logs and tests, not for control.
    pub fn diagnostics(&self) -> [AxisDiagnostics; N] {
        core::array::from_fn(|index| {
            let axis = self.frame.axes.get(index).copied().unwrap_or_default();
            let drift = axis.own.drift;
            let ratio = self.parameters.get(if P == 1 { 0 } else { index }).map(|p| p.ratio);
            let zu = self.frame.progress.identifier.unit.zu();
            let scale = self.frame.common.identifier.scale;
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
        self.frame.progress.counters
    }
}
