//! What the next measurement should be, for a gate in front.

use super::Estimator;
use super::anew::Known;
use super::output::OutOfStep;
use crate::readout::ParameterStatus;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// Whether a measurement may be given now.
    ///
    /// # Errors
    /// As [`measure`](Self::measure).
    pub fn in_step(&self) -> Result<(), OutOfStep> {
        let progress = &self.frame.progress;
        if !self.is_due() {
            return Err(OutOfStep { missing: self.frame.common.substeps - progress.substep });
        }
        Ok(())
    }

    /// Whether every axis has been measured at one instant.
    pub const fn has_started(&self) -> bool {
        self.frame.progress.started
    }

    /// The measurements to be expected at the present measurement instant (m or rad); `None` for an axis that has not been
    /// measured yet. Cost: 8 operations an axis.
    pub fn expected(&self) -> [Option<f32>; N] {
        let m1 = self.frame.progress.observer.gains.m1();
        self.frame
            .axes
            .each_ref()
            .map(|axis| axis.measured.then(|| axis.observer.predict(axis.moments, &axis.model, m1)))
    }

    /// Whether every number that is handed out or carried on is one. Only a memory changed from outside makes it false: what
    /// comes in is checked.
    pub(crate) fn is_sane(&self) -> bool {
        let most = 8.0 * self.frame.common.position_limit;
        self.frame.axes.iter().all(|axis| axis.observer.is_within(most))
            && self.parameters.iter().all(|parameter| parameter.status != ParameterStatus::Faulted)
    }

    /// What the measurements were off from what was expected; zero where it was missed. For a state that has been put elsewhere
    /// since, what it would have been from there.
    pub(crate) fn innovations(&self) -> [f32; N] {
        self.frame.axes.each_ref().map(|axis| axis.observer.innovation())
    }

    /// Moves the origins of the axes by `by` (m or rad): measurements are larger by that from now on. Velocities and the
    /// identification do not notice, as the plant is translation invariant. An axis that would come to lie beyond twice the
    /// limit of its measurements stays where it is.
    pub fn translate(&mut self, by: &[f32; N]) {
        let most = 2.0 * self.frame.common.position_limit;
        for (axis, &by) in self.frame.axes.iter_mut().zip(by) {
            if (axis.observer.measurement() + by).abs() <= most {
                axis.observer.translate(by);
                axis.origin += by;
            }
        }
    }

    /// The axes move by so much more in a measurement period (m or rad) from now on, which no input explains: the identifier's
    /// window begins anew. One that would come to move by more than twice the limit of its measurements goes on as it did.
    pub(crate) fn push(&mut self, by: &[f32; N]) {
        let most = 2.0 * self.frame.common.position_limit;
        for (axis, &by) in self.frame.axes.iter_mut().zip(by) {
            if (axis.observer.t_velocity() + by).abs() <= most {
                axis.observer.push(by);
            }
        }
        self.parts().begin_window(Known::Doubted);
    }

    /// R: control periods to a measurement period.
    pub const fn substeps(&self) -> u32 {
        self.frame.common.substeps
    }

    /// The limit of a measurement's magnitude.
    pub(crate) const fn position_limit(&self) -> f32 {
        self.frame.common.position_limit
    }

    /// The limit of an input's magnitude.
    pub(crate) const fn input_limit(&self) -> f32 {
        self.frame.common.input_limit
    }

    /// The variance of an innovation's step for measurement noise of the variance `noise`.
    pub(crate) fn innovation_step_variance(&self, noise: f32) -> f32 {
        noise / (self.frame.common.innovation_to_mean * self.frame.common.block_length as f32)
    }
}
