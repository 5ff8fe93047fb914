//! What a change leaves open for a while after it was told.
//!
//! A torque, or a force along gravity, that nobody told looks like a change at first ([`super::change`]). If it is one, the value from
//! before was right, and the new one, which fits both, is off by |k - k_before|. So much is added to its standard deviation, less and less
//! the longer it fits: h/(h + t) of it, h being the time in which nothing is decided after a change, or 1 s. What was none ends, and is
//! told as a change back; of several told meanwhile the value from before the first one counts.
//!
//! A value that is held meanwhile may be off by its distance from the newest one, and by no less than the rule tells of.
//!
//! What is handed out says so; k̂ itself, when it is valid and what is predicted with it do not change.

use crate::readout::Parameter;
use crate::snapshot::stored;

/// For three axes, with one parameter or one each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt {
    /// Instants after which it counts half.
    pub half: f32,
    /// The newest k that was known, zero where none was.
    last: [f32; 3],
    /// The same before a change was told.
    before: [f32; 3],
    /// Instants since then in which something was known anew.
    since: u32,
}

impl Doubt {
    /// After so long (s), or after the time in which nothing is decided, it counts half.
    pub const HALF: f64 = 1.0;
    /// A share below this is past.
    const PAST: f32 = 0.1;

    pub fn new(half: u32) -> Self {
        Self { half: half as f32, last: [0.0; 3], before: [0.0; 3], since: 0 }
    }

    /// Forgets what was told.
    pub fn forget(&mut self) {
        *self = Self { last: [0.0; 3], before: [0.0; 3], since: 0, ..*self };
    }

    /// A change has been told.
    pub fn begin(&mut self) {
        let past = self.share() < Self::PAST;
        for (before, last) in self.before.iter_mut().zip(self.last) {
            if past || *before == 0.0 {
                *before = last;
            }
        }
        self.since = 0;
    }

    /// Another instant, and what is `known` then. Cost: 10 operations.
    pub fn go_on(&mut self, known: &[Option<f32>; 3]) {
        let mut any = false;
        for (last, k) in self.last.iter_mut().zip(known) {
            if let Some(k) = k {
                (*last, any) = (*k, true);
            }
        }
        if any {
            self.since = self.since.saturating_add(1);
        }
    }

    fn share(&self) -> f32 {
        self.half / (self.half + self.since as f32)
    }

    /// The parameter `of` those, with what it may be off by; `newest` where it is held: what is being identified, where that can be right. Changes by less than
    /// `relative` are not told.
    pub fn widen(&self, of: usize, k: Parameter, newest: Option<Option<Parameter>>, relative: f32) -> Parameter {
        let Some(before) = self.before.get(of).filter(|before| **before > 0.0) else { return k };
        let apart = k.value - before;
        let mut square = apart * apart;
        if let Some(newest) = newest {
            let least = relative * k.value;
            let apart = newest.map_or(least, |newest| (newest.value - k.value).abs());
            let apart = if apart > least { apart } else { least };
            square += apart * apart;
        }
        let share = self.share();
        Parameter { variance: k.variance + share * share * square, ..k }
    }
}

stored!(Doubt { last, before, since });

impl Doubt {
    /// Of a state that was stored.
    pub fn is_sound(&self) -> bool {
        self.last.iter().chain(&self.before).all(|k| (0.0..=Self::MOST).contains(k))
    }

    /// Of k: its square is a number.
    const MOST: f32 = 1e15;
}

#[cfg(test)]
mod tests {
    use super::*;

    const HALF: u32 = 100;

    fn parameter(value: f32) -> Parameter {
        Parameter { value, variance: 0.01 }
    }

    /// What is added to the standard deviation.
    fn added(doubt: &Doubt, of: usize, value: f32, newest: Option<Option<f32>>) -> f32 {
        let wide = doubt.widen(of, parameter(value), newest.map(|newest| newest.map(parameter)), 0.15);
        assert_eq!(wide.value, value);
        assert!(doubt.is_sound());
        libm::sqrtf(wide.variance - 0.01)
    }

    fn known(doubt: &mut Doubt, instants: u32, k: f32) {
        for _ in 0..instants {
            doubt.go_on(&[Some(k), None, None]);
        }
    }

    fn is_about(x: f32, y: f32) {
        assert!((x - y).abs() < 1e-5, "{x} {y}");
    }

    #[test]
    fn as_far_as_from_the_value_before() {
        let mut doubt = Doubt::new(HALF);
        known(&mut doubt, 1000, 2.0);
        assert_eq!(added(&doubt, 0, 3.0, None), 0.0);
        doubt.begin();
        // Held: the newest value may be right, and if there is none one that is off by what is told.
        is_about(added(&doubt, 0, 2.0, Some(None)), 0.3);
        is_about(added(&doubt, 0, 2.0, Some(Some(2.1))), 0.3);
        is_about(added(&doubt, 0, 2.0, Some(Some(2.8))), 0.8);
        // Time in which nothing is known does not count.
        for _ in 0..1000 {
            doubt.go_on(&[None; 3]);
        }
        is_about(added(&doubt, 0, 3.0, None), 1.0);
        known(&mut doubt, HALF, 3.0);
        is_about(added(&doubt, 0, 3.0, None), 0.5);
        known(&mut doubt, 3 * HALF, 3.0);
        is_about(added(&doubt, 0, 3.0, None), 0.2);
        // Of another parameter nothing was known before.
        assert_eq!(added(&doubt, 1, 3.0, None), 0.0);
        assert_eq!(added(&doubt, 3, 3.0, None), 0.0);
        doubt.forget();
        assert_eq!(added(&doubt, 0, 3.0, None), 0.0);
        doubt.begin();
        assert_eq!(added(&doubt, 0, 3.0, None), 0.0);
    }

    /// The first of several counts, until it is long past.
    #[test]
    fn of_several() {
        for (between, added_then) in [(8 * HALF, 0.0), (10 * HALF, 1.0)] {
            let mut doubt = Doubt::new(HALF);
            known(&mut doubt, 10, 2.0);
            doubt.begin();
            known(&mut doubt, between, 3.0);
            doubt.begin();
            is_about(added(&doubt, 0, 2.0, None), added_then);
        }
    }

    #[test]
    fn no_end_of_instants() {
        let mut doubt = Doubt::new(u32::MAX);
        known(&mut doubt, 1, 2.0);
        doubt.begin();
        doubt.since = u32::MAX;
        known(&mut doubt, 1, 3.0);
        is_about(added(&doubt, 0, 3.0, None), 0.5);
    }
}
