//! Parameters identified anew: by hand, after a change, after an attitude that could not be followed.

use super::estimator::VehicleEstimator;
use super::output::Group;
use crate::estimator::{Estimator, Learning};
use crate::readout::ParameterStatus;

impl<const D: usize> VehicleEstimator<D> {
    /// Identifies the parameters of a group anew, as after a change of load: what is known goes on being handed out and used
    /// until the new value is valid. What was measured before now, where measurements are late, is not learned from.
    pub fn reinitialise(&mut self, group: Group) {
        self.identify_anew(group);
        let [position, attitude] = self.late();
        let [force, torque] = &mut self.replaced;
        match group {
            Group::Translation => force.await_now(position),
            Group::Rotation => torque.await_now(attitude),
        }
    }

    /// The same from the next measurement on.
    fn identify_anew(&mut self, group: Group) {
        match group {
            Group::Translation => {
                self.translation.reinitialise_identifier();
                if let Some(detector) = &mut self.translation_change {
                    detector.reset();
                }
            }
            Group::Rotation => {
                self.rotation.reinitialise_identifier();
                if let Some(retroactive) = &mut self.retroactive {
                    retroactive.reset();
                }
                if let Some(detector) = &mut self.rotation_change {
                    detector.reset();
                }
            }
        }
    }

    /// What goes with the identifiers begins anew with them.
    pub(super) fn begin_identification(&mut self) {
        if let Some(retroactive) = &mut self.retroactive {
            retroactive.reset();
        }
        for detector in [&mut self.translation_change, &mut self.rotation_change].into_iter().flatten() {
            detector.reset();
        }
    }

    /// What goes with the rotation begins anew with it.
    pub(super) fn begin_rotation(&mut self) {
        if let Some(retroactive) = &mut self.retroactive {
            retroactive.reset();
        }
        if let Some(detector) = &mut self.rotation_change {
            detector.restart();
        }
    }

    /// Looks for a change after a measurement instant of the group, and acts on it.
    pub(super) fn mass_has_changed(&mut self) -> bool {
        let Some(detector) = &mut self.translation_change else { return false };
        let ([k], [contradicted]) = (identified(&self.translation), contradicted(&self.translation));
        let known = [k, None, None];
        let view = self.translation.innovation_view();
        let mut changed = detector.observe(&view, &known, &[contradicted, false, false]);
        if detector.is_behind(self.translation.identifier_blocks()) && self.translation.identifier_rests() {
            let [k] = learned(&self.translation);
            changed |= detector.observe_residuals(&self.translation.identifier_view(), [k, None, None]);
        }
        if changed {
            detector.doubt.begin();
            self.identify_anew(Group::Translation);
        }
        changed
    }

    /// Looks for a change after a measurement instant of the group, and acts on it.
    pub(super) fn inertia_has_changed(&mut self) -> bool {
        let Some(detector) = &mut self.rotation_change else { return false };
        let (known, contradicted) = (identified(&self.rotation), contradicted(&self.rotation));
        let mut changed = detector.observe(&self.rotation.innovation_view(), &known, &contradicted);
        if detector.is_behind(self.rotation.identifier_blocks()) && self.rotation.identifier_rests() {
            changed |= detector.observe_residuals(&self.rotation.identifier_view(), learned(&self.rotation));
        }
        if changed {
            detector.doubt.begin();
            self.identify_anew(Group::Rotation);
            self.rotation.suspect_disturbance();
        }
        changed
    }
}

/// Whether the motion contradicts the parameters, where they are being learned.
fn contradicted<const P: usize>(estimator: &Estimator<3, P>) -> [bool; P] {
    let learning = estimator.learning() == Learning::On;
    estimator.parameter_status().map(|status| learning && status == ParameterStatus::Contradicted)
}

/// k of the parameters that are valid now, not held. None while nothing is learned: they are to stay as they are, and in contact
/// the motion says nothing about them.
fn identified<const P: usize>(estimator: &Estimator<3, P>) -> [Option<f32>; P] {
    if estimator.learning() != Learning::On {
        return [None; P];
    }
    let mut values = estimator.parameters().map(|k| k.map(|k| k.value));
    for (value, status) in values.iter_mut().zip(estimator.parameter_status()) {
        if status != ParameterStatus::Valid {
            *value = None;
        }
    }
    values
}

/// The same, and of those that have become too uncertain: what made them so may be a change.
fn learned<const P: usize>(estimator: &Estimator<3, P>) -> [Option<f32>; P] {
    let mut values = identified(estimator);
    let all = values.iter_mut().zip(estimator.parameter_status()).zip(estimator.rough_parameters());
    for ((value, status), rough) in all {
        if status == ParameterStatus::Uncertain && estimator.learning() == Learning::On {
            *value = rough.map(|k| k.value);
        }
    }
    values
}
