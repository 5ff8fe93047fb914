//! What a measurement instant does: the observers, the blocks, and whoever has a turn.

use super::Estimator;
use super::axis::{Clocks, Source};
use super::parts::Parts;

/// Counts of measurements are kept below about this: three days at 8 kHz.
pub(super) const LONG_AGO: u32 = 1 << 31;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// The quick way: everybody measured, gains that hardly change.
    #[inline(always)]
    pub(super) fn advance_steadily(&mut self, y: &[f32; N]) {
        let progress = &mut self.progress;
        progress.observer.tick();
        progress.substep = 0;
        let gains = progress.observer.gains;
        if self.design.common.block_length == 1 {
            for (axis, &y) in self.axes.iter_mut().zip(y) {
                axis.observe(y, gains.m1(), gains.t_l2());
            }
            self.parts().take_singles(y);
        } else {
            for (axis, &y) in self.axes.iter_mut().zip(y) {
                axis.observe(y, gains.m1(), gains.t_l2());
                axis.sample(y);
            }
            let position = progress.identifier.position;
            let next = position + 1;
            progress.identifier.position = if next == self.design.common.block_length { 0 } else { next };
            if self.design.common.schedule.events.wrapping_shr(position) & 1 == 1 {
                self.parts().take_turns(y, position);
            }
        }
    }
}

impl Parts<'_> {
    /// The general way.
    #[inline(never)]
    pub fn advance(&mut self, y: &mut [f32]) {
        let limit = self.common.position_limit;
        let complete = y.iter().all(|y| y.abs() <= limit);
        if !self.progress.started && !complete {
            self.count_missing(y);
            return;
        }
        let m1 = self.progress.observer.gains.m1();
        let mut gains = self.progress.observer.gains;
        if self.progress.started {
            self.progress.observer.tick();
            if !self.progress.observer.striding {
                gains = self.progress.observer.next(self.common);
            }
        }
        self.progress.started = true;
        self.progress.substep = 0;
        if !(self.progress.steady && complete) {
            self.count_missing(y);
            self.repair_positions(y, m1);
        }
        for (axis, &y) in self.axes.iter_mut().zip(y.iter()) {
            axis.observe(y, m1, gains.t_l2());
        }
        self.progress.observer.gains = gains;
        let identifying = self.progress.observer.count >= self.progress.identifier.began;
        if identifying && self.common.block_length == 1 {
            self.take_singles(y);
        } else if identifying {
            for (axis, &y) in self.axes.iter_mut().zip(y.iter()) {
                axis.sample(y);
            }
            let position = self.progress.identifier.position;
            self.take_turns(y, position);
            let next = position + 1;
            self.progress.identifier.position = if next == self.common.block_length { 0 } else { next };
        }
        self.progress.steady = complete && self.progress.all_measured && self.progress.observer.striding && identifying;
    }

    /// Blocks of one sample.
    #[inline(never)]
    fn take_singles(&mut self, y: &[f32]) {
        let common = self.common;
        self.progress.identifier.step(common);
        for (index, (axis, &y)) in self.axes.iter_mut().zip(y).enumerate() {
            let mean = axis.single(y);
            if axis.present
                && let Some(own) = self.each.axes.get(index)
                && let Some(parameter) = self.parameters.get_mut(self.each.parameter_of(index))
            {
                let own = (own.drift, common.schedule.coarse_slot(index));
                axis.identify(mean, false, own, &self.progress.identifier, parameter, common);
            }
        }
        let position = self.progress.identifier.position;
        self.progress.identifier.position = (position + 1) & 7;
        if common.schedule.unhurried {
            for index in 0..self.axes.len() {
                self.serve(index);
            }
        } else {
            self.serve(position as usize);
        }
        if position == self.common.schedule.gains_at {
            self.turn_gains();
        }
    }

    /// The turns within a block of several samples, at the `position`-th.
    #[inline(never)]
    fn take_turns(&mut self, y: &[f32], position: u32) {
        let common = self.common;
        let schedule = &common.schedule;
        let length = common.block_length;
        if position == schedule.weights_at {
            self.progress.identifier.step(common);
        }
        // Axis i begins its blocks at the i-th sample of the first axis's and ends them a sample before.
        let mut index = position as usize;
        while let (Some(axis), Some(&y)) = (self.axes.get_mut(index), y.get(index)) {
            axis.begin_block(y, common);
            index += length as usize;
        }
        let gains_turn = if schedule.round > schedule.gains_every {
            self.progress.observer.is_due(common)
        } else {
            position == schedule.gains_at
        };
        let mut index = if position + 1 == length { 0 } else { position as usize + 1 };
        while index < self.axes.len() {
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
        let common = self.common;
        if let (Some(axis), Some(own), Some(parameter)) = (
            self.axes.get_mut(index),
            self.each.axes.get(index),
            self.parameters.get_mut(self.each.parameter_of(index)),
        ) && axis.present
        {
            let mean = axis.block.complete(&common.block);
            let own = (own.drift, common.schedule.coarse_slot(index));
            axis.identify(mean, true, own, &self.progress.identifier, parameter, common);
        }
    }

    fn turn_gains(&mut self) {
        if self.progress.observer.count >= LONG_AGO {
            self.rebase();
        }
        if self.progress.observer.striding {
            self.progress.observer.renew(self.common);
        } else if !self.common.schedule.unhurried {
            self.progress.observer.settle();
        }
        if self.common.schedule.round > 32 {
            for axis in self.axes.iter_mut() {
                axis.observer.fold();
            }
        }
    }

    /// Puts the origin of the counts later, so that they never reach their end: differences and what lies far back stay as
    /// they are.
    #[inline(never)]
    fn rebase(&mut self) {
        let by = LONG_AGO / 2;
        self.progress.observer.count -= by;
        self.progress.identifier.began = self.progress.identifier.began.saturating_sub(by);
        for axis in self.axes.iter_mut() {
            axis.settled_at = axis.settled_at.saturating_sub(by);
            axis.decide_use();
        }
    }

    /// An axis's turn after its block: sums are folded, its parameter is read, its observer follows.
    #[inline(always)]
    fn serve(&mut self, index: usize) {
        let common = self.common;
        let parameter_index = self.each.parameter_of(index);
        let (Some(axis), Some(parameter), Some(rule)) = (
            self.axes.get_mut(index),
            self.parameters.get_mut(parameter_index),
            self.each.parameters.get(parameter_index).map(|p| &p.rule),
        ) else {
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
        let common = self.common;
        let parameter_index = self.each.parameter_of(index);
        let (Some(own), Some(parameter)) = (self.each.own(index), self.parameters.get_mut(parameter_index)) else {
            return;
        };
        if parameter.stale {
            let per_stride = common.covariance.per_stride;
            let mut variance = Some(0.0);
            for (other, axis) in self.axes.iter().enumerate() {
                if axis.present && self.each.parameter_of(other) == parameter_index {
                    variance = variance.zip(axis.numerator_variance(per_stride)).map(|(a, b)| a + b);
                }
            }
            parameter.read_variance(variance, common.identifier.scale2());
        }
        let Some(axis) = self.axes.get_mut(index) else { return };
        let settled = self.progress.observer.count - self.progress.identifier.began >= common.parameter_settle;
        parameter.read(settled, own.rule);
        let clocks = Clocks { identifier: &self.progress.identifier, observer: &self.progress.observer };
        axis.follow(parameter, &own, clocks, common);
    }

    fn count_missing(&mut self, y: &[f32]) {
        for y in y {
            if y.abs() <= self.common.position_limit {
                continue;
            }
            self.progress.counters.missed = self.progress.counters.missed.saturating_add(1);
            if !y.is_nan() {
                self.progress.counters.rejected_measurements =
                    self.progress.counters.rejected_measurements.saturating_add(1);
            }
        }
    }

    /// First measurements, missing ones, and ones that cannot be right.
    #[inline(never)]
    fn repair_positions(&mut self, y: &mut [f32], m1: f32) {
        let common = self.common;
        self.progress.all_measured = true;
        for (index, (axis, y)) in self.axes.iter_mut().zip(y.iter_mut()).enumerate() {
            if y.abs() <= common.position_limit {
                axis.gap = 0;
                if !axis.measured {
                    axis.measured = true;
                    axis.observer.start(*y);
                    let late = if self.progress.observer.count > 0 { common.late_settle } else { 1 };
                    axis.settled_at = self.progress.observer.count.saturating_add(late.max(common.state_settle));
                    let parameter = self.parameters.get(self.each.parameter_of(index));
                    if let (Some(own), Some(parameter)) = (self.each.own(index), parameter)
                        && axis.source == Source::Nothing
                    {
                        let clocks =
                            Clocks { identifier: &self.progress.identifier, observer: &self.progress.observer };
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
                if axis.present
                    && let Some(parameter) = self.parameters.get_mut(self.each.parameter_of(index))
                {
                    parameter.leave();
                }
                axis.measured = false;
                axis.present = false;
                axis.observer.start(0.0);
                axis.decide_use();
                *y = 0.0;
            }
            self.progress.all_measured &= axis.measured;
        }
    }
}
