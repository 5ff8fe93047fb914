//! The configuration of the loop: plain data.

use crate::allocation::Allocation;
use core::fmt;
use fsb_core::control::TrackingConfig;
use fsb_core::error::ConfigError;
use fsb_core::guard::GuardConfig;
use fsb_core::{EstimatorConfig, Tuning};

/// Plain data, read once.
#[derive(Clone, Copy, Debug)]
pub struct LoopConfig {
    /// x, y, z: one parameter, 1/m.
    pub translation: EstimatorConfig<3, 1>,
    /// φ, θ, ψ: 1/Ix, 1/Iy, 1/Iz. The same period and substeps as `translation`.
    pub rotation: EstimatorConfig<3, 3>,
    /// The gate in front of the translation: what cannot be true is not used, and what is not measured for longer than `bridge` has no
    /// state.
    pub translation_guard: GuardConfig,
    /// The same of the rotation. Its `bridge` is the longest that an attitude is used for as well.
    pub rotation_guard: GuardConfig,
    /// An axis that is not measured for longer than this \[s\] is told. 0 to 65534 measurement periods. Longer than the receiver's
    /// period, where that is not the measurement period.
    pub missing_after: f64,
    /// x, y, z, φ, θ, ψ.
    pub controllers: [TrackingConfig; 6],
    /// World-frame force \[N\] and torque \[N m\] on an axis that has no state or no parameter, from the first tick on, whether anything was
    /// measured or not, and again whenever they are lost; the force along the body's axes where the attitude is not known. Of [`new`](Self::new) the weight: do not call [`tick`](crate::ControlLoop::tick) before the motors may turn.
    pub fallback: [f32; 6],
    /// The motors.
    pub allocation: Allocation,
}

impl LoopConfig {
    /// Six axes at `period` \[s\] with the roughly known `mass` \[kg\] and `inertia` \[kg m²\], gravity along -z. The translation
    /// has λ = 2 and 10 (identifier, observer), the rotation 4 and 20; blocks of ten, in which the axes take turns.
    /// Closed-loop poles at -2 (twice) on the translation and at -8 on the rotation.
    ///
    /// Gaps are bridged for a second on the translation and half of one on the rotation, and told after 20 ms. A measurement that repeats, bit by
    /// bit, for 50 ms (ten samples at least) is one of a frozen sensor: where a live one may do that, as with quanta larger than its
    /// noise, set `frozen_after` of both guards to more, or to 0.
    pub fn new(period: f64, mass: f64, inertia: [f64; 3], allocation: Allocation) -> Self {
        let mut translation = EstimatorConfig::new(period);
        translation.block = 10;
        translation.drift = [0.0, 0.0, -9.81];
        translation.nominal = [Some(1.0 / mass)];
        let mut rotation = EstimatorConfig::new(period);
        rotation.block = 10;
        rotation.turn = 4;
        rotation.identifier = Tuning::from_lambda(4.0);
        rotation.observer = Tuning::from_lambda(20.0);
        rotation.nominal = inertia.map(|i| Some(1.0 / i));
        let frozen_after = libm::fmax(libm::round(0.05 / period), 10.0) as u32;
        let guard = GuardConfig { bridge: 1.0, frozen_after, ..GuardConfig::default() };
        let axis = |pole: f64, drift: f64| TrackingConfig {
            kp: pole * pole,
            kd: 2.0 * pole,
            drift,
            parameter_min: 1e-3,
            parameter_max: 1e4,
        };
        Self {
            translation,
            rotation,
            translation_guard: guard,
            rotation_guard: GuardConfig { acceleration: 200.0, bridge: 0.5, ..guard },
            missing_after: 0.02,
            controllers: [
                axis(2.0, 0.0),
                axis(2.0, 0.0),
                axis(2.0, -9.81),
                axis(8.0, 0.0),
                axis(8.0, 0.0),
                axis(8.0, 0.0),
            ],
            fallback: [0.0, 0.0, (9.81 * mass) as f32, 0.0, 0.0, 0.0],
            allocation,
        }
    }
}

/// A loop was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LoopConfigError {
    /// The estimator of the translation.
    Translation(ConfigError),
    /// The estimator of the rotation.
    Rotation(ConfigError),
    /// The controller of this axis.
    Controller(usize, ConfigError),
    /// The two estimators have different periods or substeps.
    PeriodsDiffer,
    /// A fallback input is not finite.
    Fallback,
    /// `missing_after` is out of range.
    MissingAfter,
}

impl fmt::Display for LoopConfigError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Translation(error) => write!(out, "translation: {error}"),
            Self::Rotation(error) => write!(out, "rotation: {error}"),
            Self::Controller(axis, error) => write!(out, "controller of axis {axis}: {error}"),
            Self::PeriodsDiffer => out.write_str("translation and rotation differ in period or substeps"),
            Self::Fallback => out.write_str("a fallback input is not finite"),
            Self::MissingAfter => out.write_str("missing_after is out of range"),
        }
    }
}

impl core::error::Error for LoopConfigError {}
