//! What is done between two rows of the regression, a few items at each measurement:
//!
//! 1. each axis takes its row in, and names the columns that may take part;
//! 2. k with all of those;
//! 3. each axis drops the columns that this k cannot tell well enough;
//! 4. k with what is left, and its status;
//! 5. each axis's D and d for that k, and the observer's model.
//!
//! Columns dropped count as zero. An axis that is not excited beyond hover therefore says of k what gravity says, and does
//! not spoil it for the others.

use super::axis::{Axis, Columns, Source};
use super::clock::Clock;
use super::design::{Common, items};
use super::model::DragModel;
use super::pooled::{Pooled, read};
use super::seed::seed;
use super::triangle::Estimate;

/// ẑv has a part of its own where more of its energy than this is not a constant's: above what rounding leaves.
const OWN_SHARE: f32 = 1e-6;
/// The square of two thirds: how far the excitation may fall before a column that is used no longer is.
const EXCITATION_STAYS: f32 = 4.0 / 9.0;
/// Twice the standard deviation, likewise.
const VARIANCE_STAYS: f32 = 4.0;

/// The items that fall to the present measurement.
pub(super) fn take(axes: &mut [Axis], pooled: &mut Pooled, clock: &mut Clock, common: &Common) {
    let first = clock.phase * common.items_per_measurement;
    let end = items(axes.len() as u32).min(first.saturating_add(common.items_per_measurement));
    for item in first..end {
        one(item as usize, axes, pooled, clock, common);
    }
    clock.phase = if clock.phase + 1 >= common.row_every { 0 } else { clock.phase + 1 };
}

fn one(item: usize, axes: &mut [Axis], pooled: &mut Pooled, clock: &Clock, common: &Common) {
    let n = axes.len();
    if item == n {
        pooled.trial = read(axes, common);
    } else if item == 2 * n + 1 {
        pooled.settle(axes, clock.count >= common.parameter_settle, common);
    } else if item < n {
        if let Some(axis) = axes.get_mut(item) {
            axis.collect(clock, common);
            axis.nominate(pooled, common);
        }
    } else if item <= 2 * n {
        if let Some(axis) = axes.get_mut(item - n - 1) {
            axis.choose(pooled.trial, n as f32, common);
        }
    } else if let Some(axis) = axes.get_mut(item - 2 * n - 2) {
        axis.settle(pooled, clock, common);
    }
}

impl Axis {
    /// The columns that may take part: asked for, with a part of their own, on an axis excited beyond hover.
    fn nominate(&mut self, pooled: &Pooled, common: &Common) {
        let asked = self.own.identify;
        let rows = self.triangle.rows();
        let moving = self.triangle.motion_share() > OWN_SHARE;
        let drag = asked.drag && moving;
        let with_all = self.triangle.keep(asked.disturbance, drag);
        let k = pooled.newest().value;
        let excitation2 = k * k * with_all.information() / rows;
        let stays = if self.used.count() > 0.0 { EXCITATION_STAYS } else { 1.0 };
        let excited = excitation2 >= stays * common.excitation2;
        self.keep(Columns { drag: drag && excited, disturbance: asked.disturbance && excited });
    }

    /// Drops, worst first, what k as it is known with all candidates cannot tell.
    fn choose(&mut self, k: Estimate, sharing: f32, common: &Common) {
        let mut kept = self.columns;
        self.weigh(k.value, sharing, common);
        while kept.count() > 0.0 {
            let (drag, disturbance) = self.terms(k);
            let drag_excess = if kept.drag { excess(&drag, common.drag_variance, self.used.drag) } else { 0.0 };
            let disturbance_excess = if kept.disturbance {
                excess(&disturbance, common.disturbance_variance, self.used.disturbance)
            } else {
                0.0
            };
            let steep = kept.drag && !(drag.value.abs() * common.period <= DragModel::LARGEST_DELTA);
            if drag_excess <= 1.0 && disturbance_excess <= 1.0 && !steep {
                break;
            }
            if steep || drag_excess >= disturbance_excess {
                kept.drag = false;
            } else {
                kept.disturbance = false;
            }
            self.keep(kept);
            self.weigh(k.value, sharing, common);
        }
        self.used = kept;
    }

    fn keep(&mut self, columns: Columns) {
        self.columns = columns;
        self.reduced = self.triangle.keep(columns.disturbance, columns.drag);
    }

    /// What the variance of the residual is worth, for this k: rows are not independent, and what the unknowns have taken
    /// does not count.
    pub fn weigh(&mut self, k: f32, sharing: f32, common: &Common) {
        let rows = self.triangle.rows() * common.per_scale2;
        let worth = rows - common.colour * (self.columns.count() + 1.0 / sharing);
        let variance = common.colour * self.reduced.residual(k) / worth;
        self.row_variance = if worth > 0.0 && variance >= 0.0 { variance } else { f32::MAX };
    }

    /// D and d for this k; zero where they do not take part.
    fn terms(&self, k: Estimate) -> (Estimate, Estimate) {
        let row_variance = self.row_variance;
        let drag = if self.columns.drag { self.reduced.drag(k, row_variance) } else { Estimate::default() };
        let disturbance = if self.columns.disturbance {
            self.reduced.disturbance(k, drag.value, row_variance)
        } else {
            Estimate::default()
        };
        (drag, disturbance)
    }

    fn settle(&mut self, pooled: &Pooled, clock: &Clock, common: &Common) {
        let known = pooled.newest();
        (self.drag, self.disturbance) = self.terms(known);
        let k = if let Some(k) = pooled.valid().map(|k| k.value) {
            let drift = self.own.drift + self.disturbance.value;
            let model = DragModel::new(k, self.drag.value, drift, &common.observer);
            if self.source != Source::Identified && self.present && !seed(self, k, &model, clock, common) {
                return;
            }
            self.source = Source::Identified;
            self.model = model;
            return;
        } else if common.nominal.is_some() {
            self.follow_nominal(common);
            return;
        } else if let Some(k) = pooled.credible() {
            self.source = Source::Provisional;
            k
        } else {
            self.source = Source::Nothing;
            self.model = DragModel::default();
            return;
        };
        self.model = DragModel::new(k, 0.0, self.own.drift, &common.observer);
    }

    /// The configured k0 predicts, if there is one.
    pub fn follow_nominal(&mut self, common: &Common) {
        if let Some(k) = common.nominal {
            self.source = Source::Nominal;
            self.model = DragModel::new(k, 0.0, self.own.drift, &common.observer);
        }
    }
}

/// The variance over its limit; more than any limit where it is none.
fn excess(estimate: &Estimate, limit: f32, used: bool) -> f32 {
    let share = estimate.variance / if used { VARIANCE_STAYS * limit } else { limit };
    if estimate.value.is_finite() && share.is_finite() { share } else { f32::MAX }
}
