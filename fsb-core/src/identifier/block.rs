//! The identity for means over blocks of M samples (design, section 11), with T as the unit of time.
//!
//! A filter of both sides leaves the identity exact, and so does a mean. With the unit response to the input from rest
//! inside each block (φ position, ψ velocity), P = φ and V = ψ at its end, and s the mean of φ over its samples,
//!
//! S̄ = M V\[-2\] + P\[-1\] - P\[-2\] + τ (V\[-1\] - V\[-2\]) + s\[0\] - 2 s\[-1\] + s\[-2\],   τ = (M-1)/2.
//!
//! With A = P + τ V - s this is S̄ = s\[0\] - s\[-1\] + A\[-1\] - (A\[-2\] - M V\[-2\]): two numbers of the past are enough.
//! M = 1 is the plain identity: s = 0, τ = 0, P = j2, V = j1.

use crate::moments::InputMoments;
use crate::snapshot::stored;

/// Constants of the block means.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BlockDesign {
    /// M
    pub(crate) length: f32,
    /// 1/M
    pub(crate) per_length: f32,
    /// 1/M²
    pub(crate) per_length2: f32,
    /// τ = (M-1)/2
    pub(crate) centre: f32,
    /// M - 1, from the first to the last sample
    pub(crate) span: f32,
    /// s of a unit input: (M-1)(2M-1)/12
    pub(crate) unit_s: f32,
    /// A - M V of a unit input held for ever: M²/2 + τ M - s - M²
    pub(crate) unit_past: f32,
}

impl BlockDesign {
    /// Blocks of `length` samples, at least one.
    pub(crate) fn new(length: u32) -> Self {
        // The products are exact in f32 up to 2048 samples.
        let m = length as f32;
        Self {
            length: m,
            per_length: 1.0 / m,
            per_length2: 1.0 / (m * m),
            centre: 0.5 * (m - 1.0),
            span: m - 1.0,
            unit_s: (m - 1.0) * (2.0 * m - 1.0) / 12.0,
            unit_past: (m + 1.0) * (2.0 * m + 1.0) / -12.0,
        }
    }
}

/// One axis's block in progress and what is left of the two before it.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlockMeans {
    /// Σ of positions in the block.
    sum_y: f32,
    /// Σ φ in the block.
    sum_phi: f32,
    /// φ since the block's first sample.
    phi: f32,
    /// ψ since the block's first sample.
    psi: f32,
    /// s\[0\] from the end of a block to the begin of the next one; A\[-1\] - s\[-1\] - (A\[-2\] - M V\[-2\]) from then on.
    pending: f32,
    /// A\[-1\] - M V\[-1\] of the block before the one in progress.
    past: f32,
}

/// The mean position of a completed block, and S̄/M².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockMean {
    /// Relative to the origin that was subtracted from the samples.
    pub y: f32,
    /// Mean input term of the identity, in units of the input.
    pub s: f32,
}

impl BlockMeans {
    /// One sample: `y` relative to the origin, and the moments of the interval that ended with it. Cost: 6 operations.
    #[inline(always)]
    pub fn sample(&mut self, y: f32, moments: InputMoments) {
        self.phi += self.psi + moments.j2;
        self.psi += moments.j1;
        self.sum_phi += self.phi;
        self.sum_y += y;
    }

    /// To be called after [`sample`](Self::sample) where that sample is the first of a block: closes the block before.
    #[inline(always)]
    pub fn begin(&mut self, design: &BlockDesign) {
        let s = self.pending;
        let a = self.phi + design.centre * self.psi - s;
        self.pending = a - s - self.past;
        self.past = a - design.length * self.psi;
        self.phi = 0.0;
        self.psi = 0.0;
        self.sum_phi = 0.0;
    }

    /// To be called after [`sample`](Self::sample) where that sample is the last of a block.
    #[inline(always)]
    pub fn complete(&mut self, design: &BlockDesign) -> BlockMean {
        let s = self.sum_phi * design.per_length;
        let mean = BlockMean { y: self.sum_y * design.per_length, s: (s + self.pending) * design.per_length2 };
        self.pending = s;
        self.sum_y = 0.0;
        mean
    }

    /// [`sample`](Self::sample) and [`complete`](Self::complete) for blocks of one. Cost: 2 operations.
    #[inline(always)]
    pub fn single(&mut self, y: f32, moments: InputMoments) -> BlockMean {
        let past = moments.j2 - moments.j1;
        let s = moments.j2 - self.past;
        self.past = past;
        BlockMean { y, s }
    }

    /// After a completed block: what the free state needs of the past.
    pub(crate) fn past(&self, length: u32, moments: InputMoments) -> Past {
        if length == 1 {
            // P = j2, V = j1 of the interval that ended now.
            Past { s: 0.0, past: moments.j2 - moments.j1, phi: 0.0, psi: 0.0 }
        } else {
            Past { s: self.pending, past: self.past, phi: self.phi, psi: self.psi }
        }
    }
}

/// s\[0\], A\[-1\] - M V\[-1\], and the response from the block's first sample to its last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Past {
    pub s: f32,
    pub past: f32,
    pub phi: f32,
    pub psi: f32,
}

stored!(BlockMeans { sum_y, sum_phi, phi, psi, pending, past });
