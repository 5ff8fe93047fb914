//! What predicts an axis with drag: y'' = k f - D y' + c + d over a measurement period.
//!
//! With δ = D T and w = T v the held acceleration a gives, over the period,
//!
//! w' = (1 - κ) w + φ1 a T²,   y' = y + φ1 w + φ2 a T²,   κ = 1 - e^(-δ),  φ1 = κ/δ,  φ2 = (1 - φ1)/δ.
//!
//! An input known by its moments j1, j2 acts through moments of its own, those of f weighed by e^(-D(T-τ)); they are exact for
//! inputs held or linear. All are polynomials of the third order in δ, computed when D changes; what is left out is δ⁴/24 of
//! the motion in a period. At δ = 0 every one of them is that of the model without drag to the last bit.

use crate::moments::InputMoments;
use crate::observer::{Gains, Model, Observer, ObserverDesign};

/// k, D, c + d as constants of a period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DragModel {
    k_t2: f32,
    c_t2: f32,
    /// δ = D T
    delta: f32,
    /// κ
    loss: f32,
    /// φ1 - 1
    lag: f32,
    /// φ1 (c + d) T²
    c_velocity: f32,
    /// φ2 (c + d) T²
    c_position: f32,
    m11: f32,
    m12: f32,
    m21: f32,
    m22: f32,
}

/// All that arrives at the observer is a motion beyond constant velocity: the model of it has no constants left.
const MOTION: Model = Model { k_t2: 1.0, c_t2: 0.0 };

impl DragModel {
    /// |D| T up to which the polynomials are good for 2e-4 of the motion in a period.
    pub const LARGEST_DELTA: f32 = 0.25;

    /// `k` of (15), the drag D (1/s, |D| T at most [`LARGEST_DELTA`](Self::LARGEST_DELTA)), and the known drift plus the
    /// disturbance, c + d (m/s²), for an observer of this design.
    pub fn new(k: f32, drag: f32, drift: f32, design: &ObserverDesign) -> Self {
        let t2 = design.period * design.period;
        Self::over(1.0, k * t2, drift * t2, drag * design.period)
    }

    /// The same for the first part `share` of a period, 0 < share <= 1.
    pub(crate) fn within(&self, share: f32) -> Self {
        Self::over(share, self.k_t2, self.c_t2, self.delta)
    }

    fn over(t: f32, k_t2: f32, c_t2: f32, delta: f32) -> Self {
        let x = delta * t;
        let lag = x * (-0.5 + x * (1.0 / 6.0 - x * (1.0 / 24.0)));
        let phi2 = 0.5 + x * (-1.0 / 6.0 + x * (1.0 / 24.0 - x * (1.0 / 120.0)));
        Self {
            k_t2,
            c_t2,
            delta,
            loss: x * (1.0 + x * (-0.5 + x * (1.0 / 6.0))),
            lag: t * lag,
            c_velocity: (1.0 + lag) * t * c_t2,
            c_position: phi2 * (t * t) * c_t2,
            // ∫ (1-s)ⁿ f ds of a linear f, from j1 and j2: n = 2: j2 - j1/6, 3: (9 j2 - 2 j1)/10, 4: (4 j2 - j1)/5.
            m11: x * x * (-1.0 / 12.0 + x * (1.0 / 30.0)),
            m12: delta * (-1.0 + x * (0.5 - x * 0.15)),
            m21: t * x * (1.0 / 12.0 + x * (-1.0 / 30.0 + x * (1.0 / 120.0))),
            m22: x * (-0.5 + x * (0.15 - x * (1.0 / 30.0))),
        }
    }

    /// What is added to the velocity (j1, times T) and to the position beyond constant velocity (j2), m or rad.
    #[inline(always)]
    pub(crate) fn motion(&self, t_velocity: f32, moments: InputMoments) -> InputMoments {
        let InputMoments { j1, j2 } = moments;
        let velocity = j1 + (self.m11 * j1 + self.m12 * j2);
        let position = j2 + (self.m21 * j1 + self.m22 * j2);
        InputMoments {
            j1: (self.k_t2 * velocity + self.c_velocity) - self.loss * t_velocity,
            j2: (self.k_t2 * position + self.c_position) + self.lag * t_velocity,
        }
    }

    /// T v at the end of a period in which the position changed by `step` under this model.
    pub(crate) fn velocity_after(&self, step: f32, moments: InputMoments) -> f32 {
        let still = self.motion(0.0, moments);
        let before = (step - still.j2) / (1.0 + self.lag);
        before - self.loss * before + still.j1
    }
}

/// Position and velocity of one axis: [`Observer`] with drag and disturbance in its prediction. With D = 0 and d = 0 it gives
/// the bits that one gives. Cost: 14 operations more.
#[derive(Clone, Copy, Debug, Default)]
pub struct DragObserver {
    inner: Observer,
}

impl DragObserver {
    /// Takes the first measurement: ŷ = y, v̂ = 0.
    pub fn start(&mut self, y: f32) {
        self.inner.start(y);
    }

    /// Predicts over one period with the input `moments` and corrects with the measurement `y`; see [`Observer::correct`].
    #[inline(always)]
    pub fn correct(&mut self, y: f32, moments: InputMoments, model: &DragModel, m1: f32, t_l2: f32) {
        self.inner.correct(y, model.motion(self.inner.t_velocity(), moments), &MOTION, m1, t_l2);
    }

    /// ŷ⁻, the measurement to be expected after one period; see [`Observer::predict`].
    pub fn predict(&self, moments: InputMoments, model: &DragModel, m1: f32) -> f32 {
        self.inner.predict(model.motion(self.inner.t_velocity(), moments), &MOTION, m1)
    }

    /// Before the step with the first measurement after a gap; see [`Observer::come_back`].
    pub(crate) fn come_back(&mut self, gap: f32, off: f32, t_l2: f32) {
        self.inner.come_back(gap, off, t_l2);
    }

    /// Moves collected steps into totals.
    #[inline(always)]
    pub fn fold(&mut self) {
        self.inner.fold();
    }

    /// The observer itself, to read position, velocity and innovation.
    #[inline(always)]
    pub const fn state(&self) -> &Observer {
        &self.inner
    }

    pub(crate) fn seed(&mut self, residual: f32, t_velocity: f32, gains: &Gains) {
        self.inner.seed(residual, t_velocity, gains);
    }
}
