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

use super::reduced::{Reduced, Share};
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
    /// The mean of what is added to that, the rows weighed by what they say of k.
    telling: Accumulator,
    /// One over the number of rows that say it: Σ x⁴/(Σ x²)² of what is left of ẑ0.
    concentration: Accumulator,
    count: Accumulator,
    opening: Accumulator,
    /// What is left of ẑv and of ẑ0 by the columns before them, at the row before.
    v_before: f32,
    f_before: f32,
    /// Σ of the squared steps of these from row to row: with dv and df, how fast they swing.
    v_steps: Accumulator,
    f_steps: Accumulator,
}

impl Triangle {
    /// A row beyond this cannot be right; its square would not leave room for the others.
    const TOO_MUCH: f32 = 1e14;

    /// Takes a row in; `forgetting` is 1 - μ. Returns whether it was one that can be right.
    /// Cost: 75 operations, 6 of them divisions, and 50 to fold.
    pub fn add(&mut self, row: &Row, forgetting: f32) -> bool {
        let Row { zu: u, minus_zv: v, z0: f, z2: y } = *row;
        // Written so that NaN fails it.
        let within = [u, v, f, y].iter().all(|x| x.abs() <= Self::TOO_MUCH);
        let sound = within && u * u >= NOTHING;
        if sound {
            let mut weight = 1.0;
            let s = take_in(&mut self.du, u, &mut weight, forgetting);
            let v = turn(&mut self.uv, u, v, s);
            let f = turn(&mut self.uf, u, f, s);
            let y = turn(&mut self.uy, u, y, s);
            add_step(&mut self.v_steps, &mut self.v_before, v, weight, forgetting);
            let s = take_in(&mut self.dv, v, &mut weight, forgetting);
            let f = turn(&mut self.vf, v, f, s);
            let y = turn(&mut self.vy, v, y, s);
            add_step(&mut self.f_steps, &mut self.f_before, f, weight, forgetting);
            let s = take_in(&mut self.df, f, &mut weight, forgetting);
            let y = turn(&mut self.fy, f, y, s);
            let left = weight * y * y;
            self.residual.add_folded(left - forgetting * self.residual.value());
            let share = s * f;
            self.telling.add_folded(share * (left - self.telling.value()));
            self.concentration.add_folded(share * (share - (2.0 - share) * self.concentration.value()));
            self.count.add_folded(1.0 - forgetting * self.count.value());
            self.opening.add_folded(u - forgetting * self.opening.value());
        }
        sound
    }

    /// Σ ẑu, in the rows' scale.
    pub const fn opening(&self) -> f32 {
        self.opening.value()
    }

    /// What the residuals of `rows` would add up to if all were as large as those that say most of k, beyond what they do add up to; none where
    /// it is no more than that again. As many of those as are `taken` by the unknowns leave nothing.
    pub(super) fn uneven(&self, rows: f32, taken: f32) -> f32 {
        let residual = self.residual.value();
        let more = self.telling.value() * rows - residual;
        let worth = 1.0 - taken * self.concentration.value();
        match more > residual {
            false => 0.0,
            true if worth > 0.0 => more / worth,
            true => f32::MAX,
        }
    }

    /// Σ ẑu², in the square of the rows' scale.
    pub const fn constant(&self) -> f32 {
        self.du.value()
    }

    /// The number of rows, those that have faded counting less.
    pub const fn count(&self) -> f32 {
        self.count.value()
    }

    /// The system without the columns that are not kept, as if they had never been there. `row_rate2` is (λ T_row)².
    pub fn keep(&self, disturbance: bool, drag: bool, row_rate2: f32) -> Reduced {
        let u = Share::slow(self.du.value());
        let v = Share::of(self.dv.value(), self.v_steps.value(), row_rate2);
        let f = Share::of(self.df.value(), self.f_steps.value(), row_rate2);
        let rows = [
            [1.0, self.uv.value(), self.uf.value(), self.uy.value()],
            [0.0, 1.0, self.vf.value(), self.vy.value()],
            [0.0, 0.0, 1.0, self.fy.value()],
        ];
        Reduced::new([u, v, f], rows, self.residual.value(), disturbance, drag)
    }

    /// Σ of the squared steps from row to row of what ẑu leaves of ẑv.
    pub(super) const fn v_steps(&self) -> f32 {
        self.v_steps.value()
    }

    /// Whether ẑv has a part of its own, beyond what rounding leaves of a constant.
    pub(crate) fn is_moving(&self) -> bool {
        let (own, du, uv) = (self.dv.value(), self.du.value(), self.uv.value());
        own > OWN_SHARE * (du * uv * uv) && own > SLOWEST2 * du
    }
}

/// Energies below this are nothing: a direction this faint would be lost in subnormal numbers, and its angle with it.
pub(super) const NOTHING: f32 = 1e-30;
/// ẑv has a part of its own where more of its energy than this is not a constant's.
const OWN_SHARE: f32 = 1e-6;
/// The square of the slowest motion that counts as one: 1e-6 m/s.
const SLOWEST2: f32 = 1e-12;

fn add_step(steps: &mut Accumulator, before: &mut f32, x: f32, weight: f32, forgetting: f32) {
    let step = x - *before;
    *before = x;
    steps.add_folded(weight * step * step - forgetting * steps.value());
}

#[inline(always)]
fn take_in(d: &mut Accumulator, x: f32, weight: &mut f32, forgetting: f32) -> f32 {
    let energy = *weight * x * x;
    if energy < NOTHING {
        d.add_folded(-forgetting * d.value());
        return 0.0;
    }
    let before = d.value() - forgetting * d.value();
    d.add_folded(energy - forgetting * d.value());
    let after = d.value();
    let s = *weight * x / after;
    *weight *= before / after;
    s
}

/// Returns what is left of `x` for the next row.
#[inline(always)]
fn turn(r: &mut Accumulator, first: f32, x: f32, s: f32) -> f32 {
    let left = x - first * r.value();
    r.add_folded(s * left);
    left
}
