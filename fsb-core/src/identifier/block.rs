//! The identity for means over blocks of M samples (design, section 11).
//!
//! A filter of both sides leaves the identity exact, and so does a mean. With the unit response to the input from rest
//! inside each block (φ position, ψ velocity), P = φ and V = ψ at its end, and s the mean of φ over its samples,
//!
//! S̄ = M T V[-2] + P[-1] - P[-2] + τ (V[-1] - V[-2]) + s[0] - 2 s[-1] + s[-2],   τ = (M-1) T/2.
//!
//! M = 1 is the plain identity: s = 0, τ = 0, P = J2, V = J1.
//! With A = P + τ V - s this is S̄ = s[0] - s[-1] + A[-1] - (A[-2] - M T V[-2]): four numbers of the past are enough.

use crate::moments::InputMoments;

/// Constants of the block means.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BlockDesign {
    /// T
    pub(crate) period: f32,
    /// 1/M
    pub(crate) per_length: f32,
    /// M T
    pub(crate) duration: f32,
    /// 1/(M T)
    pub(crate) per_duration: f32,
    /// τ = (M-1) T/2
    pub(crate) centre: f32,
    /// (M-1) T, from the first to the last sample
    pub(crate) span: f32,
    /// s of a unit input: T² (M-1)(2M-1)/12
    pub(crate) unit_s: f32,
    /// P + τ V of a unit input: (MT)²/2 + τ M T
    pub(crate) unit_step: f32,
    /// (MT)²
    pub(crate) duration2: f32,
}

impl BlockDesign {
    /// Blocks of `length` samples at `period` [s]; both are taken as valid.
    pub(crate) fn new(period: f64, length: u32) -> Self {
        let m = f64::from(length);
        let duration = m * period;
        let centre = (m - 1.0) * period / 2.0;
        Self {
            period: period as f32,
            per_length: (1.0 / m) as f32,
            duration: duration as f32,
            per_duration: (1.0 / duration) as f32,
            centre: centre as f32,
            span: ((m - 1.0) * period) as f32,
            unit_s: (period * period * (m - 1.0) * (2.0 * m - 1.0) / 12.0) as f32,
            unit_step: (duration * duration / 2.0 + centre * duration) as f32,
            duration2: (duration * duration) as f32,
        }
    }
}

/// One axis's block in progress and what is left of the two before it.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlockMeans {
    /// Σ of positions in the block; the mean once the block is complete.
    sum_y: f32,
    /// Σ φ in the block; the mean s once the block is complete.
    sum_phi: f32,
    /// ψ, φ since the block's first sample.
    pub(crate) response: InputMoments,
    /// A[-1]
    pub(crate) a1: f32,
    /// V[-1]
    pub(crate) v1: f32,
    /// s[-1]
    s1: f32,
    /// A[-2] - M T V[-2]
    e2: f32,
}

impl BlockMeans {
    /// The input's moments over the interval that ended at the present sample.
    #[inline(always)]
    pub fn input(&mut self, moments: InputMoments, design: &BlockDesign) {
        self.response.append(moments, design.period);
    }

    /// Closes the block before and makes the present sample the first of a new one.
    #[inline(always)]
    pub fn begin(&mut self, design: &BlockDesign) {
        self.e2 = self.a1 - design.duration * self.v1;
        self.a1 = self.response.j2 + design.centre * self.response.j1 - self.sum_phi;
        self.v1 = self.response.j1;
        self.s1 = self.sum_phi;
        self.response = InputMoments::ZERO;
        self.sum_phi = 0.0;
        self.sum_y = 0.0;
    }

    /// Adds the present sample, relative to the origin.
    #[inline(always)]
    pub fn sample(&mut self, y: f32) {
        self.sum_y += y;
        self.sum_phi += self.response.j2;
    }

    /// Completes the block with its last sample: the mean position and S̄.
    #[inline(always)]
    pub fn complete(&mut self, design: &BlockDesign) -> (f32, f32) {
        self.sum_y *= design.per_length;
        self.sum_phi *= design.per_length;
        (self.sum_y, self.sum_phi - self.s1 + (self.a1 - self.e2))
    }

    /// s[0] of a block just completed.
    pub(crate) const fn mean_phi(&self) -> f32 {
        self.sum_phi
    }
}
