//! What is done between two rows of the regression, a few items at each measurement:
//!
//! 1. each axis takes its row in, and names the columns that may take part;
//! 2. k with all of those;
//! 3. each axis drops the columns that this k cannot tell well enough;
//! 4. k with what is left, and its status;
//! 5. each axis's D and d for that k, and the observer's model.
//!
//! Columns dropped count as zero, but for d on an axis without a known drift: there a constant force is one against d, and says
//! nothing of k. An axis that is not excited beyond hover therefore says of k what gravity says, as far as it is
//! gravity alone that acts: what a column dropped may be is in the variance of k, and in the weight that the axis has in it.
//! The prediction takes d as k leaves it, told or not.

use super::axis::{Axis, Columns, Source};
use super::clock::Clock;
use super::config::Identify;
use super::design::{Common, items};
use super::model::DragModel;
use super::pooled::{Pooled, read};
use super::reduced::{Estimate, Unknown};
use super::seed::seed;

/// The square of two thirds: how far the excitation may fall before a column that is used no longer is.
const EXCITATION_STAYS: f32 = 4.0 / 9.0;
/// Twice the standard deviation, likewise.
const VARIANCE_STAYS: f32 = 4.0;
/// What is left at least of an axis's information.
const LEAST_SHARE: f32 = 1e-6;
/// The square of a quarter. In the weights of the axes a term left out is taken to be that much smaller than it may be: white
/// noise is not all that is wrong with an axis that moves, and gravity is a good witness.
const TRUST2: f32 = 1.0 / 16.0;

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
            axis.choose(pooled.trial, common);
        }
    } else if let Some(axis) = axes.get_mut(item - 2 * n - 2) {
        axis.settle(pooled, clock, common);
    }
}

impl Axis {
    /// The columns that may take part: asked for, with a part of their own, on an axis excited beyond hover.
    fn nominate(&mut self, pooled: &Pooled, common: &Common) {
        let Identify { drag, disturbance } = self.own.identify;
        let asked = Columns { drag: drag && self.triangle.is_moving(), disturbance };
        let k = pooled.newest().value;
        // Beyond a constant, whether d is asked for or not.
        let information = self.triangle.keep(true, asked.drag, common.row_rate2).information();
        let excitation2 = k * k * (information / self.triangle.constant());
        let stays = if self.used.count() > 0.0 { EXCITATION_STAYS } else { 1.0 };
        self.excited = excitation2 >= stays * common.excitation2;
        // More independent rows than unknowns, or the residual says nothing.
        let enough = self.rows(common) > common.colour * (asked.count() + 1.0);
        self.keep(if self.excited && enough { asked } else { Columns::default() }, common);
    }

    /// Drops, worst first, what k as it is known with all candidates cannot tell.
    fn choose(&mut self, k: Estimate, common: &Common) {
        let mut kept = self.columns;
        self.weigh(k.value, common);
        while kept.count() > 0.0 {
            let (drag, disturbance) = self.terms(k, common);
            let drag_excess = match kept.drag {
                // Also where it is more than is handed out: left out it would be taken for mass.
                true => excess(&drag, common.drag_variance, self.used.drag),
                false => 0.0,
            };
            let disturbance_excess = match kept.disturbance {
                true if is_gentle(&disturbance) => {
                    excess(&disturbance, common.disturbance_variance, self.used.disturbance)
                }
                true => f32::MAX,
                false => 0.0,
            };
            if drag_excess <= 1.0 && disturbance_excess <= 1.0 {
                break;
            }
            if drag_excess >= disturbance_excess {
                kept.drag = false;
            } else {
                kept.disturbance = false;
            }
            self.keep(kept, common);
            self.weigh(k.value, common);
        }
    }

    fn keep(&mut self, columns: Columns, common: &Common) {
        self.columns = columns;
        // Where nothing constant is known to pull, a constant force is one against d, which may be there without being told.
        let constant = columns.disturbance || (self.own.identify.disturbance && self.own.drift == 0.0);
        self.reduced = self.triangle.keep(constant, columns.drag, common.row_rate2);
        self.reduced.set_gusts(&common.gusts, self.triangle.constant());
        self.reduced.set_rule(common.trapezoid * self.triangle.v_steps());
    }

    /// The rows taken in, as far as the window was open: the noise of ẑ2 grows faster with it than its signals do.
    fn rows(&self, common: &Common) -> f32 {
        self.triangle.opening() * common.per_scale
    }

    /// The variance of the residual for this k.
    pub fn weigh(&mut self, k: f32, common: &Common) {
        // By terms left out this axis's own k may differ from that of all of them: no matter of noise.
        let (residual, taken) = if self.untold(common) > 0.0 {
            (self.reduced.least_residual(), 1.0)
        } else {
            (self.reduced.residual(k), self.share)
        };
        self.row_variance = self.variance(residual, taken, common);
    }

    /// The variance of the residual for the k that this axis alone says.
    pub fn own_variance(&self, common: &Common) -> f32 {
        self.variance(self.reduced.least_residual(), 1.0, common)
    }

    /// Rows are not independent, and those that the unknowns have taken do not count; `taken` is the part of k's.
    fn variance(&self, residual: f32, taken: f32, common: &Common) -> f32 {
        let rows = self.rows(common);
        let taken = common.colour * (self.columns.count() + taken);
        let worth = rows - taken;
        // In motion the model may be wrong by more than hover shows, however long that was.
        let uneven = if self.excited { self.triangle.uneven(rows, taken) } else { 0.0 };
        let variance = common.colour * (residual + uneven) / worth * self.stretch2();
        if worth > 0.0 && variance >= 0.0 { variance } else { f32::MAX }
    }

    /// What D and d may be where they are asked for.
    fn unknown(&self, common: &Common) -> Unknown {
        let Identify { drag, disturbance } = self.own.identify;
        Unknown {
            drag_variance: if drag { common.drag_prior } else { 0.0 },
            disturbance_variance: if disturbance { common.disturbance_prior } else { 0.0 },
        }
    }

    /// The variance of this axis's k by the terms that are asked for and left out.
    fn untold(&self, common: &Common) -> f32 {
        self.reduced.k_untold(&self.unknown(common))
    }

    /// The square of what noise fed back pulls this axis's k by: ½ Σ var ẑ2/Σ (k ẑ0)² of it (design, section 12).
    fn pulled(&self) -> f32 {
        if self.excited {
            return 0.0;
        }
        let share = self.reduced.least_residual() / self.reduced.information();
        0.25 * share * share / (self.reduced.k() * self.reduced.k())
    }

    /// What a controller that answers gusts pulls this axis's k by at the most, times k.
    pub fn answered(&self, common: &Common) -> f32 {
        common.gusts.answered * self.triangle.constant() / self.reduced.information()
    }

    /// The variance of this axis's k, but for what answers gusts, which all axes have alike.
    pub fn k_variance(&self, common: &Common) -> f32 {
        self.reduced.k_variance(self.row_variance) + self.untold(common) + self.pulled()
    }

    /// What this axis counts for in k, `row_variance` being that of the noisiest one: the information, of which terms left out
    /// and noise fed back leave the less, the more of it there is.
    pub fn weight(&self, row_variance: f32, common: &Common) -> f32 {
        let information = self.reduced.information();
        let variance = (row_variance + common.gusts.row) / information;
        let bias = TRUST2 * self.untold(common) + self.pulled();
        let share = if bias > 0.0 { variance / (variance + bias) } else { 1.0 };
        // Without noise, too, something is left: it may be all there is.
        information * if share > LEAST_SHARE { share } else { LEAST_SHARE }
    }

    /// D and d for this k; zero where they do not take part.
    fn terms(&self, k: Estimate, common: &Common) -> (Estimate, Estimate) {
        let (row_variance, unknown) = (self.row_variance, self.unknown(common));
        let (mut drag, mut disturbance) = <(Estimate, Estimate)>::default();
        if self.columns.drag {
            drag = self.reduced.drag(k, row_variance);
            drag.variance += self.reduced.drag_untold(&unknown);
        }
        if self.columns.disturbance {
            disturbance = self.reduced.disturbance(k, drag.value, row_variance);
            disturbance.variance += self.reduced.disturbance_untold(&unknown);
        }
        (drag, disturbance)
    }

    fn settle(&mut self, pooled: &Pooled, clock: &Clock, common: &Common) {
        let known = pooled.newest();
        // With their values, measurements after they were chosen.
        self.used = self.columns;
        (self.drag, self.disturbance) = self.terms(known, common);
        if !(is_slight(&self.drag, common) && is_gentle(&self.disturbance)) {
            // Another k than the one they were chosen with has thrown them off.
            (self.drag, self.disturbance, self.used) = Default::default();
        }
        let k = if let Some(k) = pooled.valid().map(|k| k.value) {
            let drift =
                self.own.drift + if self.used.disturbance { self.disturbance.value } else { self.lean(k, common) };
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

    /// d as this k has it, for predicting: be k wrong by what is not told of d, the force and d together are what acts.
    fn lean(&self, k: f32, common: &Common) -> f32 {
        if !self.own.identify.disturbance {
            return 0.0;
        }
        let reduced = self.triangle.keep(true, self.used.drag, common.row_rate2);
        let d = reduced.disturbance(Estimate { value: k, variance: 0.0 }, self.drag.value, self.row_variance);
        if d.variance <= common.disturbance_variance && is_gentle(&d) { d.value } else { 0.0 }
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
    if share.is_finite() { share } else { f32::MAX }
}

/// Whether D is one that the model holds for.
fn is_slight(drag: &Estimate, common: &Common) -> bool {
    drag.value.abs() * common.period <= DragModel::LARGEST_DELTA && drag.variance.is_finite()
}

/// Whether d is within what a known drift may be.
fn is_gentle(disturbance: &Estimate) -> bool {
    disturbance.value.abs() <= 1e6 && disturbance.variance.is_finite()
}
