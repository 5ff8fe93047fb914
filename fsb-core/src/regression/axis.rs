//! The state of one axis, and its steps at a measurement.

use super::clock::Clock;
use super::design::{AxisDesign, Common};
use super::model::{DragModel, DragObserver};
use super::reduced::{Estimate, Reduced};
use super::triangle::{Row, Triangle};
use super::velocity::VelocityCascade;
use crate::identifier::{BlockMeans, Cascade};
use crate::moments::InputMoments;

/// Where most measurements are missing, the residuals tell of the predictions as well.
const STRETCH: f32 = 3.0;

/// What predicts this axis at present.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Source {
    /// Nothing credible: constant velocity.
    #[default]
    Nothing,
    /// The newest quotient, not valid yet: good enough to stand in for a missed sample, not handed out.
    Provisional,
    /// The configured k0.
    Nominal,
    /// k̂ with D and d, the observer having been seeded with them.
    Identified,
}

/// Which of an axis's own unknowns take part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Columns {
    pub drag: bool,
    pub disturbance: bool,
}

impl Columns {
    pub const fn count(self) -> f32 {
        (self.drag as u8 + self.disturbance as u8) as f32
    }
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Axis {
    pub observer: DragObserver,
    pub model: DragModel,
    /// Input over the last measurement interval, or over the present one as far as it is known.
    pub moments: InputMoments,
    block: BlockMeans,
    /// The first position, subtracted from all.
    pub origin: f32,
    pub cascade: Cascade,
    pub velocity: VelocityCascade,
    pub triangle: Triangle,
    /// The triangle without the columns that do not take part, and those that do.
    pub reduced: Reduced,
    pub columns: Columns,
    /// The columns that took part in the end, this round or the one before.
    pub used: Columns,
    /// Excited beyond hover.
    pub excited: bool,
    /// What part of the information on k is this axis's.
    pub share: f32,
    /// Variance that a row, taken as independent of the others, has. Scaled.
    pub row_variance: f32,
    pub drag: Estimate,
    pub disturbance: Estimate,
    /// The measurement count from which on the state may be handed out, if there is something to predict it with.
    pub settled_at: u32,
    /// Measurements replaced since the last row.
    missed: u32,
    /// Measurements replaced since the last one that came.
    gap: u32,
    /// Σ over the rows of the share of the measurements before each that was replaced.
    absent: f32,
    pub source: Source,
    /// Measured at least once, and not lost since.
    pub measured: bool,
    /// Takes part in the identification: measured from the start and never lost.
    pub present: bool,
    pub own: AxisDesign,
}

impl Axis {
    pub fn start(own: AxisDesign) -> Self {
        Self { own, row_variance: f32::MAX, ..Self::default() }
    }

    /// The first measurement of all.
    pub fn begin(&mut self, y: f32, settle: u32) {
        self.observer.start(y);
        self.origin = y;
        self.measured = true;
        self.present = true;
        self.settled_at = settle;
    }

    /// Whether the measurement `y` is the first one after a gap of `longest` or more, and within its `limit`.
    #[inline(always)]
    pub fn is_back(&self, y: Option<f32>, longest: u32, limit: f32) -> bool {
        self.gap >= longest && self.present && y.is_some_and(|y| y.abs() <= limit)
    }

    /// Forgets what the cascades hold; what was learned stays.
    pub fn begin_window(&mut self) {
        (self.block, self.cascade, self.velocity) = Default::default();
    }

    /// What is measured, or what stands in for it; zero for an axis that is lost. Returns whether it was measured.
    pub fn repair(&mut self, y: &mut f32, m1: f32, clock: &Clock, common: &Common) -> bool {
        if y.abs() <= common.position_limit {
            if self.measured && self.gap > 0 {
                let off = *y - self.observer.predict(self.moments, &self.model, m1);
                self.observer.come_back(self.gap as f32, off, clock.gains.t_l2());
            }
            self.gap = 0;
            if !self.measured {
                self.measured = true;
                self.observer.start(*y);
                self.settled_at = clock.count.saturating_add(common.late_settle.max(common.state_settle));
            }
            return true;
        }
        self.missed = self.missed.saturating_add(1);
        self.gap = self.gap.saturating_add(1);
        let mut predicted = self.observer.predict(self.moments, &self.model, m1);
        // With no parameter the innovation is what the input does, and goes on for a time of 1/λ, as in the plain estimator.
        let gap = self.gap as f32;
        if gap * gap * clock.gains.t_l2() <= 1.0 && matches!(self.source, Source::Nothing | Source::Provisional) {
            predicted += self.observer.state().innovation();
        }
        if self.measured && predicted.abs() <= common.position_limit {
            *y = predicted;
        } else {
            self.measured = false;
            self.present = false;
            self.observer.start(0.0);
            *y = 0.0;
        }
        false
    }

    /// The cascades' step with the measurement just taken.
    #[inline(always)]
    pub fn identify(&mut self, y: f32, clock: &Clock, common: &Common) {
        let mean = self.block.single(y - self.origin, self.moments);
        self.cascade.step(mean.y, mean.s, &common.identifier, &clock.at);
        self.velocity.step(mean.y, &common.velocity, &clock.velocity_at);
    }

    pub fn fold(&mut self) {
        self.observer.fold();
        self.cascade.fold();
        self.velocity.fold();
    }

    /// The identity of this moment as a row.
    pub fn row(&self, clock: &Clock) -> Row {
        let zu = clock.unit.zu();
        Row { zu, minus_zv: -self.velocity.zv(), z0: self.cascade.z0(), z2: self.cascade.z2() - self.own.drift * zu }
    }

    /// How many times the residuals' mean square counts: one over the share of the measurements that came, squared, nine at most. What
    /// stands in for those that did not is off by the same for a whole gap, and by what was not known of k at its time.
    #[inline(always)]
    pub fn stretch2(&self) -> f32 {
        if self.absent > 0.0 { self.stretched() } else { 1.0 }
    }

    #[inline(never)]
    fn stretched(&self) -> f32 {
        let came = 1.0 - self.absent / self.triangle.count();
        if came > 1.0 / STRETCH { 1.0 / (came * came) } else { STRETCH * STRETCH }
    }

    /// Takes the row of this moment in. One between which and the last every measurement was missed says nothing.
    pub fn collect(&mut self, clock: &Clock, common: &Common) {
        if self.present && self.missed < common.row_every {
            let row = self.row(clock);
            self.triangle.add(&row, common.forgetting);
            if self.missed > 0 || self.absent > 0.0 {
                self.absent += self.missed as f32 * common.per_row_every - common.forgetting * self.absent;
            }
        }
        self.missed = 0;
    }
}
