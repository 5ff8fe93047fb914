//! An axis's block through the cascade, and into its parameter's sums.

use super::axis::{Axis, Marks};
use super::design::Common;
use super::shared::IdentifierClock;
use crate::identifier::{BlockMean, Coefficients, Stage};
use crate::readout::{CoarseStep, NoiseLevel, ParameterState, Ratio, Readout, weight};

/// What all axes need in a round of single samples.
#[derive(Clone, Copy)]
pub(super) struct SingleRound {
    pub stage: Stage,
    pub at: Coefficients,
    pub zu: f32,
}

impl SingleRound {
    #[inline(always)]
    pub fn new(clock: &IdentifierClock, common: &Common) -> Self {
        Self { stage: common.identifier.stage(), at: clock.at, zu: clock.unit.zu() }
    }
}

impl Axis {
    /// Takes the mean of a completed block through the cascade into the parameter's sums, and folds the cascade's on the way.
    #[inline(always)]
    pub fn identify_block(
        &mut self,
        mean: BlockMean,
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        common: &Common,
    ) {
        self.cascade.step_folded(mean.y, mean.s, &common.identifier, &clock.at);
        let mut z2 = self.cascade.z2();
        if common.wants_unit {
            z2 -= self.own.drift * clock.unit.zu();
        }
        let coarse = clock.stride == 0 && clock.is_shaped(common);
        if clock.stride == 0 {
            self.cascade.keep_normal();
        }
        // The window is zero in the first two blocks.
        if self.missed != 0 {
            self.read_out_in_part(z2, coarse, clock, parameter, common);
        } else if clock.blocks > 2 {
            self.read_out(z2, coarse, clock, parameter, common);
        }
    }

    /// A block in which measurements were missed.
    #[inline(never)]
    fn read_out_in_part(
        &mut self,
        z2: f32,
        coarse: bool,
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        common: &Common,
    ) {
        if u32::from(self.missed) < common.block_length && clock.blocks > 2 {
            let coarse = coarse || self.marks.has(Marks::OWES);
            self.marks.set(Marks::OWES, false);
            self.read_out_generally(z2, coarse, clock, parameter, common);
        } else {
            self.marks.set(Marks::OWES, coarse || self.marks.has(Marks::OWES));
        }
        self.missed = 0;
    }

    /// The sample `y`, a block by itself, through the cascade. Returns ẑ2 without the drift. Sums are not folded.
    #[inline(always)]
    pub fn step_single(&mut self, y: f32, round: &SingleRound) -> f32 {
        let mean = self.block.single(y - self.origin, self.moments);
        self.cascade.step_at(mean.y, mean.s, &round.stage, &round.at);
        self.cascade.z2() - self.own.drift * round.zu
    }

    /// What it led to, into the parameter's sums. The coarse step comes after all axes.
    #[inline(always)]
    pub fn add_single(&self, z2: f32, parameter: &mut ParameterState, common: &Common) {
        let z0 = self.cascade.z0();
        if common.plain {
            parameter.ratio.add_plain(z2, z0);
        } else {
            parameter.add_generally(z2, z0, common.readout, common.forgetting);
        }
    }

    /// The coarse step with the sample that has just gone through the cascade.
    pub fn step_coarsely(&mut self, clock: &IdentifierClock, parameter: &mut ParameterState, common: &Common) {
        let (z2, z0) = (self.cascade.z2() - self.own.drift * clock.unit.zu(), self.cascade.z0());
        if Ratio::is_informative(z0) {
            self.coarse_step(z2, z0, clock, parameter, common);
        } else {
            parameter.skip_coarse_step();
        }
    }

    /// The coarse step that fell to a sample that was missing, at the first one after the gap: what that one adds to the quotient, which may be
    /// more than all before it, is in the variance as well.
    #[inline(never)]
    pub fn make_up(&mut self, clock: &IdentifierClock, parameter: &mut ParameterState, common: &Common) {
        if self.marks.has(Marks::OWES) && self.gap == 0 && self.present && clock.blocks > 2 {
            self.marks.set(Marks::OWES, false);
            let z0 = self.cascade.z0();
            if Ratio::is_informative(z0) {
                let z2 = self.cascade.z2() - self.own.drift * clock.unit.zu();
                self.coarse_step(z2, z0, clock, parameter, common);
            }
        }
    }

    /// `coarse`: it is the axis's turn for a coarse step.
    #[inline(always)]
    fn read_out(
        &mut self,
        z2: f32,
        coarse: bool,
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        common: &Common,
    ) {
        if !common.plain {
            self.read_out_generally(z2, coarse, clock, parameter, common);
            return;
        }
        let z0 = self.cascade.z0();
        if parameter.ratio.add_plain(z2, z0) {
            if coarse {
                self.coarse_step(z2, z0, clock, parameter, common);
            }
        } else if coarse {
            parameter.skip_coarse_step();
        }
    }

    #[inline(never)]
    fn read_out_generally(
        &mut self,
        z2: f32,
        coarse: bool,
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        common: &Common,
    ) {
        let z0 = self.cascade.z0();
        if parameter.add_generally(z2, z0, common.readout, common.forgetting) {
            if coarse {
                self.coarse_step(z2, z0, clock, parameter, common);
            }
        } else if coarse {
            parameter.skip_coarse_step();
        }
    }

    /// Every D-th block: the noise level, and how noise reaches k̂.
    #[inline(never)]
    fn coarse_step(
        &mut self,
        z2: f32,
        z0: f32,
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        common: &Common,
    ) {
        let covariance = &common.covariance;
        let step = self.observer.innovation() - self.innovation_before;
        // With the quotient of this very moment: the one read last may be from before the take-off.
        let to_mean = common.measurement_scale(clock);
        let quotient = parameter.ratio.quotient();
        let residual = z2 - quotient * z0;
        let (up, down) = weight(common.readout, z2, z0);
        if self.gap == 0 || self.noise.is_known() {
            self.noise.add(
                self.fine(step * step, common),
                residual * residual * to_mean,
                z2 * z2 * to_mean,
                down * z0,
                (covariance.noise_memory, covariance.noise_forgetting),
            );
        }
        let mut stretch = 1.0;
        if self.noise.has_gaps() {
            // A block in which nothing came is not heard, and does not fade what was missing.
            let came = 1.0 - f32::from(self.missed) * common.block.per_length;
            stretch = self.noise.stretch(covariance.fading(clock.blocks), came);
        }
        let added = self.cross.step(covariance.stride * up * stretch, &clock.shape, covariance);
        self.noise_sum.add_folded(added - covariance.noise_forgetting * self.noise_sum.value());
        let of_noise = self.noise.measurement_variance() * clock.shape.variance() * common.identifier.scale2();
        // What k̂ and the input may be off by is no disturbance.
        let tolerated = quotient * quotient * self.tolerance + parameter.undisturbed_variance(quotient) * z0 * z0;
        let beyond = residual * residual - NoiseLevel::EXPLAINED * (of_noise * (stretch * stretch) + tolerated);
        let beyond = match parameter.suspected() {
            Some(held) => {
                let off = z2 - held * z0;
                if off * off > beyond { off * off } else { beyond }
            }
            None => beyond,
        };
        // As much as is seen, where it can be, and no less than is expected.
        let expected = common.expected(clock);
        let beyond = if beyond > expected && self.noise.is_known() { beyond } else { expected };
        let disturbance = covariance.correlation * beyond;
        let (noise, disturbance) = match common.readout {
            Readout::LeastSquares => (of_noise, disturbance),
            Readout::AbsoluteRatio => (0.0, 0.0),
        };
        let step = CoarseStep { added: covariance.stride * down * z0, noise, weight: up, disturbance };
        parameter.step_coarsely(&step, covariance.forgetting);
    }

    /// Of ẑ2, by noise and by the disturbance that is expected; none before the noise and its shape are known.
    pub fn variance(&self, clock: &IdentifierClock, common: &Common) -> Option<f32> {
        let known = self.present && self.noise.is_known() && clock.is_shaped(common);
        let of_noise = self.noise.measurement_variance() * clock.shape.variance() * common.identifier.scale2();
        known.then_some(of_noise + common.expected(clock))
    }

    /// The variance of a block's mean from the squared step of the innovation. A block has the noise of as many measurements as
    /// came; and a prediction in place of a measurement is off by nothing, which tells nothing.
    #[inline(always)]
    fn fine(&self, square: f32, common: &Common) -> f32 {
        if self.missed == 0 { square * common.innovation_to_mean } else { self.fine_in_part(square, common) }
    }

    #[inline(never)]
    fn fine_in_part(&self, square: f32, common: &Common) -> f32 {
        if self.gap == 0 {
            let came = common.block_length.saturating_sub(u32::from(self.missed)).max(1);
            square * common.innovation_to_mean * (common.block.length / came as f32)
        } else {
            self.noise.measurement_variance()
        }
    }

    /// Adds this axis's share of what its parameter's uncertainty is made of. What an axis that no longer takes part has left
    /// in the sums stays as noisy as it was (a little more than that where memory fades); of the model it tells nothing.
    #[inline(always)]
    pub fn add_misfit(&self, to: &mut Misfit, per_stride: f32) {
        let sum = self.noise_sum.value();
        to.gain += sum;
        let share = per_stride * sum;
        to.variance += self.noise.variance() * share;
        to.measured += self.noise.measured() * share;
        if !self.present {
            return;
        }
        let (unexplained, signal) = self.noise.misfit(to.disturbance);
        // While the noise level is not known the variance is not, unless nothing has been added yet.
        to.known &= sum == 0.0 || self.noise.is_known();
        to.unexplained += unexplained;
        to.signal += signal;
    }
}

impl Common {
    /// Variance of ẑ2 by the disturbance that is expected.
    #[inline(always)]
    fn expected(&self, clock: &IdentifierClock) -> f32 {
        self.disturbance * (clock.unit.zu() * clock.unit.zu())
    }

    /// From a square of ẑ2 to the variance that measurements would need for it.
    #[inline(always)]
    fn measurement_scale(&self, clock: &IdentifierClock) -> f32 {
        self.covariance.stride / (clock.shape.variance() * self.identifier.scale2())
    }

    /// The disturbance that is expected as that variance, which is where misfits are compared.
    #[inline(always)]
    pub fn expected_misfit(&self, clock: &IdentifierClock) -> f32 {
        if self.disturbance > 0.0 { self.expected(clock) * self.measurement_scale(clock) } else { 0.0 }
    }
}

/// What the axes that share a parameter contribute to its uncertainty.
#[derive(Clone, Copy)]
pub(super) struct Misfit {
    /// Whether the noise is known.
    pub known: bool,
    /// var a, the variance of the numerator of k̂ for unit noise of coarse steps.
    gain: f32,
    /// σ² var a, the variance of the numerator of k̂.
    variance: f32,
    /// The same of measurement noise alone.
    measured: f32,
    /// What the model leaves unexplained beyond noise, and what there is to explain.
    pub unexplained: f32,
    pub signal: f32,
    /// What is expected to be there without the model explaining it.
    disturbance: f32,
}

impl Misfit {
    /// Nothing yet, where a disturbance of that variance is expected, in the square of the position's unit.
    pub const fn beside(disturbance: f32) -> Self {
        Self { known: true, gain: 0.0, variance: 0.0, measured: 0.0, unexplained: 0.0, signal: 0.0, disturbance }
    }

    /// A gain below this is made of numbers that are too small for f32: of a window that has hardly opened yet.
    const LEAST: f32 = 1e-34;

    /// The variance of the numerator, where it is known, and what part of it measurement noise has by itself.
    #[inline(always)]
    pub fn known_variance(&self) -> Option<[f32; 2]> {
        if self.known && self.gain >= Self::LEAST { Some([self.variance, self.measured]) } else { None }
    }
}
