//! One axis of the observer, in innovation form.
//!
//! r[n] = y[n] - ŷ⁻[n] is kept instead of ŷ: with m1 = 1 - l1,
//!
//! r ← (y[n] - y[n-1]) - (T v̂ + k J2 + c T²/2) + m1[n-1] r,    v̂ ← v̂ + k J1 + c T + l2 r,    ŷ = y[n] - m1[n] r.
//!
//! y[n] - y[n-1] is exact in f32, r is small, and v̂ is a compensated sum; the textbook form ŷ ← ŷ + l1 r loses small
//! corrections in a large ŷ.

use super::gains::{Gains, ObserverDesign};
use crate::compensated::CompensatedSum;
use crate::moments::InputMoments;

/// Adding and subtracting this quantises the innovation to 1e-22 of its unit, so that it ends at zero and not in the
/// subnormal numbers when nothing moves.
const QUANTISE: f32 = 1e-15;

/// What the axis is taken to obey: `y'' = k f + drift`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Model {
    /// k of (15).
    pub k: f32,
    /// The known drift c [m/s² or rad/s²].
    pub drift: f32,
}

/// What an interval does to the state beyond `T v`: the known part of the prediction.
#[derive(Clone, Copy, Debug)]
struct Motion {
    position: f32,
    velocity: f32,
}

/// Position and velocity of one axis. The position is exact to the rounding of the measurement.
#[derive(Clone, Copy, Debug, Default)]
pub struct Observer {
    /// The last measurement, or what was predicted in its place.
    y: f32,
    /// The innovation at the last sample; as good as zero where nothing was measured.
    r: f32,
    v: CompensatedSum,
}

impl Observer {
    /// Takes the first measurement: ŷ = y, v̂ = 0, which the dead-beat second one replaces.
    pub fn start(&mut self, y: f32) {
        *self = Self { y, r: 0.0, v: CompensatedSum::ZERO };
    }

    /// Puts the state at velocity `velocity` and position `y - residual`, `y` being the last measurement and `gains` those
    /// of its sample.
    pub fn seed(&mut self, y: f32, residual: f32, velocity: f32, gains: &Gains) {
        self.y = y;
        self.r = if gains.m1 > 0.0 { residual / gains.m1 } else { 0.0 };
        self.v = CompensatedSum::new(velocity);
    }

    /// Predicts over one period with the input `moments` and corrects with the measurement `y`.
    ///
    /// `before` are the gains of the sample before, `now` those of this one.
    /// Cost: 20 operations.
    #[inline(always)]
    pub fn correct(
        &mut self,
        y: f32,
        moments: InputMoments,
        model: &Model,
        before: &Gains,
        now: &Gains,
        design: &ObserverDesign,
    ) {
        let motion = self.motion(moments, model, design);
        let r = (y - self.y) - motion.position + before.m1 * self.r;
        self.r = (r + QUANTISE) - QUANTISE;
        self.v.add(motion.velocity + now.l2 * self.r);
        self.y = y;
    }

    /// Predicts over one period; nothing was measured. Returns the predicted position.
    ///
    /// The position is large and its change small: what rounding takes from the sum is kept in r, so that a run of missed
    /// measurements adds no noise of its own.
    #[inline(always)]
    pub fn predict(
        &mut self,
        moments: InputMoments,
        model: &Model,
        before: &Gains,
        now: &Gains,
        design: &ObserverDesign,
    ) -> f32 {
        let motion = self.motion(moments, model, design);
        let step = motion.position - before.m1 * self.r;
        let y = self.y + step;
        let lost = step - (y - self.y);
        self.r = if now.m1 > 0.0 { -lost / now.m1 } else { 0.0 };
        self.y = y;
        self.v.add(motion.velocity);
        self.y
    }

    #[inline(always)]
    fn motion(&self, moments: InputMoments, model: &Model, design: &ObserverDesign) -> Motion {
        Motion {
            position: design.period * self.v.value() + model.k * moments.j2 + model.drift * design.half_period2,
            velocity: model.k * moments.j1 + model.drift * design.period,
        }
    }

    /// ŷ at the last sample plus `ahead`, `gains` being those of that sample. Rounded once.
    #[inline(always)]
    pub fn position(&self, ahead: f32, gains: &Gains) -> f32 {
        self.y + (ahead - gains.m1 * self.r)
    }

    /// The last measurement, or what was predicted in its place.
    pub(crate) const fn measurement(&self) -> f32 {
        self.y
    }

    /// v̂ at the last sample.
    #[inline(always)]
    pub const fn velocity(&self) -> f32 {
        self.v.value()
    }

    /// The innovation y - ŷ⁻ at the last sample; below an ulp of y where nothing was measured.
    #[inline(always)]
    pub const fn innovation(&self) -> f32 {
        self.r
    }
}
