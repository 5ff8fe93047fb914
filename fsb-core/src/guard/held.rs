//! Values that come again. A sensor that is asked more often than it measures gives its last value once more, and one that rounds
//! gives the same one as long as it stays within a step. Then it steps, and that is no jump of its origin.

use crate::snapshot::stored;

/// How often values come again, and how far it is to the next one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Held {
    /// How often the last measurement has come again.
    pub repeated: u16,
    /// How often the one before it came again.
    before: u16,
    /// The step of the innovation to the last measurement, as long as that has not come again.
    pending: f32,
    /// About the largest of the last steps from a value that had come again to another one that did: a spike does not.
    step: f32,
}

impl Held {
    /// A step below this is none (m or rad).
    const NOTHING: f32 = 1e-12;
    /// A step smaller than the largest one counts for an eighth; where nothing comes again that is forgotten sooner or later.
    const FORGETS: f32 = 0.125;

    /// Nothing has come again of late: the usual case, which is to cost next to nothing.
    #[inline(always)]
    const fn is_usual(&self) -> bool {
        self.before == 0 && self.step.to_bits() == 0
    }

    /// The same value once more.
    pub fn once_more(&mut self) {
        self.repeated = self.repeated.saturating_add(1);
        if self.pending > 0.0 {
            self.add(self.pending);
        }
    }

    /// Another value.
    #[inline(always)]
    pub fn next(&mut self) {
        if self.repeated != 0 || self.before != 0 {
            (self.before, self.repeated, self.pending) = (self.repeated, 0, 0.0);
        }
    }

    /// The measurement was used. `step` is that of the innovation.
    #[inline(always)]
    pub fn learn(&mut self, step: f32) {
        if !self.is_usual() && self.repeated == 0 {
            self.learn_step(step.abs());
        }
    }

    #[inline(never)]
    fn learn_step(&mut self, step: f32) {
        if self.before > 0 {
            self.pending = if step > Self::NOTHING { step } else { 0.0 };
        } else {
            self.step = if self.step > Self::NOTHING { (1.0 - Self::FORGETS) * self.step } else { 0.0 };
        }
    }

    /// What was taken for a jump of a value that has come again may have been a step; `usual` is what passes anyway.
    pub fn learn_jump(&mut self, step: f32, usual: f32) {
        let most = 4.0 * if self.step > usual { self.step } else { usual };
        let step = step.abs();
        if self.repeated > 0 {
            self.add(if step < most { step } else { most });
        }
    }

    #[inline(never)]
    fn add(&mut self, step: f32) {
        self.pending = 0.0;
        self.step = if step > self.step { step } else { self.step - Self::FORGETS * (self.step - step) };
    }

    /// What the innovation may step by: twice what it did of late, and once the value has stood still for a while, what an acceleration does
    /// in that time, as much again at most. `fall` is what that is in one sample.
    #[inline(always)]
    pub fn allowance(&self, fall: f32) -> f32 {
        if self.is_usual() { 0.0 } else { self.allowance_of_steps(fall) }
    }

    #[inline(never)]
    fn allowance_of_steps(&self, fall: f32) -> f32 {
        let usual = 2.0 * self.step;
        let stood = if self.repeated > 0 { 0.0 } else { f32::from(self.before) };
        let more = fall * (stood * stood);
        usual + if more < usual { more } else { usual }
    }

    /// Whether it can have been learned.
    pub fn is_sound(&self) -> bool {
        self.step >= 0.0 && self.pending >= 0.0
    }
}

stored!(Held { repeated, before, pending, step });

#[cfg(test)]
mod tests {
    use super::*;

    const FALL: f32 = 1e-3;

    /// Of a sensor that never sends a value again nothing changes, whatever it does; nor of one that stands still, but for spikes.
    #[test]
    fn no_steps() {
        let mut held = Held::default();
        for step in [1.0, -3.0, 100.0] {
            held.next();
            held.learn(step);
            assert_eq!(held.allowance(FALL), 0.0);
        }
        for spike in [1.0, -2.0, 0.1] {
            (0..9).for_each(|_| held.once_more());
            held.next();
            held.learn(spike);
            held.next();
            held.learn(-spike);
            held.once_more();
            assert_eq!(held.allowance(FALL), 0.0);
        }
    }

    /// Twice what the last steps were, and once the value has stood still for long, four times.
    #[test]
    fn steps() {
        let mut held = Held::default();
        let near = |a: f32, b: f32| (a - b).abs() < 1e-6;
        let step = |held: &mut Held, by: f32, stood: usize| {
            (0..stood).for_each(|_| held.once_more());
            held.next();
            held.learn(by);
        };
        step(&mut held, -0.3, 9);
        assert_eq!(held.allowance(FALL), 0.0, "it may be a spike");
        held.once_more();
        assert!(near(held.allowance(FALL), 0.6));
        step(&mut held, 0.1, 9);
        assert!(near(held.allowance(FALL), 0.6 + FALL * 100.0));
        held.once_more();
        assert!(near(held.step, 0.3 - 0.125 * (0.3 - 0.1)));
        step(&mut held, 0.1, 1000);
        assert!(near(held.allowance(FALL), 4.0 * held.step));
        // What was taken for a jump: four times the largest one at most, and none of a sensor that never sends a value again.
        let before = held.step;
        held.learn_jump(50.0, 0.01);
        assert_eq!(held.step, before);
        held.once_more();
        let before = held.step;
        held.learn_jump(-50.0, 0.01);
        assert!(near(held.step, 4.0 * before));
        for _ in 0..100 {
            held.next();
            held.learn(1e-4);
        }
        assert!(held.step < 1e-4 && held.is_sound());
    }
}
