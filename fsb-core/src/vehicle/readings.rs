//! Parameters and counters handed out.

use super::change::Detector;
use super::estimator::VehicleEstimator;
use super::output::{Identified, VehicleCounters, VehicleModel};
use super::triple::all;
use crate::estimator::Estimator;
use crate::guard::Guarded;
use crate::readout::{Parameter, ParameterStatus};

impl<const D: usize> VehicleEstimator<D> {
    /// 1/I that is predicted with, where all three are known.
    pub(super) fn reciprocals(&self) -> Option<[f32; 3]> {
        all(self.rotation.prediction_parameters())
    }

    /// m (kg), where it is valid or held.
    pub fn mass(&self) -> Option<Identified> {
        let [k] = handed_out(&self.translation, self.translation_change.as_ref());
        k
    }

    /// I_x, I_y, I_z (kg m²), where they are valid or held.
    pub fn inertia(&self) -> [Option<Identified>; 3] {
        handed_out(&self.rotation, self.rotation_change.as_ref())
    }

    /// Why the mass is valid or not.
    pub fn mass_status(&self) -> ParameterStatus {
        let [status] = self.translation.parameter_status();
        status
    }

    /// Why the moments of inertia are valid or not.
    pub fn inertia_status(&self) -> [ParameterStatus; 3] {
        self.rotation.parameter_status()
    }

    /// What the state is predicted with, and what a controller may divide by.
    pub fn model(&self) -> VehicleModel {
        let [k] = self.translation.prediction_parameters();
        VehicleModel {
            mass: k.map(|k| 1.0 / k),
            inertia: self.rotation.prediction_parameters().map(|k| k.map(|k| 1.0 / k)),
        }
    }

    /// The estimator of x, y, z: for its diagnostics.
    pub const fn translation(&self) -> &Guarded<3, 1> {
        &self.translation
    }

    /// The estimator of the body angles: for its diagnostics.
    pub const fn rotation(&self) -> &Guarded<3, 3> {
        &self.rotation
    }

    /// What has been rejected, lost or changed.
    pub const fn counters(&self) -> VehicleCounters {
        self.counters
    }
}

/// The parameters that are valid or held, with what a change leaves open.
fn handed_out<const P: usize>(of: &Estimator<3, P>, detector: Option<&Detector>) -> [Option<Identified>; P] {
    let mut parameters = of.parameters();
    if let Some(Detector { doubt, relative, .. }) = detector {
        let newest = of.rough_parameters().into_iter().zip(of.parameter_status());
        for (index, (k, (newest, status))) in parameters.iter_mut().zip(newest).enumerate() {
            let newest = (status == ParameterStatus::Held).then_some(newest);
            *k = k.map(|k| doubt.widen(index, k, newest, *relative));
        }
    }
    parameters.map(|k| k.map(inverse))
}

/// 1/k with var(k)/k⁴.
fn inverse(k: Parameter) -> Identified {
    let value = 1.0 / k.value;
    let square = value * value;
    Identified { value, variance: (k.variance * square) * square }
}
