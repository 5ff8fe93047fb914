//! Measurements that did not come, or cannot be right.

use super::anew::Known;
use super::axis::{Axis, Clocks, Source};
use super::design::Common;
use super::parts::{Frame, Parts, parameter_of};
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
    #[inline(never)]
    pub fn repair_positions(&mut self, y: &mut [f32], m1: f32, t_l2: f32) {
        let Frame { common, progress, axes } = &mut *self.frame;
        progress.all_measured = true;
        // Back from a gap that was too long for the window, or from where it was lost: it takes part from the next window on.
        let (limit, longest) = (common.position_limit, longest_gap(common.late_settle));
        let gone = |axis: &Axis| !axis.measured || axis.present && u32::from(axis.gap) >= longest;
        let back = |axis: &Axis, y: f32| gone(axis) && y.abs() <= limit;
        let reopen = progress.identifier.blocks > 0 && axes.iter().zip(y.iter()).any(|(axis, y)| back(axis, *y));
        for (index, (axis, y)) in axes.iter_mut().zip(y.iter_mut()).enumerate() {
            let parameter = self.parameters.get_mut(parameter_of(index, self.parameters));
            if y.abs() <= common.position_limit {
                if axis.measured && axis.gap > 0 {
                    axis.come_back(*y, m1, t_l2, common);
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
            axis.go_missing(common);
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
            if short && matches!(axis.source, Source::Nothing | Source::Provisional) {
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
        if reopen {
            self.begin_window(Known::Kept);
        }
        self.heed_contact();
    }
}

impl Axis {
    /// Before the step with what stands in for a measurement. At first that is off by what the last one was off by.
    fn go_missing(&mut self, common: &Common) {
        let (share, per_length) = (common.covariance.share(), common.block.per_length);
        self.noise.miss(share * per_length);
        if self.gap == 0 {
            self.noise.come_back(1.0, 2.0 * self.observer.innovation(), share * (per_length * per_length));
        }
    }

    /// Before the step with `y`, the first measurement after a gap.
    fn come_back(&mut self, y: f32, m1: f32, t_l2: f32, common: &Common) {
        let gap = f32::from(self.gap);
        let off = y - self.observer.predict(self.moments, &self.model, m1);
        // A mean over a block has so much less of it.
        let per_length = common.block.per_length;
        self.noise.come_back(gap, off, common.covariance.share() * (per_length * per_length));
        self.observer.come_back(gap, off, t_l2);
    }
}
