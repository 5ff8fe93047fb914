//! The rows of one axis, ẑu d - ẑv D + ẑ0 k = ẑ2 - c ẑu, as an upper triangle.
//!
//! Rows are taken in by square-root-free Givens rotations (Gentleman, 1973): with R = D^½ Ř, Ř of unit diagonal, a row x of
//! weight w changes a row of the triangle to
//!
//! d' = μ d + w x₁²,   s = w x₁/d',   w' = w μ d/d',   x_k' = x_k - x₁ r_k,   r_k' = r_k + s x_k',
//!
//! and goes on to the next one as x', w'. Nothing is squared that does not belong to one column, so nearly parallel columns
//! (hover: ẑ0 and ẑu) cost what they must and no more. Every number of the triangle is an accumulator: it does not stagnate over
//! days. k comes last: the last row is what the axis says of k whatever its D and d are.

use crate::accumulator::Accumulator;

/// One row of the regression. Any scale, the same in all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// ẑu, the regressor of d.
    pub zu: f32,
    /// -ẑv, the regressor of D.
    pub minus_zv: f32,
    /// ẑ0, the regressor of k.
    pub z0: f32,
    /// ẑ2 - c ẑu.
    pub z2: f32,
}

/// The triangle of one axis: columns u (d), v (D), f (k) and the right-hand side y.
#[derive(Clone, Copy, Debug, Default)]
pub struct Triangle {
    du: Accumulator,
    dv: Accumulator,
    df: Accumulator,
    uv: Accumulator,
    uf: Accumulator,
    uy: Accumulator,
    vf: Accumulator,
    vy: Accumulator,
    fy: Accumulator,
    residual: Accumulator,
    count: Accumulator,
}

impl Triangle {
    /// A row whose ẑu² is below this comes before the window opens: nothing is in it but rounding.
    const NOTHING: f32 = 1e-30;
    /// A row beyond this cannot be right; its square would not leave room for the others.
    const TOO_MUCH: f32 = 1e14;

    /// Takes a row in; `forgetting` is 1 - μ. Returns whether it was one that can be right.
    /// Cost: 58 operations, 3 of them divisions, and 30 to fold.
    pub fn add(&mut self, row: &Row, forgetting: f32) -> bool {
        let Row { zu: u, minus_zv: v, z0: f, z2: y } = *row;
        let within = u.abs().max(v.abs()) <= Self::TOO_MUCH && f.abs().max(y.abs()) <= Self::TOO_MUCH;
        // The larger of a number and NaN is the number.
        let sound = within && !(u + v + f + y).is_nan() && u * u >= Self::NOTHING;
        if sound {
            let mut weight = 1.0;
            let s = take_in(&mut self.du, u, &mut weight, forgetting);
            let v = turn(&mut self.uv, u, v, s);
            let f = turn(&mut self.uf, u, f, s);
            let y = turn(&mut self.uy, u, y, s);
            let s = take_in(&mut self.dv, v, &mut weight, forgetting);
            let f = turn(&mut self.vf, v, f, s);
            let y = turn(&mut self.vy, v, y, s);
            let s = take_in(&mut self.df, f, &mut weight, forgetting);
            let y = turn(&mut self.fy, f, y, s);
            self.residual.add_folded(weight * y * y - forgetting * self.residual.value());
            self.count.add_folded(1.0 - forgetting * self.count.value());
        }
        sound
    }

    /// Σ ẑu²: the number of rows as far as the window was open, times the square of the scale.
    pub const fn rows(&self) -> f32 {
        self.du.value()
    }

    /// The number of rows, those that have faded counting less.
    pub const fn count(&self) -> f32 {
        self.count.value()
    }

    /// The system without the columns that are not kept, as if they had never been there.
    pub fn keep(&self, disturbance: bool, drag: bool) -> Reduced {
        let (du, dv) = (self.du.value(), self.dv.value());
        let mut kept = Reduced {
            du,
            dv,
            df: self.df.value(),
            uv: if drag { self.uv.value() } else { 0.0 },
            uf: self.uf.value(),
            uy: self.uy.value(),
            vf: self.vf.value(),
            vy: self.vy.value(),
            fy: self.fy.value(),
            residual: self.residual.value(),
        };
        if !drag {
            let (vf, vy) = (kept.vf, kept.vy);
            (kept.dv, kept.vf, kept.vy) = (0.0, 0.0, 0.0);
            kept.take_in(0.0, vf, vy, dv);
        }
        if !disturbance {
            let (uv, uf, uy) = (kept.uv, kept.uf, kept.uy);
            (kept.du, kept.uv, kept.uf, kept.uy) = (0.0, 0.0, 0.0, 0.0);
            kept.take_in(uv, uf, uy, du);
        }
        kept
    }

    /// What share of the energy of ẑv a constant does not explain.
    pub(crate) fn motion_share(&self) -> f32 {
        let (own, uv) = (self.dv.value(), self.uv.value());
        own / (own + self.du.value() * uv * uv)
    }
}

#[inline(always)]
fn take_in(d: &mut Accumulator, x: f32, weight: &mut f32, forgetting: f32) -> f32 {
    let before = d.value() - forgetting * d.value();
    d.add_folded(*weight * x * x - forgetting * d.value());
    let after = d.value();
    if after > 0.0 {
        let s = *weight * x / after;
        *weight *= before / after;
        s
    } else {
        0.0
    }
}

/// Returns what is left of `x` for the next row.
#[inline(always)]
fn turn(r: &mut Accumulator, first: f32, x: f32, s: f32) -> f32 {
    let left = x - first * r.value();
    r.add_folded(s * left);
    left
}

/// A triangle at the moment of reading, columns that do not take part being left out (their row is zero).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reduced {
    du: f32,
    dv: f32,
    df: f32,
    uv: f32,
    uf: f32,
    uy: f32,
    vf: f32,
    vy: f32,
    fy: f32,
    residual: f32,
}

/// A value and its variance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// In the unit of what is estimated.
    pub value: f32,
    /// The square of its standard deviation.
    pub variance: f32,
}

impl Reduced {
    /// The information on k: what of Σ ẑ0² the axis's own unknowns do not take.
    pub const fn information(&self) -> f32 {
        self.df
    }

    /// What this axis alone says k is.
    pub const fn k(&self) -> f32 {
        self.fy
    }

    /// Σ of the squared residuals of this axis if the parameter is `k`, D and d being the best for it.
    pub fn residual(&self, k: f32) -> f32 {
        let off = self.fy - k;
        self.residual + self.df * (off * off)
    }

    /// D for this k; `row_variance` is what a row's variance is worth.
    pub fn drag(&self, k: Estimate, row_variance: f32) -> Estimate {
        Estimate {
            value: self.vy - self.vf * k.value,
            variance: row_variance / self.dv + self.vf * self.vf * k.variance,
        }
    }

    /// d for this k and this D, which is zero where it does not take part.
    pub fn disturbance(&self, k: Estimate, drag: f32, row_variance: f32) -> Estimate {
        let by_k = self.uf - self.uv * self.vf;
        let by_drag = if self.dv > 0.0 { self.uv * self.uv * (row_variance / self.dv) } else { 0.0 };
        Estimate {
            value: self.uy - self.uv * drag - self.uf * k.value,
            variance: row_variance / self.du + by_drag + by_k * by_k * k.variance,
        }
    }

    /// A row of the given weight without a first column.
    fn take_in(&mut self, v: f32, f: f32, y: f32, mut weight: f32) {
        let s = rotate(&mut self.dv, v, &mut weight);
        let left_f = f - v * self.vf;
        let left_y = y - v * self.vy;
        self.vf += s * left_f;
        self.vy += s * left_y;
        let s = rotate(&mut self.df, left_f, &mut weight);
        let left = left_y - left_f * self.fy;
        self.fy += s * left;
        self.residual += weight * left * left;
    }
}

fn rotate(d: &mut f32, x: f32, weight: &mut f32) -> f32 {
    let before = *d;
    *d += *weight * x * x;
    if *d > 0.0 {
        let s = *weight * x / *d;
        *weight *= before / *d;
        s
    } else {
        0.0
    }
}
