//! A triangle at the moment of reading, columns that do not take part being left out, and what it says.
//!
//! Rows are not independent of each other. White measurement noise reaches ẑ2 with the spectrum ω⁴/(ω² + λ²)³, which peaks at
//! ω = √2 λ with 0.79/λ times its variance: a regressor that swings at that frequency meets 0.79/(λ T_row) rows in the place
//! of one, a slower one fewer by 27/4 w²/(1 + w)³, w = (ω/λ)². Errors of the model are slow, too, so that the factor is
//! not taken below a quarter: the standard deviation of d is two to four times too large for white noise alone.

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

    /// Over the information, the variance of what this row of the triangle tells.
    fn variance(&self, row_variance: f32) -> f32 {
        let factor = self.noise / self.energy;
        row_variance * factor / self.energy
    }
}

/// Columns u (d), v (D), f (k) and the right-hand side y; a column left out has a row of zeros.
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
}

impl Reduced {
    pub(super) fn new(shares: [Share; 3], rows: [[f32; 4]; 3], residual: f32, disturbance: bool, drag: bool) -> Self {
        let [u, v, f] = shares;
        let [[_, uv, uf, uy], [_, _, vf, vy], [_, _, _, fy]] = rows;
        let uv = if drag { uv } else { 0.0 };
        let mut kept = Self { f, fy, residual, ..Self::default() };
        if drag {
            (kept.v, kept.vf, kept.vy) = (v, vf, vy);
        } else {
            kept.take_in(v, 0.0, vf, vy);
        }
        if disturbance {
            (kept.u, kept.uv, kept.uf, kept.uy) = (u, uv, uf, uy);
        } else {
            kept.take_in(u, uv, uf, uy);
        }
        kept
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
        self.f.variance(row_variance)
    }

    /// Σ of the squared residuals of this axis if the parameter is `k`, D and d being the best for it.
    pub fn residual(&self, k: f32) -> f32 {
        let off = self.fy - k;
        self.residual + self.f.energy * (off * off)
    }

    /// D for this k.
    pub fn drag(&self, k: Estimate, row_variance: f32) -> Estimate {
        Estimate {
            value: self.vy - self.vf * k.value,
            variance: self.v.variance(row_variance) + self.vf * self.vf * k.variance,
        }
    }

    /// d for this k and this D, which is zero where it does not take part.
    pub fn disturbance(&self, k: Estimate, drag: f32, row_variance: f32) -> Estimate {
        let by_k = self.uf - self.uv * self.vf;
        let by_drag = if self.v.energy > 0.0 { self.uv * self.uv * self.v.variance(row_variance) } else { 0.0 };
        Estimate {
            value: self.uy - self.uv * drag - self.uf * k.value,
            variance: self.u.variance(row_variance) + by_drag + by_k * by_k * k.variance,
        }
    }

    /// A row of the triangle whose own column is left out.
    fn take_in(&mut self, row: Share, v: f32, f: f32, y: f32) {
        let (mut weight, noise) = (row.energy, row.noise / row.energy);
        let s = rotate(&mut self.v, v, &mut weight, noise);
        let left_f = f - v * self.vf;
        let left_y = y - v * self.vy;
        self.vf += s * left_f;
        self.vy += s * left_y;
        let s = rotate(&mut self.f, left_f, &mut weight, noise);
        let left = left_y - left_f * self.fy;
        self.fy += s * left;
        self.residual += weight * left * left;
    }
}

fn rotate(to: &mut Share, x: f32, weight: &mut f32, noise: f32) -> f32 {
    let energy = *weight * x * x;
    if energy < NOTHING {
        return 0.0;
    }
    let before = to.energy;
    to.energy += energy;
    to.noise += energy * noise;
    let s = *weight * x / to.energy;
    *weight *= before / to.energy;
    s
}
