//! Values that come again. A sensor that is asked more often than it measures gives its last value once more, and one that rounds
//! gives the same one as long as it stays within a step. Then it steps, and that is no jump of its origin.

use crate::snapshot::stored;

/// How often values come again, and how far it is to the next one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Held {
    /// How often the last measurement has come again.
    pub repeated: u16,
    /// How often the one before it came again.
    pub before: u16,
    /// About the largest of the last steps of the innovation from a value that had come again to the next one.
    pub step: f32,
}

impl Held {
    /// A step smaller than the largest one counts for an eighth; where nothing comes again that is forgotten sooner or later.
    const FORGETS: f32 = 0.125;

    /// Another value has come.
    #[inline(always)]
    pub fn next(&mut self) {
        (self.before, self.repeated) = (self.repeated, 0);
    }

    /// The measurement was used. `step` is that of the innovation.
    #[inline(always)]
    pub fn learn(&mut self, step: f32) {
        if self.repeated == 0 && (self.before > 0 || self.step > 0.0) {
            self.learn_step(step.abs());
        }
    }

    #[inline(never)]
    fn learn_step(&mut self, step: f32) {
        if step > self.step {
            self.step = if self.before > 0 { step } else { self.step };
        } else {
            self.step -= Self::FORGETS * (self.step - step);
        }
    }

    /// What the innovation may step by where values come again: twice what it did of late, and what an acceleration does in the time
    /// that the value stood still for, `fall` being that in one sample; no longer than `most` samples, in which the observer has come to rest.
    #[inline(always)]
    pub fn allowance(&self, fall: f32, most: f32) -> f32 {
        if self.before == 0 || self.repeated > 0 {
            return 2.0 * self.step;
        }
        let stood = f32::from(self.before) + 1.0;
        let stood = if stood < most { stood } else { most };
        2.0 * self.step + fall * stood * stood
    }

    /// Whether it can have been learned.
    pub fn is_sound(&self) -> bool {
        self.step >= 0.0
    }
}

stored!(Held { repeated, before, step });

#[cfg(test)]
mod tests {
    use super::*;

    const FALL: f32 = 1e-3;

    /// Of a sensor that never sends a value again nothing changes, whatever it does.
    #[test]
    fn nothing_comes_again() {
        let mut held = Held::default();
        for step in [1.0, -3.0, 100.0] {
            held.next();
            assert_eq!(held.allowance(FALL, 50.0), 0.0);
            held.learn(step);
        }
        assert_eq!(held.step, 0.0);
    }

    /// What an acceleration does in the time that a value stood still for, up to a limit; and twice what the last steps were.
    #[test]
    fn a_value_that_stood_still() {
        let mut held = Held { repeated: 9, ..Held::default() };
        assert_eq!(held.allowance(FALL, 50.0), 0.0, "as long as it stands still");
        held.next();
        let near = |a: f32, b: f32| (a - b).abs() < 1e-6;
        assert!(near(held.allowance(FALL, 50.0), FALL * 100.0) && near(held.allowance(FALL, 5.0), FALL * 25.0));
        held.learn(-0.3);
        held.repeated = 9;
        assert_eq!(held.allowance(FALL, 50.0), 0.6);
        held.learn(1.0);
        assert_eq!(held.step, 0.3, "not a step to another value");
        held.next();
        held.learn(0.1);
        assert!(near(held.step, 0.3 - 0.125 * (0.3 - 0.1)));
        // A larger one after a value that had not come again is none of these; smaller ones let it be forgotten.
        held.next();
        let before = held.step;
        held.learn(5.0);
        assert_eq!(held.step, before);
        for _ in 0..100 {
            held.next();
            held.learn(1e-4);
        }
        assert!(held.step < 2e-4 && held.is_sound());
    }
}
