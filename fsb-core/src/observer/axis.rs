//! One axis of the observer, in innovation form.
//!
//! r\[n\] = y\[n\] - ŷ⁻\[n\] is kept instead of ŷ, and w = T v̂ instead of v̂. With m1 = 1 - l1,
//!
//! r ← (y\[n\] - y\[n-1\]) - (w + k T² j2 + c T²/2) + m1\[n-1\] r,    w ← w + k T² j1 + c T² + T l2 r,    ŷ = y\[n\] - m1\[n\] r.
//!
//! y\[n\] - y\[n-1\] is exact in f32, r is small, and w is an accumulator; the textbook form ŷ ← ŷ + l1 r loses small
//! corrections in a large ŷ. A missed measurement is replaced by its prediction: r is then zero but for rounding, and
//! nothing is corrected.

use super::gains::{Gains, ObserverDesign};
use crate::accumulator::Accumulator;
use crate::moments::InputMoments;
use crate::snapshot::stored;

/// Innovations, and motions in a period, below this are none, m or rad: they end at zero instead of decaying through the
/// subnormal numbers.
const NOTHING: f32 = 1e-20;

/// What the axis is taken to obey, `y'' = k f + c`, over one period: k T² and c T².
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Model {
    pub(crate) k_t2: f32,
    pub(crate) c_t2: f32,
}

impl Model {
    /// The parameter `k` of (15) and the known drift `c`, in m/s² or rad/s², for an observer of this design.
    pub fn new(k: f32, c: f32, design: &ObserverDesign) -> Self {
        let t2 = design.period * design.period;
        Self { k_t2: k * t2, c_t2: c * t2 }
    }

    /// The same with another k; `period2` is T².
    #[inline(always)]
    pub(crate) fn follow(&mut self, k: f32, period2: f32) {
        self.k_t2 = k * period2;
    }
}

/// Position and velocity of one axis. The position is exact to the rounding of the measurement.
#[derive(Clone, Copy, Debug, Default)]
pub struct Observer {
    /// The last measurement, or what was predicted in its place.
    y: f32,
    /// The innovation at the last sample.
    r: f32,
    /// T v̂.
    w: Accumulator,
}

impl Observer {
    /// Takes the first measurement: ŷ = y, v̂ = 0, which the dead-beat second one replaces.
    pub fn start(&mut self, y: f32) {
        *self = Self { y, r: 0.0, w: Accumulator::ZERO };
    }

    #[cfg(test)]
    pub(crate) fn at(y: f32) -> Self {
        Self { y, r: y, w: Accumulator::new(y) }
    }

    /// Puts the state at T v̂ = `t_velocity` and ŷ = y - `residual`, y being the last measurement and `gains` those of its
    /// sample.
    pub fn seed(&mut self, residual: f32, t_velocity: f32, gains: &Gains) {
        // 0 in the first two samples, a tenth and more from then on.
        self.r = if gains.m1 > 1e-3 { residual / gains.m1 } else { 0.0 };
        self.w = Accumulator::new(t_velocity);
    }

    /// Predicts over one period with the input `moments` and corrects with the measurement `y`.
    ///
    /// `m1` is that of the sample before, `t_l2` that of this one. Cost: 14 operations. Every 32 samples or sooner
    /// [`fold`](Self::fold) is due.
    #[inline(always)]
    pub fn correct(&mut self, y: f32, moments: InputMoments, model: &Model, m1: f32, t_l2: f32) {
        let step = self.w.value() + (model.k_t2 * moments.j2 + 0.5 * model.c_t2);
        self.r = (y - self.y) - step + m1 * self.r;
        self.w.add(model.k_t2 * moments.j1 + model.c_t2 + t_l2 * self.r);
        self.y = y;
    }

    /// ŷ⁻, the measurement to be expected after one period: what takes the place of one that is missed. `m1` is that of
    /// the sample before.
    pub fn predict(&self, moments: InputMoments, model: &Model, m1: f32) -> f32 {
        self.y + (self.w.value() + (model.k_t2 * moments.j2 + 0.5 * model.c_t2) - m1 * self.r)
    }

    /// Moves the origin of positions: everything measured is larger by `by` from now on.
    pub(crate) fn translate(&mut self, by: f32) {
        self.y += by;
    }

    /// The axis moves by so much more in a period from now on.
    pub(crate) fn push(&mut self, by: f32) {
        self.w.add_folded(by);
    }

    /// Before the step with the first measurement after a `gap` of so many, which is `off` from what was expected. That has come
    /// together over the whole gap; a velocity corrected by more of it than a share of one in so many periods overshoots, and would do so
    /// the more the longer the gaps are.
    pub(crate) fn come_back(&mut self, gap: f32, off: f32, t_l2: f32) {
        let most = 1.0 / (gap + 1.0);
        if t_l2 > most {
            // The velocity alone moves: what is expected stays.
            let by = (most - t_l2) * off;
            self.push(by);
            self.translate(-by);
        }
    }

    /// Moves collected steps into totals, and ends an innovation and a velocity that have died away.
    #[inline(always)]
    pub fn fold(&mut self) {
        self.w.fold();
        if self.r.abs() < NOTHING {
            self.r = 0.0;
            if self.w.value().abs() < NOTHING {
                self.w = Accumulator::ZERO;
            }
        }
    }

    /// ŷ at the last sample, `gains` being those of that sample.
    #[inline(always)]
    pub(crate) fn corrected(&self, gains: &Gains) -> f32 {
        self.y - gains.m1 * self.r
    }

    /// The same plus `ahead`. Rounded once.
    #[inline(always)]
    pub fn position(&self, ahead: f32, gains: &Gains) -> f32 {
        self.y + (ahead - gains.m1 * self.r)
    }

    /// T v̂ at the last sample.
    #[inline(always)]
    pub const fn t_velocity(&self) -> f32 {
        self.w.value()
    }

    /// v̂ at the last sample.
    #[inline(always)]
    pub const fn velocity(&self, design: &ObserverDesign) -> f32 {
        self.w.value() * design.per_period
    }

    /// The innovation y - ŷ⁻ at the last sample.
    #[inline(always)]
    pub const fn innovation(&self) -> f32 {
        self.r
    }

    /// The last measurement, or what was predicted in its place.
    #[inline(always)]
    pub const fn measurement(&self) -> f32 {
        self.y
    }
}

stored!(Observer { y, r, w });

impl Observer {
    /// Whether position, innovation and motion in a period are all within `most`.
    pub(crate) fn is_within(&self, most: f32) -> bool {
        self.y.abs() <= most && self.r.abs() <= most && self.w.value().abs() <= most
    }
}

impl Model {
    /// Whether k is one that can be configured, and the drift none or that of the axis, `c_t2`.
    pub(crate) fn is_sound(&self, c_t2: f32, period2: f32) -> bool {
        let k = self.k_t2 / period2;
        (0.0..=1.001e15).contains(&k) && (self.c_t2 == 0.0 || self.c_t2 == c_t2)
    }
}
