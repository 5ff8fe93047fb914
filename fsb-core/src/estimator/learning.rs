//! Learning only when told: on the ground thrust moves nothing, and what is learned there is wrong.

use super::Estimator;
use super::anew::Known;
use super::axis::{Axis, Clocks};
use super::design::Common;
use super::output::Learning;
use super::parts::{Frame, Parts, parameter_of};
use super::shared::Pace;
use crate::observer::Model;
use crate::readout::ParameterState;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// Whether to learn from now on. When learning resumes the identification begins anew, the parameters known so far being
    /// held until the new ones are valid: a window that spans a contact would remember it. The observer goes on throughout.
    pub fn set_learning(&mut self, learning: Learning) {
        let before = self.frame.progress.learning;
        if learning != before {
            self.parts().set_learning(learning);
        }
    }

    /// Whether it learns.
    pub const fn learning(&self) -> Learning {
        self.frame.progress.learning
    }
}

impl Parts<'_> {
    #[inline(never)]
    fn set_learning(&mut self, learning: Learning) {
        let progress = &mut self.frame.progress;
        progress.learning = learning;
        progress.pace = Pace::Careful;
        match learning {
            Learning::On => self.begin_window(Known::Held),
            Learning::Off => self.predict_with_parameters(),
            Learning::Contact => self.heed_contact(),
        }
    }

    /// In contact nothing that a parameter says counts, whoever has just set the models.
    pub fn heed_contact(&mut self) {
        if self.frame.progress.learning == Learning::Contact {
            for axis in &mut self.frame.axes {
                axis.model = Model::default();
            }
        }
    }

    /// Back from constant velocity.
    fn predict_with_parameters(&mut self) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let clocks = Clocks { identifier: &progress.identifier, observer: &progress.observer };
        for (index, axis) in axes.iter_mut().enumerate() {
            if let Some(parameter) = self.parameters.get(parameter_of(index, self.parameters)) {
                axis.predict_with(parameter, clocks, common);
            }
        }
    }
}

impl Axis {
    /// What the axis's source says, the observer staying where it is.
    fn predict_with(&mut self, parameter: &ParameterState, clocks: Clocks<'_>, common: &Common) {
        let present = core::mem::replace(&mut self.present, false);
        self.change_source(parameter, clocks, common);
        self.present = present;
    }
}
