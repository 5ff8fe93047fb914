//! The identification begun anew, and what becomes of what is known.

use super::axis::{Axis, Clocks, Marks};
use super::design::Common;
use super::parts::{Frame, Parts, parameter_of};
use super::shared::{IdentifierClock, Pace};
use crate::readout::{NoiseLevel, ParameterState};

/// What becomes of what is known when the identifier's window begins anew.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Known {
    /// It is forgotten.
    Forgotten,
    /// Parameters that are valid are held until the new ones are.
    Held,
    /// The same where a parameter is valid or contradicted: it may have changed. What is being learned goes on being learned.
    Doubted,
    /// It stays: k is the same in all windows, and their sums add up.
    Kept,
}

impl Parts<'_> {
    /// The identifier's window begins anew with the next measurement.
    #[inline(never)]
    pub fn begin_window(&mut self, known: Known) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let next = if progress.started { progress.observer.count.saturating_add(1) } else { 0 };
        progress.identifier = IdentifierClock::start(next.saturating_add(common.schedule.turn));
        progress.pace = Pace::Careful;
        let measured = axes.iter().filter(|axis| axis.measured).count();
        let members = if self.parameters.len() == 1 { measured as u8 } else { 1 };
        for parameter in self.parameters.iter_mut() {
            match known {
                Known::Forgotten => parameter.restart(members),
                Known::Doubted if parameter.is_being_learned() => parameter.reopen(members),
                Known::Held | Known::Doubted => parameter.hold(members),
                Known::Kept => parameter.reopen(members),
            }
        }
        let clocks = Clocks { identifier: &progress.identifier, observer: &progress.observer };
        for (index, axis) in axes.iter_mut().enumerate() {
            let Some(parameter) = self.parameters.get(parameter_of(index, self.parameters)) else { continue };
            axis.begin_window(parameter, known, common);
            axis.change_source(parameter, clocks, common);
        }
        self.heed_contact();
    }
}

impl Axis {
    /// Forgets what the cascade holds, and with a parameter that has been forgotten what goes into its variance. Takes part
    /// again from the first block of the new window on.
    fn begin_window(&mut self, parameter: &ParameterState, known: Known, common: &Common) {
        if parameter.is_new() {
            (self.origin, self.noise_sum) = Default::default();
            // What noise there is from sample to sample is known; what the old parameter left over is none.
            self.noise = if known != Known::Forgotten && self.noise.is_known() {
                NoiseLevel::expected(self.noise.measurement_variance())
            } else {
                common.noise
            };
        }
        self.noise.forget_gaps();
        (self.cascade, self.cross, self.block) = Default::default();
        (self.present, self.missed) = (false, 0);
        for mark in [Marks::BEGUN, Marks::OWES] {
            self.marks.set(mark, false);
        }
    }
}
