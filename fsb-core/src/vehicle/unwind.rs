//! Body angles are turns added up: of a vehicle that spins on and on they grow without bound. The plant is translation invariant,
//! so their origin moves and nothing else does.

use super::estimator::VehicleEstimator;

impl<const D: usize> VehicleEstimator<D> {
    /// Angles that have turned far are taken from a later origin: they would lose digits, and in the end their limit.
    pub(super) fn unwind(&mut self) {
        let far = self.far;
        if self.angles.angles().iter().map(|angle| angle.abs()).sum::<f32>() <= far {
            return;
        }
        let by = self.angles.angles().map(|angle| {
            if angle > far {
                -far
            } else if angle < -far {
                far
            } else {
                0.0
            }
        });
        if by != [0.0; 3] {
            self.angles.translate(&by);
            self.rotation.translate(&by);
        }
    }
}
