//! Improbable measurements that leave what is predicted at a constant rate: what is wrong is the velocity of the state, not the
//! sensor. A collision does that, or an input that was told wrongly.

use super::config::GuardDesign;
use crate::snapshot::stored;

/// Distances to what is predicted from one and the same state, as long as they lie on a straight line. Times are in measurement
/// instants since a measurement was used.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Course {
    /// How many they are.
    pub(super) count: u16,
    /// When the first one came, and the last one.
    began: u16,
    at: u16,
    first: f32,
    pub(super) last: f32,
}

impl Course {
    /// Any two make a line, and a third lies on it by chance now and then.
    const LEAST: u16 = 4;

    /// The next distance, at the time `at`. Where it is off the line the last two begin a new one; `noise` is what the square of
    /// a distance may be off by.
    pub fn add(&mut self, distance: f32, at: u16, noise: f32, design: &GuardDesign) {
        let ahead = f32::from(at) - f32::from(self.at);
        let off = distance - (self.last + self.rate() * ahead);
        if self.count == 0 || at == self.at {
            // The first one; or time is no longer counted.
            (self.first, self.began, self.count) = (distance, at, 1);
        } else if self.count == 1
            || lies_within(off, noise, design.step + design.fall * ahead * (ahead + self.length()))
        {
            self.count = self.count.saturating_add(1);
        } else {
            (self.first, self.began, self.count) = (self.last, self.at, 2);
        }
        (self.last, self.at) = (distance, at);
    }

    fn length(&self) -> f32 {
        f32::from(self.at) - f32::from(self.began)
    }

    /// The slope of the line, per measurement period; before there are two it is no number.
    pub fn rate(&self) -> f32 {
        (self.last - self.first) / self.length()
    }

    /// Whether it is a push: long enough, and leading further than noise, and an acceleration that is not known of, do. A jump of
    /// the sensor stays where it is.
    pub fn is_push(&self, noise: f32, design: &GuardDesign) -> bool {
        let length = self.length();
        let long = self.count >= Self::LEAST && self.count >= design.jump_after;
        long && !lies_within(self.last - self.first, noise, design.step + design.fall * length * length)
    }
}

/// Whether the square of `x` is no more than `noise` and that of what is `known` together.
pub(super) fn lies_within(x: f32, noise: f32, known: f32) -> bool {
    x * x <= noise + known * known
}

stored!(Course { count, began, at, first, last });
