//! The state of one axis, and what it does at its turns.

use super::design::{AxisDesign, Common};
use super::shared::{IdentifierClock, ObserverClock};
use crate::accumulator::Accumulator;
use crate::identifier::{BlockMeans, Cascade, Completed, FreeState, Hypothesis};
use crate::moments::InputMoments;
use crate::observer::{Model, Observer};
use crate::readout::{NoiseCross, NoiseLevel, ParameterState};

/// What predicts this axis at present.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Source {
    /// Nothing credible: constant velocity; a measurement missed for less than 1/λ is taken to be off from it as the
    /// last one was.
    #[default]
    Nothing,
    /// The newest quotient, not valid yet: good enough to stand in for a missed sample, not handed out.
    Provisional,
    /// The configured k0.
    Nominal,
    /// The k̂ from before a re-initialisation.
    Held,
    /// k̂, the observer having been seeded with it.
    Identified,
}

/// The two clocks.
#[derive(Clone, Copy)]
pub(super) struct Clocks<'a> {
    pub identifier: &'a IdentifierClock,
    pub observer: &'a ObserverClock,
}

/// Yes or no, several in a byte.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Marks {
    pub bits: u8,
}

impl Marks {
    /// The first block has begun.
    pub const BEGUN: u8 = 1;
    /// A coarse step fell to a block in which nothing came.
    pub const OWES: u8 = 2;
    /// The innovation after the last gap came together over a long time, and does not go on.
    pub const LEAPT: u8 = 4;

    #[inline(always)]
    pub const fn has(self, mark: u8) -> bool {
        self.bits & mark != 0
    }

    #[inline(always)]
    pub const fn set(&mut self, mark: u8, to: bool) {
        self.bits = if to { self.bits | mark } else { self.bits & !mark };
    }
}

/// In this order in memory: what every measurement touches comes first, within reach of one base address for several axes.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub(super) struct Axis {
    pub observer: Observer,
    pub model: Model,
    /// Input over the last measurement interval, or over the present one as far as it is known.
    pub moments: InputMoments,
    /// The innovation before the last.
    pub(super) innovation_before: f32,
    /// The first position, subtracted from all: the plant is translation invariant, rounding is not.
    pub(super) origin: f32,
    pub block: BlockMeans,
    pub cascade: Cascade,
    pub own: AxisDesign,
    pub(super) cross: NoiseCross,
    /// var a for unit noise.
    pub(super) noise_sum: Accumulator,
    pub noise: NoiseLevel,
    /// The measurement count from which on the state may be handed out, if there is something to predict it with.
    pub settled_at: u32,
    /// The same, or out of reach where there is nothing to predict it with.
    pub usable_at: u32,
    /// The variance of ẑ0, which may be known no better than that: no disturbance.
    pub(super) tolerance: f32,
    /// Measurements replaced in the block in progress.
    pub missed: u16,
    /// Measurements replaced since the last one that came.
    pub gap: u16,
    pub source: Source,
    /// Measured at least once, and not lost since.
    pub measured: bool,
    /// What has happened: bits of [`Marks`].
    pub(super) marks: Marks,
    /// Takes part in the identification: it was measured when its first block began.
    pub present: bool,
}

impl Axis {
    /// Before the first measurement: the configured parameter, if there is one, predicts. `period2` is T².
    pub fn start(noise: NoiseLevel, own: AxisDesign, nominal: Option<f32>, period2: f32) -> Self {
        let (source, model) = match nominal {
            Some(k) => (Source::Nominal, Model { k_t2: k * period2, c_t2: own.drift_t2 }),
            None => (Source::Nothing, Model::default()),
        };
        Self { noise, own, source, model, usable_at: u32::MAX, ..Self::default() }
    }

    /// To be called when the source, `settled_at` or `measured` has changed.
    pub fn decide_use(&mut self) {
        let usable = self.measured && matches!(self.source, Source::Identified | Source::Held | Source::Nominal);
        self.usable_at = if usable { self.settled_at } else { u32::MAX };
    }

    /// The first measurement, or the first one after the axis was lost.
    #[inline(always)]
    pub fn measure_first(&mut self, y: f32, settled_at: u32) {
        self.measured = true;
        self.settled_at = settled_at;
        self.observer.start(y);
        self.decide_use();
    }

    /// The observer's step with a measurement, or with what stands in for it.
    #[inline(always)]
    pub fn observe(&mut self, y: f32, m1: f32, t_l2: f32) {
        self.innovation_before = self.observer.innovation();
        self.observer.correct(y, self.moments, &self.model, m1, t_l2);
    }

    /// The identifier's sample inside a block.
    #[inline(always)]
    pub fn sample(&mut self, y: f32) {
        self.block.sample(y - self.origin, self.moments);
    }

    /// The sample just taken is the first of a block.
    #[inline(always)]
    pub fn begin_block(&mut self, common: &Common) {
        if self.marks.has(Marks::BEGUN) {
            self.block.begin(&common.block);
        } else {
            self.begin_first();
        }
    }

    #[inline(never)]
    fn begin_first(&mut self) {
        self.marks.set(Marks::BEGUN, true);
        self.origin = self.observer.measurement();
        self.present = self.measured;
        self.block = BlockMeans::default();
    }

    #[inline(never)]
    pub fn fold_observer(&mut self) {
        self.observer.fold();
    }

    /// Counts begin so much later.
    #[inline(never)]
    pub fn rebase(&mut self, by: u32) {
        self.settled_at = self.settled_at.saturating_sub(by);
        self.decide_use();
    }

    /// Whether the axis takes part, which is decided at the first sample of its first block.
    #[inline(always)]
    pub fn takes_part(&mut self) -> bool {
        if !self.present && !self.marks.has(Marks::BEGUN) {
            self.begin_first();
        }
        self.present
    }

    /// The observer follows a parameter that is valid and stays so. False where there is more to decide.
    #[inline(always)]
    pub fn follow_on(&mut self, parameter: &mut ParameterState, common: &Common) -> bool {
        let usual = self.source == Source::Identified && parameter.read_on();
        if usual {
            self.model.follow(parameter.newest_value(), common.period2);
        }
        usual
    }

    /// Where [`follow_on`](Self::follow_on) did not do: whether there is more to it than a parameter that is not valid and stays
    /// so, which may wait for the next turn.
    #[inline(always)]
    pub fn has_more_to_do(&self, parameter: &ParameterState, settled: bool) -> bool {
        self.source == Source::Identified || parameter.may_be_valid(settled)
    }

    /// Settles what predicts this axis, and puts the observer where the identifier's own states say it is when the
    /// parameter has become valid. Right after a completed block.
    #[inline(always)]
    pub fn follow(&mut self, parameter: &ParameterState, clocks: Clocks<'_>, common: &Common) {
        if self.source == Source::Identified
            && let Some(k) = parameter.valid_value()
        {
            self.model.k_t2 = k * common.period2;
        } else {
            self.change_source(parameter, clocks, common);
        }
    }

    #[inline(never)]
    pub fn change_source(&mut self, parameter: &ParameterState, clocks: Clocks<'_>, common: &Common) {
        self.choose_source(parameter, clocks, common);
        self.decide_use();
    }

    fn choose_source(&mut self, parameter: &ParameterState, clocks: Clocks<'_>, common: &Common) {
        let (k, source) = if let Some(k) = parameter.valid_value() {
            if self.present && !self.seed(k, clocks, common) {
                return;
            }
            (k, Source::Identified)
        } else if let Some(k) = parameter.held_value() {
            (k, Source::Held)
        } else if let Some(k) = parameter.nominal {
            (k, Source::Nominal)
        } else if let Some(k) = parameter.credible() {
            (k, Source::Provisional)
        } else {
            self.source = Source::Nothing;
            self.model = Model::default();
            return;
        };
        self.source = source;
        self.model = Model { k_t2: k * common.period2, c_t2: self.own.drift_t2 };
    }

    fn seed(&mut self, k: f32, clocks: Clocks<'_>, common: &Common) -> bool {
        let block = Completed {
            cascade: &self.cascade,
            unit: &clocks.identifier.unit,
            at: &clocks.identifier.at,
            block: &self.block,
            moments: self.moments,
        };
        let by = Hypothesis { k, c: self.own.drift, k_t2: k * common.period2, c_t2: self.own.drift_t2 };
        let free = FreeState::at_block_end(&block, &common.block, common.block_length, &by);
        // Relative to the first position; what is out of all bounds, or no number, is no state.
        let most = 4.0 * common.position_limit;
        let sound = free.position.abs() <= most && free.t_velocity.abs() <= most;
        if sound {
            let residual = (self.observer.measurement() - self.origin) - free.position;
            self.observer.seed(residual, free.t_velocity, &clocks.observer.gains);
            // A late start is forgotten with it.
            self.settled_at = self.settled_at.min(clocks.observer.count.max(common.state_settle));
        }
        sound
    }
}
