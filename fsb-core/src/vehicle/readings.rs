//! Parameters and counters handed out.

use super::estimator::VehicleEstimator;
use super::output::{Identified, VehicleCounters, VehicleModel};
use super::triple::all;
use crate::guard::Guarded;
use crate::readout::{Parameter, ParameterStatus};

impl<const D: usize> VehicleEstimator<D> {
    /// 1/I that is predicted with, where all three are known.
    pub(super) fn reciprocals(&self) -> Option<[f32; 3]> {
        all(self.rotation.prediction_parameters())
    }

    /// m (kg), where it is valid or held.
    pub fn mass(&self) -> Option<Identified> {
        let [k] = self.translation.parameters();
        k.map(inverse)
    }

    /// I_x, I_y, I_z (kg m²), where they are valid or held.
    pub fn inertia(&self) -> [Option<Identified>; 3] {
        self.rotation.parameters().map(|k| k.map(inverse))
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

/// 1/k with var(k)/k⁴.
fn inverse(k: Parameter) -> Identified {
    let value = 1.0 / k.value;
    let square = value * value;
    Identified { value, variance: (k.variance * square) * square }
}
