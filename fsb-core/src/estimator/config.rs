//! The configuration of an [`super::Estimator`]: plain data.

use crate::readout::{Memory, ParameterRule, Readout};
use crate::tuning::Tuning;

/// Plain data; [`super::EstimatorDesign::new`] validates it. Read once, hence f64.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EstimatorConfig<const N: usize, const P: usize> {
    /// Control period (s): the time from one input to the next. 1e-6..=1e3.
    pub period: f64,
    /// Control periods from one measurement to the next, 1..=65535. The measurement period is `T = substeps * period`.
    pub substeps: u32,
    /// M, measurements per step of the identifier, 1..=65535. More than one where the measurement rate is high
    /// (λT below about 1e-3): cheaper, and no less accurate. The axes take turns within the block.
    pub block: u32,
    /// Measurements by which the identifier starts later than the observer, so that several estimators on one processor do
    /// not complete their blocks in the same tick: 0 for one, N + 1 for the other. Below `block`, or below 8.
    pub turn: u32,
    /// λ and q of the identifier.
    pub identifier: Tuning,
    /// λ and q of the observer.
    pub observer: Tuning,
    /// Standard deviation of a measurement (m or rad), where it is known beforehand. It is used until enough samples have
    /// been seen to learn it; without it k̂ is not valid in the first 0.75/λ or so. 1e-12..=1e6.
    pub noise_sd: Option<f64>,
    /// Standard deviation of the acceleration that neither the input nor the drift is the cause of (m/s² or rad/s²), of any axis: wind,
    /// drag, actuators that do not quite do what they are told. It counts in the variance of k̂ from the first sample on, as an
    /// acceleration that is correlated over 1/λ of the identifier: after a time t of accelerations of rms A sd(k)/k is
    /// (d/A) √(2/(λt)) to a fifth from t = 20/λ on, and up to twice that before. Position noise that wanders by w within 1/λ
    /// (GNSS, SLAM, what another filter puts out) is such an acceleration, of λ² w. One that stays is a `drift`, or for
    /// [`crate::regression::DragEstimator`]. `None`: only what the residuals show of it counts, which the first k̂ is ahead of.
    /// [`Readout::AbsoluteRatio`] takes no account of it. 1e-12..=1e6.
    pub disturbance_sd: Option<f64>,
    /// How k is read out.
    pub readout: Readout,
    /// How long the read-out remembers.
    pub memory: Memory,
    /// Known constant drift c of each axis (m/s² or rad/s²), -g on a vertical axis that points up. Magnitude up to 1e6.
    pub drift: [f64; N],
    /// k0 of each parameter, used by the observer until k̂ is valid. `None`: no state is handed out before.
    /// 1e-15..=1e15.
    pub nominal: [Option<f64>; P],
    /// When k̂ of each parameter counts as valid.
    pub rule: [ParameterRule; P],
    /// The largest share of the filtered acceleration's mean square that `k f + c` may leave unexplained, beyond noise, before
    /// the parameter is contradicted (thrust on the ground, a motor that does not obey) and no longer valid. Above 0, up to
    /// 1; `None`: not asked.
    pub max_misfit: Option<f64>,
    /// ε of the parameter (s): k̂ is not valid earlier. 0 to 1e9 measurement periods.
    pub parameter_settle: f64,
    /// ε of the state (s): position and velocity are not handed out earlier. 0 to 1e9 measurement periods.
    pub state_settle: f64,
    /// A measurement of larger magnitude is rejected (m or rad). Up to 1e6.
    pub position_limit: f64,
    /// An input of larger magnitude is rejected (N or N m). Up to 1e6.
    pub input_limit: f64,
}

/// The part of an [`EstimatorConfig`] that does not depend on the number of axes, in numbers alone: as it may stand in a table
/// of parameters, or in a structure of C.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct SharedConfig {
    /// See [`EstimatorConfig::period`].
    pub period: f64,
    /// See [`EstimatorConfig::substeps`].
    pub substeps: u32,
    /// See [`EstimatorConfig::block`].
    pub block: u32,
    /// See [`EstimatorConfig::turn`].
    pub turn: u32,
    /// 0 for [`Readout::LeastSquares`], 1 for [`Readout::AbsoluteRatio`].
    pub readout: u32,
    /// See [`EstimatorConfig::identifier`].
    pub identifier: Tuning,
    /// See [`EstimatorConfig::observer`].
    pub observer: Tuning,
    /// See [`EstimatorConfig::noise_sd`]; NaN where it is not known.
    pub noise_sd: f64,
    /// See [`EstimatorConfig::disturbance_sd`]; NaN where it is not known.
    pub disturbance_sd: f64,
    /// τ of [`Memory::Fading`] (s); infinite for [`Memory::Infinite`].
    pub memory_tau: f64,
    /// See [`EstimatorConfig::max_misfit`]; NaN where it is not asked.
    pub max_misfit: f64,
    /// See [`EstimatorConfig::parameter_settle`].
    pub parameter_settle: f64,
    /// See [`EstimatorConfig::state_settle`].
    pub state_settle: f64,
    /// See [`EstimatorConfig::position_limit`].
    pub position_limit: f64,
    /// See [`EstimatorConfig::input_limit`].
    pub input_limit: f64,
}

/// NaN for a value that is not known; one that is NaN itself becomes infinite, which is refused like it.
pub(super) const fn or_nan(value: Option<f64>) -> f64 {
    match value {
        None => f64::NAN,
        Some(value) => {
            if value.is_nan() {
                f64::INFINITY
            } else {
                value
            }
        }
    }
}

impl<const N: usize, const P: usize> EstimatorConfig<N, P> {
    /// What does not depend on the number of axes.
    pub const fn shared(&self) -> SharedConfig {
        SharedConfig {
            period: self.period,
            substeps: self.substeps,
            block: self.block,
            turn: self.turn,
            readout: match self.readout {
                Readout::LeastSquares => 0,
                Readout::AbsoluteRatio => 1,
            },
            identifier: self.identifier,
            observer: self.observer,
            noise_sd: or_nan(self.noise_sd),
            disturbance_sd: or_nan(self.disturbance_sd),
            memory_tau: match self.memory {
                Memory::Infinite => f64::INFINITY,
                // An infinite τ is refused, as any that is not finite.
                Memory::Fading { tau } => {
                    if tau == f64::INFINITY {
                        f64::NAN
                    } else {
                        tau
                    }
                }
            },
            max_misfit: or_nan(self.max_misfit),
            parameter_settle: self.parameter_settle,
            state_settle: self.state_settle,
            position_limit: self.position_limit,
            input_limit: self.input_limit,
        }
    }

    /// Every sample measured, no blocks, λ = 2, q = 1 for the identifier, λ = 10, q = 5 for the observer, least squares with
    /// infinite memory, no drift, no nominal parameter, ε = 0.
    pub const fn new(period: f64) -> Self {
        Self {
            period,
            substeps: 1,
            block: 1,
            turn: 0,
            identifier: Tuning::from_lambda(2.0),
            observer: Tuning::from_lambda(10.0),
            noise_sd: None,
            disturbance_sd: None,
            readout: Readout::LeastSquares,
            memory: Memory::Infinite,
            drift: [0.0; N],
            nominal: [None; P],
            rule: [ParameterRule::DEFAULT; P],
            max_misfit: Some(0.02),
            parameter_settle: 0.0,
            state_settle: 0.0,
            position_limit: 1e5,
            input_limit: 1e5,
        }
    }
}
