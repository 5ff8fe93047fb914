//! Measurements that did not come, or cannot be right.

use super::anew::Known;
use super::axis::{Axis, Clocks, Marks, Source};
use super::design::Common;
use super::parts::{Frame, Parts, parameter_of};
use super::shared::Progress;
use crate::identifier::longest_gap;

impl Parts<'_> {
    pub fn count_missing(&mut self, y: &[f32]) {
        let Frame { common, progress, .. } = &mut *self.frame;
        for y in y {
            if y.abs() <= common.position_limit {
                continue;
            }
            progress.counters.missed = progress.counters.missed.saturating_add(1);
            if !y.is_nan() {
                progress.counters.rejected_measurements = progress.counters.rejected_measurements.saturating_add(1);
            }
        }
    }

    /// First measurements, missing ones, and ones that cannot be right. `m1` is that of the sample before, `t_l2` that of this one.
    /// Returns whether an axis is back from a gap.
    #[inline(never)]
    pub fn repair_positions(&mut self, y: &mut [f32], m1: f32, t_l2: f32) -> bool {
        let Frame { common, progress, axes } = &mut *self.frame;
        progress.all_measured = true;
        // Back from a gap that was too long for the window, or from where it was lost: it takes part from the next window on.
        let (limit, longest) = (common.position_limit, longest_gap(common.late_settle));
        let gone = |axis: &Axis| !axis.measured || axis.present && u32::from(axis.gap) >= longest;
        let back = |axis: &Axis, y: f32| gone(axis) && y.abs() <= limit;
        let mut back_after = 0;
        let reopen = progress.identifier.blocks > 0 && axes.iter().zip(y.iter()).any(|(axis, y)| back(axis, *y));
        for (index, (axis, y)) in axes.iter_mut().zip(y.iter_mut()).enumerate() {
            let parameter = self.parameters.get_mut(parameter_of(index, self.parameters));
            if y.abs() <= common.position_limit {
                if axis.measured && axis.gap > 0 {
                    back_after = axis.gap.max(back_after);
                    axis.come_back(*y, m1, t_l2, progress, common);
                }
                axis.gap = 0;
                if !axis.measured {
                    let late = if progress.observer.count > 0 { common.late_settle } else { 1 };
                    let settled_at = progress.observer.count.saturating_add(late.max(common.state_settle));
                    axis.measure_first(*y, settled_at);
                    // A late one may find a parameter that the others have identified.
                    let late = progress.observer.count > 0 && axis.source == Source::Nominal;
                    if (late || axis.source == Source::Nothing)
                        && let Some(parameter) = parameter
                    {
                        let clocks = Clocks { identifier: &progress.identifier, observer: &progress.observer };
                        axis.change_source(parameter, clocks, common);
                    }
                }
                continue;
            }
            axis.missed = axis.missed.saturating_add(1);
            axis.go_missing(progress, common);
            axis.gap = axis.gap.saturating_add(1);
            if axis.measured && u32::from(axis.gap) == progress.observer.count {
                axis.settled_at = common.settled_after(progress.observer.count);
                axis.decide_use();
            }
            let mut predicted = axis.observer.predict(axis.moments, &axis.model, m1);
            // With no parameter the innovation is what the input does, and goes on for a time of 1/λ. Without it the predictions
            // would say that the input does nothing, and k̂ would be taken in by them.
            let gap = f32::from(axis.gap);
            let short = gap * gap * progress.observer.gains.t_l2() <= 1.0;
            if short && !axis.marks.has(Marks::LEAPT) && matches!(axis.source, Source::Nothing | Source::Provisional) {
                predicted += axis.observer.innovation();
            }
            if axis.measured && predicted.abs() <= common.position_limit {
                *y = predicted;
            } else {
                // Never measured, or predicted out of all bounds: lost until it is measured again.
                if axis.present
                    && let Some(parameter) = parameter
                {
                    parameter.leave();
                }
                axis.measured = false;
                axis.present = false;
                axis.observer.start(0.0);
                axis.decide_use();
                *y = 0.0;
            }
            progress.all_measured = false;
        }
        if back_after > 0 {
            // What was missed among the first is in the state for as long as the observer remembers the start.
            progress.observer.note_gap(back_after, common.late_settle);
        }
        if reopen {
            self.begin_window(Known::Kept);
        }
        self.heed_contact();
        back_after > 0
    }
}

impl Axis {
    /// Before the step with what stands in for a measurement. At first that is off by what the last one was off by.
    #[cold]
    #[inline(never)]
    fn go_missing(&mut self, progress: &Progress, common: &Common) {
        let share = common.covariance.share(progress.identifier.blocks);
        let per_length = common.block.per_length;
        self.noise.miss(share * per_length);
        if self.gap == 0 {
            self.noise.come_back(1.0, 1.0, 2.0 * self.observer.innovation(), share * (per_length * per_length));
        }
    }

    /// Before the step with `y`, the first measurement after a gap.
    #[cold]
    #[inline(never)]
    fn come_back(&mut self, y: f32, m1: f32, t_l2: f32, progress: &Progress, common: &Common) {
        let gap = f32::from(self.gap);
        self.marks.set(Marks::LEAPT, gap * gap * progress.observer.gains.t_l2() > 1.0);
        if self.marks.has(Marks::OWES) && common.block_length > 1 {
            // Begins with it: the block is looked at as one with a gap.
            self.missed = self.missed.max(1);
        }
        let off = y - self.observer.predict(self.moments, &self.model, m1);
        // While there is something of the start in the state, what is predicted is off by the same for as long as that lasts: all the time so
        // far, up to 1/λ.
        let starting = progress.observer.came(0) < common.late_settle;
        let longest = longest_gap(common.late_settle);
        let lasting = if starting { progress.observer.count.min(longest) as f32 } else { 0.0 };
        let share = common.covariance.share(progress.identifier.blocks);
        // A mean over a block has so much less of it.
        let per_length = common.block.per_length;
        let lasting = if gap > lasting { gap } else { lasting };
        self.noise.come_back(gap, lasting, off, share * (per_length * per_length));
        self.observer.come_back(gap, off, t_l2);
    }
}
