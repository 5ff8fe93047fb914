//! The estimator's two calls a tick: [`Estimator::measure`] and [`Estimator::apply`].

use super::Estimator;
use super::axis::Source;
use super::design::EstimatorDesign;
use super::output::OutOfStep;
use crate::moments::InputMoments;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// The positions at the present measurement instant; `None` for an axis whose measurement is missing.
    ///
    /// # Errors
    /// [`OutOfStep`] where fewer than `substeps` inputs were applied since the last instant; nothing has changed then.
    pub fn measure(&mut self, positions: &[Option<f32>; N]) -> Result<(), OutOfStep> {
        self.measure_raw(&positions.map(|y| y.unwrap_or(f32::NAN)))
    }

    /// As [`measure`](Self::measure), a missing measurement being NaN.
    ///
    /// # Errors
    /// As [`measure`](Self::measure).
    pub fn measure_raw(&mut self, positions: &[f32; N]) -> Result<(), OutOfStep> {
        if self.started {
            let missing = self.design.substeps.saturating_sub(self.substep);
            if missing > 0 {
                return Err(OutOfStep { missing });
            }
        }
        self.advance(*positions);
        Ok(())
    }

    /// The inputs held over the control period that begins now. Before the first measurement nothing happens.
    pub fn apply(&mut self, inputs: &[f32; N]) {
        if !self.begin_substep() {
            return;
        }
        let inputs = self.accepted(inputs);
        if self.design.substeps == 1 {
            for (axis, &f) in self.axes.iter_mut().zip(&inputs) {
                axis.moments = InputMoments { j1: f, j2: 0.5 * f };
            }
        } else {
            for (axis, &f) in self.axes.iter_mut().zip(&inputs) {
                if self.substep == 0 {
                    axis.moments = InputMoments::ZERO;
                }
                axis.moments.hold(f, &self.design.substep);
            }
        }
        self.substep += 1;
    }

    /// As [`apply`](Self::apply), for inputs that go linearly from `from` to `to` over the control period.
    pub fn apply_ramp(&mut self, from: &[f32; N], to: &[f32; N]) {
        if !self.begin_substep() {
            return;
        }
        let (from, to) = (self.accepted(from), self.accepted(to));
        for (axis, (&from, &to)) in self.axes.iter_mut().zip(from.iter().zip(&to)) {
            if self.substep == 0 {
                axis.moments = InputMoments::ZERO;
            }
            axis.moments.ramp(from, to, &self.design.substep);
        }
        self.substep += 1;
    }

    /// Goes past a measurement instant at which nothing was measured. False before the first measurement.
    #[inline(always)]
    fn begin_substep(&mut self) -> bool {
        if !self.started {
            return false;
        }
        if self.substep >= self.design.substeps {
            self.advance([f32::NAN; N]);
        }
        true
    }

    /// The inputs, a rejected one replaced by the mean of the axis's input over the interval so far.
    #[inline(always)]
    fn accepted(&mut self, inputs: &[f32; N]) -> [f32; N] {
        // One comparison for all: the sum is within the limit only if each is, and no NaN passes.
        if inputs.iter().map(|f| f.abs()).sum::<f32>() <= self.design.input_limit {
            *inputs
        } else {
            self.repaired_inputs(*inputs)
        }
    }

    #[inline(never)]
    fn repaired_inputs(&mut self, mut inputs: [f32; N]) -> [f32; N] {
        for (axis, f) in self.axes.iter().zip(inputs.iter_mut()) {
            if f.abs() <= self.design.input_limit {
                continue;
            }
            self.counters.rejected_inputs = self.counters.rejected_inputs.saturating_add(1);
            // j1 is the mean of the interval before, or the part of the present one's that is known.
            let periods = if self.substep == 0 { self.design.substeps } else { self.substep };
            *f = axis.moments.j1 / (periods as f32 * self.design.substep_share);
        }
        inputs
    }

    fn advance(&mut self, mut y: [f32; N]) {
        if self.started {
            self.observer.step(&self.design);
        }
        self.started = true;
        self.substep = 0;
        if !(self.all_measured && y.iter().map(|y| y.abs()).sum::<f32>() <= self.design.position_limit) {
            self.repair_positions(&mut y);
        }
        let clock = &mut self.identifier;
        if clock.delay > 0 {
            clock.delay -= 1;
            for (axis, &y) in self.axes.iter_mut().zip(&y) {
                axis.observe(y, &self.observer);
            }
            return;
        }
        clock.age = clock.age.saturating_add(1);
        if self.design.block_length == 1 {
            self.advance_singles(&y);
        } else {
            self.advance_blocks(&y);
        }
    }

    /// Every sample is a block.
    #[inline(always)]
    fn advance_singles(&mut self, y: &[f32; N]) {
        let design = &self.design;
        let clock = &mut self.identifier;
        clock.step(design);
        let turn = clock.position;
        clock.position = if turn + 1 >= design.schedule.service_every { 0 } else { turn + 1 };
        for (index, (axis, &y)) in self.axes.iter_mut().zip(y).enumerate() {
            axis.observe(y, &self.observer);
            let mean = axis.single(y);
            if axis.present
                && let Some(parameter) = self.parameters.get_mut(EstimatorDesign::<N, P>::parameter_of(index))
            {
                axis.identify(index, mean, clock, parameter, design);
            }
        }
        if design.schedule.service_every == 1 {
            for index in 0..N {
                self.serve(index);
            }
        } else {
            self.serve(turn as usize);
        }
    }

    /// Blocks of several samples, the axes one sample apart from each other.
    #[inline(always)]
    fn advance_blocks(&mut self, y: &[f32; N]) {
        let design = &self.design;
        let clock = &mut self.identifier;
        let position = clock.position;
        let length = design.block_length;
        if position == design.schedule.weights_at {
            clock.step(design);
        }
        let next = if position + 1 == length { 0 } else { position + 1 };
        clock.position = next;
        for (axis, &y) in self.axes.iter_mut().zip(y) {
            axis.observe(y, &self.observer);
            axis.sample(y);
        }
        // Axis i begins its blocks at the i-th sample of the first axis's and ends them a sample before.
        let mut index = position;
        while let (Some(axis), Some(&y)) = (self.axes.get_mut(index as usize), y.get(index as usize)) {
            axis.begin_block(y, design);
            index += length;
        }
        let mut index = next;
        while let Some(axis) = self.axes.get_mut(index as usize) {
            let parameter_index = EstimatorDesign::<N, P>::parameter_of(index as usize);
            if axis.present
                && let Some(parameter) = self.parameters.get_mut(parameter_index)
            {
                let mean = axis.block.complete(&design.block);
                axis.identify(index as usize, mean, clock, parameter, design);
            }
            index += length;
        }
        let mut index = next;
        while (index as usize) < N {
            self.serve(index as usize);
            index += length;
        }
        if length > 32
            && let Some(axis) = self.axes.get_mut((position % 16) as usize)
        {
            axis.observer.fold();
        }
    }

    /// What an axis does now and then: sums are folded, its parameter is read, its observer follows.
    #[inline(always)]
    fn serve(&mut self, index: usize) {
        let design = &self.design;
        let parameter_index = EstimatorDesign::<N, P>::parameter_of(index);
        let (Some(parameter), Some(rule)) =
            (self.parameters.get_mut(parameter_index), design.rule.get(parameter_index))
        else {
            return;
        };
        if self.identifier.stride == design.coarse_slot(index) || design.schedule.service_every > 1 {
            let per_stride = design.covariance.per_stride;
            let variance = if P == 1 {
                let mut sum = Some(0.0);
                for axis in self.axes.iter().filter(|a| a.present) {
                    sum = sum.zip(axis.numerator_variance(per_stride)).map(|(a, b)| a + b);
                }
                sum
            } else {
                self.axes.get(index).and_then(|axis| axis.numerator_variance(per_stride))
            };
            parameter.read_variance(variance, design.identifier.scale2());
        }
        let Some(axis) = self.axes.get_mut(index) else { return };
        axis.fold();
        parameter.ratio.fold();
        parameter.read(self.identifier.age > design.parameter_settle, rule);
        let nominal = design.nominal.get(parameter_index).copied().flatten();
        axis.follow(index, parameter, nominal, (&self.identifier, &self.observer), design);
    }

    /// The slow way through a measurement instant: first measurements, missing ones, and ones that cannot be right.
    #[inline(never)]
    fn repair_positions(&mut self, y: &mut [f32; N]) {
        let design = &self.design;
        self.all_measured = true;
        for (index, (axis, y)) in self.axes.iter_mut().zip(y.iter_mut()).enumerate() {
            if y.abs() <= design.position_limit {
                if !axis.measured {
                    axis.measured = true;
                    axis.observer.start(*y);
                    let settle = if self.observer.count > 0 {
                        design.late_settle.max(design.state_settle)
                    } else {
                        design.state_settle.max(1)
                    };
                    axis.valid_from = self.observer.count.saturating_add(settle);
                    if axis.source == Source::Nothing {
                        let nominal = design.nominal.get(EstimatorDesign::<N, P>::parameter_of(index));
                        if let Some(parameter) = self.parameters.get(EstimatorDesign::<N, P>::parameter_of(index)) {
                            let clocks = (&self.identifier, &self.observer);
                            axis.follow(index, parameter, nominal.copied().flatten(), clocks, design);
                        }
                    }
                }
                continue;
            }
            self.counters.missed = self.counters.missed.saturating_add(1);
            if !y.is_nan() {
                self.counters.rejected_measurements = self.counters.rejected_measurements.saturating_add(1);
            }
            axis.missed = axis.missed.saturating_add(1);
            let predicted = axis.observer.predict(axis.moments, &axis.model, &self.observer.before);
            if axis.measured && predicted.abs() <= design.position_limit {
                *y = predicted;
            } else {
                // Never measured, or predicted out of all bounds: lost until it is measured again.
                axis.measured = false;
                axis.present = false;
                axis.observer.start(0.0);
                *y = 0.0;
            }
            self.all_measured &= axis.measured;
        }
    }
}
