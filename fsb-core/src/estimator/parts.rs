//! An estimator without its shape: the code behind it is there once for all numbers of axes.

use super::axis::{Axis, Clocks, Own};
use super::design::{AxisDesign, Common, ParameterDesign};
use super::shared::{IdentifierClock, Progress};
use crate::readout::ParameterState;

/// Borrowed from an estimator.
pub(super) struct Parts<'a> {
    pub common: &'a Common,
    pub each: Each<'a>,
    pub progress: &'a mut Progress,
    pub axes: &'a mut [Axis],
    pub parameters: &'a mut [ParameterState],
}

/// What differs from axis to axis, and from parameter to parameter.
#[derive(Clone, Copy)]
pub(super) struct Each<'a> {
    pub axes: &'a [AxisDesign],
    pub parameters: &'a [ParameterDesign],
}

impl<'a> Each<'a> {
    /// The parameter that `axis` shares in.
    #[inline(always)]
    pub fn parameter_of(&self, axis: usize) -> usize {
        if self.parameters.len() == 1 { 0 } else { axis }
    }

    /// What an axis needs.
    #[inline(always)]
    pub fn own(&self, axis: usize) -> Option<Own<'a>> {
        let AxisDesign { drift, drift_t2 } = *self.axes.get(axis)?;
        let ParameterDesign { nominal, rule } = self.parameters.get(self.parameter_of(axis))?;
        Some(Own { drift, drift_t2, nominal: *nominal, rule })
    }
}

impl Parts<'_> {
    /// See [`super::Estimator::reset_identifier`].
    pub fn reset_identifier(&mut self) {
        let progress = &mut *self.progress;
        let next = if progress.started { progress.observer.count.saturating_add(1) } else { 0 };
        progress.identifier = IdentifierClock::start(next.saturating_add(self.common.schedule.turn));
        progress.steady = false;
        let pooled = self.parameters.len() == 1;
        let measured = self.axes.iter().filter(|axis| axis.measured).count();
        let members = if pooled { measured as u8 } else { 1 };
        for parameter in self.parameters.iter_mut() {
            *parameter = ParameterState::start(members);
        }
        let clocks = Clocks { identifier: &progress.identifier, observer: &progress.observer };
        for (index, axis) in self.axes.iter_mut().enumerate() {
            axis.reset_identifier(self.common.noise);
            if let Some(own) = self.each.own(index) {
                axis.change_source(&ParameterState::start(0), &own, clocks, self.common);
            }
        }
    }
}
