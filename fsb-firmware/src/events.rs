//! What happened, with the tick it happened at: the newest 32, and how many older ones were dropped unread.

use fsb_core::control::ControlError;
use fsb_core::readout::ParameterStatus;
use heapless::Deque;

/// Something worth a line in a log. Axes are 0 to 5: x, y, z, φ, θ, ψ; parameters 0 to 3: 1/m, 1/Ix, 1/Iy, 1/Iz.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Event {
    /// A parameter may be used from here on.
    ParameterValid(u8),
    /// A parameter may no longer be used, and why.
    ParameterLost(u8, ParameterStatus),
    /// Measurements, this many at once, were infinite or beyond the limit. NaN counts as missing.
    MeasurementRejected(u32),
    /// A sample came before its instant and was not used.
    SampleEarly,
    /// The attitude matrix was not finite; the last good one is used.
    AttitudeRejected,
    /// Motors ask for more than they have, by bits, and did not the tick before.
    Saturated(u8),
    /// No motor saturates any more.
    SaturationOver,
    /// The controller of this axis had nothing to give: the fallback is used from here on.
    ControlRefused(u8, ControlError),
    /// The estimators were started anew.
    Reset,
}

/// An event and its tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct StampedEvent {
    /// Ticks since the loop was made; wraps.
    pub tick: u32,
    /// What happened.
    pub event: Event,
}

/// The newest events, oldest first. Telemetry takes them out between ticks.
#[derive(Debug, Default)]
pub struct Events {
    ring: Deque<StampedEvent, 32>,
    dropped: u32,
}

impl Events {
    pub(crate) fn push(&mut self, tick: u32, event: Event) {
        let stamped = StampedEvent { tick, event };
        #[cfg(feature = "defmt")]
        defmt::info!("{}", stamped);
        if self.ring.is_full() {
            self.ring.pop_front();
            self.dropped = self.dropped.saturating_add(1);
        }
        // There is room: one was taken out.
        let _ = self.ring.push_back(stamped);
    }

    /// The oldest event, taken out.
    pub fn take(&mut self) -> Option<StampedEvent> {
        self.ring.pop_front()
    }

    /// Events lost because nobody took them out in time; stops at the largest number.
    pub const fn dropped(&self) -> u32 {
        self.dropped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_the_newest_and_counts_the_rest() {
        let mut events = Events::default();
        for tick in 0..40 {
            events.push(tick, Event::Reset);
        }
        assert_eq!(events.dropped(), 8);
        assert_eq!(events.take(), Some(StampedEvent { tick: 8, event: Event::Reset }));
        assert_eq!(core::iter::from_fn(|| events.take()).last().unwrap().tick, 39);
    }
}
