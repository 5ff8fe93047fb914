//! What an estimator hands out.

use crate::moments::InputMoments;
use core::fmt;

/// Position and velocity of an axis at the present tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AxisState {
    /// ŷ (m or rad), in the frame of the measurement.
    pub position: f32,
    /// v̂ (m/s or rad/s).
    pub velocity: f32,
}

/// Whether a state may be used, and why not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum StateStatus {
    /// This axis has not been measured yet.
    NotMeasured,
    /// Less than the configured time has passed since the first measurement, or too few measurements came since to tell the
    /// velocity.
    Settling,
    /// Not measured for longer than is bridged by prediction ([`Guarded`](crate::guard::Guarded)).
    Stale,
    /// No parameter to predict with: k̂ is not valid and there is no nominal one.
    NoParameter,
    /// Usable, predicted with the nominal parameter, and as right as that is: off by Δk it leaves the velocity off by up to 2 |Δk f|/λ of the
    /// observer, and where measurements are missing by one over the share that comes more.
    Nominal,
    /// Usable, predicted with the identified parameter.
    Identified,
    /// Usable, predicted with the parameter identified before the last re-initialisation.
    Held,
}

impl fmt::Display for StateStatus {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::NotMeasured => "not measured",
            Self::Settling => "settling",
            Self::Stale => "stale",
            Self::NoParameter => "no parameter",
            Self::Nominal => "on the nominal parameter",
            Self::Identified => "on the identified parameter",
            Self::Held => "on the held parameter",
        })
    }
}

/// Whether the estimator learns from what it sees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Learning {
    /// In flight: the parameters are identified, and the states predicted with them.
    #[default]
    On,
    /// The parameters stay as they are, and the states are predicted with them.
    Off,
    /// On the ground or held: forces act that nobody knows. The parameters stay as they are, and the states are predicted
    /// with constant velocity.
    Contact,
}

/// A measurement was given at an instant that is none: `missing` more inputs must be applied first. Nothing has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OutOfStep {
    /// Control periods left until the next measurement instant.
    pub missing: u32,
}

impl fmt::Display for OutOfStep {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "a measurement came {} control periods early", self.missing)
    }
}

impl core::error::Error for OutOfStep {}

/// Events since construction. They only rise, and stop at the largest number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Counters {
    /// Measurements that did not come, over all axes.
    pub missed: u32,
    /// Measurements that were not finite or beyond the limit; treated as missed.
    pub rejected_measurements: u32,
    /// Inputs that were not finite or beyond the limit; the axis's mean input of late was used in their place.
    pub rejected_inputs: u32,
}

/// What goes with the observer from outside needs of its last step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InnovationView<const N: usize> {
    /// y - ŷ⁻.
    pub innovations: [f32; N],
    /// Input over the interval that ended with it.
    pub moments: [InputMoments; N],
    /// σ² of a measurement, where it is known.
    pub noise_variances: [Option<f32>; N],
    /// Every axis was measured.
    pub measured: bool,
    pub m1: f32,
    pub t_l2: f32,
}

/// What goes with the identifier from outside needs of its last step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IdentifierView<const N: usize> {
    /// Steps so far; begins anew with the identification.
    pub blocks: u32,
    /// g\[n-1\], the weight of S; scaled.
    pub weight: f32,
    /// c = 1 - e^(-λT)
    pub c: f32,
    /// 1/M
    pub per_length: f32,
    /// What the sums forget in a step: 1 - e^(-T/τ).
    pub forgetting: f32,
    /// ẑ0, scaled.
    pub z0: [f32; N],
    /// ẑ2 without what the drift has in it, scaled alike.
    pub z2: [f32; N],
    /// Variance of ẑ2 by noise and by the disturbance that is expected, where it is known.
    pub variances: [Option<f32>; N],
    /// Whether the step has been added to the sums.
    pub counts: [bool; N],
    /// Σ ω ẑ0 of the axis's parameter.
    pub denominators: [f32; N],
}

/// What an axis's input turns out to have been beyond what was applied, to be added to its identifier.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InputShift {
    /// x4, x5, x6 of the cascade.
    pub cascade: [f32; 3],
    /// Σ ω ẑ0 of the parameter.
    pub denominator: f32,
    /// The square of what its k may be off by, relative to itself, as the input may be.
    pub doubt: f32,
    /// The variance that ẑ0 has for the same reason, scaled.
    pub tolerance: f32,
}

/// The identifier's inner signals in physical units: for logs and tests, not for control.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AxisDiagnostics {
    /// ẑ2 with the known drift removed: windowed, filtered acceleration (m/s² or rad/s²).
    pub z2: f32,
    /// ẑ0: windowed, filtered input (N or N m).
    pub z0: f32,
    /// ẑu: windowed, filtered one.
    pub zu: f32,
    /// The observer's innovation y - ŷ⁻ at the last measurement.
    pub innovation: f32,
    /// σ² of the measurement noise as learned so far: from sample to sample, and in the band of the identifier.
    pub noise_variance: [f32; 2],
    /// Σ ω ẑ2 of the axis's parameter, scaled.
    pub numerator: f32,
    /// Σ ω ẑ0 of the axis's parameter, scaled alike: the quotient of the two is the newest k̂, valid or not.
    pub denominator: f32,
}
