//! The estimator's two calls a tick: [`Estimator::measure`] and [`Estimator::apply`].

use super::Estimator;
use super::output::OutOfStep;
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
        let due = self.substep >= self.design.common.substeps;
        if due && self.steady && self.all_within(positions, self.design.common.position_limit) {
            self.advance_steadily(positions);
            return Ok(());
        }
        if self.started && !due {
            return Err(OutOfStep { missing: self.design.common.substeps - self.substep });
        }
        self.advance(*positions);
        Ok(())
    }

    /// One comparison for all: the sum of the magnitudes is within the limit only if each is, and no NaN passes.
    #[inline(always)]
    fn all_within(&self, values: &[f32; N], limit: f32) -> bool {
        values.iter().map(|x| x.abs()).sum::<f32>() <= limit
    }

    /// The inputs held over the control period that begins now. Before the first measurement nothing happens.
    pub fn apply(&mut self, inputs: &[f32; N]) {
        if self.substep < self.design.common.substeps
            && self.started
            && self.all_within(inputs, self.design.common.input_limit)
        {
            self.hold(inputs);
        } else {
            self.apply_carefully(inputs);
        }
    }

    #[inline(always)]
    fn hold(&mut self, inputs: &[f32; N]) {
        if self.design.common.substeps == 1 {
            for (axis, &f) in self.axes.iter_mut().zip(inputs) {
                axis.moments = InputMoments { j1: f, j2: 0.5 * f };
            }
        } else {
            if self.substep == 0 {
                for axis in &mut self.axes {
                    axis.moments = InputMoments::ZERO;
                }
            }
            for (axis, &f) in self.axes.iter_mut().zip(inputs) {
                axis.moments.hold(f, &self.design.common.substep);
            }
        }
        self.substep += 1;
    }

    #[inline(never)]
    fn apply_carefully(&mut self, inputs: &[f32; N]) {
        if self.begin_substep() {
            let inputs = self.repaired_inputs(*inputs);
            self.hold(&inputs);
        }
    }

    /// As [`apply`](Self::apply), for inputs that go linearly from `from` to `to` over the control period.
    pub fn apply_ramp(&mut self, from: &[f32; N], to: &[f32; N]) {
        if !self.begin_substep() {
            return;
        }
        let (from, to) = (self.repaired_inputs(*from), self.repaired_inputs(*to));
        for (axis, (&from, &to)) in self.axes.iter_mut().zip(from.iter().zip(&to)) {
            if self.substep == 0 {
                axis.moments = InputMoments::ZERO;
            }
            axis.moments.ramp(from, to, &self.design.common.substep);
        }
        self.substep += 1;
    }

    /// Goes past a measurement instant at which nothing was measured. False before the first measurement.
    fn begin_substep(&mut self) -> bool {
        if self.started && self.substep >= self.design.common.substeps {
            self.advance([f32::NAN; N]);
        }
        self.started
    }

    /// The inputs, a rejected one replaced by the mean of the axis's input over the interval so far.
    fn repaired_inputs(&mut self, mut inputs: [f32; N]) -> [f32; N] {
        let common = &self.design.common;
        for (axis, f) in self.axes.iter().zip(inputs.iter_mut()) {
            if f.abs() <= common.input_limit {
                continue;
            }
            self.counters.rejected_inputs = self.counters.rejected_inputs.saturating_add(1);
            // j1 is the mean of the interval before, or the part of the present one's that is known.
            let periods = if self.substep == 0 { common.substeps } else { self.substep };
            *f = axis.moments.j1 / (periods as f32 * common.substep_share);
        }
        inputs
    }
}
