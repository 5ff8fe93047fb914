//! How white measurement noise reaches k̂: the covariance of (x1, x2, x3, a), a = Σ ω x1, under unit noise.
//!
//! The position cascade is X ← A X + B w with A, B known at every step, so P = cov(X) obeys P ← A P Aᵀ + B Bᵀ; it does not
//! depend on the data and is shared by every axis of a tuning ([`NoiseShape`], six numbers). The noise that reaches the
//! numerator of k̂ through the weights ω is a; its covariance with X is three numbers per axis ([`NoiseCross`]), and
//!
//! var a ← μ² var a + 2 μ ω (A q)₁ + ω² P₁₁,   q ← μ A q + ω P e₁,   std(k̂)² = σ² var a / (Σ ω ẑ0)².
//!
//! The last sum is taken at the same steps as the others: what a coarse step makes of a growing signal is then the same
//! above and below.
//!
//! The recursion runs every D-th identifier step, where λ D T is still small: averaging the noise over D samples and
//! weighing the mean D-fold is the same filter at a coarser step (design, section 11).

use super::noise_level::NoiseLevel;
use crate::identifier::{Coefficients, IdentifierDesign};
use crate::snapshot::stored;
use crate::tuning::{Tuning, decayed};
use crate::wide::Wide;
use crate::window::Window;
use core::hint::black_box;

/// Constants of the covariance recursion.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct CovarianceDesign {
    /// The identifier at the coarse step, in physical units.
    coarse: IdentifierDesign,
    c: f32,
    p: f32,
    cp: f32,
    c2p: f32,
    /// D
    pub steps: u32,
    /// D, as a weight
    pub stride: f32,
    /// 1/D
    pub per_stride: f32,
    /// μ over D steps
    mu: f32,
    /// 1 - μ² over D steps
    pub noise_forgetting: f32,
    /// Values of the noise level that are remembered.
    pub noise_memory: u16,
    /// Steps that the residual of an acceleration without memory is spread over, D times: the noise bandwidth of the three
    /// stages, ∫ |F|⁶ dω/2π = 3 λ/16, times T, into D.
    pub correlation: f32,
    /// 1 - μ over D steps, for one of the axes that share a parameter
    pub forgetting: f32,
}

impl CovarianceDesign {
    /// λ D T is kept at about this; steps of more than half of it, or so, are taken as they are.
    const COARSE: f32 = 0.08;

    pub const BLANK: Self = Self {
        coarse: IdentifierDesign::BLANK,
        c: 0.0,
        p: 0.0,
        cp: 0.0,
        c2p: 0.0,
        steps: 0,
        stride: 0.0,
        per_stride: 0.0,
        mu: 0.0,
        noise_forgetting: 0.0,
        noise_memory: 0,
        correlation: 0.0,
        forgetting: 0.0,
    };

    /// For an identifier at `period` whose memory fades by e^(-`fading`) in each step, together with all the `sharing` axes
    /// of a parameter. D is a multiple of `unit` where it is as large.
    #[inline(never)]
    pub fn fill(&mut self, tuning: &Tuning, period: Wide, fading: Wide, sharing: u32, unit: u32) {
        let tuning = black_box(tuning);
        let (lambda, q) = (Wide::new(tuning.lambda).rounded(), Wide::new(tuning.q).rounded());
        let fastest = if lambda > q { lambda } else { q };
        let strides = Self::COARSE / (fastest * period.rounded());
        // At least 1.75, rounded to the nearest.
        let steps = if strides >= 1.75 { (strides + 0.5) as u32 } else { 1 };
        let steps = if steps >= unit { steps.saturating_add((unit - 1) / 2) / unit.max(1) * unit } else { steps };
        let stride = Wide::of(steps);
        self.coarse = IdentifierDesign::at_scale(&tuning.decay(stride * period), Wide::ONE);
        let (c, p) = (self.coarse.c, 1.0 - self.coarse.c);
        (self.c, self.p, self.cp, self.c2p) = (c, p, c * p, c * c * p);
        self.steps = steps;
        self.stride = steps as f32;
        self.per_stride = 1.0 / self.stride;
        let faded = stride * fading;
        let forgetting = decayed(faded).rounded();
        self.mu = 1.0 - forgetting;
        self.noise_forgetting = forgetting * (2.0 - forgetting);
        self.noise_memory = NoiseLevel::memory(faded.rounded());
        self.correlation = self.stride * 16.0 / (3.0 * lambda * period.rounded());
        self.forgetting = decayed(faded.over(Wide::of(sharing))).rounded();
    }

    /// What three stages of the identifier's filter forget in a coarse step: the memory of what was missing. After fewer `steps` of the
    /// identifier than they remember it is the mean of all.
    pub const fn fading(&self, steps: u32) -> f32 {
        let three = 3.0 * self.c;
        let all = self.stride / (steps as f32 + 1.0);
        let fading = if three > all { three } else { all };
        if fading < 1.0 { fading } else { 1.0 }
    }

    /// The share of that which one step of the identifier has.
    pub fn share(&self, steps: u32) -> f32 {
        self.fading(steps) * self.per_stride
    }

    /// A x, A = [[p, cp, c²p], [0, p, cp], [0, 0, p]].
    #[inline(always)]
    fn propagate(&self, x: [f32; 3]) -> [f32; 3] {
        [self.p * x[0] + self.cp * x[1] + self.c2p * x[2], self.p * x[1] + self.cp * x[2], self.p * x[2]]
    }
}

/// P = cov(x1, x2, x3) for unit noise, upper triangle, in physical units (the position's, per s⁴).
#[derive(Clone, Copy, Debug)]
pub struct NoiseShape {
    p11: f32,
    p12: f32,
    p13: f32,
    p22: f32,
    p23: f32,
    p33: f32,
}

impl NoiseShape {
    /// Before the first sample.
    pub(crate) const START: Self = Self { p11: 0.0, p12: 0.0, p13: 0.0, p22: 0.0, p23: 0.0, p33: 0.0 };

    /// One coarse step, the identifier's window being at `window`. Cost: about 60 operations.
    pub(crate) fn step(&mut self, window: &Window, design: &CovarianceDesign) {
        let at = Coefficients::at(window, &design.coarse);
        let c = design.c;
        // B: how one noisy sample enters the three stages, which feed one another within the step.
        let b3 = c * at.b3;
        let b2 = c * (at.b2 + b3);
        let b1 = c * (at.b1 + b2);
        // Columns of A P, then rows of (A P) Aᵀ.
        let first = design.propagate([self.p11, self.p12, self.p13]);
        let second = design.propagate([self.p12, self.p22, self.p23]);
        let third = design.propagate([self.p13, self.p23, self.p33]);
        let row1 = design.propagate([first[0], second[0], third[0]]);
        let row2 = design.propagate([first[1], second[1], third[1]]);
        self.p11 = row1[0] + b1 * b1;
        self.p12 = row1[1] + b1 * b2;
        self.p13 = row1[2] + b1 * b3;
        self.p22 = row2[1] + b2 * b2;
        self.p23 = row2[2] + b2 * b3;
        self.p33 = design.p * third[2] + b3 * b3;
    }

    /// Variance of ẑ2 for coarse noise of variance one.
    pub(crate) const fn variance(&self) -> f32 {
        self.p11
    }
}

/// q = cov(X, a), one axis.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoiseCross {
    q: [f32; 3],
}

impl NoiseCross {
    /// One coarse step with the weight ω. Returns what is added to var a beyond its own fading. Cost: 22 operations.
    pub(crate) fn step(&mut self, weight: f32, shape: &NoiseShape, design: &CovarianceDesign) -> f32 {
        let moved = design.propagate(self.q);
        let faded = [design.mu * moved[0], design.mu * moved[1], design.mu * moved[2]];
        self.q = [faded[0] + weight * shape.p11, faded[1] + weight * shape.p12, faded[2] + weight * shape.p13];
        weight * (2.0 * faded[0] + weight * shape.p11)
    }
}

stored!(NoiseShape { p11, p12, p13, p22, p23, p33 });
stored!(NoiseCross { q });
