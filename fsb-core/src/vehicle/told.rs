//! What the estimator is told beside its updates: whether to learn, periods that were lost, to begin anew.

use super::estimator::VehicleEstimator;
use super::measured::Measured;
use crate::attitude::BodyAngles;
use crate::estimator::Learning;

impl<const D: usize> VehicleEstimator<D> {
    /// Whether to learn from now on, as [`Estimator::set_learning`](crate::Estimator::set_learning): on the ground
    /// [`Learning::Contact`]. What was measured before learning is on again, where measurements are late, is not learned from,
    /// and moments of inertia not before the rates have recovered from contact, for 4/λ of the rotation's observer.
    pub fn set_learning(&mut self, learning: Learning) {
        let before = self.translation.learning();
        if learning != before {
            self.translation.set_learning(learning);
            self.rotation.set_learning(learning);
            self.begin_identification();
            self.await_learning(before, learning);
        }
    }

    /// The control loop has been late by so many control periods, before the [`update`](Self::update) that ends the last of them. As many
    /// updates with nothing measured and with the wrench of the last one, at most those that end in a start anew.
    ///
    /// That is the wrench of the period before the one now late. Where the actuators have been told another one since, and it is at hand, as many
    /// updates with that one and nothing measured are right, and this is only nearly so.
    pub fn missed(&mut self, periods: u32) {
        let last = self.last;
        let most = self.translation.longest().max(self.rotation.longest());
        for _ in 0..periods.min(most) {
            self.update(&Measured::default(), &last);
        }
    }

    /// Forgets everything but the configuration, what was said about [learning](Self::set_learning), and the counters.
    pub fn reset(&mut self) {
        self.translation.reset();
        self.rotation.reset();
        self.begin_rotation();
        if let Some(detector) = &mut self.translation_change {
            detector.restart();
        }
        for detector in [&mut self.translation_change, &mut self.rotation_change].into_iter().flatten() {
            detector.doubt.forget();
        }
        self.angles = BodyAngles::default();
        self.wrenches.clear();
        self.forces.clear();
        self.actual = None;
        (self.last, self.replaced) = Default::default();
        (self.too_far, self.early) = (0, [0; 2]);
        self.attitude_measured = false;
        self.begun = false;
    }
}
