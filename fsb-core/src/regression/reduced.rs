//! A triangle at the moment of reading, columns that do not take part being left out, and what it says.
//!
//! Rows are not independent of each other. White measurement noise reaches ẑ2 with the spectrum ω⁴/(ω² + λ²)³, which peaks at
//! ω = √2 λ with 0.79/λ times its variance: a regressor that swings at that frequency meets 0.79/(λ T_row) rows in the place
//! of one, a slower one fewer by 27/4 w²/(1 + w)³, w = (ω/λ)². Errors of the model are slow, too, so that the factor is
//! not taken below a quarter: the standard deviation of d is two to four times too large for white noise alone.
//!
//! What the trapezoidal rule leaves out of ẑv, T²/12 ẑv'' (`velocity`), pulls D by as much of it as goes with ẑv, and k at the worst by
//! all of D times it over what is left of ẑ0; steps from row to row tell ẑv ẑv''. Squares of both count.
//!
//! A term left out is not known to be zero. What it would put into the others is linear in it; so its variance, that of what it
//! may be, is one of theirs.

use super::gusts::Gusts;
use super::triangle::NOTHING;

/// A value and its variance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// In the unit of what is estimated.
    pub value: f32,
    /// The square of its standard deviation.
    pub variance: f32,
}

/// The energy of one column that the columns before do not explain, and the same as noise weighs it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Share {
    energy: f32,
    noise: f32,
}

impl Share {
    /// What noise counts for at least, of what it would at the peak of its spectrum.
    const FLOOR: f32 = 0.25;

    /// Of a column that hardly changes.
    pub fn slow(energy: f32) -> Self {
        Self { energy, noise: Self::FLOOR * energy }
    }

    /// Of a column whose squared steps add up to `steps`.
    pub fn of(energy: f32, steps: f32, row_rate2: f32) -> Self {
        let w = steps / (energy * row_rate2);
        let sum = 1.0 + w;
        let factor = if w < 2.0 { 6.75 * (w * w) / (sum * sum * sum) } else { 1.0 };
        Self { energy, noise: if factor > Self::FLOOR { factor * energy } else { Self::FLOOR * energy } }
    }

    /// Over the information, the variance of what this row of the triangle tells; `gusts` adds to that of a row, at any frequency.
    fn variance(&self, row_variance: f32, gusts: f32) -> f32 {
        let factor = self.noise / self.energy;
        (row_variance * factor + gusts) / self.energy
    }
}

/// What a unit of D and of d, where its column is left out, puts into a right-hand side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Untold {
    drag: f32,
    disturbance: f32,
}

impl Untold {
    /// The variance that `unknown` terms make of it.
    fn variance(self, unknown: &Unknown) -> f32 {
        let Self { drag, disturbance } = self;
        drag * drag * unknown.drag_variance + disturbance * disturbance * unknown.disturbance_variance
    }

    /// x ← x + s (row - first x), as the right-hand side itself; returns the row without what the triangle knows of it.
    fn turn(&mut self, first: f32, row: Self, s: f32) -> Self {
        let left = Self { drag: row.drag - first * self.drag, disturbance: row.disturbance - first * self.disturbance };
        self.drag += s * left.drag;
        self.disturbance += s * left.disturbance;
        left
    }

    fn over(self, first: f32) -> Self {
        Self { drag: self.drag / first, disturbance: self.disturbance / first }
    }
}

/// How far from zero the terms may be that are asked for and left out: variances, zero for one that is not asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Unknown {
    /// Of D, 1/s².
    pub drag_variance: f32,
    /// Of d, m²/s⁴.
    pub disturbance_variance: f32,
}

/// Columns u (d), v (D), f (k) and the right-hand side y; a column left out has a row of zeros, and its share in the
/// right-hand sides of the others is kept beside them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reduced {
    u: Share,
    v: Share,
    f: Share,
    uv: f32,
    uf: f32,
    uy: f32,
    vf: f32,
    vy: f32,
    fy: f32,
    residual: f32,
    in_u: Untold,
    in_v: Untold,
    in_f: Untold,
    /// What gusts add to the variance of a row.
    gusts: f32,
    /// What goes with the velocity of them, Σ over the rows.
    carried: f32,
    /// What the rule by which ẑv is taken leaves out, times ẑv, Σ over the rows.
    bent: f32,
}

impl Reduced {
    pub(super) fn new(shares: [Share; 3], rows: [[f32; 4]; 3], residual: f32, disturbance: bool, drag: bool) -> Self {
        let [u, v, f] = shares;
        let [[_, uv, uf, uy], [_, _, vf, vy], [_, _, _, fy]] = rows;
        let (uv, untold) = if drag { (uv, 0.0) } else { (0.0, uv) };
        let mut kept = Self { f, fy, residual, ..Self::default() };
        if drag {
            (kept.v, kept.vf, kept.vy) = (v, vf, vy);
        } else {
            kept.take_in(v, 0.0, vf, vy, Untold { drag: 1.0, disturbance: 0.0 });
        }
        if disturbance {
            (kept.u, kept.uv, kept.uf, kept.uy) = (u, uv, uf, uy);
            kept.in_u.drag = untold;
        } else {
            kept.take_in(u, uv, uf, uy, Untold { drag: untold, disturbance: 1.0 });
        }
        kept
    }

    /// The same in gusts.
    #[inline(always)]
    pub(super) fn set_gusts(&mut self, gusts: &Gusts, constant: f32) {
        self.gusts = gusts.row;
        self.carried = gusts.carried * constant;
    }

    /// The same with what the rule by which ẑv is taken leaves out of it: T²/12 ẑv''.
    #[inline(always)]
    pub(super) fn set_rule(&mut self, bent: f32) {
        self.bent = bent;
    }

    /// The information on k: what of Σ ẑ0² the axis's own unknowns do not take.
    pub const fn information(&self) -> f32 {
        self.f.energy
    }

    /// What this axis alone says k is.
    pub const fn k(&self) -> f32 {
        self.fy
    }

    /// Variance of that, `row_variance` being that of a row at the peak of the spectrum of noise.
    pub fn k_variance(&self, row_variance: f32) -> f32 {
        self.f.variance(row_variance, self.gusts) + self.by_rule()
    }

    /// The square of what k is off by where all that the rule leaves out of D ẑv goes with ẑ0.
    fn by_rule(&self) -> f32 {
        if self.v.energy > 0.0 {
            let bent = self.bent * (self.vy - self.vf * self.fy);
            (bent / self.v.energy) * (bent / self.f.energy)
        } else {
            0.0
        }
    }

    /// Variance of that by the terms left out.
    pub(super) fn k_untold(&self, unknown: &Unknown) -> f32 {
        self.in_f.variance(unknown)
    }

    /// Σ of the squared residuals of this axis with the parameter that is the best for it.
    pub(super) const fn least_residual(&self) -> f32 {
        self.residual
    }

    /// Σ of the squared residuals of this axis if the parameter is `k`, D and d being the best for it.
    pub fn residual(&self, k: f32) -> f32 {
        let off = self.fy - k;
        self.residual + self.f.energy * (off * off)
    }

    /// D for this k.
    pub fn drag(&self, k: Estimate, row_variance: f32) -> Estimate {
        let value = self.vy - self.vf * k.value;
        Estimate { value, variance: self.own_drag_variance(value, row_variance) + self.vf * self.vf * k.variance }
    }

    /// The variance of D for a k that is known.
    fn own_drag_variance(&self, drag: f32, row_variance: f32) -> f32 {
        let per_energy = 1.0 / self.v.energy;
        let (pulled, bent) = (self.carried * per_energy, self.bent * per_energy * drag);
        self.v.variance(row_variance, self.gusts) + (pulled * pulled + bent * bent)
    }

    /// Variance of that by the terms left out.
    pub(super) fn drag_untold(&self, unknown: &Unknown) -> f32 {
        self.in_v.variance(unknown)
    }

    /// d for this k and this D, which is zero where it does not take part.
    pub fn disturbance(&self, k: Estimate, drag: f32, row_variance: f32) -> Estimate {
        let by_k = self.uf - self.uv * self.vf;
        let by_drag =
            if self.v.energy > 0.0 { self.uv * self.uv * self.own_drag_variance(drag, row_variance) } else { 0.0 };
        Estimate {
            value: self.uy - self.uv * drag - self.uf * k.value,
            variance: self.u.variance(row_variance, self.gusts) + by_drag + by_k * by_k * k.variance,
        }
    }

    /// Variance of that by the terms left out.
    pub(super) fn disturbance_untold(&self, unknown: &Unknown) -> f32 {
        self.in_u.variance(unknown)
    }

    /// A row of the triangle whose own column is left out.
    #[inline(always)]
    fn take_in(&mut self, row: Share, v: f32, f: f32, y: f32, untold: Untold) {
        let (mut weight, noise) = (row.energy, row.noise / row.energy);
        let (s, alone) = rotate(&mut self.v, v, &mut weight, noise);
        let left_f = f - v * self.vf;
        let left_y = y - v * self.vy;
        self.vf += s * left_f;
        self.vy += s * left_y;
        let left_untold = self.in_v.turn(v, untold, s);
        if alone {
            (self.vf, self.vy, self.in_v) = (f / v, y / v, untold.over(v));
        }
        let (s, alone) = rotate(&mut self.f, left_f, &mut weight, noise);
        let left = left_y - left_f * self.fy;
        self.fy += s * left;
        self.in_f.turn(left_f, left_untold, s);
        if alone {
            (self.fy, self.in_f) = (left_y / left_f, left_untold.over(left_f));
        }
        self.residual += weight * left * left;
    }
}

/// A row next to whose energy what was there before is less than this share of it stands alone: that may be anything, noise over rounding,
/// and what it should be is not to be had by correcting it.
const NEXT_TO_NOTHING: f32 = 6.1e-5;

/// s, and whether the row stands alone.
fn rotate(to: &mut Share, x: f32, weight: &mut f32, noise: f32) -> (f32, bool) {
    let energy = *weight * x * x;
    if energy < NOTHING {
        return (0.0, false);
    }
    let before = to.energy;
    to.energy += energy;
    to.noise += energy * noise;
    let s = *weight * x / to.energy;
    *weight *= before / to.energy;
    (s, before < NEXT_TO_NOTHING * energy)
}
