//! What is not to be learned from: forces and torques that were rejected, and replaced by the one before. One is a fault in the bits, and passes; where they
//! go on nobody knows what acts, and what is learned from it would be wrong and look right. And where measurements are late, those of before
//! the learning began, or of before a change of load that was told; nor after contact before the rates have recovered.

use super::estimator::VehicleEstimator;
use crate::estimator::Learning;
use crate::snapshot::stored;

/// The inputs of one group.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Replaced {
    /// Replaced in succession; stops at [`Self::MANY`].
    count: u32,
    /// Control periods until those that were replaced have acted, as far as the measurements know.
    acting: u32,
}

impl Replaced {
    /// So many in succession are no fault in the bits any more.
    const MANY: u32 = 3;

    /// A control period has ended, whose input was `rejected` or not; measurements are `late` by so many.
    pub fn count(&mut self, rejected: bool, late: usize) {
        self.count = match self.count {
            count if rejected && count < Self::MANY => count + 1,
            count if rejected => count,
            _ => 0,
        };
        self.acting = self.acting.saturating_sub(1);
        if self.count == Self::MANY && self.acting <= late as u32 {
            self.acting = late as u32 + 1;
        }
    }

    /// From now on everything is another: what the measurements know is so many control periods `late`.
    pub fn await_now(&mut self, late: usize) {
        let acting = if late > 0 { late as u32 + 2 } else { 0 };
        if self.acting < acting {
            self.acting = acting;
        }
    }

    pub const fn is_acting(self) -> bool {
        self.acting > 0
    }

    /// Of a state that was stored.
    pub const fn is_sound(self, late: usize) -> bool {
        self.count <= Self::MANY && self.acting as usize <= late + 2
    }
}

stored!(Replaced { count, acting });

impl<const D: usize> VehicleEstimator<D> {
    /// By how many control periods the force and the torque of now come before the measurements that know of them.
    pub(super) fn late(&self) -> [usize; 2] {
        let late = self.wrenches.periods();
        [late + self.forces.periods(), late]
    }

    /// Learning was told `now`, which it was not `before`: what is late is of before. And the rates lag behind in contact, when they are
    /// predicted to stay; the gyroscopic moment learned with them would be another.
    pub(super) fn await_learning(&mut self, before: Learning, now: Learning) {
        let [position, attitude] = self.late();
        let recovery = if before == Learning::Contact { self.recovery as usize } else { 0 };
        let [force, torque] = &mut self.replaced;
        if now == Learning::On {
            force.await_now(position);
        }
        if now != Learning::Contact {
            torque.await_now(attitude + recovery);
        }
    }

    /// Before a measurement instant of the translation: nothing is learned from forces that were replaced. What is known stays.
    pub(super) fn pass_over_forces(&mut self) {
        let [force, _] = self.replaced;
        if force.is_acting() {
            self.translation.reopen_window();
            if let Some(detector) = &mut self.translation_change {
                detector.restart();
            }
        }
    }

    /// The same for the rotation and torques.
    pub(super) fn pass_over_torques(&mut self) {
        let [_, torque] = self.replaced;
        if torque.is_acting() {
            self.rotation.reopen_window();
            if let Some(detector) = &mut self.rotation_change {
                detector.restart();
            }
        }
    }
}
