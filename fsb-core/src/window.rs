//! The window g\[n\] = h\[n\] h\[n+1\], the sampled counterpart of h(t)² in (39), by recurrence.
//!
//! With ρ = e^(-qT): e\[n\] = ρ^n and h\[n\] = 1 - ρ^n. The frequency shift (21) multiplies a sequence by ρ^n; the operator
//! (σ - 1)(ρσ - 1), the sampled counterpart of δ_q² in (20), multiplies it by g\[n\]. g vanishes at n = -1 and n = 0, which
//! is what removes y(0) and y'(0).
//!
//! Numerics: e by multiplication keeps its relative precision for ever; h by accumulation is exact near 0, where it
//! matters, and would stagnate near 1. From e = 1/2 on it is therefore h∞ - e, with the h∞ = h + e of that moment and not 1:
//! a window that jumps, if only by an ulp, looks like a position that jumps, while nothing in the identity needs h∞ = 1.
//! Both are accumulators: a rounding error that stays in the window is a step of it, and costs 1e-6 of k at 8 kHz; one
//! that is made up for at the next sample costs nothing. Below 1e-9 e no longer moves any f32 that depends on it; it is set
//! to 0 then, and the window is settled.
//! Cost: 15 operations a step, 9 for the neighbours; no transcendental.

use crate::accumulator::Accumulator;
use crate::snapshot::stored;
use crate::tuning::Decay;

/// Constants of the window.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WindowDesign {
    alpha: f32,
    alpha_over_rho: f32,
}

impl WindowDesign {
    pub(crate) const BLANK: Self = Self { alpha: 0.0, alpha_over_rho: 0.0 };

    #[inline(never)]
    pub(crate) fn new(decay: &Decay) -> Self {
        Self { alpha: decay.alpha.rounded(), alpha_over_rho: (decay.mixed - decay.alpha).rounded() }
    }
}

/// e = ρ^n and h = 1 - ρ^n at the current sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    e: Accumulator,
    h: Accumulator,
    /// h + e.
    limit: f32,
}

/// The window and its neighbours at sample n.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbours {
    /// ρ^n
    pub e: f32,
    /// h\[n\]
    pub h: f32,
    /// h\[n+1\]
    pub h_next: f32,
    /// h\[n+2\]
    pub h_after: f32,
    /// g\[n-1\] = h\[n-1\] h\[n\]
    pub g_before: f32,
    /// g\[n+1\] = h\[n+1\] h\[n+2\]
    pub g_after: f32,
}

impl Window {
    /// n = 0: e = 1, h = 0.
    pub const START: Self = Self { e: Accumulator::new(1.0), h: Accumulator::ZERO, limit: 1.0 };

    /// At e = e^(-`qt`). Uses an exponential: not for the tick.
    pub(crate) fn after(qt: f64) -> Self {
        let (e, h) = (libm::exp(-qt) as f32, -libm::expm1(-qt) as f32);
        Self { e: Accumulator::new(e), h: Accumulator::new(h), limit: h + e }
    }

    /// Whether the window is fully open: every further step changes nothing.
    #[inline(always)]
    pub const fn is_settled(&self) -> bool {
        self.e.value() == 0.0
    }

    #[inline(always)]
    pub(crate) fn neighbours(&self, design: &WindowDesign) -> Neighbours {
        let (e, h) = (self.e.value(), self.h.value());
        let h_before = h - design.alpha_over_rho * e;
        let h_next = h + design.alpha * e;
        let e_next = e - design.alpha * e;
        let h_after = h_next + design.alpha * e_next;
        Neighbours { e, h, h_next, h_after, g_before: h_before * h, g_after: h_next * h_after }
    }

    /// n ← n + 1, or by as many samples as `design` is for.
    #[inline(always)]
    pub(crate) fn step(&mut self, design: &WindowDesign) {
        let e = self.e.value();
        let step = design.alpha * e;
        if e > 0.5 {
            self.e.add_folded(-step);
            self.h.add_folded(step);
            self.limit = self.h.value() + self.e.value();
        } else {
            self.e.add_folded(-step);
            if e < 1e-9 {
                self.e = Accumulator::ZERO;
            }
            self.h = Accumulator::new(self.limit - self.e.value());
        }
    }
}

stored!(Window { e, h, limit });

impl Window {
    /// Whether it is a window at any sample.
    pub(crate) fn is_sound(&self) -> bool {
        let within = |x: f32| (0.0..=1.000_1).contains(&x);
        let (e, h) = (self.e.value(), self.h.value());
        within(e) && within(h) && (h + e - self.limit).abs() < 1e-3 && (0.999..=1.001).contains(&self.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tuning::Tuning;
    use crate::wide::Wide;

    fn decay(q_t: f64) -> Decay {
        Tuning { lambda: q_t, q: q_t }.decay(Wide::ONE)
    }

    /// e = ρ^n and h = 1 - ρ^n, h to a few ulps of itself from the first sample on: that is what the sums are for.
    #[test]
    fn the_exponential_and_what_it_lacks() {
        for q_t in [1e-5, 1e-3, 0.1, 1.0] {
            let (design, mut window) = (WindowDesign::new(&decay(q_t)), Window::START);
            for n in 0..(3.0 / q_t) as u32 {
                let exact = -libm::expm1(-f64::from(n) * q_t);
                let off = (f64::from(window.h.value()) - exact).abs() / exact;
                assert!(n == 0 || off < 1e-6, "{n} at {q_t}: h off by {off:.1e} of itself");
                assert!(window.is_sound() && !window.is_settled(), "{n} at {q_t}: {window:?}");
                window.step(&design);
            }
        }
    }

    /// Open for good once e is below 1e-9, which takes 20.7/(qT) samples; nothing moves from then on.
    #[test]
    fn it_settles() {
        let (design, mut window) = (WindowDesign::new(&decay(0.01)), Window::START);
        for n in 0..2200 {
            assert!(window.is_settled() == (n > 2074) || (2072..=2076).contains(&n), "{n}: {window:?}");
            window.step(&design);
        }
        let settled = window;
        window.step(&design);
        assert_eq!((window, window.e.value()), (settled, 0.0));
    }

    /// Each of what a window must obey, broken by itself.
    #[test]
    fn what_is_no_window() {
        let sound =
            |e: f32, h: f32, limit: f32| Window { e: Accumulator::new(e), h: Accumulator::new(h), limit }.is_sound();
        assert!(sound(1.0, 0.0, 1.0) && sound(0.5, 0.5, 1.0) && sound(0.25, 0.7499, 1.0) && sound(0.0, 1.0, 1.0));
        // e out of 0..=1, h out of 0..=1, a sum that is not the one recorded, a sum that is not 1, and no numbers.
        assert!(!sound(1.0005, 0.0, 1.0005) && !sound(-0.0005, 1.0, 0.9995));
        assert!(!sound(0.0, 1.0005, 1.0005) && !sound(1.0, -0.0005, 0.9995));
        assert!(!sound(0.5, 0.4, 1.0) && !sound(0.5, 0.6, 1.0));
        assert!(!sound(0.5, 0.52, 1.02) && !sound(0.5, 0.48, 0.98));
        assert!(!sound(f32::NAN, 0.5, 1.0) && !sound(0.5, f32::NAN, 1.0) && !sound(0.5, 0.5, f32::NAN));
    }
}
