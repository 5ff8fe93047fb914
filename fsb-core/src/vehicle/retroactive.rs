//! The gyroscopic moment with the newest moments of inertia, in retrospect.
//!
//! What went into the identifier beside the torque is γ₀(t) w(t), w = ω_j ω_k, with the γ = I_j - I_k of its time; with a rough
//! first guess that stays in sums over everything. Two more cascades per axis, of w and of γ₀ w, and their correlations with
//! ẑ0 tell by how much: with A = Σ ẑ0 ẑ_w and B = Σ ẑ0 ẑ_(γ₀w)
//!
//! Σ ẑ0 ẑ2 = k (Σ ẑ0² + γ A - B)
//!
//! holds for the true γ, whatever γ₀ was. The bracket replaces the parameter's denominator as γ becomes better known, and ẑ0
//! itself moves to the newest γ: a fixed point, one step of it per step of the identifier. Exact for blocks of one; for longer ones w lags by a part of a block, which
//! matters to the difference γ - γ₀ alone.
//!
//! For least squares: where its sums fade, A, B and what they have put into the denominator fade with them. Those of the
//! absolute ratio are not linear in ẑ0, and keep what a rough first guess did to them.

use super::gyroscopic::differences_known;
use crate::accumulator::Accumulator;
use crate::estimator::{IdentifierView, InnovationView, InputShift};
use crate::moments::{InputMoments, Substep};
use crate::readout::{Parameter, Ratio};
use crate::snapshot::{Archive, Stored, stored};

/// One cascade for an input: x4, x5, x6 of (38).
#[derive(Clone, Copy, Debug, Default)]
struct Chain {
    /// Over the present interval.
    moments: InputMoments,
    /// j1 - j2 of the interval before.
    past: f32,
    /// Σ S in the block, and its mean over the block before.
    sum: f32,
    before: f32,
    x: [f32; 3],
}

/// Products of rates below this are none, (rad/s)²; and where chains and means of nothing end, instead of decaying through the subnormal
/// numbers.
const NOTHING: f32 = 1e-30;

/// A product of rates.
#[inline(always)]
fn noticed(w: f32) -> f32 {
    if w.abs() < NOTHING { 0.0 } else { w }
}

impl Chain {
    /// The interval has ended. The identity's S joins the block.
    fn sample(&mut self) {
        self.sum += self.moments.j2 + self.past;
        self.past = self.moments.j1 - self.moments.j2;
        self.moments = InputMoments::ZERO;
    }

    fn step(&mut self, view: &IdentifierView<3>) -> f32 {
        let mean = self.sum * view.per_length;
        self.sum = 0.0;
        // The S of a block's mean is a mean over two blocks.
        let s = if view.per_length == 1.0 { mean } else { 0.5 * (mean + self.before) };
        self.before = mean;
        let [x4, x5, x6] = &mut self.x;
        *x6 += view.c * (view.weight * s - *x6) + NOTHING;
        *x5 += view.c * (*x6 - *x5);
        *x4 += view.c * (*x5 - *x4);
        *x4
    }
}

#[derive(Clone, Copy, Debug, Default)]
struct Axis {
    /// Of w.
    own: Chain,
    /// Of γ₀ w.
    used: Chain,
    a: Accumulator,
    b: Accumulator,
    /// γ A - B as it stands in the parameter's denominator.
    applied: f32,
    /// The square of what it may be off by, over that of the denominator.
    doubt: f32,
}

impl Axis {
    /// As the parameter's sums do before they take ẑ0.
    #[inline(never)]
    fn fade(&mut self, z0: f32, forgetting: f32) {
        if Ratio::is_informative(z0) {
            self.a.add_folded(-forgetting * self.a.value());
            self.b.add_folded(-forgetting * self.b.value());
            self.applied -= forgetting * self.applied;
        }
    }
}

/// Three axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Retroactive {
    axes: [Axis; 3],
    blocks: u32,
    substep: Substep,
    /// At the last measurement instant.
    innovations: [f32; 3],
    /// What the rates have lacked of late (rad/s): a mean over some eight intervals.
    lacked: [f32; 3],
}

impl Retroactive {
    /// The correction's largest share of the denominator: beyond, the torque is too small beside the gyroscopic moment for
    /// the fixed point to be one.
    const LARGEST: f32 = 0.5;
    /// Nothing is known of k any more.
    const MOST_DOUBT: f32 = 1e6;

    pub fn new(substep: Substep) -> Self {
        Self { axes: [Axis::default(); 3], blocks: 0, substep, innovations: [0.0; 3], lacked: [0.0; 3] }
    }

    /// With the identification.
    pub fn reset(&mut self) {
        *self = Self::new(self.substep);
    }

    /// With the identifier's window. Where its sums stay, so do these.
    fn begin_window(&mut self, view: &IdentifierView<3>) {
        self.blocks = 0;
        for (axis, denominator) in self.axes.iter_mut().zip(view.denominators) {
            if denominator == 0.0 {
                *axis = Axis::default();
            }
            (axis.own, axis.used) = Default::default();
        }
    }

    /// A control period with w and the γ₀ that was used with it.
    pub fn hold(&mut self, products: &[f32; 3], used: &[f32; 3]) {
        for ((axis, w), gamma) in self.axes.iter_mut().zip(products).zip(used) {
            let w = noticed(*w);
            axis.own.moments.hold(w, &self.substep);
            axis.used.moments.hold(gamma * w, &self.substep);
        }
    }

    /// What `rates` lacked in the interval that has ended, while the prediction may be a wrong one: the innovations tell it,
    /// r - m1 r of the one before being T times that (but for its growth in the interval).
    pub fn correct(&mut self, view: &InnovationView<3>, [p, q, r]: &[f32; 3], period: f32) {
        let mut lacked = [0.0; 3];
        let innovations = view.innovations.iter().zip(&self.innovations).zip(&mut self.lacked);
        for (lacked, ((now, before), of_late)) in lacked.iter_mut().zip(innovations) {
            *lacked = (now - view.m1 * before) / period;
            *of_late += 0.125 * (*lacked - *of_late) + NOTHING;
        }
        let [dp, dq, dr] = lacked;
        // The product of two noises would be one more of them; that of their means hardly is any.
        let [ep, eq, er] = self.lacked;
        let products = [q * dr + r * dq + eq * er, r * dp + p * dr + er * ep, p * dq + q * dp + ep * eq];
        for (axis, w) in self.axes.iter_mut().zip(products.map(noticed)) {
            axis.own.moments.j1 += w;
            axis.own.moments.j2 += 0.5 * w;
        }
    }

    /// After a measurement instant.
    pub fn sample(&mut self, view: &InnovationView<3>) {
        self.innovations = view.innovations;
        for axis in &mut self.axes {
            axis.own.sample();
            axis.used.sample();
        }
    }

    /// Whether the identifier, which has come to so many blocks, has stepped or begun anew since the last [`step`](Self::step).
    pub fn is_behind(&self, blocks: u32) -> bool {
        blocks != self.blocks
    }

    /// After a step of the identifier: what has to change. `k` are the newest 1/I, where there are any, and `guesses` those
    /// from before. Nothing, where it has only begun anew. Cost: about 180 operations.
    pub fn step(
        &mut self,
        view: &IdentifierView<3>,
        k: &[Option<Parameter>; 3],
        guesses: &[Option<f32>; 3],
    ) -> Option<[InputShift; 3]> {
        let mut shifts = [InputShift::default(); 3];
        if view.blocks < self.blocks {
            self.begin_window(view);
            if view.blocks == 0 {
                return None;
            }
        }
        self.blocks = view.blocks;
        let (differences, variances) = differences_known(k, guesses);
        let known = differences.iter().zip(&variances);
        let of_axes = view.z0.iter().zip(view.counts).zip(view.denominators).zip(known);
        for ((axis, shift), (((z0, counts), denominator), (gamma, variance))) in
            self.axes.iter_mut().zip(&mut shifts).zip(of_axes)
        {
            let (own, used) = (axis.own.step(view), axis.used.step(view));
            if counts {
                if view.forgetting > 0.0 {
                    axis.fade(*z0, view.forgetting);
                }
                axis.a.add_folded(z0 * own);
                axis.b.add_folded(z0 * used);
            }
            let correction = gamma * axis.a.value() - axis.b.value();
            let limit = Self::LARGEST * (denominator - axis.applied);
            let wanted = correction - axis.applied;
            let (left, share) = if correction.abs() <= limit {
                shift.denominator = wanted;
                axis.applied = correction;
                (0.0, axis.a.value() / (denominator + wanted))
            } else {
                (wanted / denominator, axis.a.value() / denominator)
            };
            let doubt = share * share * variance + left * left;
            let doubt = if doubt <= Self::MOST_DOUBT { doubt } else { Self::MOST_DOUBT };
            // k is read out a step later.
            shift.doubt = if doubt > axis.doubt { doubt } else { axis.doubt };
            axis.doubt = doubt;
            shift.tolerance = variance * (own * own);
            for ((shift, used), own) in shift.cascade.iter_mut().zip(&mut axis.used.x).zip(axis.own.x) {
                let wanted = gamma * own;
                *shift = wanted - *used;
                *used = wanted;
            }
        }
        Some(shifts)
    }
}

stored!(Chain { moments, past, sum, before, x });
stored!(Axis { own, used, a, b, applied, doubt });

impl Stored for Retroactive {
    fn pass(&mut self, archive: &mut dyn Archive) {
        self.axes.pass(archive);
        self.blocks.pass(archive);
        self.innovations.pass(archive);
        self.lacked.pass(archive);
    }
}

impl Chain {
    fn numbers(&self) -> impl Iterator<Item = f32> {
        [self.moments.j1, self.moments.j2, self.past, self.sum, self.before].into_iter().chain(self.x)
    }
}

impl Retroactive {
    /// Products of rates, scaled as inputs are: far below this. The square of it is a number.
    const MOST: f32 = 1e15;

    /// Of a state that was stored: nothing in it can overflow.
    pub fn is_sound(&self) -> bool {
        self.innovations.iter().chain(&self.lacked).all(|x| x.abs() <= Self::MOST)
            && self.axes.iter().all(|axis| {
                axis.own.numbers().chain(axis.used.numbers()).all(|x| x.abs() <= Self::MOST)
                    && [axis.a.value(), axis.b.value(), axis.applied].iter().all(|x| x.abs() <= Self::MOST * Self::MOST)
            })
    }
}
