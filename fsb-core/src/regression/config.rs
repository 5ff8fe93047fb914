//! The configuration of a [`super::DragEstimator`]: plain data.

use crate::readout::{Memory, ParameterRule};
use crate::tuning::Tuning;

/// What is identified on an axis besides k, which always is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Identify {
    /// D, the linear drag.
    pub drag: bool,
    /// d, the constant disturbance: wind, trim, a known drift that is not quite right.
    pub disturbance: bool,
}

impl Identify {
    /// k alone.
    pub const NOTHING_ELSE: Self = Self { drag: false, disturbance: false };
    /// k, D and d.
    pub const BOTH: Self = Self { drag: true, disturbance: true };
}

/// Plain data; [`super::DragEstimator::new`] validates it. Read once, hence f64.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DragConfig<const N: usize> {
    /// Control period (s): the time from one input to the next. 1e-6..=1e3.
    pub period: f64,
    /// Control periods from one measurement to the next, 1..=65535. The measurement period is `T = substeps * period`.
    pub substeps: u32,
    /// λ and q of the identifier; λT and qT within 1e-6..=1.
    pub identifier: Tuning,
    /// λ and q of the observer; the same.
    pub observer: Tuning,
    /// What is identified on each axis besides k.
    pub identify: [Identify; N],
    /// How long the regression remembers.
    pub memory: Memory,
    /// Known constant drift c of each axis (m/s²), -g on a vertical axis that points up. Magnitude up to 1e6.
    pub drift: [f64; N],
    /// k0, used by the observer until k̂ is valid. `None`: no state is handed out before.
    pub nominal: Option<f64>,
    /// When k̂ counts as valid.
    pub rule: ParameterRule,
    /// The rms acceleration (m/s²) by which k f must have varied, beyond what a constant and the axis's velocity explain,
    /// for D and d of the axis to be told from k. Below it they count as zero; once used they stay so down to two thirds.
    pub excitation: f64,
    /// The largest sd of D (1/s) at which it is used. It stays used up to twice that.
    pub drag_sd_limit: f64,
    /// The largest sd of d (m/s²) at which it is used. It stays used up to twice that.
    pub disturbance_sd_limit: f64,
    /// How far from zero D may be where it is asked for and not told (1/s): a standard deviation, which enters those of k and of
    /// the other terms. Up to 1e6; 0 where there is none.
    pub drag_prior_sd: f64,
    /// The same of d (m/s²). Without excitation sd(k̂) comes to this over the known drift: 2 % in hover with the default of 0.2.
    pub disturbance_prior_sd: f64,
    /// Standard deviation of the acceleration that comes and goes (m/s²), about what D and d explain, on any axis: gusts, actuators that
    /// do not quite do what they are told. It counts in the standard deviations of k, D and d from the first row on, as an acceleration
    /// that is correlated over 1/λ of the identifier: sd(d) is about g √(2/(λt)) after a time t, and that of k the same over the rms of
    /// k f that the other terms do not explain. A controller answers gusts, and the velocity goes with them; what that pulls k and D by, at the
    /// worst (3/8 g² over the square of that rms, relative to k; g²/λ over the velocity's), counts as well, and time does not make it less.
    /// `None`: only what the residuals show of it counts, in which what is slow is missing. 1e-12..=1e6.
    pub disturbance_sd: Option<f64>,
    /// ε of the parameter (s): k̂, and with it D and d, is not valid earlier.
    pub parameter_settle: f64,
    /// ε of the state (s): position and velocity are not handed out earlier.
    pub state_settle: f64,
    /// A measurement of larger magnitude is rejected (m). Up to 1e6.
    pub position_limit: f64,
    /// An input of larger magnitude is rejected (N). Up to 1e6.
    pub input_limit: f64,
}

impl<const N: usize> DragConfig<N> {
    /// Every sample measured, λ = 2, q = 1 for the identifier, λ = 10, q = 5 for the observer, D and d on every axis,
    /// infinite memory, no drift, no nominal parameter, ε = 0.
    pub fn new(period: f64) -> Self {
        Self {
            period,
            substeps: 1,
            identifier: Tuning::from_lambda(2.0),
            observer: Tuning::from_lambda(10.0),
            identify: [Identify::BOTH; N],
            memory: Memory::Infinite,
            drift: [0.0; N],
            nominal: None,
            rule: ParameterRule::default(),
            excitation: 0.03,
            drag_sd_limit: 0.25,
            disturbance_sd_limit: 0.2,
            drag_prior_sd: 0.25,
            disturbance_prior_sd: 0.2,
            disturbance_sd: None,
            parameter_settle: 0.0,
            state_settle: 0.0,
            position_limit: 1e5,
            input_limit: 1e5,
        }
    }
}
