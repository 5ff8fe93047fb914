//! Measurements that come between two measurement instants. One is an accident; where all do, the instants are elsewhere: the
//! control loop has lost a period, or the sensor has, and what comes would not be taken until nothing is known any more.

use super::estimator::VehicleEstimator;
use super::output::Events;

impl<const D: usize> VehicleEstimator<D> {
    /// Whether an attitude that has come is one too many of those between two instants: the instants have to begin anew with it.
    pub(super) fn attitude_is_early(&mut self) -> bool {
        let [attitudes, _] = &mut self.early;
        is_early(attitudes, self.rotation.is_due(), self.enough)
    }

    /// The same for a position; tells of it.
    pub(super) fn position_is_early(&mut self, events: &mut Events) -> bool {
        let due = self.translation.is_due();
        events.position_out_of_step = !due;
        let [_, positions] = &mut self.early;
        is_early(positions, due, self.enough_positions)
    }
}

/// Counts those in succession, up to `enough`.
fn is_early(count: &mut u32, due: bool, enough: u32) -> bool {
    *count = if due { 0 } else { count.saturating_add(1) };
    let anew = *count >= enough;
    if anew {
        *count = 0;
    }
    anew
}
