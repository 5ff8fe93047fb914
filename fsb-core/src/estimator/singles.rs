//! Blocks of one sample: every measurement goes through the cascade of its axis, and the rest by turns.

use super::axis::{Axis, Marks, Source};
use super::identify::SingleRound;
use super::parts::{Frame, Parts, parameter_of};

impl Parts<'_> {
    /// [`Pace::Singles`](super::shared::Pace::Singles).
    #[inline(never)]
    pub fn advance_singles(&mut self, y: &mut [f32]) {
        let Frame { common, progress, axes } = &mut *self.frame;
        // One comparison for all; the general way looks at each.
        let within = y.iter().map(|y| y.abs()).sum::<f32>() <= common.position_limit;
        if !within {
            return self.advance(y);
        }
        let m1 = progress.observer.gains.m1();
        progress.observer.gains = progress.observer.next(common);
        progress.substep = 0;
        let t_l2 = progress.observer.gains.t_l2();
        let clock = &mut progress.identifier;
        clock.step(common);
        let round = SingleRound::new(clock, common);
        // One for each axis, or one for all.
        let mut others = self.parameters.iter_mut();
        let Some(mut parameter) = others.next() else { return };
        for (axis, &mut y) in axes.iter_mut().zip(y) {
            axis.observe(y, m1, t_l2);
            let z2 = axis.step_single(y, &round);
            axis.add_single(z2, parameter, common);
            if let Some(next) = others.next() {
                parameter = next;
            }
        }
        self.take_turns_of_singles();
    }

    /// Blocks of one sample, the general way; the observers have gone before.
    #[inline(never)]
    pub fn take_singles(&mut self) {
        let Frame { common, progress, axes } = &mut *self.frame;
        progress.identifier.step(common);
        let settled = progress.is_settled(common);
        let clock = &progress.identifier;
        let round = SingleRound::new(clock, common);
        for (index, axis) in axes.iter_mut().enumerate() {
            let of = parameter_of(index, self.parameters);
            if !axis.takes_part() {
                continue;
            }
            if clock.blocks == 1 {
                // The window is zero, and so is what the cascade makes of the first sample.
                axis.block.single(0.0, axis.moments);
                if settled && let Some(parameter) = self.parameters.get_mut(of) {
                    parameter.read(settled);
                }
                continue;
            }
            let z2 = axis.step_single(axis.observer.measurement(), &round);
            // The window is zero in the first two samples; a prediction says nothing that was not known.
            if axis.missed == 0
                && clock.blocks > 2
                && let Some(parameter) = self.parameters.get_mut(of)
            {
                axis.add_single(z2, parameter, common);
            }
        }
        self.take_turns_of_singles();
        self.frame.axes.iter_mut().for_each(|axis| axis.missed = 0);
    }

    #[inline(always)]
    fn take_turns_of_singles(&mut self) {
        let Frame { common, progress, axes } = &*self.frame;
        // The axis that takes its coarse step, or the first of them.
        let staggered = common.schedule.staggered;
        let coarse = progress.identifier.stride.wrapping_sub(staggered.into()) as usize;
        if coarse < if staggered { axes.len() } else { 1 } && progress.identifier.is_shaped(common) {
            self.step_singles_coarsely(coarse);
        }
        let Frame { common, progress, .. } = &mut *self.frame;
        let position = progress.identifier.position;
        progress.identifier.position = (position + 1) & (common.schedule.round - 1);
        if common.schedule.events.wrapping_shr(position) & 1 == 1 {
            self.take_turn_of_single(position);
        }
    }

    /// The coarse step of an axis, or of all of them where they do not take them one after the other.
    #[inline(never)]
    fn step_singles_coarsely(&mut self, index: usize) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let of = if common.schedule.staggered { index..index + 1 } else { 0..axes.len() };
        for index in of {
            let of = parameter_of(index, self.parameters);
            if let (Some(axis), Some(parameter)) = (axes.get_mut(index), self.parameters.get_mut(of))
                && axis.present
            {
                if axis.missed == 0 {
                    axis.step_coarsely(&progress.identifier, parameter, common);
                } else {
                    axis.marks.set(Marks::OWES, true);
                }
            }
        }
    }

    /// What fell to samples that were missing.
    #[inline(never)]
    pub fn make_up(&mut self) {
        let Frame { common, progress, axes } = &mut *self.frame;
        for (index, axis) in axes.iter_mut().enumerate() {
            if let Some(parameter) = self.parameters.get_mut(parameter_of(index, self.parameters)) {
                axis.make_up(&progress.identifier, parameter, common);
            }
        }
    }

    #[inline(never)]
    fn take_turn_of_single(&mut self, position: u32) {
        let schedule = &self.frame.common.schedule;
        let (half, reads_turn) = (schedule.gains_every, position == u32::from(schedule.reads_at));
        if position & (half - 1) == 0 {
            self.turn_gains();
        }
        if self.frame.common.schedule.unhurried {
            self.serve_all_singles();
        } else {
            if reads_turn && self.parameters.len() == 1 {
                self.read_variances(0, 1);
            }
            let before = position.wrapping_sub(1);
            self.serve_single((before & (half - 1)) as usize, before & half != 0);
        }
    }

    /// An axis's turn where blocks are single samples: in the second half of a round, and in the first one as well when its
    /// parameter is becoming valid.
    #[inline(always)]
    fn serve_single(&mut self, index: usize, regularly: bool) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let settled = progress.is_settled(common);
        let of = parameter_of(index, self.parameters);
        let pooled = self.parameters.len() == 1;
        if let (Some(axis), Some(parameter)) = (axes.get_mut(index), self.parameters.get_mut(of)) {
            let mut due = false;
            if regularly {
                axis.fold_single();
                due = parameter.stale && !pooled;
                if !due && axis.follow_on(parameter, common) {
                    return;
                }
            } else if axis.source == Source::Identified || !parameter.may_be_valid(settled) {
                return;
            }
            self.serve_carefully(index, due);
        }
    }

    /// All axes, where there is time enough.
    #[inline(never)]
    fn serve_all_singles(&mut self) {
        for index in 0..self.frame.axes.len() {
            if let Some(axis) = self.frame.axes.get_mut(index) {
                axis.fold_single();
            }
            self.serve_carefully(index, true);
        }
    }
}

impl Axis {
    #[inline(never)]
    fn fold_single(&mut self) {
        self.observer.fold();
        self.cascade.fold();
    }
}
