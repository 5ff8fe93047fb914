//! One axis: its noise level, and whether a measurement can be true.

use super::config::GuardDesign;
use super::course::{Course, lies_within};
use super::held::Held;
use super::verdict::Verdict;

/// What the gate of one axis remembers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gate {
    /// V: the mean square of the innovation's step, as far as [`Gate::learn`] lets single values count.
    pub(super) level: f32,
    /// Values in it; saturates.
    pub(super) values: u16,
    /// Measurements not used since the last one that was.
    pub(super) gap: u16,
    /// Of these, instants at which nothing was measured that could be judged.
    pub(super) blind: u16,
    /// Improbable measurements in a row that agree with each other.
    pub(super) run: u16,
    /// How values come again.
    pub(super) held: Held,
    /// The observer's innovation after the last measurement that was used.
    pub(super) innovation: f32,
    /// Those of the improbable ones.
    pub(super) course: Course,
    /// The bits of the last measurement, used or not; they may be those of a subnormal number.
    pub(super) last: u32,
}

impl Gate {
    /// Values before which the level is not trusted.
    const ENOUGH: u16 = 8;
    /// The longest memory of the level, in values.
    const MEMORY: u16 = 128;
    /// One value counts for no more than so many times the level: outliers that passed do not keep the gate open, as long as
    /// they are fewer than an eighth of all.
    const MOST: f32 = 4.0;
    /// Values below this share of the level are rare where the level is right, and the rule where outliers in the first few
    /// values have made it.
    const LOW: f32 = 1.0 / 64.0;
    /// They count as much as one in so many.
    const HASTE: u16 = 32;
    /// The level that normal noise of variance 1 ends at, by the rules above.
    const OF_NORMAL: f32 = 0.66;
    /// The level cannot come closer to the subnormal numbers.
    const LEAST: f32 = 1e-24;

    /// A level known beforehand, of the innovation's steps.
    pub fn expecting(level: Option<f32>) -> Self {
        match level {
            Some(level) => Self { level: Self::OF_NORMAL * level, values: Self::ENOUGH, ..Self::default() },
            None => Self::default(),
        }
    }

    /// Whether `y` can be true where `expected` is predicted (`None`: nothing is). `limit` is the physical one, and
    /// `settled` tells that the observer's first few measurements, whose innovations are large, are over. Cost: about 35
    /// operations.
    pub fn judge(&mut self, y: f32, expected: Option<f32>, limit: f32, settled: bool, design: &GuardDesign) -> Verdict {
        let verdict = self.verdict(y, expected, limit, settled, design);
        if verdict.is_used() {
            if self.gap > 0 {
                (self.gap, self.blind) = (0, 0);
                self.begin_run();
            }
        } else if verdict == Verdict::Improbable {
            self.gap = self.gap.saturating_add(1);
        } else {
            self.miss();
        }
        verdict
    }

    fn verdict(&mut self, y: f32, expected: Option<f32>, limit: f32, settled: bool, design: &GuardDesign) -> Verdict {
        if !y.is_finite() {
            return Verdict::NonFinite;
        }
        if y.abs() > limit {
            return Verdict::BeyondLimit;
        }
        if self.is_frozen(y, design) {
            // A frozen sensor agrees with itself, which is no jump.
            self.begin_run();
            return Verdict::Frozen;
        }
        let Some(expected) = expected else {
            return Verdict::Taken;
        };
        let innovation = y - expected;
        let step = innovation - self.innovation;
        if !settled {
            return Verdict::Taken;
        }
        let noise = design.sigmas2 * (1.0 / Self::OF_NORMAL) * self.level;
        let gap = f32::from(self.gap);
        let stretch = 1.0 + design.lambda_t * gap;
        // The velocity may be off, and what it does was not seen. A large innovation is on its way back to zero.
        let unseen = design.drift * f32::from(self.blind) + design.fall * gap * gap;
        let held = self.held.allowance(design.fall);
        let known = design.step + held + unseen + design.decay * self.innovation.abs();
        let trusted = self.values >= Self::ENOUGH;
        // What was expected is no outlier: it may be the last one that was, and passed.
        let off = if innovation.abs() < step.abs() { innovation } else { step };
        if !trusted || lies_within(off, noise * stretch * stretch, known) {
            if self.gap == 0 {
                self.learn(step * step);
                self.held.learn(step);
            }
            return Verdict::Taken;
        }
        // Predicted all along from the same state: only a jump keeps its distance, and only a push leaves it on a straight line.
        let agree = lies_within(innovation - self.course.last, noise, design.step);
        self.run = if self.run > 0 && agree { self.run.saturating_add(1) } else { 1 };
        self.course.add(innovation, self.gap, noise, design);
        if self.course.is_push(noise, design) {
            return Verdict::Pushed(self.course.rate() * design.per_period);
        }
        if self.run >= design.jump_after {
            // The next innovation is about that of before the jump.
            self.held.learn_jump(step, design.step);
            return Verdict::Jumped(step);
        }
        Verdict::Improbable
    }

    fn begin_run(&mut self) {
        self.run = 0;
        self.course = Course::default();
    }

    /// What the observer's innovation has become: where the measurement was used it is the gate's own, but for a state that
    /// was put elsewhere meanwhile, as with the first valid parameter. That is no step of the sensor.
    pub fn follow(&mut self, innovation: f32, design: &GuardDesign) {
        if self.gap == 0 || innovation.abs() > design.step {
            self.innovation = innovation;
        }
    }

    /// Measurement instants since a measurement was used.
    pub const fn gap(&self) -> u16 {
        self.gap
    }

    /// The observer starts anew: what was learned of the noise stays, and so do the age of the last measurement and whether the
    /// sensor has frozen, which is none the more alive for it.
    pub fn restart(&mut self) {
        let Self { level, values, gap, blind, .. } = *self;
        *self = Self { level, values, gap, blind, ..Self::default() }.of_sensor(self);
    }

    /// With what `other` knows of its sensor: the bits that came last, and how values come again.
    pub fn of_sensor(self, other: &Self) -> Self {
        Self { held: other.held, last: other.last, ..self }
    }

    /// Whether its level can have been learned.
    pub fn is_sound(&self) -> bool {
        self.level >= 0.0 && self.held.is_sound()
    }

    /// Nothing was measured.
    pub fn miss(&mut self) {
        self.gap = self.gap.saturating_add(1);
        self.blind = self.blind.saturating_add(1);
    }

    fn is_frozen(&mut self, y: f32, design: &GuardDesign) -> bool {
        let looked_for = design.frozen_after > 0;
        if y.to_bits() == self.last {
            self.held.once_more();
        } else if looked_for && self.held.repeated > design.frozen_after {
            // One that differs may be the frozen one with a fault of its own: it takes two to be alive.
            self.held.repeated = design.frozen_after;
            return true;
        } else {
            self.held.next();
            self.last = y.to_bits();
        }
        looked_for && self.held.repeated > design.frozen_after
    }

    fn learn(&mut self, square: f32) {
        let most = Self::MOST * self.level;
        let square = if self.values >= Self::ENOUGH && square > most { most } else { square };
        if self.values < Self::MEMORY {
            self.values += 1;
        }
        let hasty = self.values > Self::HASTE && square < Self::LOW * self.level;
        let memory = if hasty { Self::HASTE } else { self.values };
        self.level += (square - self.level) / f32::from(memory);
        if self.level < Self::LEAST {
            self.level = Self::LEAST;
        }
    }
}
