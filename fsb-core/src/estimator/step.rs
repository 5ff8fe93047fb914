//! The estimator's two calls a tick: [`Estimator::measure`] and [`Estimator::apply`].

use super::Estimator;
use super::axis::Axis;
use super::design::Common;
use super::output::OutOfStep;
use super::parts::{Frame, Parts};
use super::shared::{Pace, Progress};
use crate::moments::InputMoments;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// The positions at the present measurement instant; `None` for an axis whose measurement is missing.
    ///
    /// The estimator starts at the first instant at which every axis is measured; what comes before only counts.
    ///
    /// # Errors
    /// [`OutOfStep`] where fewer than `substeps` inputs were applied since the last instant; nothing has changed then.
    pub fn measure(&mut self, positions: &[Option<f32>; N]) -> Result<(), OutOfStep> {
        // A number that is none is a rejected measurement, not a missing one.
        self.measure_raw(&positions.map(|y| match y {
            Some(y) if y.is_nan() => f32::INFINITY,
            Some(y) => y,
            None => f32::NAN,
        }))
    }

    /// As [`measure`](Self::measure), a missing measurement being NaN.
    ///
    /// # Errors
    /// As [`measure`](Self::measure).
    pub fn measure_raw(&mut self, positions: &[f32; N]) -> Result<(), OutOfStep> {
        let due = self.frame.progress.substep >= self.frame.common.substeps;
        let pace = self.frame.progress.pace;
        let in_block = matches!(pace, Pace::Steady | Pace::Hurried);
        if due && in_block && all_within(positions, self.frame.common.position_limit) {
            self.advance_steadily(positions, pace);
            return Ok(());
        }
        if self.frame.progress.started && !due {
            return Err(OutOfStep { missing: self.frame.common.substeps - self.frame.progress.substep });
        }
        let mut positions = *positions;
        if pace == Pace::Singles {
            self.parts().advance_singles(&mut positions);
        } else {
            self.parts().advance(&mut positions);
        }
        Ok(())
    }

    /// The inputs held over the control period that begins now. Before the first measurement nothing happens.
    pub fn apply(&mut self, inputs: &[f32; N]) {
        let limit = self.frame.common.input_limit;
        let Frame { common, progress, axes } = &mut self.frame;
        if progress.substep < common.substeps && progress.started && all_within(inputs, limit) {
            hold(common, progress, axes, inputs);
        } else {
            let mut inputs = *inputs;
            self.parts().apply_carefully(&mut inputs, &mut [f32::NAN; N]);
        }
    }

    /// As [`apply`](Self::apply), for inputs that go linearly from `from` to `to` over the control period.
    pub fn apply_ramp(&mut self, from: &[f32; N], to: &[f32; N]) {
        let (mut from, mut to) = (*from, *to);
        self.parts().apply_ramp(&mut from, &mut to, &mut [f32::NAN; N]);
    }

    /// As [`apply`](Self::apply), for inputs of any course over the control period: their moments over it, the control
    /// period being the unit of time. Moments that no input within the limit can have are rejected as such an input is.
    pub fn apply_moments(&mut self, moments: &[InputMoments; N]) {
        let limit = self.frame.common.input_limit;
        let Frame { common, progress, axes } = &mut self.frame;
        let sound = all_within(&moments.map(|m| m.j1), limit) && all_within(&moments.map(|m| m.j2), 0.5 * limit);
        if progress.substep < common.substeps && progress.started && sound {
            append(common, progress, axes, moments);
        } else {
            let mut moments = *moments;
            self.parts().apply_moments_carefully(&mut moments, &mut [f32::NAN; N]);
        }
    }
}

/// One comparison for all: the sum of the magnitudes is within the limit only if each is, and no NaN passes.
#[inline(always)]
fn all_within<const N: usize>(values: &[f32; N], limit: f32) -> bool {
    values.iter().map(|x| x.abs()).sum::<f32>() <= limit
}

#[inline(always)]
fn hold(common: &Common, progress: &mut Progress, axes: &mut [Axis], inputs: &[f32]) {
    let step = &common.substep;
    for (axis, &f) in axes.iter_mut().zip(inputs) {
        if common.substeps == 1 {
            axis.moments = InputMoments { j1: f, j2: 0.5 * f };
        } else if progress.substep == 0 {
            axis.moments = InputMoments::held(f, step);
        } else {
            axis.moments.hold(f, step);
        }
    }
    progress.substep += 1;
}

#[inline(always)]
fn append(common: &Common, progress: &mut Progress, axes: &mut [Axis], moments: &[InputMoments]) {
    for (axis, part) in axes.iter_mut().zip(moments) {
        if common.substeps == 1 {
            axis.moments = *part;
        } else {
            if progress.substep == 0 {
                axis.moments = InputMoments::ZERO;
            }
            axis.moments.append(part, &common.substep);
        }
    }
    progress.substep += 1;
}

impl Parts<'_> {
    /// The general way to hold inputs. `missing` is what a measurement is of which nothing came.
    #[inline(never)]
    fn apply_carefully(&mut self, inputs: &mut [f32], missing: &mut [f32]) {
        if self.begin_substep(missing) {
            self.repair_inputs(inputs);
            let Frame { common, progress, axes } = &mut *self.frame;
            hold(common, progress, axes, inputs);
        }
    }

    #[inline(never)]
    fn apply_ramp(&mut self, from: &mut [f32], to: &mut [f32], missing: &mut [f32]) {
        if !self.begin_substep(missing) {
            return;
        }
        self.repair_inputs(from);
        self.repair_inputs(to);
        let Frame { common, progress, axes } = &mut *self.frame;
        for (axis, (&mut from, &mut to)) in axes.iter_mut().zip(from.iter_mut().zip(to)) {
            if progress.substep == 0 {
                axis.moments = InputMoments::ZERO;
            }
            axis.moments.ramp(from, to, &common.substep);
        }
        progress.substep += 1;
    }

    #[inline(never)]
    fn apply_moments_carefully(&mut self, moments: &mut [InputMoments], missing: &mut [f32]) {
        if !self.begin_substep(missing) {
            return;
        }
        let Frame { common, progress, axes } = &mut *self.frame;
        for (axis, part) in axes.iter().zip(moments.iter_mut()) {
            if part.j1.abs() <= common.input_limit && part.j2.abs() <= 0.5 * common.input_limit {
                continue;
            }
            progress.counters.rejected_inputs = progress.counters.rejected_inputs.saturating_add(1);
            let f = late_input(common, progress.substep, axis);
            *part = InputMoments { j1: f, j2: 0.5 * f };
        }
        append(common, progress, axes, moments);
    }

    /// Goes past a measurement instant at which nothing was measured. False before the first measurement.
    fn begin_substep(&mut self, missing: &mut [f32]) -> bool {
        let Frame { common, progress, .. } = &mut *self.frame;
        if progress.started && progress.substep >= common.substeps {
            self.advance(missing);
        }
        self.frame.progress.started
    }

    /// The inputs, a rejected one replaced by the mean of the axis's input over the interval so far.
    fn repair_inputs(&mut self, inputs: &mut [f32]) {
        let Frame { common, progress, axes } = &mut *self.frame;
        for (axis, f) in axes.iter().zip(inputs) {
            if f.abs() <= common.input_limit {
                continue;
            }
            progress.counters.rejected_inputs = progress.counters.rejected_inputs.saturating_add(1);
            *f = late_input(common, progress.substep, axis);
        }
    }
}

/// The mean input of late: j1 is that of the interval before, or the part of the present one's that is known.
fn late_input(common: &Common, substep: u32, axis: &Axis) -> f32 {
    let periods = if substep == 0 { common.substeps } else { substep };
    axis.moments.j1 / (periods as f32 * common.substep_share)
}
