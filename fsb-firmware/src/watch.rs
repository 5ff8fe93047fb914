//! Which axes are measured and which have a state, and what of that is told. An outage is told once, however it flickers.

use crate::events::{Event, Events};
use fsb_core::estimator::{AxisState, StateStatus};
use fsb_core::guard::Verdict;

/// How long things may last, of one group of axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    /// Measurement instants without a measurement that are nothing special.
    pub missing: u16,
    /// Instants in a row without anything special that end an outage.
    pub quiet: u16,
    /// Control periods after which an axis that has never had a state is told.
    pub start: u32,
}

/// The measurements of one axis.
#[derive(Clone, Copy, Debug, Default)]
struct Measured {
    /// Instants since one was used.
    gap: u16,
    /// Instants since one at which there was something to tell.
    good: u16,
    /// Reasons told in this outage, by bits; none where there is no outage.
    told: u8,
}

/// What is known of N axes, the first of which is number `first` of the loop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watch<const N: usize> {
    first: u8,
    patience: Patience,
    measured: [Measured; N],
    /// As told.
    usable: [bool; N],
    /// Ticks since the start, as far as they matter.
    waited: u32,
}

impl<const N: usize> Watch<N> {
    pub fn new(first: u8, patience: Patience) -> Self {
        Self { first, patience, measured: [Measured::default(); N], usable: [false; N], waited: 0 }
    }

    pub fn reset(&mut self) {
        *self = Self::new(self.first, self.patience);
    }

    /// What became of the measurements at an instant.
    pub fn note(&mut self, verdicts: &[Verdict; N], tick: u32, events: &mut Events) {
        for ((axis, verdict), number) in self.measured.iter_mut().zip(verdicts).zip(self.first..) {
            if *verdict == Verdict::Taken && axis.told == 0 {
                axis.gap = 0;
            } else {
                axis.note(*verdict, number, &self.patience, tick, events);
            }
        }
    }

    /// Tells which axes have lost their state or have one again. To be called once a tick.
    pub fn compare(
        &mut self,
        states: &[Option<AxisState>; N],
        why: impl Fn() -> [StateStatus; N],
        tick: u32,
        events: &mut Events,
    ) {
        let started = self.waited > self.patience.start;
        if !started {
            self.waited += 1;
        }
        // Never had one, and should by now.
        let late = !started && self.waited > self.patience.start;
        let same = self.usable.iter().zip(states).all(|(before, now)| *before == now.is_some());
        if same && !late {
            return;
        }
        let axes = self.usable.iter_mut().zip(states).zip(why()).zip(self.first..);
        for (((usable, state), status), number) in axes {
            let now = state.is_some();
            if now && !*usable {
                events.push(tick, Event::StateUsable(number, status));
            } else if !now && (*usable || late) {
                events.push(tick, Event::StateLost(number, status));
            }
            *usable = now;
        }
    }
}

impl Measured {
    #[cold]
    #[inline(never)]
    fn note(&mut self, verdict: Verdict, number: u8, patience: &Patience, tick: u32, events: &mut Events) {
        match verdict {
            Verdict::Jumped(by) => events.push(tick, Event::Jumped(number, by)),
            Verdict::Pushed(by) => events.push(tick, Event::Pushed(number, by)),
            _ => {}
        }
        self.gap = if verdict.is_used() { 0 } else { self.gap.saturating_add(1) };
        let reason = match verdict {
            Verdict::NonFinite => 1,
            Verdict::BeyondLimit => 2,
            Verdict::Improbable => 4,
            Verdict::Frozen => 8,
            _ if self.gap > patience.missing => 16,
            _ => 0,
        };
        if reason & !self.told != 0 {
            self.told |= reason;
            events.push(tick, Event::MeasurementRejected(number, verdict));
        }
        self.good = if reason == 0 { self.good.saturating_add(1) } else { 0 };
        if self.told != 0 && self.good >= patience.quiet {
            self.told = 0;
            events.push(tick, Event::MeasuredAgain(number));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATIENCE: Patience = Patience { missing: 3, quiet: 4, start: 5 };
    const STATE: Option<AxisState> = Some(AxisState { position: 0.0, velocity: 0.0 });

    fn told(events: &mut Events) -> Vec<(u32, Event)> {
        core::iter::from_fn(|| events.take()).map(|stamped| (stamped.tick, stamped.event)).collect()
    }

    extern crate std;
    use std::vec::Vec;

    fn noted(verdicts: &[Verdict]) -> Vec<(u32, Event)> {
        let (mut watch, mut events) = (Watch::<1>::new(3, PATIENCE), Events::default());
        for (verdict, tick) in verdicts.iter().zip(0..) {
            watch.note(&[*verdict], tick, &mut events);
        }
        told(&mut events)
    }

    #[test]
    fn what_is_missing_is_told_when_it_is_long() {
        let (y, n) = (Verdict::Taken, Verdict::Missing);
        assert_eq!(noted(&[n, n, n, y, n, n, n, y, y]), []);
        let long = [n, n, n, n, n, y, y, y, y, y];
        assert_eq!(noted(&long), [(3, Event::MeasurementRejected(3, n)), (8, Event::MeasuredAgain(3))]);
    }

    /// A slow receiver has gaps all the time: they neither begin an outage nor keep it from ending.
    #[test]
    fn short_gaps_are_nothing() {
        let (y, n, i) = (Verdict::Taken, Verdict::Missing, Verdict::Improbable);
        let events = noted(&[y, n, n, y, n, i, y, n, n, y, n, n]);
        assert_eq!(events, [(5, Event::MeasurementRejected(3, i)), (9, Event::MeasuredAgain(3))]);
    }

    /// Each reason once; the outage ends with the fourth in a row that is used.
    #[test]
    fn what_flickers_is_told_once() {
        let (y, n, i) = (Verdict::Taken, Verdict::NonFinite, Verdict::Improbable);
        let events = noted(&[y, n, y, n, i, y, y, y, n, i, y, y, y, y, n]);
        let rejected = |verdict| Event::MeasurementRejected(3, verdict);
        assert_eq!(events, [(1, rejected(n)), (4, rejected(i)), (13, Event::MeasuredAgain(3)), (14, rejected(n))]);
    }

    #[test]
    fn a_jump_is_told_whenever_it_comes() {
        let jump = Verdict::Jumped(2.0);
        assert_eq!(noted(&[jump, jump]), [(0, Event::Jumped(3, 2.0)), (1, Event::Jumped(3, 2.0))]);
    }

    #[test]
    fn states_are_told_when_they_come_and_go() {
        let (mut watch, mut events) = (Watch::<2>::new(0, PATIENCE), Events::default());
        let mut compare = |states, tick| watch.compare(&states, || [StateStatus::Stale; 2], tick, &mut events);
        for tick in 0..10 {
            compare([if tick > 1 { STATE } else { None }, None], tick);
        }
        compare([None, STATE], 10);
        let (stale, lost) = (StateStatus::Stale, Event::StateLost);
        let usable = Event::StateUsable;
        let wanted = [(2, usable(0, stale)), (5, lost(1, stale)), (10, lost(0, stale)), (10, usable(1, stale))];
        assert_eq!(told(&mut events), wanted);
    }
}
