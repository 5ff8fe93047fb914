//! What a measurement instant does: the observers, the blocks, and whoever has a turn.

use super::Estimator;
use super::axis::{Axis, Clocks};
use super::design::Common;
use super::identify::Misfit;
use super::parts::{Frame, Parts, parameter_of};
use super::schedule::Schedule;
use super::shared::Pace;
use crate::identifier::BlockMeans;
use crate::observer::Gains;
use crate::readout::ParameterState;

/// Counts of measurements are kept below about this: three days at 8 kHz.
pub(super) const LONG_AGO: u32 = 1 << 31;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// [`Pace::Steady`], and [`Pace::Hurried`].
    #[inline(always)]
    pub(super) fn advance_steadily(&mut self, y: &[f32; N], pace: Pace) {
        let Frame { common, progress, axes } = &mut self.frame;
        progress.observer.tick();
        progress.substep = 0;
        let Gains { m1, mut t_l2 } = progress.observer.gains;
        if pace == Pace::Hurried {
            t_l2 = progress.hurry_on(common);
        }
        for (axis, &y) in axes.iter_mut().zip(y) {
            axis.observe(y, m1, t_l2);
            axis.sample(y);
        }
        let position = progress.identifier.position;
        let next = progress.identifier.move_on(common);
        if common.schedule.events.wrapping_shr(position) & 1 == 1 {
            self.parts().take_turns(position, next);
        }
    }
}

impl Parts<'_> {
    /// The general way.
    #[inline(never)]
    pub fn advance(&mut self, y: &mut [f32]) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let limit = common.position_limit;
        let complete = y.iter().all(|y| y.abs() <= limit);
        let m1 = progress.observer.gains.m1();
        let mut gains = progress.observer.gains;
        if progress.started {
            gains = progress.observer.next(common);
        } else if complete {
            // The first instant.
            (progress.started, progress.all_measured) = (true, true);
            let settled_at = common.state_settle.max(1);
            for (axis, &mut y) in axes.iter_mut().zip(y.iter_mut()) {
                axis.measure_first(y, settled_at);
            }
        } else {
            self.count_missing(y);
            return;
        }
        progress.substep = 0;
        let mut back = false;
        if !(progress.all_measured && complete) {
            self.count_missing(y);
            back = self.repair_positions(y, m1, gains.t_l2());
        }
        let Frame { common, progress, axes } = &mut *self.frame;
        progress.observer.gains = gains;
        let identifying = progress.is_identifying();
        let in_block = identifying && common.block_length > 1;
        for (axis, &y) in axes.iter_mut().zip(y.iter()) {
            axis.observe(y, m1, gains.t_l2());
            if in_block {
                axis.sample(y);
            }
        }
        self.identify(identifying, complete, back);
    }

    /// The identifier's part of an instant at which every axis was measured, if it is `complete`, and one is `back` from a gap, if so.
    #[inline(always)]
    fn identify(&mut self, identifying: bool, complete: bool, back: bool) {
        let Frame { common, progress, .. } = &mut *self.frame;
        if identifying && common.block_length > 1 {
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
        let Frame { common, progress, axes } = &mut *self.frame;
        progress.pace = if !(complete && progress.all_measured && identifying) {
            Pace::Careful
        } else if common.block_length > 1 {
            if progress.observer.striding { Pace::Steady } else { Pace::Hurried }
        } else {
            // The window is zero in the first two samples.
            let open = progress.identifier.blocks >= 2;
            if open && axes.iter().all(|axis| axis.present) { Pace::Singles } else { Pace::Careful }
        };
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
        if self.frame.common.schedule.shared.wrapping_shr(begins) & 1 == 1 {
            self.take_shared_turns(begins);
        }
        let Frame { common, progress, axes } = &mut *self.frame;
        if let Some(axis) = axes.get_mut(begins as usize) {
            axis.begin_block(common);
        }
        let index = completes as usize;
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
            // Where there is no room for the variance elsewhere, it is read when the next block ends.
            let coarse = progress.identifier.stride == 0 && common.covariance.steps > 1;
            let due = parameter.stale && !coarse && common.schedule.reads_at == Schedule::NEVER;
            if due
                || !axis.follow_on(parameter, common)
                    && (!coarse || axis.has_more_to_do(parameter, progress.is_settled(common)))
            {
                self.serve_carefully(index, due);
            }
        }
    }

    /// Variances, weights, gains.
    #[inline(never)]
    fn take_shared_turns(&mut self, begins: u32) {
        let Frame { common, progress, .. } = &mut *self.frame;
        let schedule = &common.schedule;
        let weighs = begins == u32::from(schedule.weights_at);
        let of = 2 * progress.identifier.stride as usize + usize::from(weighs);
        let reads = weighs && schedule.reads_at != Schedule::NEVER || begins == u32::from(schedule.reads_at);
        if reads && of < self.parameters.len() {
            // All of them at the two opportunities of a block, or of several; none in the block before the next coarse step: what
            // it leads to would come with that step.
            let opportunities = 2 * common.covariance.steps.saturating_sub(1).max(1);
            self.read_variances(of, opportunities as usize);
        }
        let Frame { common, progress, .. } = &mut *self.frame;
        let schedule = &common.schedule;
        if weighs {
            progress.identifier.step(common);
        }
        let gains_turn = if schedule.round > schedule.gains_every {
            progress.observer.is_due(common)
        } else {
            begins == u32::from(schedule.gains_at)
        };
        if gains_turn {
            self.turn_gains();
        }
    }

    #[inline(never)]
    pub fn turn_gains(&mut self) {
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
    pub fn serve_carefully(&mut self, index: usize, read: bool) {
        let of = parameter_of(index, self.parameters);
        if read && self.parameters.get(of).is_some_and(|parameter| parameter.stale) {
            self.read_variances(of, self.parameters.len());
        }
        let Frame { common, progress, axes } = &mut *self.frame;
        let (Some(axis), Some(parameter)) = (axes.get_mut(index), self.parameters.get_mut(of)) else { return };
        parameter.read(progress.is_settled(common));
        let clocks = Clocks { identifier: &progress.identifier, observer: &progress.observer };
        axis.follow(parameter, clocks, common);
    }

    /// The variances that are due, of the parameter `of` and of every `step`-th one after it.
    #[inline(never)]
    pub fn read_variances(&mut self, mut of: usize, step: usize) {
        let Frame { common, progress, axes } = &*self.frame;
        let beside = Misfit::beside(common.expected_misfit(&progress.identifier));
        let pooled = self.parameters.len() == 1;
        while let Some(parameter) = self.parameters.get_mut(of) {
            let whose = if pooled { 0..axes.len() } else { of..of + 1 };
            if parameter.stale
                && let Some(whose) = axes.get(whose)
            {
                read_variance_of(whose, beside, parameter, common);
            }
            of += step;
        }
    }
}

/// The variance of a parameter out of what its axes contribute to `sum`, in which there is nothing yet.
#[inline(never)]
fn read_variance_of(axes: &[Axis], mut sum: Misfit, parameter: &mut ParameterState, common: &Common) {
    for axis in axes {
        axis.add_misfit(&mut sum, common.covariance.per_stride);
    }
    parameter.read_variance(sum.known_variance(), common.identifier.scale2());
    parameter.compare(sum.unexplained, common.max_misfit * sum.signal);
}
