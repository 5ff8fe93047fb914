//! The state of one axis and its step.

use super::design::EstimatorDesign;
use super::shared::{IdentifierClock, ObserverClock};
use crate::identifier::{BlockMeans, Cascade, FreeState};
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

/// The model to predict with, and where its k is from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prediction {
    pub source: Source,
    pub model: Model,
}

/// Where in its block an axis is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct BlockPosition {
    pub first: bool,
    pub last: bool,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Axis {
    pub observer: Observer,
    /// Input since the last measurement instant.
    pub moments: InputMoments,
    /// The last accepted input.
    pub input: f32,
    /// Measured at least once.
    pub measured: bool,
    /// The observer holds the past of k̂.
    pub seeded: bool,
    /// Takes part in the identification: it was measured when its first block began.
    pub present: bool,
    /// The first block has begun.
    begun: bool,
    /// The block in progress holds a measured sample, not only predicted ones.
    fresh: bool,
    /// Blocks completed, up to two: a second difference needs them.
    history: u8,
    /// Measurement instants since this axis was first measured; saturates.
    pub age: u32,
    /// Late by more than the estimator's first measurement.
    pub late: bool,
    block: BlockMeans,
    pub cascade: Cascade,
    /// The first position, subtracted from all: the plant is translation invariant, rounding is not.
    origin: f32,
    /// Means of the two blocks before.
    y1: f32,
    y2: f32,
    cross: NoiseCross,
    pub noise: NoiseLevel,
}

impl Axis {
    pub fn predict_with<const N: usize, const P: usize>(
        &self,
        axis: usize,
        parameter: &ParameterState,
        nominal: Option<f32>,
        design: &EstimatorDesign<N, P>,
    ) -> Prediction {
        let drift = design.drift.get(axis).copied().unwrap_or(0.0);
        if let Some(known) = parameter.valid()
            && self.seeded
        {
            return Prediction { source: Source::Identified, model: Model { k: known.value, drift } };
        }
        if let Some(k) = nominal {
            return Prediction { source: Source::Nominal, model: Model { k, drift } };
        }
        match parameter.credible() {
            Some(k) => Prediction { source: Source::Provisional, model: Model { k, drift } },
            None => Prediction { source: Source::Nothing, model: Model::default() },
        }
    }

    /// Observer: one measurement instant. Returns the sample for the identifier: measured, or predicted in its place.
    #[inline(always)]
    pub fn observe<const N: usize, const P: usize>(
        &mut self,
        y: Option<f32>,
        moments: InputMoments,
        by: &Prediction,
        clock: &ObserverClock,
        design: &EstimatorDesign<N, P>,
    ) -> f32 {
        self.age = self.age.saturating_add(1);
        match y {
            Some(y) if self.measured => {
                self.observer.correct(y, moments, &by.model, &clock.before, &clock.gains, &design.observer);
                self.fresh = true;
                y
            }
            Some(y) => {
                self.observer.start(y);
                self.measured = true;
                self.fresh = true;
                self.late = clock.count > 0;
                self.age = 0;
                y
            }
            None if self.measured => {
                self.observer.predict(moments, &by.model, &clock.before, &clock.gains, &design.observer)
            }
            None => 0.0,
        }
    }

    /// Identifier: one measurement instant. Returns true where it completed a block.
    #[inline(always)]
    pub fn identify<const N: usize, const P: usize>(
        &mut self,
        y: f32,
        moments: InputMoments,
        at: BlockPosition,
        design: &EstimatorDesign<N, P>,
    ) -> bool {
        self.block.input(moments, &design.block);
        if at.first {
            self.block.begin(&design.block);
            if !self.begun {
                self.begun = true;
                self.origin = y;
                self.present = self.measured;
            }
        }
        self.block.sample(y - self.origin);
        at.last && self.present
    }

    /// Takes the completed block through the cascade into the parameter's sums.
    #[inline(always)]
    pub fn complete_block<const N: usize, const P: usize>(
        &mut self,
        axis: usize,
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        design: &EstimatorDesign<N, P>,
    ) {
        let drift = design.drift.get(axis).copied().unwrap_or(0.0);
        let (y, s) = self.block.complete(&design.block);
        self.cascade.step(y, s, &design.identifier, &clock.at);
        let z2 = self.cascade.z2() - drift * clock.unit.zu();
        let z0 = self.cascade.z0();
        // The window is zero in the first two blocks; a block of predictions alone says nothing that was not known.
        if self.fresh && clock.blocks > 2 {
            parameter.ratio.add(design.readout, z2, z0, design.forgetting);
            if clock.stride == design.coarse_slot(axis) {
                self.coarse_step(axis, (y, s), (z2, z0), clock, parameter, design);
            }
        }
        self.fresh = false;
        self.y2 = self.y1;
        self.y1 = y;
        if self.history < 2 {
            self.history += 1;
        }
    }

    /// Every D-th block: the noise level and its way into k̂.
    fn coarse_step<const N: usize, const P: usize>(
        &mut self,
        axis: usize,
        (y, s): (f32, f32),
        (z2, z0): (f32, f32),
        clock: &IdentifierClock,
        parameter: &mut ParameterState,
        design: &EstimatorDesign<N, P>,
    ) {
        let covariance = &design.covariance;
        let response = clock.shape.variance();
        if let Some(k) = parameter.newest()
            && self.history >= 2
            && response > 0.0
        {
            let drift = design.drift.get(axis).copied().unwrap_or(0.0);
            let second_difference = (y - self.y1) - (self.y1 - self.y2) - k * s - drift * design.block.duration2;
            let residual = z2 - k * z0;
            self.noise.add(
                second_difference * second_difference * (1.0 / 6.0),
                covariance.stride * (residual * residual) / (response * design.identifier.scale2()),
            );
        }
        let (w, _) = weight(design.readout, z2, z0);
        let added = self.cross.step(covariance.stride * w, &clock.shape, covariance);
        // A pooled parameter fades once a coarse step, with its first axis.
        let fading = if P == 1 && axis > 0 { 0.0 } else { design.noise_forgetting };
        parameter.add_noise(added * (self.noise.variance() * covariance.per_stride), fading);
        if self.noise.is_known() {
            parameter.read_variance(design.identifier.scale2());
        }
    }

    /// Puts the observer where the identifier's own states say it is for the parameter `k`, right after a completed block.
    pub fn seed<const N: usize, const P: usize>(
        &mut self,
        axis: usize,
        k: f32,
        y: f32,
        clock: &IdentifierClock,
        observer: &ObserverClock,
        design: &EstimatorDesign<N, P>,
    ) {
        let drift = design.drift.get(axis).copied().unwrap_or(0.0);
        let free = FreeState::at_block_end(
            &self.cascade,
            &clock.unit,
            &clock.at,
            &self.block,
            &design.block,
            &Model { k, drift },
        );
        if free.position.is_finite() && free.velocity.is_finite() {
            self.observer.seed(y, (y - self.origin) - free.position, free.velocity, &observer.gains);
            self.seeded = true;
        }
    }

    /// Before the first measurement.
    pub fn start(noise: NoiseLevel) -> Self {
        Self { noise, ..Self::default() }
    }

    /// Forgets what the identifier knows, keeps the observer.
    pub fn reset_identifier(&mut self, noise: NoiseLevel) {
        let fresh = Self::start(noise);
        *self = Self {
            block: fresh.block,
            cascade: fresh.cascade,
            cross: fresh.cross,
            noise: fresh.noise,
            present: false,
            begun: false,
            fresh: false,
            history: 0,
            ..*self
        };
    }
}
