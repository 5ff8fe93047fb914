//! The state that depends on time alone, shared by all axes: windows, gains, weights, covariance.

use super::design::Common;
use super::output::{Counters, Learning};
use crate::identifier::{Coefficients, UnitChain};
use crate::observer::Gains;
use crate::readout::NoiseShape;
use crate::snapshot::stored;
use crate::window::{Window, WindowDesign};

/// The way that the next measurement goes, if every axis is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pace {
    /// The general one.
    Careful,
    /// Blocks of one, in which everybody takes part.
    Singles,
    /// Blocks of several samples, and gains that hardly change.
    Steady,
    /// Blocks of several samples, in the first measurements.
    Hurried,
}

/// Where the estimator is in time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Progress {
    pub observer: ObserverClock,
    pub identifier: IdentifierClock,
    /// Control periods since the last measurement instant.
    pub substep: u32,
    pub started: bool,
    /// Every axis was measured at the last instant.
    pub all_measured: bool,
    pub pace: Pace,
    pub learning: Learning,
    pub counters: Counters,
}

impl Progress {
    pub fn start(common: &Common) -> Self {
        Self {
            observer: ObserverClock::START,
            identifier: IdentifierClock::start(common.schedule.turn),
            substep: 0,
            started: false,
            all_measured: false,
            pace: Pace::Careful,
            learning: Learning::On,
            counters: Counters::default(),
        }
    }
}

impl Progress {
    /// At the start again, still counting, and learning as it was told.
    pub fn anew(&self, common: &Common) -> Self {
        Self { counters: self.counters, learning: self.learning, ..Self::start(common) }
    }

    /// The gains of the next of the first measurements; returns that of the velocity.
    #[cold]
    #[inline(never)]
    pub fn hurry_on(&mut self, common: &Common) -> f32 {
        if self.observer.striding {
            self.pace = Pace::Steady;
        } else {
            self.observer.gains = self.observer.hurry(common);
        }
        self.observer.gains.t_l2()
    }

    /// Whether ε of the parameter has passed.
    #[inline(always)]
    pub fn is_settled(&self, common: &Common) -> bool {
        self.observer.count - self.identifier.began >= common.parameter_settle
    }

    /// Whether this measurement is the identifier's as well.
    #[inline(always)]
    pub fn is_identifying(&self) -> bool {
        self.observer.count >= self.identifier.began && self.learning == Learning::On
    }
}

/// The observer's part.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObserverClock {
    window: Window,
    pub gains: Gains,
    /// Measurement instants since the first one, or since a later origin once they are many.
    pub count: u32,
    /// Measurements until the gains are renewed, where a round is longer than that.
    until: u32,
    /// The gains change slowly: they are renewed, and the window moves, once in a while.
    pub striding: bool,
    /// Measurements that had been missed when others came, among the first.
    pub early: u16,
}

impl ObserverClock {
    /// Measurements in which the gains change too fast to be held.
    const HURRIED: u32 = 32;

    pub const START: Self =
        Self { window: Window::START, gains: Gains::FIRST, count: 0, until: 0, striding: false, early: 0 };

    /// Measurements that came, where there was a `gap` since the last of them, as far as it matters.
    pub fn came(&self, gap: u16) -> u32 {
        self.count.saturating_sub(u32::from(self.early) + u32::from(gap))
    }

    /// Measurements were missed before the one that has come, after which the state has forgotten its start in `late` of them.
    pub fn note_gap(&mut self, gap: u16, late: u32) {
        if self.came(gap) < late {
            self.early = self.early.saturating_add(gap);
        }
    }

    /// One more measurement instant. The origin moves on long before the count could run out.
    #[inline(always)]
    pub const fn tick(&mut self) {
        self.count = self.count.wrapping_add(1);
    }

    /// One more measurement instant, and its gains.
    #[inline(always)]
    pub fn next(&mut self, common: &Common) -> Gains {
        self.tick();
        if self.striding { self.gains } else { self.hurry(common) }
    }

    /// The gains of the next of the first measurements.
    #[inline(never)]
    fn hurry(&mut self, common: &Common) -> Gains {
        // The very first at once, then in turns with an estimator that has another turn.
        let schedule = &common.schedule;
        let anew = self.count < 4 || schedule.unhurried || (self.count ^ u32::from(schedule.turn != 0)) & 1 == 0;
        self.move_on(&common.observer.window, anew, common)
    }

    /// Moves the window, and returns the gains there or those so far.
    #[inline(never)]
    fn move_on(&mut self, by: &WindowDesign, anew: bool, common: &Common) -> Gains {
        self.window.step(by);
        if anew { Gains::at(&self.window, &common.observer) } else { self.gains }
    }

    /// At the gains' turn: from now on they stride.
    pub fn settle(&mut self) {
        self.striding = self.striding || self.count >= Self::HURRIED;
    }

    /// New gains for the measurements to come.
    pub fn renew(&mut self, common: &Common) {
        if !self.window.is_settled() {
            self.gains = self.move_on(&common.observer_stride, true, common);
        }
    }

    /// Whether it is the gains' turn, in a long round.
    pub fn is_due(&mut self, common: &Common) -> bool {
        let due = self.until == 0;
        self.until = if due { common.schedule.gains_every - 1 } else { self.until - 1 };
        due
    }
}

/// The identifier's part: one step a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct IdentifierClock {
    window: Window,
    pub at: Coefficients,
    pub unit: UnitChain,
    pub shape: NoiseShape,
    /// The present measurement's place in the round.
    pub position: u32,
    /// The measurement count at which the identification began or begins.
    pub began: u32,
    /// Blocks for which weights have been computed; saturates.
    pub blocks: u32,
    /// Blocks since the last coarse step.
    pub stride: u32,
    /// The window is fully open: the weights stay.
    settled: bool,
}

impl IdentifierClock {
    pub fn start(began: u32) -> Self {
        Self {
            window: Window::START,
            at: Coefficients::default(),
            unit: UnitChain::default(),
            shape: NoiseShape::START,
            position: 0,
            began,
            blocks: 0,
            stride: 0,
            settled: false,
        }
    }

    /// To the next measurement of a block; returns its place.
    #[inline(always)]
    pub const fn move_on(&mut self, common: &Common) -> u32 {
        let next = self.position + 1;
        self.position = if next == common.block_length { 0 } else { next };
        self.position
    }

    /// Whether the covariance is that of noise: in its first two coarse steps the window is zero, and what it says is rounding,
    /// while the sums have begun to tell.
    #[inline(always)]
    pub const fn is_shaped(&self, common: &Common) -> bool {
        self.blocks > 2 * common.covariance.steps
    }

    /// The weights for the present block, for all axes, and every D-th time a coarse step.
    #[inline(never)]
    pub fn step(&mut self, common: &Common) {
        let identifier = &common.identifier;
        let last = common.covariance.steps - 1;
        self.stride = if self.blocks == 0 || self.stride >= last { 0 } else { self.stride + 1 };
        if self.stride == 0 {
            self.shape.step(&self.window, &common.covariance);
        }
        if !self.settled {
            self.at = Coefficients::at(&self.window, identifier);
            self.settled = self.window.is_settled();
            self.window.step(&identifier.window);
        }
        if common.wants_unit {
            self.unit.step(identifier, &self.at);
        }
        self.blocks = self.blocks.saturating_add(1);
    }
}

stored!(ObserverClock { window, gains, count, until, striding, early });
stored!(IdentifierClock { window, at, unit, shape, position, began, blocks, stride, settled });

impl ObserverClock {
    /// Whether its numbers are possible. Rounding makes of the zero of the second measurement's m1 a little less.
    pub fn is_sound(&self) -> bool {
        let within = |x: f32| (-1e-4..=1.000_1).contains(&x);
        self.window.is_sound() && within(self.gains.m1()) && within(self.gains.t_l2())
    }
}

impl IdentifierClock {
    /// Whether its numbers are possible.
    pub fn is_sound(&self) -> bool {
        self.window.is_sound()
    }
}
