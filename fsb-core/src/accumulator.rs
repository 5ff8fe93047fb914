//! A running sum in two parts, so that small steps are not lost in a large total.
//!
//! `x += d` in f32 stops moving once |d| is below half an ulp of x: a slow low-pass stage then stalls up to ulp/(2c) away
//! from its input, and a sum over a day stops growing. Here steps are collected in `recent`, which is small and therefore
//! fine-grained, and [`fold`](Accumulator::fold) moves them into `total` now and then, leaving behind what rounding takes
//! (fast two-sum). As long as it is folded before `recent` grows to a fair share of `total`, the pair is good for 40 bits or more.
//! Cost: one operation a step, one to read, three to fold.

use crate::snapshot::stored;

/// `total + recent`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accumulator {
    total: f32,
    recent: f32,
}

impl Accumulator {
    /// Zero.
    pub const ZERO: Self = Self { total: 0.0, recent: 0.0 };

    /// A sum that starts at `x`.
    pub const fn new(x: f32) -> Self {
        Self { total: x, recent: 0.0 }
    }

    /// The sum, rounded to f32.
    #[inline(always)]
    pub const fn value(&self) -> f32 {
        self.total + self.recent
    }

    /// The sum without what was added since the last [`fold`](Self::fold); right after it, the sum.
    #[inline(always)]
    pub const fn total(&self) -> f32 {
        self.total
    }

    /// Adds `d`.
    #[inline(always)]
    pub const fn add(&mut self, d: f32) {
        self.recent += d;
    }

    /// Moves what was collected into the total.
    #[inline(always)]
    pub const fn fold(&mut self) {
        let total = self.total + self.recent;
        self.recent -= total - self.total;
        self.total = total;
    }

    /// [`add`](Self::add) and [`fold`](Self::fold).
    #[inline(always)]
    pub const fn add_folded(&mut self, d: f32) {
        self.add(d);
        self.fold();
    }
}

stored!(Accumulator { total, recent });
