//! Inputs on their way to a measurement that comes late.

use crate::snapshot::{Archive, Stored};
use heapless::Deque;

/// What goes in comes out `periods` calls later.
#[derive(Clone, Debug)]
pub(super) struct Delay<T, const D: usize> {
    ring: Deque<T, D>,
    periods: usize,
}

impl<T: Copy, const D: usize> Delay<T, D> {
    /// Empty, for a delay of up to D.
    pub const fn new(periods: u32) -> Self {
        Self { ring: Deque::new(), periods: periods as usize }
    }

    /// The item of `periods` calls ago; `None` in the first calls.
    pub fn through(&mut self, item: T) -> Option<T> {
        if self.periods == 0 {
            return Some(item);
        }
        let out = if self.is_full() { self.ring.pop_front() } else { None };
        // There is room: it never holds more than `periods`, which is at most D.
        let _ = self.ring.push_back(item);
        out
    }

    /// Whether the next item brings one out.
    pub fn is_full(&self) -> bool {
        self.ring.iter().len() >= self.periods
    }

    /// What is on its way, the oldest first.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.ring.iter()
    }

    pub const fn periods(&self) -> usize {
        self.periods
    }

    pub fn clear(&mut self) {
        self.ring.clear();
    }
}

/// As many words however many wait.
impl<T: Copy + Default + Stored, const D: usize> Stored for Delay<T, D> {
    fn pass(&mut self, archive: &mut dyn Archive) {
        let mut count = self.ring.iter().len() as u32;
        count.pass(archive);
        if count as usize > self.periods {
            archive.refuse();
        }
        let waiting = core::mem::take(&mut self.ring);
        let mut waiting = waiting.iter();
        for place in 0..self.periods {
            let mut item = waiting.next().copied().unwrap_or_default();
            item.pass(archive);
            if place < count as usize {
                // There is room for all periods.
                let _ = self.ring.push_back(item);
            }
        }
    }
}
