//! An estimator without its shape: the code behind it is there once for all numbers of axes.

use super::axis::{Axis, Source};
use super::design::Common;
use super::output::Learning;
use super::shared::Progress;
use crate::observer::Model;
use crate::readout::ParameterState;

/// The axes and what they share. Without its shape it is this with a slice in place of the array: two words to hand over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<A: ?Sized> {
    pub common: Common,
    pub progress: Progress,
    pub axes: A,
}

impl<const N: usize> Frame<[Axis; N]> {
    /// Before it is configured: takes nothing in, and hands nothing out.
    #[inline(never)]
    pub fn blank() -> Self {
        let axis = Axis { usable_at: u32::MAX, ..Axis::default() };
        Self { progress: Progress::start(&Common::BLANK), axes: [axis; N], common: Common::BLANK }
    }
}

/// Borrowed from an estimator.
pub(super) struct Parts<'a> {
    pub frame: &'a mut Frame<[Axis]>,
    pub parameters: &'a mut [ParameterState],
}

/// The parameter that `axis` shares in.
#[inline(always)]
pub(super) fn parameter_of(axis: usize, parameters: &[ParameterState]) -> usize {
    if parameters.len() == 1 { 0 } else { axis }
}

/// An axis before its first measurement; what its parameter holds, or else its nominal value, predicts.
#[inline(never)]
fn start_axis(axis: &mut Axis, common: &Common, parameter: Option<&ParameterState>, contact: bool) {
    *axis = Axis::start(common.noise, axis.own, None, common.period2);
    if let Some(parameter) = parameter {
        let held = parameter.held_value();
        if let Some(k) = held.or(parameter.nominal) {
            axis.source = if held.is_some() { Source::Held } else { Source::Nominal };
            // In contact nothing that a parameter says counts.
            if !contact {
                axis.model = Model { k_t2: k * common.period2, c_t2: axis.own.drift_t2 };
            }
        }
    }
}

impl Parts<'_> {
    /// Every axis as it is before its first measurement.
    #[inline(never)]
    pub fn start_axes(&mut self) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let contact = progress.learning == Learning::Contact;
        let last = self.parameters.len().saturating_sub(1);
        for (index, axis) in axes.iter_mut().enumerate() {
            start_axis(axis, common, self.parameters.get(index.min(last)), contact);
        }
    }
}
