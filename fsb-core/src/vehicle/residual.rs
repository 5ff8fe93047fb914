//! Has a parameter changed? By what it leaves in the band of the identifier.
//!
//! With k off by Δk the residual ẑ2 - k ẑ0 is Δk ẑ0 (design, section 4), as far below the noise as the identifier's band is
//! below the observer's: this finds the changes that the innovations hide, only later, by some 2/λ of the identifier.
//! κ = k Σ w e a/Σ w a², a = k ẑ0, over the last 3/λ, w being one over the variance that e has by noise and by the disturbance
//! that was configured. Not all that stands out is a change: κ has to explain more of Σ w e² than it leaves.

use crate::estimator::IdentifierView;
use crate::snapshot::{Archive, Stored, stored};

/// Σ w e², Σ w e a, Σ w a², and Σ 1, of one parameter.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    squares: f32,
    product: f32,
    square: f32,
    values: f32,
}

impl Sums {
    fn fade(&mut self, keep: f32) {
        for sum in [&mut self.squares, &mut self.product, &mut self.square, &mut self.values] {
            let faded = keep * *sum;
            *sum = if faded.abs() < Self::NOTHING { 0.0 } else { faded };
        }
    }

    fn add(&mut self, e: f32, a: f32, variance: f32) {
        let squares = [e * e, a * a];
        let weight = 1.0 / (variance + Self::ROUNDING * (squares[0] + squares[1]));
        let [of_e, of_a] = squares.map(|square| weight * square);
        // What is no number tells nothing.
        if of_e <= Self::MOST && of_a <= Self::MOST {
            self.squares += of_e;
            self.product += weight * (e * a);
            self.square += of_a;
            self.values += 1.0;
        }
    }

    /// Whether κ is beyond both limits and explains most.
    fn show(&self, relative: f32, sigmas2: f32) -> bool {
        let explained = self.product * (self.product / self.square);
        let beyond_noise = self.squares - Self::NOISE * self.values;
        self.product.abs() > relative * self.square && explained > sigmas2 && 2.0 * explained > beyond_noise
    }

    /// Sums below this are none: they do not end among the subnormal numbers.
    const NOTHING: f32 = 1e-30;
    /// What noise makes of w e², at most.
    const NOISE: f32 = 1.5;
    /// The square of what rounding makes of e.
    const ROUNDING: f32 = 1e-14;
    /// Of w e² and w a², which rounding limits.
    const MOST: f32 = 2.0 / Self::ROUNDING;
}

/// For three axes, with one parameter or one each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residuals {
    relative: f32,
    sigmas2: f32,
    pooled: bool,
    /// Steps of the identifier from one look to the next.
    every: u32,
    blocks: u32,
    sums: [Sums; 3],
    /// For how long, times λ, each has shown a change.
    streaks: [f32; 3],
}

impl Residuals {
    /// λT by which residuals hardly change.
    const SAME: f64 = 0.08;

    /// `step` is λ times the identifier's period.
    pub fn new(relative: f32, sigmas2: f32, step: f64, pooled: bool) -> Self {
        let every = libm::fmin(Self::SAME / step, 1e6) as u32;
        let (sums, streaks) = Default::default();
        Self { relative, sigmas2, pooled, every: every.max(1), blocks: 0, sums, streaks }
    }

    /// The identification has begun anew.
    pub fn reset(&mut self) {
        (self.blocks, self.sums, self.streaks) = Default::default();
    }

    /// Whether the identifier, which has come to so many blocks, is steps enough further than at the last look, or has begun anew.
    pub fn are_behind(&self, blocks: u32) -> bool {
        blocks < self.blocks || blocks - self.blocks >= self.every
    }

    /// A look after a step of the identifier: whether one of the parameters, `known` where they are, has changed. Cost: about 70 operations.
    pub fn observe(&mut self, view: &IdentifierView<3>, known: &[Option<f32>; 3]) -> bool {
        self.blocks = view.blocks;
        // Over 3/λ, which is all one value: as correlated as that.
        let since = view.c * self.every as f32;
        let keep = 1.0 - since * (1.0 / 3.0);
        let sigmas2 = self.sigmas2 * 3.0 / since;
        for (sums, known) in self.sums.iter_mut().zip(known) {
            if known.is_some() { sums.fade(keep) } else { *sums = Sums::default() }
        }
        let of_axes = view.z2.iter().zip(&view.z0).zip(&view.variances);
        for (axis, ((z2, z0), of_e)) in of_axes.enumerate() {
            let of = if self.pooled { 0 } else { axis };
            if let (Some(sums), Some(Some(k)), Some(of_e)) = (self.sums.get_mut(of), known.get(of), of_e) {
                let a = k * z0;
                sums.add(z2 - a, a, *of_e);
            }
        }
        let mut changed = false;
        for ((streak, sums), k) in self.streaks.iter_mut().zip(&self.sums).zip(known) {
            let shows = k.is_some() && sums.show(self.relative, sigmas2);
            *streak = if shows { *streak + since } else { 0.0 };
            changed |= *streak > 0.2;
        }
        changed
    }
}

stored!(Sums { squares, product, square, values });

impl Stored for Residuals {
    fn pass(&mut self, archive: &mut dyn Archive) {
        self.blocks.pass(archive);
        self.sums.pass(archive);
        self.streaks.pass(archive);
    }
}

impl Residuals {
    /// Of a state that was stored: sums of squares are none below zero, and nothing in them can overflow.
    pub fn is_sound(&self) -> bool {
        const MOST: f32 = 1e25;
        let is_square = |x: f32| (0.0..=MOST).contains(&x);
        self.sums.iter().all(|sums| {
            [sums.squares, sums.square, sums.values].into_iter().all(is_square) && sums.product.abs() <= MOST
        }) && self.streaks.iter().all(|streak| is_square(*streak))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const K: f32 = 2.0;
    const C: f32 = 0.04;

    /// Steps until a change is told, of `(ẑ2, ẑ0, variance)`, after 400 of a k that is right.
    fn told(pooled: bool, mut step: impl FnMut(f32) -> [(f32, f32, Option<f32>); 3]) -> Option<u32> {
        let mut residuals = Residuals::new(0.15, 36.0, 0.04, pooled);
        let known = if pooled { [Some(K), None, None] } else { [Some(K); 3] };
        (0..1200).find(|&n| {
            assert_eq!(residuals.are_behind(n + 1), n % 2 == 1);
            if n % 2 == 0 {
                return false;
            }
            let axes = if n < 400 { right(n) } else { step(n as f32) };
            let view = IdentifierView {
                blocks: n + 1,
                weight: 1.0,
                c: C,
                per_length: 1.0,
                forgetting: 0.0,
                z0: axes.map(|axis| axis.1),
                z2: axes.map(|axis| axis.0),
                variances: axes.map(|axis| axis.2),
                counts: [true; 3],
                denominators: [1.0; 3],
            };
            let changed = residuals.observe(&view, &known);
            assert!(residuals.is_sound());
            changed
        })
    }

    fn force(n: f32, axis: usize) -> f32 {
        libm::sinf(0.02 * n + axis as f32)
    }

    fn right(n: u32) -> [(f32, f32, Option<f32>); 3] {
        [0, 1, 2].map(|axis| (K * force(n as f32, axis), force(n as f32, axis), Some(1e-6)))
    }

    /// `k` of the axes, and what each has beyond that.
    fn axes(n: f32, k: [f32; 3], beyond: f32, variance: f32) -> [(f32, f32, Option<f32>); 3] {
        [0, 1, 2].map(|axis| (k[axis] * force(n, axis) + beyond, force(n, axis), Some(variance)))
    }

    #[test]
    fn what_is_a_change() {
        for pooled in [true, false] {
            for factor in [1.2, 0.8, 3.0, 0.3] {
                let late = told(pooled, |n| axes(n, [factor * K; 3], 0.0, 1e-6)).expect("a change") - 400;
                // By 20 % once the last 3/λ are of after it, by more sooner; never in less than 0.2/λ.
                assert!((5..200).contains(&late), "{pooled} {factor}: {late}");
            }
            for factor in [1.13, 1.0, 0.87] {
                assert_eq!(told(pooled, |n| axes(n, [factor * K; 3], 0.0, 1e-6)), None, "{pooled} {factor}");
            }
            // What noise or a disturbance of that size may be.
            assert_eq!(told(pooled, |n| axes(n, [1.5 * K; 3], 0.0, 0.3)), None);
            // As large, and not along the input.
            assert_eq!(told(pooled, |n| axes(n, [K; 3], 0.7 * K * libm::sinf(0.5 * n), 1e-6)), None);
            // Of which no variance is known.
            assert_eq!(told(pooled, |n| axes(n, [3.0 * K; 3], 0.0, 1e-6).map(|axis| (axis.0, axis.1, None))), None);
        }
        // Of one axis, where each has its own parameter.
        for one in 0..3 {
            let k = [0, 1, 2].map(|axis| if axis == one { 1.5 * K } else { K });
            assert!(told(false, |n| axes(n, k, 0.0, 1e-6)).is_some(), "{one}");
        }
    }

    /// Numbers that are none are passed over.
    #[test]
    fn no_numbers() {
        for bad in [f32::NAN, f32::INFINITY, f32::MAX] {
            for which in 0..2 {
                let wrong = |axis: (f32, f32, Option<f32>)| {
                    if which == 0 { (bad, axis.1, axis.2) } else { (axis.0, bad, axis.2) }
                };
                let step =
                    |n: f32| axes(n, [3.0 * K; 3], 0.0, 1e-6).map(|axis| if n < 600.0 { wrong(axis) } else { axis });
                assert!(told(false, step).is_some_and(|n| n > 600), "{bad} {which}");
            }
        }
    }
}
