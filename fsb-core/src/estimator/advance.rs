//! What a measurement instant does: the observers, the blocks, and whoever has a turn.

use super::Estimator;
use super::axis::{Clocks, Source};
use super::design::EstimatorDesign;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// The quick way: everybody measured, gains that hardly change.
    #[inline(always)]
    pub(super) fn advance_steadily(&mut self, y: &[f32; N]) {
        self.observer.tick();
        self.substep = 0;
        let gains = self.observer.gains;
        if self.design.common.block_length == 1 {
            for (axis, &y) in self.axes.iter_mut().zip(y) {
                axis.observe(y, gains.m1(), gains.t_l2());
            }
            self.take_singles(y);
        } else {
            for (axis, &y) in self.axes.iter_mut().zip(y) {
                axis.observe(y, gains.m1(), gains.t_l2());
                axis.sample(y);
            }
            let position = self.identifier.position;
            if self.design.common.schedule.events.wrapping_shr(position) & 1 == 1 {
                self.take_turns(y, position);
            }
            let next = position + 1;
            self.identifier.position = if next == self.design.common.block_length { 0 } else { next };
        }
    }

    /// The general way.
    #[inline(never)]
    pub(super) fn advance(&mut self, mut y: [f32; N]) {
        let limit = self.design.common.position_limit;
        let complete = y.iter().all(|y| y.abs() <= limit);
        if !self.started && !complete {
            self.count_missing(&y);
            return;
        }
        let m1 = self.observer.gains.m1();
        let mut gains = self.observer.gains;
        if self.started {
            self.observer.tick();
            if !self.observer.striding {
                gains = self.observer.next(&self.design.common);
            }
        }
        self.started = true;
        self.substep = 0;
        if !(self.steady && complete) {
            self.count_missing(&y);
            self.repair_positions(&mut y, m1);
        }
        for (axis, &y) in self.axes.iter_mut().zip(&y) {
            axis.observe(y, m1, gains.t_l2());
        }
        self.observer.gains = gains;
        let identifying = self.observer.count >= self.identifier.began;
        if identifying && self.design.common.block_length == 1 {
            self.take_singles(&y);
        } else if identifying {
            for (axis, &y) in self.axes.iter_mut().zip(&y) {
                axis.sample(y);
            }
            let position = self.identifier.position;
            self.take_turns(&y, position);
            let next = position + 1;
            self.identifier.position = if next == self.design.common.block_length { 0 } else { next };
        }
        self.steady = complete && self.all_measured && self.observer.striding && identifying;
    }

    /// Blocks of one sample.
    #[inline(always)]
    fn take_singles(&mut self, y: &[f32; N]) {
        let common = &self.design.common;
        self.identifier.step(common);
        for (index, (axis, &y)) in self.axes.iter_mut().zip(y).enumerate() {
            let mean = axis.single(y);
            let Some(own) = self.design.own(index) else { continue };
            if axis.present
                && let Some(parameter) = self.parameters.get_mut(EstimatorDesign::<N, P>::parameter_of(index))
            {
                axis.identify(mean, false, &own, &self.identifier, parameter, common);
            }
        }
        let position = self.identifier.position;
        self.identifier.position = (position + 1) & 7;
        if common.schedule.unhurried {
            for index in 0..N {
                self.serve(index);
            }
        } else {
            self.serve(position as usize);
        }
        if position == self.design.common.schedule.gains_at {
            self.turn_gains();
        }
    }

    /// The turns within a block of several samples, at the `position`-th.
    #[inline(never)]
    fn take_turns(&mut self, y: &[f32; N], position: u32) {
        let common = &self.design.common;
        let schedule = &common.schedule;
        let length = common.block_length;
        if position == schedule.weights_at {
            self.identifier.step(common);
        }
        // Axis i begins its blocks at the i-th sample of the first axis's and ends them a sample before.
        let mut index = position as usize;
        while let (Some(axis), Some(&y)) = (self.axes.get_mut(index), y.get(index)) {
            axis.begin_block(y, common);
            index += length as usize;
        }
        let gains_turn = if schedule.round > schedule.gains_every {
            self.observer.is_due(common)
        } else {
            position == schedule.gains_at
        };
        let mut index = if position + 1 == length { 0 } else { position as usize + 1 };
        while index < N {
            self.complete_block(index);
            self.serve(index);
            index += length as usize;
        }
        if gains_turn {
            self.turn_gains();
        }
    }

    #[inline(always)]
    fn complete_block(&mut self, index: usize) {
        let common = &self.design.common;
        if let (Some(axis), Some(own), Some(parameter)) = (
            self.axes.get_mut(index),
            self.design.own(index),
            self.parameters.get_mut(EstimatorDesign::<N, P>::parameter_of(index)),
        ) && axis.present
        {
            let mean = axis.block.complete(&common.block);
            axis.identify(mean, true, &own, &self.identifier, parameter, common);
        }
    }

    fn turn_gains(&mut self) {
        if self.observer.striding {
            self.observer.renew(&self.design.common);
        } else if !self.design.common.schedule.unhurried {
            self.observer.settle();
        }
        if self.design.common.schedule.round > 32 {
            for axis in &mut self.axes {
                axis.observer.fold();
            }
        }
    }

    /// An axis's turn after its block: sums are folded, its parameter is read, its observer follows.
    #[inline(always)]
    fn serve(&mut self, index: usize) {
        let common = &self.design.common;
        let parameter_index = EstimatorDesign::<N, P>::parameter_of(index);
        let (Some(axis), Some(parameter), Some(rule)) =
            (self.axes.get_mut(index), self.parameters.get_mut(parameter_index), self.design.rule.get(parameter_index))
        else {
            return;
        };
        axis.observer.fold();
        if common.block_length == 1 {
            axis.cascade.fold();
        }
        if !parameter.stale && axis.source == Source::Identified && parameter.read_on(rule) {
            axis.model.follow(parameter.newest_value(), common.period2);
        } else {
            self.serve_carefully(index);
        }
    }

    /// The same, where the variance has to be read or the status or the source of the prediction may change.
    #[inline(never)]
    fn serve_carefully(&mut self, index: usize) {
        let common = &self.design.common;
        let parameter_index = EstimatorDesign::<N, P>::parameter_of(index);
        let (Some(own), Some(parameter)) = (self.design.own(index), self.parameters.get_mut(parameter_index)) else {
            return;
        };
        if parameter.stale {
            let per_stride = common.covariance.per_stride;
            let mut variance = Some(0.0);
            for (other, axis) in self.axes.iter().enumerate() {
                if axis.present && EstimatorDesign::<N, P>::parameter_of(other) == parameter_index {
                    variance = variance.zip(axis.numerator_variance(per_stride)).map(|(a, b)| a + b);
                }
            }
            parameter.read_variance(variance, common.identifier.scale2());
        }
        let Some(axis) = self.axes.get_mut(index) else { return };
        let settled = self.observer.count - self.identifier.began >= common.parameter_settle;
        parameter.read(settled, own.rule);
        let clocks = Clocks { identifier: &self.identifier, observer: &self.observer };
        axis.follow(parameter, &own, clocks, common);
    }

    fn count_missing(&mut self, y: &[f32; N]) {
        for y in y {
            if y.abs() <= self.design.common.position_limit {
                continue;
            }
            self.counters.missed = self.counters.missed.saturating_add(1);
            if !y.is_nan() {
                self.counters.rejected_measurements = self.counters.rejected_measurements.saturating_add(1);
            }
        }
    }

    /// First measurements, missing ones, and ones that cannot be right.
    #[inline(never)]
    fn repair_positions(&mut self, y: &mut [f32; N], m1: f32) {
        let common = &self.design.common;
        self.all_measured = true;
        for (index, (axis, y)) in self.axes.iter_mut().zip(y.iter_mut()).enumerate() {
            if y.abs() <= common.position_limit {
                axis.gap = 0;
                if !axis.measured {
                    axis.measured = true;
                    axis.observer.start(*y);
                    let late = if self.observer.count > 0 { common.late_settle } else { 1 };
                    axis.settled_at = self.observer.count.saturating_add(late.max(common.state_settle));
                    let parameter = self.parameters.get(EstimatorDesign::<N, P>::parameter_of(index));
                    if let (Some(own), Some(parameter)) = (self.design.own(index), parameter)
                        && axis.source == Source::Nothing
                    {
                        let clocks = Clocks { identifier: &self.identifier, observer: &self.observer };
                        axis.change_source(parameter, &own, clocks, common);
                    }
                    axis.decide_use();
                }
                continue;
            }
            axis.missed = axis.missed.saturating_add(1);
            axis.gap = axis.gap.saturating_add(1);
            let predicted = axis.observer.predict(axis.moments, &axis.model, m1);
            if axis.measured && predicted.abs() <= common.position_limit {
                *y = predicted;
            } else {
                // Never measured, or predicted out of all bounds: lost until it is measured again.
                axis.measured = false;
                axis.present = false;
                axis.observer.start(0.0);
                axis.decide_use();
                *y = 0.0;
            }
            self.all_measured &= axis.measured;
        }
    }
}
