//! What a measurement instant does: the observers, the blocks, and whoever has a turn.

use super::Estimator;
use super::axis::Clocks;
use super::identify::{Misfit, SingleRound};
use super::output::Learning;
use super::parts::{Frame, Parts, parameter_of};
use crate::identifier::BlockMeans;

/// Counts of measurements are kept below about this: three days at 8 kHz.
pub(super) const LONG_AGO: u32 = 1 << 31;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// The quick way: everybody measured, gains that hardly change.
    #[inline(always)]
    pub(super) fn advance_steadily(&mut self, y: &[f32; N]) {
        let Frame { common, progress, axes } = &mut self.frame;
        progress.observer.tick();
        progress.substep = 0;
        let gains = progress.observer.gains;
        if common.block_length == 1 {
            for (axis, &y) in axes.iter_mut().zip(y) {
                axis.observe(y, gains.m1(), gains.t_l2());
            }
            self.parts().take_singles();
        } else {
            for (axis, &y) in axes.iter_mut().zip(y) {
                axis.observe(y, gains.m1(), gains.t_l2());
                axis.sample(y);
            }
            let position = progress.identifier.position;
            let next = progress.identifier.move_on(common);
            if common.schedule.events.wrapping_shr(position) & 1 == 1 {
                self.parts().take_turns(position, next);
            }
        }
    }
}

impl Parts<'_> {
    /// The general way.
    #[inline(never)]
    pub fn advance(&mut self, y: &mut [f32]) {
        let Frame { common, progress, .. } = &mut *self.frame;
        let limit = common.position_limit;
        let complete = y.iter().all(|y| y.abs() <= limit);
        if !progress.started && !complete {
            self.count_missing(y);
            return;
        }
        let m1 = progress.observer.gains.m1();
        let mut gains = progress.observer.gains;
        if progress.started {
            progress.observer.tick();
            if !progress.observer.striding {
                gains = progress.observer.next(common);
            }
        }
        progress.started = true;
        progress.substep = 0;
        let mut back = false;
        if !(progress.all_measured && complete) {
            self.count_missing(y);
            back = self.repair_positions(y, m1, gains.t_l2());
        }
        let Frame { common, progress, axes } = &mut *self.frame;
        progress.observer.gains = gains;
        let identifying = progress.observer.count >= progress.identifier.began && progress.learning == Learning::On;
        let in_block = identifying && common.block_length > 1;
        for (axis, &y) in axes.iter_mut().zip(y.iter()) {
            axis.observe(y, m1, gains.t_l2());
        }
        if in_block {
            for (axis, &y) in axes.iter_mut().zip(y.iter()) {
                axis.sample(y);
            }
            let position = progress.identifier.position;
            let next = progress.identifier.move_on(common);
            self.take_turns(position, next);
        } else if identifying {
            self.take_singles();
            if back {
                self.make_up();
            }
        } else if progress.observer.count.checked_rem(common.schedule.gains_every) == Some(1) {
            // Nobody has a turn, and the observers go on.
            self.turn_gains();
            self.fold_observers();
        }
        let progress = &mut self.frame.progress;
        progress.steady = complete && progress.all_measured && progress.observer.striding && identifying;
    }

    /// Blocks of one sample.
    #[inline(never)]
    fn take_singles(&mut self) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let schedule = &common.schedule;
        let clock = &mut progress.identifier;
        clock.step(common);
        let round =
            SingleRound { stage: common.identifier.stage(), at: clock.at, zu: clock.unit.zu(), open: clock.blocks > 2 };
        // The axis that takes its coarse step, and how far that is from one axis to the next.
        let apart = u32::from(schedule.staggered);
        let mut until = if clock.is_shaped(common) { clock.stride } else { u32::MAX };
        until = until.wrapping_sub(apart);
        let of_next = usize::from(self.parameters.len() != 1);
        let mut of = 0;
        for axis in axes.iter_mut() {
            if axis.takes_part()
                && let Some(parameter) = self.parameters.get_mut(of)
            {
                axis.identify_single(&round, until == 0, clock, parameter, common);
            }
            of += of_next;
            until = until.wrapping_sub(apart);
        }
        let position = progress.identifier.position;
        progress.identifier.position = (position + 1) & 7;
        let gains_turn = position == schedule.gains_at;
        if schedule.unhurried {
            self.serve_all_singles();
        } else {
            self.serve_single(position as usize);
        }
        if gains_turn {
            self.turn_gains();
        }
    }

    /// What fell to samples that were missing.
    #[inline(never)]
    fn make_up(&mut self) {
        let Frame { common, progress, axes } = &mut *self.frame;
        for (index, axis) in axes.iter_mut().enumerate() {
            if let Some(parameter) = self.parameters.get_mut(parameter_of(index, self.parameters)) {
                axis.make_up(&progress.identifier, parameter, common);
            }
        }
    }

    /// An axis's turn where blocks are single samples.
    #[inline(always)]
    fn serve_single(&mut self, index: usize) {
        let Frame { common, axes, .. } = &mut *self.frame;
        let of = parameter_of(index, self.parameters);
        if let (Some(axis), Some(parameter)) = (axes.get_mut(index), self.parameters.get_mut(of)) {
            axis.observer.fold();
            axis.cascade.fold();
            if parameter.stale || !axis.follow_on(parameter, common) {
                self.serve_carefully(index, true);
            }
        }
    }

    /// All axes, where there is time enough.
    #[inline(never)]
    fn serve_all_singles(&mut self) {
        for index in 0..self.frame.axes.len() {
            if let Some(axis) = self.frame.axes.get_mut(index) {
                axis.observer.fold();
                axis.cascade.fold();
            }
            self.serve_carefully(index, true);
        }
    }

    /// The turns within a block of several samples: `begins` is the axis that has just taken the first one of a block,
    /// `completes` the one that has taken its last. Axis i begins its blocks at the i-th sample of the first axis's and ends
    /// them a sample before.
    #[inline(always)]
    fn take_turns(&mut self, begins: u32, completes: u32) {
        self.turn(begins, completes);
        if (self.frame.common.block_length as usize) < self.frame.axes.len() {
            self.take_later_turns(begins, completes);
        }
    }

    /// Blocks shorter than there are axes: those whose turn is a block or more later than another one's.
    #[inline(never)]
    fn take_later_turns(&mut self, mut begins: u32, mut completes: u32) {
        let length = self.frame.common.block_length;
        let axes = self.frame.axes.len() as u32;
        while begins + length < axes || completes + length < axes {
            begins += length;
            completes += length;
            self.turn(begins, completes);
        }
    }

    #[inline(never)]
    fn turn(&mut self, begins: u32, completes: u32) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let schedule = &common.schedule;
        if begins == schedule.weights_at {
            progress.identifier.step(common);
        }
        if let Some(axis) = axes.get_mut(begins as usize) {
            axis.begin_block(common);
        }
        let index = completes as usize;
        let gains_turn = if schedule.round > schedule.gains_every {
            progress.observer.is_due(common)
        } else {
            begins == schedule.gains_at
        };
        let of = parameter_of(index, self.parameters);
        if let (Some(axis), Some(parameter)) = (axes.get_mut(index), self.parameters.get_mut(of)) {
            if axis.present {
                let mean = axis.block.complete(&common.block);
                axis.identify_block(mean, &progress.identifier, parameter, common);
            } else {
                // Blocks that begin and are never completed would grow without bounds.
                axis.block = BlockMeans::default();
            }
            // Sums are folded, the parameter is read, the observer follows.
            axis.observer.fold();
            // The variance that a coarse step makes due is read when the next block ends, if that one brings none.
            let coarse = progress.identifier.stride == 0 && common.covariance.steps > 1;
            let due = parameter.stale && !coarse;
            if due || !axis.follow_on(parameter, common) {
                self.serve_carefully(index, due);
            }
        }
        if gains_turn {
            self.turn_gains();
        }
    }

    #[inline(never)]
    fn turn_gains(&mut self) {
        if self.frame.progress.observer.count >= LONG_AGO {
            self.rebase();
        }
        let Frame { common, progress, .. } = &mut *self.frame;
        if progress.observer.striding {
            progress.observer.renew(common);
        } else if !common.schedule.unhurried {
            progress.observer.settle();
        }
        if common.schedule.round > 32 {
            self.fold_observers();
        }
    }

    fn fold_observers(&mut self) {
        for axis in &mut self.frame.axes {
            axis.fold_observer();
        }
    }

    /// Puts the origin of the counts later, so that they never reach their end: differences and what lies far back stay as
    /// they are.
    #[inline(never)]
    fn rebase(&mut self) {
        let by = LONG_AGO / 2;
        let Frame { progress, axes, .. } = &mut *self.frame;
        progress.observer.count -= by;
        progress.identifier.began = progress.identifier.began.saturating_sub(by);
        for axis in axes {
            axis.rebase(by);
        }
    }

    /// An axis's turn where the variance has to be `read` or the status or the source of the prediction may change.
    #[inline(never)]
    fn serve_carefully(&mut self, index: usize, read: bool) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let pooled = self.parameters.len() == 1;
        let Some(parameter) = self.parameters.get_mut(if pooled { 0 } else { index }) else { return };
        if read && parameter.stale {
            let per_stride = common.covariance.per_stride;
            let mut sum = Misfit::beside(common.expected_misfit(&progress.identifier));
            if pooled {
                axes.iter().for_each(|axis| axis.share_misfit(&mut sum, per_stride));
            } else if let Some(axis) = axes.get(index) {
                axis.add_misfit(&mut sum, per_stride);
            }
            parameter.read_variance(sum.known_variance(), common.identifier.scale2());
            parameter.compare(sum.unexplained, common.max_misfit * sum.signal);
        }
        let Some(axis) = axes.get_mut(index) else { return };
        let settled = progress.observer.count - progress.identifier.began >= common.parameter_settle;
        parameter.read(settled);
        let clocks = Clocks { identifier: &progress.identifier, observer: &progress.observer };
        axis.follow(parameter, clocks, common);
    }
}
