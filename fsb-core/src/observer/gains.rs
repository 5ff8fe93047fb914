//! The observer's gains at sample n.
//!
//! l1 = 1 - p² g\[n-1\]/g\[n+1\],   T l2 = (c + p a)² + p² (1-a) e \[α²(1+ρ)/ρ\]/G,   a = \[(1-ρ²)/ρ\] e h₊₊/G,   G = g\[n+1\].
//!
//! n = 1 is dead-beat (l1 = 1, T l2 = 1): whatever was assumed before is gone. n → ∞: l1 = 1 - p², T l2 = (1-p)². No 1/h²
//! as in (57) and (59), so there is no singularity to stay away from and no ε.

use crate::error::ConfigError;
use crate::tuning::{Decay, Tuning};
use crate::wide::Wide;
use crate::window::{Window, WindowDesign};

/// Constants of an observer: a tuning at the measurement period.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ObserverDesign {
    pub(crate) window: WindowDesign,
    /// T
    pub(crate) period: f32,
    /// 1/T
    pub(crate) per_period: f32,
    c: f32,
    p: f32,
    p2: f32,
    a_factor: f32,
    l2_factor: f32,
}

impl ObserverDesign {
    pub(crate) const BLANK: Self = Self {
        window: WindowDesign::BLANK,
        period: 0.0,
        per_period: 0.0,
        c: 0.0,
        p: 0.0,
        p2: 0.0,
        a_factor: 0.0,
        l2_factor: 0.0,
    };

    /// Constants for `tuning` at the measurement `period`, in s.
    ///
    /// # Errors
    /// Names `lambda`, `q` or `period`; ranges as for the identifier.
    pub fn new(tuning: Tuning, period: f64) -> Result<Self, ConfigError> {
        Ok(Self::from_decay(&tuning.named(period, &["lambda", "q"])?))
    }

    #[inline(never)]
    pub(crate) fn from_decay(d: &Decay) -> Self {
        let p2 = d.p * d.p;
        Self {
            window: WindowDesign::new(d),
            period: d.period.rounded(),
            per_period: Wide::ONE.over(d.period).rounded(),
            c: d.c.rounded(),
            p: d.p.rounded(),
            p2: p2.rounded(),
            a_factor: d.mixed.rounded(),
            l2_factor: (p2 * d.alpha * d.mixed).rounded(),
        }
    }
}

impl ObserverDesign {
    /// 1 - e^(-λT)
    pub(crate) const fn c(&self) -> f32 {
        self.c
    }

    /// e^(-λT)
    pub(crate) const fn p(&self) -> f32 {
        self.p
    }

    /// Moves the window of the gains to the next sample.
    pub fn step(&self, window: &mut Window) {
        window.step(&self.window);
    }
}

/// The gains at one sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gains {
    /// 1 - l1: the share of the innovation that the position estimate does not follow.
    pub(crate) m1: f32,
    /// T l2.
    pub(crate) t_l2: f32,
}

impl Gains {
    /// At n = 0 the first measurement is taken as it is: l1 = 1, l2 = 0.
    pub const FIRST: Self = Self { m1: 0.0, t_l2: 0.0 };

    /// The gains at the window's sample, n >= 1. Cost: 20 operations, one of them a division. Every term is positive.
    #[inline(always)]
    pub fn at(window: &Window, design: &ObserverDesign) -> Self {
        let w = window.neighbours(&design.window);
        let per_g = 1.0 / w.g_after;
        let a = design.a_factor * w.e * w.h_after * per_g;
        let s = design.c + design.p * a;
        Self { m1: design.p2 * w.g_before * per_g, t_l2: s * s + design.l2_factor * (1.0 - a) * w.e * per_g }
    }

    /// 1 - l1.
    pub const fn m1(&self) -> f32 {
        self.m1
    }

    /// l1, the share of the innovation that the position estimate follows.
    pub const fn l1(&self) -> f32 {
        1.0 - self.m1
    }

    /// T l2, what the velocity estimate takes of the innovation over a period.
    pub const fn t_l2(&self) -> f32 {
        self.t_l2
    }
}
