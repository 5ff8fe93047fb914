//! The calls of a tick: [`DragEstimator::measure`] and [`DragEstimator::apply`].

use super::DragEstimator;
use super::axis::Axis;
use super::turns;
use crate::estimator::OutOfStep;
use crate::identifier::longest_gap;
use crate::moments::InputMoments;

impl<const N: usize> DragEstimator<N> {
    /// The positions (m) at the present measurement instant; `None` for an axis whose measurement is missing.
    ///
    /// It starts at the first instant at which every axis is measured; what comes before only counts.
    ///
    /// # Errors
    /// [`OutOfStep`] where fewer than `substeps` inputs were applied since the last instant; nothing has changed then.
    pub fn measure(&mut self, positions: &[Option<f32>; N]) -> Result<(), OutOfStep> {
        if self.clock.started && self.clock.substep < self.common.substeps {
            return Err(OutOfStep { missing: self.common.substeps - self.clock.substep });
        }
        self.advance(positions);
        Ok(())
    }

    /// The inputs (N) held over the control period that begins now. Before the first measurement nothing happens.
    pub fn apply(&mut self, inputs: &[f32; N]) {
        if self.begin_substep() {
            let inputs = self.repaired(inputs);
            self.begin_moments();
            for (axis, f) in self.axes.iter_mut().zip(inputs) {
                axis.moments.hold(f, &self.common.substep);
            }
            self.clock.substep += 1;
        }
    }

    /// As [`apply`](Self::apply), for inputs that go linearly from `from` to `to` over the control period.
    pub fn apply_ramp(&mut self, from: &[f32; N], to: &[f32; N]) {
        if self.begin_substep() {
            let (from, to) = (self.repaired(from), self.repaired(to));
            self.begin_moments();
            for (axis, (from, to)) in self.axes.iter_mut().zip(from.into_iter().zip(to)) {
                axis.moments.ramp(from, to, &self.common.substep);
            }
            self.clock.substep += 1;
        }
    }

    fn advance(&mut self, positions: &[Option<f32>; N]) {
        let Self { common, axes, clock, pooled, counters } = self;
        let limit = common.position_limit;
        for position in positions {
            let within = position.is_some_and(|y| y.abs() <= limit);
            counters.missed = counters.missed.saturating_add(u32::from(!within));
            let rejected = position.is_some() && !within;
            counters.rejected_measurements = counters.rejected_measurements.saturating_add(u32::from(rejected));
        }
        if !clock.started {
            if !positions.iter().all(|y| y.is_some_and(|y| y.abs() <= limit)) {
                return;
            }
            for (axis, y) in axes.iter_mut().zip(positions) {
                axis.begin(y.unwrap_or_default(), common.state_settle.max(1));
            }
        }
        let m1 = clock.gains.m1();
        if clock.started {
            clock.advance(common);
        }
        let longest = longest_gap(common.late_settle);
        if axes.iter().zip(positions).any(|(axis, y)| axis.is_back(*y, longest, limit)) {
            clock.begin_window();
            axes.iter_mut().for_each(Axis::begin_window);
        }
        clock.weigh(common);
        for ((axis, y), index) in axes.iter_mut().zip(positions).zip(0..) {
            let mut y = y.unwrap_or(f32::NAN);
            axis.repair(&mut y, m1, clock, common);
            if clock.started {
                axis.observer.correct(y, axis.moments, &axis.model, m1, clock.gains.t_l2());
            }
            if axis.present {
                axis.identify(y, clock, common);
            }
            if clock.folds(index) {
                axis.fold();
            }
        }
        clock.started = true;
        clock.substep = 0;
        turns::take(axes, pooled, clock, common);
    }

    /// Goes past a measurement instant at which nothing was measured. False before the first measurement.
    fn begin_substep(&mut self) -> bool {
        if self.clock.started && self.clock.substep >= self.common.substeps {
            self.advance(&[None; N]);
        }
        self.clock.started
    }

    fn begin_moments(&mut self) {
        if self.clock.substep == 0 {
            for axis in &mut self.axes {
                axis.moments = InputMoments::ZERO;
            }
        }
    }

    /// The inputs, a rejected one replaced by the mean of the axis's input over the interval so far.
    fn repaired(&mut self, inputs: &[f32; N]) -> [f32; N] {
        let Self { common, axes, clock, counters, .. } = self;
        // j1 is the mean of the interval before, or the part of the present one's that is known.
        let periods = if clock.substep == 0 { common.substeps } else { clock.substep };
        let share = periods as f32 * common.substep_share;
        let mut repaired = *inputs;
        for (f, axis) in repaired.iter_mut().zip(axes) {
            if f.abs() <= common.input_limit {
                continue;
            }
            counters.rejected_inputs = counters.rejected_inputs.saturating_add(1);
            *f = axis.moments.j1 / share;
        }
        repaired
    }
}
