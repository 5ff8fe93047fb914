//! What happened, with the tick it happened at: the newest 32, and how many older ones were dropped unread.

use fsb_core::control::ControlError;
use fsb_core::estimator::StateStatus;
use fsb_core::guard::Verdict;
use fsb_core::readout::ParameterStatus;
use fsb_core::vehicle::Group;
use heapless::Deque;

/// Something worth a line in a log. Axes are 0 to 5: x, y, z, φ, θ, ψ; parameters 0 to 3: 1/m, 1/Ix, 1/Iy, 1/Iz.
///
/// What goes on is told when it begins and when it ends, and what flickers once: an outage ends when nothing has been wrong for a second,
/// and each reason is told once in it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Event {
    /// A parameter may be used from here on.
    ParameterValid(u8),
    /// A parameter is identified anew, after a gap that was too long; the value from before goes on being used.
    ParameterHeld(u8),
    /// A parameter may no longer be used, and why. The nominal one is, where there is one.
    ParameterLost(u8, ParameterStatus),
    /// Measurements of this axis are not used, and why; one that is [`Missing`](Verdict::Missing) has been so for longer than
    /// [`missing_after`](crate::LoopConfig::missing_after). The axis is flown on prediction.
    MeasurementRejected(u8, Verdict),
    /// The outage that [`MeasurementRejected`](Self::MeasurementRejected) began is over.
    MeasuredAgain(u8),
    /// The sensor's origin has jumped by so much (m or rad) on this axis. Its positions are taken as they are now, so that the
    /// vehicle flies to where it shall be by them; velocity and identification do not notice.
    Jumped(u8, f32),
    /// The velocity on this axis has changed at once, by so much (m/s or rad/s), which no input explains. The state follows, the
    /// identification's window begins anew.
    Pushed(u8, f32),
    /// This axis has no state to fly on, and why: not measured for longer than is bridged, or never since the start. It has the
    /// configured fallback input from here on.
    StateLost(u8, StateStatus),
    /// This axis has a state from here on, and what it is predicted with: it is controlled.
    StateUsable(u8, StateStatus),
    /// Samples came before their instant and are not used for this group. Where it goes on the group's states are lost, and it starts
    /// anew in step with the samples.
    SampleEarly(Group),
    /// The attitude matrix is no rotation, or the angles that came with it were turned away; the last good one is used.
    AttitudeRejected,
    /// No good attitude for longer than the rotation bridges: no force can be pointed. The fallback force is applied along the body's axes,
    /// and the translation learns nothing meanwhile.
    AttitudeLost,
    /// There is an attitude from here on: the translation is controlled.
    AttitudeUsable,
    /// Motors ask for more than they have, by bits, and did not the tick before.
    Saturated(u8),
    /// No motor saturates any more.
    SaturationOver,
    /// The controller of this axis had nothing to give: the fallback is used from here on.
    ControlRefused(u8, ControlError),
    /// The estimators were started anew: no axis has a state, which is not told again.
    Reset,
}

/// An event and its tick.
#[derive(Clone, Copy, Debug, PartialEq)]
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
