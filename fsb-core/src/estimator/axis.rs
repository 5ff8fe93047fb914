//! The state of one axis, and what it does now and then. What it does at every measurement is in `step`.

use super::design::EstimatorDesign;
use super::shared::{IdentifierClock, ObserverClock};
use crate::accumulator::Accumulator;
use crate::identifier::{BlockMean, BlockMeans, Cascade, Completed, FreeState, Hypothesis};
use crate::moments::InputMoments;
use crate::observer::{Model, Observer};
use crate::readout::{NoiseCross, NoiseLevel, ParameterState, weight};

/// What predicts this axis at present.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Source {
    /// Nothing credible: constant velocity.
    #[default]
    Nothing,
    /// The newest quotient, not valid yet: good enough to stand in for a missed sample, not handed out.
    Provisional,
    /// The configured k0.
    Nominal,
    /// k̂, the observer having been seeded with it.
    Identified,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Axis {
    pub observer: Observer,
    pub model: Model,
    /// Input over the last measurement interval, or over the present one as far as it is known.
    pub moments: InputMoments,
    /// The innovation before the last.
    innovation_before: f32,
    /// The first position, subtracted from all: the plant is translation invariant, rounding is not.
    origin: f32,
    pub block: BlockMeans,
    pub cascade: Cascade,
    cross: NoiseCross,
    /// var a for unit noise.
    noise_sum: Accumulator,
    pub noise: NoiseLevel,
    /// The measurement count at which the state may be handed out.
    pub valid_from: u32,
    /// Measurements replaced in the block in progress.
    pub missed: u16,
    pub source: Source,
    /// Measured at least once, and not lost since.
    pub measured: bool,
    /// The first block has begun.
    begun: bool,
    /// Takes part in the identification: it was measured when its first block began.
    pub present: bool,
}

impl Axis {
    /// Before the first measurement.
    pub fn start(noise: NoiseLevel) -> Self {
        Self { noise, ..Self::default() }
    }

    /// The observer's step with a measurement, or with what stands in for it.
    #[inline(always)]
    pub fn observe(&mut self, y: f32, clock: &ObserverClock) {
        self.innovation_before = self.observer.innovation();
        self.observer.correct(y, self.moments, &self.model, &clock.before, &clock.gains);
    }

    /// The identifier's sample inside a block.
    #[inline(always)]
    pub fn sample(&mut self, y: f32) {
        self.block.sample(y - self.origin, self.moments);
    }

    /// The sample just taken is the first of a block.
    #[inline(always)]
    pub fn begin_block<const N: usize, const P: usize>(&mut self, y: f32, design: &EstimatorDesign<N, P>) {
        if self.begun {
            self.block.begin(&design.block);
        } else {
            self.begin_first(y);
        }
    }

    fn begin_first(&mut self, y: f32) {
        self.begun = true;
        self.origin = y;
        self.present = self.measured;
        self.block = BlockMeans::default();
    }

    /// A block of one sample: its mean.
    #[inline(always)]
    pub fn single(&mut self, y: f32) -> BlockMean {
        if !self.begun {
            self.begin_first(y);
        }
        self.block.single(y - self.origin, self.moments)
    }

    /// Takes a completed block through the cascade into the parameter's sums.
    #[inline(always)]
    pub fn identify<const N: usize, const P: usize>(
        &mut self,
        axis: usize,
        mean: BlockMean,
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        design: &EstimatorDesign<N, P>,
    ) {
        self.cascade.step(mean.y, mean.s, &design.identifier, &clock.at);
        let drift = if design.any_drift { design.drift.get(axis).copied().unwrap_or(0.0) } else { 0.0 };
        let z2 = self.cascade.z2() - drift * clock.unit.zu();
        let z0 = self.cascade.z0();
        // The window is zero in the first two blocks; a block of predictions alone says nothing that was not known.
        if clock.blocks > 2 && u32::from(self.missed) < design.block_length {
            parameter.ratio.add(design.readout, z2, z0, design.forgetting);
            if clock.stride == design.coarse_slot(axis) {
                self.coarse_step(z2, z0, clock, parameter, design);
            }
        }
        self.missed = 0;
    }

    /// Every D-th block: the noise level, and how noise reaches k̂.
    #[inline(never)]
    fn coarse_step<const N: usize, const P: usize>(
        &mut self,
        z2: f32,
        z0: f32,
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        design: &EstimatorDesign<N, P>,
    ) {
        let covariance = &design.covariance;
        // The covariance of the cascade is that of a filled one from its third step on.
        if let Some(k) = parameter.newest()
            && clock.blocks > 2 * covariance.steps
        {
            let step = self.observer.innovation() - self.innovation_before;
            let residual = z2 - k * z0;
            self.noise.add(
                step * step * design.innovation_to_mean,
                covariance.stride * (residual * residual) / (clock.shape.variance() * design.identifier.scale2()),
            );
        }
        let (w, _) = weight(design.readout, z2, z0);
        let added = self.cross.step(covariance.stride * w, &clock.shape, covariance);
        self.noise_sum.add_folded(added - design.noise_forgetting * self.noise_sum.value());
    }

    /// σ² var a, this axis's share of the variance of the numerator of k̂; `None` while the noise level is not known.
    pub fn numerator_variance(&self, per_stride: f32) -> Option<f32> {
        if self.noise.is_known() { Some(self.noise.variance() * per_stride * self.noise_sum.value()) } else { None }
    }

    /// Moves collected steps into totals.
    #[inline(always)]
    pub fn fold(&mut self) {
        self.observer.fold();
        self.cascade.fold();
    }

    /// Settles what predicts this axis, and puts the observer where the identifier's own states say it is when the
    /// parameter has become valid. Right after a completed block.
    #[inline(always)]
    pub fn follow<const N: usize, const P: usize>(
        &mut self,
        axis: usize,
        parameter: &ParameterState,
        nominal: Option<f32>,
        clocks: (&IdentifierClock, &ObserverClock),
        design: &EstimatorDesign<N, P>,
    ) {
        let drift_t2 = design.drift_t2.get(axis).copied().unwrap_or(0.0);
        let (k, source) = if let Some(known) = parameter.valid_value() {
            if self.source != Source::Identified && !self.seed(axis, known, clocks, design) {
                return;
            }
            (known, Source::Identified)
        } else if let Some(k) = nominal {
            (k, Source::Nominal)
        } else if let Some(k) = parameter.credible() {
            (k, Source::Provisional)
        } else {
            self.source = Source::Nothing;
            self.model = Model::default();
            return;
        };
        self.source = source;
        self.model = Model { k_t2: k * design.period2, c_t2: drift_t2 };
    }

    #[inline(never)]
    fn seed<const N: usize, const P: usize>(
        &mut self,
        axis: usize,
        k: f32,
        (clock, observer): (&IdentifierClock, &ObserverClock),
        design: &EstimatorDesign<N, P>,
    ) -> bool {
        if !self.present {
            // Nothing to seed from; the observer goes on with the new k and forgets by itself.
            return true;
        }
        let block = Completed {
            cascade: &self.cascade,
            unit: &clock.unit,
            at: &clock.at,
            block: &self.block,
            moments: self.moments,
        };
        let by = Hypothesis {
            k,
            c: design.drift.get(axis).copied().unwrap_or(0.0),
            k_t2: k * design.period2,
            c_t2: design.drift_t2.get(axis).copied().unwrap_or(0.0),
        };
        let free = FreeState::at_block_end(&block, &design.block, design.block_length, &by);
        let sound = free.position.is_finite() && free.t_velocity.is_finite();
        if sound {
            let residual = (self.observer.measurement() - self.origin) - free.position;
            self.observer.seed(residual, free.t_velocity, &observer.gains);
            // A late start is forgotten with it.
            self.valid_from = self.valid_from.min(observer.count.max(design.state_settle));
        }
        sound
    }

    /// Forgets what the identifier knows, keeps the observer.
    pub fn reset_identifier(&mut self, noise: NoiseLevel) {
        *self = Self {
            observer: self.observer,
            model: self.model,
            moments: self.moments,
            innovation_before: self.innovation_before,
            valid_from: self.valid_from,
            source: self.source,
            measured: self.measured,
            ..Self::start(noise)
        };
    }
}
