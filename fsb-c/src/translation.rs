//! Three axes that share one parameter: x, y, z and 1/mass.

#![allow(unsafe_op_in_unsafe_fn, reason = "every function passes its caller's contract on")]

use core::ffi::c_char;

use fsb_core::Estimator;

use crate::config::{fsb_rule_t, fsb_tuning_t};
use crate::estimator as any;
use crate::object::{Object, check_storage};
use crate::readings;
use crate::status::fsb_status_t;
use crate::values::{fsb_counters_t, fsb_diagnostics_t, fsb_parameter_t, fsb_state_sd_t, fsb_state_t};

/// sizeof(fsb_translation_t).
pub const FSB_TRANSLATION_SIZE: usize = 1232;
/// Alignment of fsb_translation_t.
pub const FSB_TRANSLATION_ALIGNMENT: usize = 8;

/// Three axes with one k: position (x, y, z) under the force (x, y, z), k = 1/mass. Storage of the caller; what
/// is in it is the library's.
#[repr(C)]
pub struct fsb_translation_t {
    /// Not to be touched. Copying the whole object is fine, and the copy goes on from there.
    opaque: [u64; 154],
}

impl Object for fsb_translation_t {
    type Value = Estimator<3, 1>;
    const KIND: u32 = 2;
}

const _: () = check_storage::<fsb_translation_t>(FSB_TRANSLATION_SIZE, FSB_TRANSLATION_ALIGNMENT);

/// Configuration of an fsb_translation_t. Start from fsb_translation_config_default.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_translation_config_t {
    /// Control period [s]: the time from one call of apply to the next. 1e-6..1e3.
    pub period: f64,
    /// Control periods from one measurement to the next, 1..65535.
    pub substeps: u32,
    /// Measurements per step of the identifier, 1..65535. More where the measurement rate is high: cheaper,
    /// and no less accurate.
    pub block: u32,
    /// Measurements by which the turns of this estimator come later, so that several on one processor do not do their
    /// rare work in the same tick: 0 for one, 4 for the next. Below `block`, or below 8 where that is more.
    pub turn: u32,
    /// FSB_READOUT_LEAST_SQUARES or FSB_READOUT_ABSOLUTE_RATIO.
    pub readout: u32,
    /// Tuning of the identifier; runs at period * substeps * block.
    pub identifier: fsb_tuning_t,
    /// Tuning of the observer; runs at period * substeps.
    pub observer: fsb_tuning_t,
    /// Standard deviation of a measurement [m] where it is known beforehand, else NaN. 1e-12..1e6.
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
    /// A measurement of larger magnitude is rejected [m]. Up to 1e6.
    pub position_limit: f64,
    /// An input of larger magnitude is rejected [N]. Up to 1e6.
    pub input_limit: f64,
    /// Known constant drift of each axis [m/s^2]: -9.81 on an axis that points up, +9.81 on one that points down
    /// (NED). Up to 1e6.
    pub drift: [f64; 3],
    /// k that the observer uses until the identified one is valid, else NaN: no state is valid before. 1e-15..1e15.
    pub nominal: f64,
    /// When k counts as valid.
    pub rule: fsb_rule_t,
}

/// The configuration for a control period [s], which is not checked here: every tick measured, no blocks, lambda
/// 2 and q 1 for the identifier, 10 and 5 for the observer, least squares that never forget, no drift, no
/// nominal k.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_translation_config_default(period: f64) -> fsb_translation_config_t {
    fsb_translation_config_t::new(period)
}

/// Starts an estimator in the caller's storage. Nothing else may be called with it before; calling it again
/// starts anew.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault
/// as it is written in the configuration ("observer.lambda"; static storage), and the object is not initialised.
/// Without a fault `*parameter` becomes NULL; `parameter` itself may be NULL. Not for the tick: exponentials in
/// double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_init(
    estimator: *mut fsb_translation_t,
    config: *const fsb_translation_config_t,
    parameter: *mut *const c_char,
) -> fsb_status_t {
    any::init(estimator, config, parameter)
}

/// Forgets everything but the configuration, what was said about learning and the counters. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
/// FSB_NOT_INITIALISED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_reset(estimator: *mut fsb_translation_t) -> fsb_status_t {
    any::reset(estimator)
}

/// Starts the identification anew, the observer going on with the nominal k. For a known change of load. Errors:
/// FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_reset_identifier(estimator: *mut fsb_translation_t) -> fsb_status_t {
    any::reset_identifier(estimator)
}

/// Starts the identification anew, what is known being held: a k that is valid goes on being handed out
/// (FSB_PARAMETER_HELD) and predicted with until the new one is valid. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
/// FSB_NOT_INITIALISED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_reinitialise_identifier(estimator: *mut fsb_translation_t) -> fsb_status_t {
    any::reinitialise_identifier(estimator)
}

/// Whether to learn from now on: FSB_LEARNING_ON, FSB_LEARNING_OFF or FSB_LEARNING_CONTACT. When learning resumes
/// the identification begins anew, what is known being held. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
/// FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_set_learning(
    estimator: *mut fsb_translation_t,
    learning: u32,
) -> fsb_status_t {
    any::set_learning(estimator, learning)
}

/// Takes the positions x, y, z [m] at the present instant; NaN where a measurement is missing. Comes before
/// apply, every `substeps` ticks. An instant at which it is not called counts as missed on its own.
///
/// The estimator starts at the first instant at which every axis is measured; what comes before only counts.
/// What is infinite or beyond the limit is rejected, counted, and treated as missing. Errors: FSB_NULL_POINTER,
/// FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_OUT_OF_STEP; nothing has changed then. For the tick: bounded work.
/// cbindgen:ptrs-as-arrays=[[position;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_measure(
    estimator: *mut fsb_translation_t,
    position: *const f32,
) -> fsb_status_t {
    any::measure(estimator, position)
}

/// Takes the forces x, y, z [N] held over the control period that begins now, once a tick. Give what the
/// actuators really do (saturated, and with their lag where it is known).
///
/// Not finite or beyond the limit: rejected, counted, and replaced by the axis's mean input of late. Nothing happens before
/// the first measurement. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED. For the tick: bounded
/// work.
/// cbindgen:ptrs-as-arrays=[[input;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_apply(estimator: *mut fsb_translation_t, input: *const f32) -> fsb_status_t {
    any::apply(estimator, input)
}

/// As fsb_translation_apply, for an input that goes linearly from `from` to `to` over the control period.
/// cbindgen:ptrs-as-arrays=[[from;3], [to;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_apply_ramp(
    estimator: *mut fsb_translation_t,
    from: *const f32,
    to: *const f32,
) -> fsb_status_t {
    any::apply_ramp(estimator, from, to)
}

/// Hands out the three states at the present control instant, predicted from the last measurement with what was
/// applied since. What is not valid is NaN and its `status` says why.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED; `state` holds NaN then, where it can be
/// written. For the tick.
/// cbindgen:ptrs-as-arrays=[[state;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_states(
    estimator: *const fsb_translation_t,
    state: *mut fsb_state_t,
) -> fsb_status_t {
    readings::states(estimator, state)
}

/// Hands out the standard deviations of the three states, as measurement noise causes it and what residuals show that the model lacks; NaN
/// until the noise is known, and after gaps among the first measurements until 8/lambda of them have come.
/// Errors as fsb_translation_states. Uses square roots: for logs, not for the tick.
/// cbindgen:ptrs-as-arrays=[[sd;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_state_sd(
    estimator: *const fsb_translation_t,
    sd: *mut fsb_state_sd_t,
) -> fsb_status_t {
    readings::state_sd(estimator, sd)
}

/// Hands out the parameter 1/mass. What is not valid is NaN and its `status` says why. Errors as
/// fsb_translation_states. For the tick; for mass or inertia in SI units and standard deviations see
/// fsb_parameter_report.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_parameters(
    estimator: *const fsb_translation_t,
    parameter: *mut fsb_parameter_t,
) -> fsb_status_t {
    readings::parameters(estimator, parameter)
}

/// Hands out what was missed or rejected. Errors as fsb_translation_states; the counters are zero then. For the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_counters(
    estimator: *const fsb_translation_t,
    counters: *mut fsb_counters_t,
) -> fsb_status_t {
    readings::counters(estimator, counters)
}

/// Hands out inner signals, for logs and tests. Errors as fsb_translation_states. Not for the tick: divisions.
/// cbindgen:ptrs-as-arrays=[[diagnostics;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_translation_diagnostics(
    estimator: *const fsb_translation_t,
    diagnostics: *mut fsb_diagnostics_t,
) -> fsb_status_t {
    readings::diagnostics(estimator, diagnostics)
}
