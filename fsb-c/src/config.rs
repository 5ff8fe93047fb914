//! What the configurations have in common, and the names of their parameters.

use core::ffi::CStr;

use fsb_core::readout::{Memory, ParameterRule, Readout};
use fsb_core::{ConfigError, EstimatorConfig, Tuning};

use crate::axis::fsb_axis_config_t;
use crate::rotation::fsb_rotation_config_t;
use crate::status::{FSB_CONFIG_OUT_OF_RANGE, fsb_status_t, of_config};
use crate::translation::fsb_translation_config_t;

/// k = sum(z2 z0) / sum(z0^2): keeps the sign of k, close to the best possible. The default.
pub const FSB_READOUT_LEAST_SQUARES: u32 = 0;
/// k = sum|z2| / sum|z0|, the paper's (44): loses the sign, reads too high where the excitation is weak.
pub const FSB_READOUT_ABSOLUTE_RATIO: u32 = 1;

/// In flight: k is identified, and the states are predicted with it. The default.
pub const FSB_LEARNING_ON: u32 = 0;
/// k stays as it is, and the states are predicted with it.
pub const FSB_LEARNING_OFF: u32 = 1;
/// On the ground or held: forces act that nobody knows. k stays as it is, and the states are predicted with
/// constant velocity.
pub const FSB_LEARNING_CONTACT: u32 = 2;

/// The paper's lambda and q [1/s]. Each, times the period it runs at, must be within 1e-6..1; q = lambda/2 is
/// the paper's choice.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_tuning_t {
    /// Cut-off of the filters [1/s].
    pub lambda: f64,
    /// Frequency shift: how fast the window opens [1/s].
    pub q: f64,
}

/// When a parameter counts as valid.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_rule_t {
    /// The smallest k that can be right; positive.
    pub min: f64,
    /// The largest k that can be right.
    pub max: f64,
    /// The largest sd(k)/k at which k becomes valid; it stays valid up to twice that.
    pub max_relative_sd: f64,
}

/// A refused configuration: the code, and the name of the parameter as it is written in C.
pub(crate) type Refusal = (fsb_status_t, &'static CStr);

pub(crate) fn refusal(error: ConfigError) -> Refusal {
    (of_config(error), c_name(error.parameter()))
}

/// The core's name of a parameter, as C text and as the field is called in the C structures.
fn c_name(name: &str) -> &'static CStr {
    match name {
        "period" => c"period",
        "substeps" => c"substeps",
        "block" => c"block",
        "turn" => c"turn",
        "identifier.lambda" => c"identifier.lambda",
        "identifier.q" => c"identifier.q",
        "observer.lambda" => c"observer.lambda",
        "observer.q" => c"observer.q",
        "noise_sd" => c"noise_sd",
        "memory.tau" => c"memory_tau",
        "drift" => c"drift",
        "nominal" => c"nominal",
        "rule.min" => c"rule.min",
        "rule.max" => c"rule.max",
        "rule.max_relative_sd" => c"rule.max_relative_sd",
        "max_misfit" => c"max_misfit",
        "parameter_settle" => c"parameter_settle",
        "state_settle" => c"state_settle",
        "position_limit" => c"position_limit",
        "input_limit" => c"input_limit",
        "kp" => c"kp",
        "kd" => c"kd",
        "parameter_min" => c"k_min",
        "parameter_max" => c"k_max",
        _ => c"configuration",
    }
}

/// A field of the C structure: one number for one axis, an array for three.
trait Lanes<T, const N: usize> {
    fn to_array(self) -> [T; N];
    fn from_array(array: [T; N]) -> Self;
}

impl<T> Lanes<T, 1> for T {
    fn to_array(self) -> [T; 1] {
        [self]
    }
    fn from_array([one]: [T; 1]) -> Self {
        one
    }
}

impl<T> Lanes<T, 3> for [T; 3] {
    fn to_array(self) -> [T; 3] {
        self
    }
    fn from_array(array: [T; 3]) -> Self {
        array
    }
}

macro_rules! conversions {
    ($config:ident, $axes:literal, $parameters:literal) => {
        impl $config {
            pub(crate) fn new(period: f64) -> Self {
                let of = EstimatorConfig::<$axes, $parameters>::new(period);
                Self {
                    period: of.period,
                    substeps: of.substeps,
                    block: of.block,
                    turn: of.turn,
                    readout: match of.readout {
                        Readout::AbsoluteRatio => FSB_READOUT_ABSOLUTE_RATIO,
                        _ => FSB_READOUT_LEAST_SQUARES,
                    },
                    identifier: of.identifier.into(),
                    observer: of.observer.into(),
                    noise_sd: of.noise_sd.unwrap_or(f64::NAN),
                    memory_tau: match of.memory {
                        Memory::Fading { tau } => tau,
                        _ => f64::INFINITY,
                    },
                    max_misfit: of.max_misfit.unwrap_or(f64::NAN),
                    parameter_settle: of.parameter_settle,
                    state_settle: of.state_settle,
                    position_limit: of.position_limit,
                    input_limit: of.input_limit,
                    drift: Lanes::<f64, $axes>::from_array(of.drift),
                    nominal: Lanes::<f64, $parameters>::from_array(of.nominal.map(|k| k.unwrap_or(f64::NAN))),
                    rule: Lanes::<fsb_rule_t, $parameters>::from_array(of.rule.map(fsb_rule_t::from)),
                }
            }

            pub(crate) fn to_core(self) -> Result<EstimatorConfig<$axes, $parameters>, Refusal> {
                let readout = match self.readout {
                    FSB_READOUT_LEAST_SQUARES => Readout::LeastSquares,
                    FSB_READOUT_ABSOLUTE_RATIO => Readout::AbsoluteRatio,
                    _ => return Err((FSB_CONFIG_OUT_OF_RANGE, c"readout")),
                };
                let tau = self.memory_tau;
                let memory = if tau == f64::INFINITY { Memory::Infinite } else { Memory::Fading { tau } };
                Ok(EstimatorConfig {
                    period: self.period,
                    substeps: self.substeps,
                    block: self.block,
                    turn: self.turn,
                    identifier: self.identifier.into(),
                    observer: self.observer.into(),
                    noise_sd: known(self.noise_sd),
                    readout,
                    memory,
                    drift: Lanes::<f64, $axes>::to_array(self.drift),
                    nominal: Lanes::<f64, $parameters>::to_array(self.nominal).map(known),
                    rule: Lanes::<fsb_rule_t, $parameters>::to_array(self.rule).map(ParameterRule::from),
                    max_misfit: known(self.max_misfit),
                    parameter_settle: self.parameter_settle,
                    state_settle: self.state_settle,
                    position_limit: self.position_limit,
                    input_limit: self.input_limit,
                })
            }
        }
    };
}

conversions!(fsb_axis_config_t, 1, 1);
conversions!(fsb_translation_config_t, 3, 1);
conversions!(fsb_rotation_config_t, 3, 3);

/// NaN stands for a value that is not known.
pub(crate) fn known(value: f64) -> Option<f64> {
    if value.is_nan() { None } else { Some(value) }
}

impl From<Tuning> for fsb_tuning_t {
    fn from(Tuning { lambda, q }: Tuning) -> Self {
        Self { lambda, q }
    }
}

impl From<fsb_tuning_t> for Tuning {
    fn from(fsb_tuning_t { lambda, q }: fsb_tuning_t) -> Self {
        Self { lambda, q }
    }
}

impl From<ParameterRule> for fsb_rule_t {
    fn from(ParameterRule { min, max, max_relative_sd }: ParameterRule) -> Self {
        Self { min, max, max_relative_sd }
    }
}

impl From<fsb_rule_t> for ParameterRule {
    fn from(fsb_rule_t { min, max, max_relative_sd }: fsb_rule_t) -> Self {
        Self { min, max, max_relative_sd }
    }
}
