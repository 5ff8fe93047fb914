//! One axis, one parameter.

#![allow(unsafe_op_in_unsafe_fn, reason = "every function passes its caller's contract on")]

use core::ffi::c_char;

use fsb_core::Estimator;

use crate::config::{fsb_rule_t, fsb_tuning_t};
use crate::estimator as any;
use crate::object::{Object, check_storage};
use crate::readings;
use crate::status::fsb_status_t;
use crate::values::{fsb_counters_t, fsb_diagnostics_t, fsb_parameter_t, fsb_state_sd_t, fsb_state_t};

/// sizeof(fsb_axis_t).
pub const FSB_AXIS_SIZE: usize = 840;
/// Alignment of fsb_axis_t.
pub const FSB_AXIS_ALIGNMENT: usize = 8;

/// One axis: y'' = k f + drift. Storage of the caller; what is in it is the library's.
#[repr(C)]
pub struct fsb_axis_t {
    /// Not to be touched. Copying the whole object is fine, and the copy goes on from there.
    opaque: [u64; 105],
}

impl Object for fsb_axis_t {
    type Value = Estimator<1, 1>;
    const KIND: u32 = 1;
}

const _: () = check_storage::<fsb_axis_t>(FSB_AXIS_SIZE, FSB_AXIS_ALIGNMENT);

/// Configuration of an fsb_axis_t. Start from fsb_axis_config_default.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_axis_config_t {
    /// Control period [s]: the time from one call of apply to the next. 1e-6..1e3.
    pub period: f64,
    /// Control periods from one measurement to the next, 1..65535.
    pub substeps: u32,
    /// Measurements per step of the identifier, 1..65535. More where the measurement rate is high: cheaper,
    /// and no less accurate.
    pub block: u32,
    /// Measurements by which the turns of this estimator come later, so that several on one processor do not do their
    /// rare work in the same tick: 0 for one, 2 for the next. Below `block`, or below 8 where that is more.
    pub turn: u32,
    /// FSB_READOUT_LEAST_SQUARES or FSB_READOUT_ABSOLUTE_RATIO.
    pub readout: u32,
    /// Tuning of the identifier; runs at period * substeps * block.
    pub identifier: fsb_tuning_t,
    /// Tuning of the observer; runs at period * substeps.
    pub observer: fsb_tuning_t,
    /// Standard deviation of a measurement [m or rad] where it is known beforehand, else NaN. 1e-12..1e6.
    pub noise_sd: f64,
    /// Standard deviation of the acceleration that is not accounted for [m/s^2 or rad/s^2], such as wind, where it is
    /// known beforehand, else NaN; noise of the position that wanders by w within 1/lambda of the identifier is one of
    /// lambda^2 w. 1e-12..1e6.
    pub disturbance_sd: f64,
    /// Time constant [s] with which the identifier forgets, at least one of its steps; INFINITY: never.
    pub memory_tau: f64,
    /// The largest share of the filtered acceleration's mean square that the model may leave unexplained before k
    /// is contradicted; above 0, up to 1. NaN: not asked.
    pub max_misfit: f64,
    /// k is not valid earlier than this after a reset [s]. 0 to 1e9 measurements.
    pub parameter_settle: f64,
    /// States are not valid earlier than this after the first measurement [s]. 0 to 1e9 measurements.
    pub state_settle: f64,
    /// A measurement of larger magnitude is rejected [m or rad]. Up to 1e6.
    pub position_limit: f64,
    /// An input of larger magnitude is rejected [N or N m]. Up to 1e6.
    pub input_limit: f64,
    /// Known constant drift [m/s^2 or rad/s^2]: -9.81 on an axis that points up, +9.81 on one that points down
    /// (NED). Up to 1e6.
    pub drift: f64,
    /// k that the observer uses until the identified one is valid, else NaN: no state is valid before. 1e-15..1e15.
    pub nominal: f64,
    /// When k counts as valid.
    pub rule: fsb_rule_t,
}

/// The configuration for a control period [s], which is not checked here: every tick measured, no blocks, lambda
/// 2 and q 1 for the identifier, 10 and 5 for the observer, least squares that never forget, no drift, no
/// nominal k.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_axis_config_default(period: f64) -> fsb_axis_config_t {
    fsb_axis_config_t::new(period)
}

/// Starts an estimator in the caller's storage. Nothing else may be called with it before; calling it again
/// starts anew.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault
/// as it is written in the configuration ("observer.lambda"; static storage), and the object is not initialised.
/// Without a fault `*parameter` becomes NULL; `parameter` itself may be NULL. Not for the tick: exponentials in
/// double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_init(
    estimator: *mut fsb_axis_t,
    config: *const fsb_axis_config_t,
    parameter: *mut *const c_char,
) -> fsb_status_t {
    any::init(estimator, config, parameter)
}

/// Forgets everything but the configuration, what was said about learning and the counters. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
/// FSB_NOT_INITIALISED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_reset(estimator: *mut fsb_axis_t) -> fsb_status_t {
    any::reset(estimator)
}

/// Starts the identification anew, the observer going on with the nominal k. For a known change of load. Errors:
/// FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_reset_identifier(estimator: *mut fsb_axis_t) -> fsb_status_t {
    any::reset_identifier(estimator)
}

/// Starts the identification anew, what is known being held: a k that is valid goes on being handed out
/// (FSB_PARAMETER_HELD) and predicted with until the new one is valid. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
/// FSB_NOT_INITIALISED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_reinitialise_identifier(estimator: *mut fsb_axis_t) -> fsb_status_t {
    any::reinitialise_identifier(estimator)
}

/// Whether to learn from now on: FSB_LEARNING_ON, FSB_LEARNING_OFF or FSB_LEARNING_CONTACT. When learning resumes
/// the identification begins anew, what is known being held. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
/// FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_set_learning(estimator: *mut fsb_axis_t, learning: u32) -> fsb_status_t {
    any::set_learning(estimator, learning)
}

/// Takes the position [m or rad] at the present instant; NaN where the measurement is missing. Comes before
/// apply, every `substeps` ticks. An instant at which it is not called counts as missed on its own.
///
/// What is infinite or beyond the limit is rejected, counted, and treated as missing. Errors: FSB_NULL_POINTER,
/// FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_OUT_OF_STEP; nothing has changed then. For the tick: bounded work.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_measure(estimator: *mut fsb_axis_t, position: *const f32) -> fsb_status_t {
    any::measure(estimator, position)
}

/// Takes the input [N or N m] held over the control period that begins now, once a tick. Give what the actuators
/// really do (saturated, and with their lag where it is known).
///
/// Not finite or beyond the limit: rejected, counted, and replaced by the axis's mean input of late. Nothing happens before
/// the first measurement. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED. For the tick: bounded
/// work.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_apply(estimator: *mut fsb_axis_t, input: *const f32) -> fsb_status_t {
    any::apply(estimator, input)
}

/// As fsb_axis_apply, for an input that goes linearly from `from` to `to` over the control period.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_apply_ramp(
    estimator: *mut fsb_axis_t,
    from: *const f32,
    to: *const f32,
) -> fsb_status_t {
    any::apply_ramp(estimator, from, to)
}

/// Hands out the state at the present control instant, predicted from the last measurement with what was applied
/// since. What is not valid is NaN and its `status` says why.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED; `state` holds NaN then, where it can be
/// written. For the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_state(estimator: *const fsb_axis_t, state: *mut fsb_state_t) -> fsb_status_t {
    readings::states(estimator, state)
}

/// Hands out the standard deviations of the state, as measurement noise causes it and what residuals show that the model lacks; NaN
/// until the noise is known, and after gaps among the first measurements until 8/lambda of them have come.
/// Errors as fsb_axis_state. Uses square roots: for logs, not for the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_state_sd(estimator: *const fsb_axis_t, sd: *mut fsb_state_sd_t) -> fsb_status_t {
    readings::state_sd(estimator, sd)
}

/// Hands out the parameter. What is not valid is NaN and its `status` says why. Errors as fsb_axis_state. For
/// the tick; for mass or inertia in SI units and standard deviations see fsb_parameter_report.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_parameter(
    estimator: *const fsb_axis_t,
    parameter: *mut fsb_parameter_t,
) -> fsb_status_t {
    readings::parameters(estimator, parameter)
}

/// Hands out what was missed or rejected. Errors as fsb_axis_state; the counters are zero then. For the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_counters(
    estimator: *const fsb_axis_t,
    counters: *mut fsb_counters_t,
) -> fsb_status_t {
    readings::counters(estimator, counters)
}

/// Hands out inner signals, for logs and tests. Errors as fsb_axis_state. Not for the tick: divisions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_axis_diagnostics(
    estimator: *const fsb_axis_t,
    diagnostics: *mut fsb_diagnostics_t,
) -> fsb_status_t {
    readings::diagnostics(estimator, diagnostics)
}
