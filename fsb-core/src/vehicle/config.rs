//! The configuration of a [`super::VehicleEstimator`]: plain data.

use crate::guard::GuardConfig;
use crate::readout::{Memory, Readout};
use crate::tuning::Tuning;

/// Plain data; [`super::VehicleEstimator::new`] validates it. Read once, hence f64.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VehicleConfig {
    /// Control period (s): the time from one [`update`](super::VehicleEstimator::update) to the next. 1e-6..=1e3.
    pub period: f64,
    /// x, y, z in the world frame, pooled into the mass.
    pub translation: GroupConfig,
    /// Angles about the body's x, y, z, each with its moment of inertia.
    pub rotation: GroupConfig,
    /// g (m/s²), along -z of the world frame. 0..=1e6.
    pub gravity: f64,
    /// m (kg).
    pub mass: Expected,
    /// I_x, I_y, I_z (kg m²).
    pub inertia: [Expected; 3],
    /// τ (s) of force and torque behind what the actuators are told, first order: τ F' = F_told - F. From a twentieth of the
    /// control period to 1e3 s; `None` where they follow at once.
    pub actuator_lag: Option<f64>,
    /// When a change of mass or inertia is taken as such; `None`: never.
    pub change: Option<ChangeRule>,
}

/// What is known of a mass (kg) or a moment of inertia (kg m²) beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Expected {
    /// Predicted with until the parameter is identified; 1e-12..=1e12. `None`: no state is handed out before.
    pub nominal: Option<f64>,
    /// The smallest that can be right; 1e-12..=1e12. A smaller estimate is never used.
    pub min: f64,
    /// The largest that can be right; above the smallest, up to 1e12.
    pub max: f64,
}

/// One of the two groups of axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct GroupConfig {
    /// Control periods from one measurement to the next, at least 1.
    pub substeps: u32,
    /// Control periods by which a measurement is late: what is given at an update was true so many periods before. At most
    /// the capacity D of the estimator; that of the translation not below that of the rotation.
    pub latency: u32,
    /// Measurements per step of the identifier, at least 1; see [`crate::EstimatorConfig::block`].
    pub block: u32,
    /// λ and q of the identifier.
    pub identifier: Tuning,
    /// λ and q of the observer.
    pub observer: Tuning,
    /// Standard deviation of a measurement (m or rad), where it is known beforehand.
    pub noise_sd: Option<f64>,
    /// Standard deviation of the acceleration that force and torque do not account for (m/s² or rad/s²), where it is known
    /// beforehand; see [`crate::EstimatorConfig::disturbance_sd`]. A change ([`ChangeRule`]) has to stand out from it.
    pub disturbance_sd: Option<f64>,
    /// How the parameters are read out.
    pub readout: Readout,
    /// How long the read-out remembers.
    pub memory: Memory,
    /// The largest relative standard deviation at which a parameter becomes valid.
    pub max_relative_sd: f64,
    /// The share of the acceleration that the model may leave unexplained; see [`crate::EstimatorConfig::max_misfit`].
    pub max_misfit: Option<f64>,
    /// ε of the parameters (s): none is valid earlier.
    pub parameter_settle: f64,
    /// ε of the states (s): none is handed out earlier.
    pub state_settle: f64,
    /// What makes a measurement one that cannot be true.
    pub guard: GuardConfig,
    /// A position, or a body angle, of larger magnitude is rejected (m or rad). Up to 1e6.
    pub measurement_limit: f64,
    /// A force or torque with a larger component is rejected (N or N m). Up to 5e5. Best what the actuators can do, no more: a
    /// wrong one within it is believed, and moves the prediction as a gust of that force would.
    pub input_limit: f64,
}

/// When a change of a parameter k (1/m, 1/I) is taken as such, and its group identified anew; so is one with a parameter that was
/// known and is contradicted. In wind, or with actuators that do not quite do what they are told, give [`GroupConfig::disturbance_sd`]
/// as well: without it what they do is taken for a change, again and again.
///
/// For a while after a change a torque or force that nobody told may have been taken for it: the standard deviation has the distance from the
/// value before in it, times h/(h + t), h being `hold_off` and 1 s at least and t the time for which the new value has been known. It ends nothing: when
/// the new value is valid, and what is predicted with, do not depend on it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ChangeRule {
    /// The smallest change of k, relative to k, to react to. 1e-3..=1e3. A smaller one goes into k̂ as more is learned, for as long as the
    /// memory lasts by more than its standard deviation.
    pub relative: f64,
    /// By how many of its standard deviations the change must show. 1..=1e3.
    pub sigmas: f64,
    /// Time (s) after a start or a re-initialisation in which nothing is decided. 0..=1e6.
    pub hold_off: f64,
}

impl Default for ChangeRule {
    /// 15 % of k, six standard deviations, 1 s.
    fn default() -> Self {
        Self { relative: 0.15, sigmas: 6.0, hold_off: 1.0 }
    }
}

impl Expected {
    /// Nothing but the least and the largest.
    pub const fn within(min: f64, max: f64) -> Self {
        Self { nominal: None, min, max }
    }

    /// Roughly `nominal`: within a tenth and ten times of it.
    pub fn about(nominal: f64) -> Self {
        Self { nominal: Some(nominal), min: 0.1 * nominal, max: 10.0 * nominal }
    }
}

impl GroupConfig {
    /// λ = 4 of the identifier as in the design's table, and `observer` as the observer's; q = λ/2. Every period measured, not
    /// late, no blocks, least squares with infinite memory, valid at 5 %.
    fn with_observer(observer: f64, max_misfit: f64, guard: GuardConfig) -> Self {
        Self {
            substeps: 1,
            latency: 0,
            block: 1,
            identifier: Tuning::from_lambda(4.0),
            observer: Tuning::from_lambda(observer),
            noise_sd: None,
            disturbance_sd: None,
            readout: Readout::LeastSquares,
            memory: Memory::Infinite,
            max_relative_sd: 0.05,
            max_misfit: Some(max_misfit),
            parameter_settle: 0.0,
            state_settle: 0.0,
            guard,
            measurement_limit: 1e5,
            input_limit: 1e5,
        }
    }
}

impl VehicleConfig {
    /// λ = 4 of both identifiers, 10 and 20 of the observers of translation and rotation; gravity 9.81 m/s², mass between 1 g
    /// and 1000 kg, moments of inertia between 1e-7 and 1000 kg m², no nominal values: set [`mass`](Self::mass) and
    /// [`inertia`](Self::inertia) to have a state from the second measurement on. No lag, no latency, no reaction to changes. The gates are the default ones, but
    /// for 200 rad/s² of an angular acceleration that the model may not know.
    pub fn new(period: f64) -> Self {
        Self {
            period,
            translation: GroupConfig::with_observer(10.0, 0.02, GuardConfig::default()),
            rotation: GroupConfig::with_observer(
                20.0,
                0.1,
                GuardConfig { acceleration: 200.0, ..GuardConfig::default() },
            ),
            gravity: 9.81,
            mass: Expected::within(1e-3, 1e3),
            inertia: [Expected::within(1e-7, 1e3); 3],
            actuator_lag: None,
            change: None,
        }
    }
}
