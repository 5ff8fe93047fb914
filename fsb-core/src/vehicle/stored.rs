//! What a snapshot holds of a vehicle's estimator, and what it must obey.

use super::VehicleEstimator;
use super::measured::Wrench;
use super::output::VehicleCounters;
use super::triple::within;
use crate::snapshot::{Archive, Fingerprint, Stored, Whole, snapshots, stored};

stored!(Wrench { force, torque });
stored!(VehicleCounters {
    rejected_attitudes,
    lost_attitudes,
    rejected_positions,
    position_jumps,
    translation_pushes,
    rotation_pushes,
    positions_out_of_step,
    rejected_wrenches,
    mass_changes,
    inertia_changes,
});

impl<const D: usize> Stored for VehicleEstimator<D> {
    fn pass(&mut self, archive: &mut dyn Archive) {
        self.translation.pass(archive);
        self.rotation.pass(archive);
        self.angles.pass(archive);
        self.actual.pass(archive);
        self.wrenches.pass(archive);
        self.forces.pass(archive);
        self.attitude_measured.pass(archive);
        self.last.pass(archive);
        self.replaced.pass(archive);
        self.too_far.pass(archive);
        self.early.pass(archive);
        // What is there is a matter of the design.
        if let Some(retroactive) = &mut self.retroactive {
            retroactive.pass(archive);
        }
        for detector in [&mut self.translation_change, &mut self.rotation_change].into_iter().flatten() {
            detector.pass(archive);
        }
        self.begun.pass(archive);
        self.counters.pass(archive);
    }
}

impl<const D: usize> VehicleEstimator<D> {
    snapshots!();
}

impl<const D: usize> Whole for VehicleEstimator<D> {
    const SHAPE: [u8; 3] = [2, 6, 4];

    fn fingerprint(&self) -> u32 {
        let mut hash = Fingerprint::new();
        for word in [self.translation.fingerprint(), self.rotation.fingerprint(), self.enough] {
            hash.add(word);
        }
        for delay in [self.wrenches.periods(), self.forces.periods()] {
            hash.add(delay as u32);
        }
        for number in [self.period, self.actuators.decay(), self.position_limit, self.force_limit, self.torque_limit] {
            hash.add_number(number);
        }
        hash.add(u32::from(self.retroactive.is_some()));
        for detector in [&self.translation_change, &self.rotation_change] {
            hash.add(u32::from(detector.is_some()));
            if let Some(detector) = detector {
                detector.add_to(&mut hash);
            }
        }
        hash.value()
    }

    fn is_sound(&self) -> bool {
        let possible =
            |wrench: &Wrench| within(&wrench.force, self.force_limit) && within(&wrench.torque, self.torque_limit);
        // Turned into the world frame a force may be longer along one axis, by the square root of three.
        let most = 2.0 * self.force_limit;
        self.translation.is_sound()
            && self.rotation.is_sound()
            && self.angles.is_sound()
            && possible(&self.last)
            && self
                .replaced
                .iter()
                .all(|replaced| replaced.is_sound(self.late().iter().sum::<usize>() + self.recovery as usize))
            && self.actual.iter().all(possible)
            && self.wrenches.iter().all(possible)
            && self.forces.iter().flatten().all(|moments| moments.j1.abs() <= most && moments.j2.abs() <= most)
            && self.too_far < self.enough
            && self.early.iter().zip([self.enough, self.enough_positions]).all(|(early, enough)| *early < enough)
            && self.retroactive.iter().all(|retroactive| retroactive.is_sound())
            && [&self.translation_change, &self.rotation_change]
                .into_iter()
                .flatten()
                .all(|detector| detector.is_sound())
    }
}
