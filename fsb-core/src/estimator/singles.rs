//! Blocks of one sample: every measurement goes through the cascade of its axis, and the rest by turns.

use super::axis::Axis;
use super::design::Common;
use super::identify::SingleRound;
use super::parts::{Frame, Parts, parameter_of};
use super::shared::IdentifierClock;

/// The axis whose coarse step it is, counted down from axis to axis.
struct CoarseTurn {
    until: u32,
    apart: u32,
}

impl CoarseTurn {
    #[inline(always)]
    fn new(clock: &IdentifierClock, common: &Common) -> Self {
        let until = if clock.is_shaped(common) { clock.stride } else { u32::MAX };
        Self { until, apart: u32::from(common.schedule.staggered) }
    }

    /// Whether it is the next axis's.
    #[inline(always)]
    fn next(&mut self) -> bool {
        self.until = self.until.wrapping_sub(self.apart);
        self.until == 0
    }
}

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
        let mut coarse = CoarseTurn::new(clock, common);
        let of_next = usize::from(self.parameters.len() != 1);
        let mut of = 0;
        for (axis, &mut y) in axes.iter_mut().zip(y) {
            let Some(parameter) = self.parameters.get_mut(of) else { break };
            axis.observe(y, m1, t_l2);
            let z2 = axis.step_single(y, &round);
            axis.read_out(z2, coarse.next(), clock, parameter, common);
            of += of_next;
        }
        self.take_turns_of_singles();
    }

    /// Blocks of one sample, the general way; the observers have gone before.
    #[inline(never)]
    pub fn take_singles(&mut self) {
        let Frame { common, progress, axes } = &mut *self.frame;
        let clock = &mut progress.identifier;
        clock.step(common);
        if clock.blocks == 1 {
            axes.iter_mut().for_each(Axis::take_first_single);
            return self.take_turns_of_singles();
        }
        let round = SingleRound::new(clock, common);
        let mut coarse = CoarseTurn::new(clock, common);
        for (index, axis) in axes.iter_mut().enumerate() {
            let coarse = coarse.next();
            if axis.takes_part()
                && let Some(parameter) = self.parameters.get_mut(parameter_of(index, self.parameters))
            {
                axis.identify_single(&round, coarse, clock, parameter, common);
            }
        }
        self.take_turns_of_singles();
    }

    #[inline(always)]
    fn take_turns_of_singles(&mut self) {
        let Frame { common, progress, .. } = &mut *self.frame;
        let position = progress.identifier.position;
        progress.identifier.position = (position + 1) & 7;
        if common.schedule.events.wrapping_shr(position) & 1 == 1 {
            self.take_turn_of_single(position);
        }
    }

    #[inline(never)]
    fn take_turn_of_single(&mut self, position: u32) {
        let schedule = &self.frame.common.schedule;
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

    /// An axis's turn where blocks are single samples.
    #[inline(always)]
    fn serve_single(&mut self, index: usize) {
        let Frame { common, axes, .. } = &mut *self.frame;
        let of = parameter_of(index, self.parameters);
        if let (Some(axis), Some(parameter)) = (axes.get_mut(index), self.parameters.get_mut(of)) {
            axis.fold_single();
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
                axis.fold_single();
            }
            self.serve_carefully(index, true);
        }
    }
}

impl Axis {
    /// The window is zero, and so is what the cascade makes of the first sample.
    #[inline(always)]
    fn take_first_single(&mut self) {
        if self.takes_part() {
            self.block.single(0.0, self.moments);
            self.missed = 0;
        }
    }

    #[inline(always)]
    fn fold_single(&mut self) {
        self.observer.fold();
        self.cascade.fold();
    }
}
