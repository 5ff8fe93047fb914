//! What goes in and out.

#![allow(unsafe_op_in_unsafe_fn, reason = "every function passes its caller's contract on")]

use core::ffi::c_char;

use fsb_core::estimator::{AxisDiagnostics, AxisState, Counters, StateStatus};
use fsb_core::readout::{Parameter, ParameterStatus};

use crate::names;
use crate::object::{borrow, give};
use crate::status::{FSB_NOT_VALID, fsb_status_t};

/// Whether a position and a velocity may be used, and why not. Usable is whatever is FSB_STATE_NOMINAL or more.
pub type fsb_state_status_t = i32;

/// Not usable: nothing could be read from the object.
pub const FSB_STATE_UNKNOWN: i32 = 0;
/// Not usable: this axis has not been measured yet.
pub const FSB_STATE_NOT_MEASURED: i32 = 1;
/// Not usable: less than the configured time has passed since the first measurement.
pub const FSB_STATE_SETTLING: i32 = 2;
/// Not usable: no k to predict with, as k is not valid and no nominal k was configured.
pub const FSB_STATE_NO_PARAMETER: i32 = 3;
/// Not usable: not measured for longer than is bridged by prediction (fsb_vehicle_t).
pub const FSB_STATE_STALE: i32 = 4;
/// Usable, predicted with the nominal k.
pub const FSB_STATE_NOMINAL: i32 = 8;
/// Usable, predicted with the identified k.
pub const FSB_STATE_IDENTIFIED: i32 = 9;
/// Usable, predicted with the k from before the identification began anew.
pub const FSB_STATE_HELD: i32 = 10;

/// Whether a parameter may be used, and why not. Usable is whatever is FSB_PARAMETER_VALID or more.
pub type fsb_parameter_status_t = i32;

/// Not usable: nothing could be read from the object.
pub const FSB_PARAMETER_UNKNOWN: i32 = 0;
/// Not usable: less than the configured time has passed since the last reset.
pub const FSB_PARAMETER_SETTLING: i32 = 1;
/// Not usable: the input has been zero, nothing can be said.
pub const FSB_PARAMETER_UNEXCITED: i32 = 2;
/// Not usable: the standard deviation is above the configured share of k.
pub const FSB_PARAMETER_UNCERTAIN: i32 = 3;
/// Not usable: k is below the configured range.
pub const FSB_PARAMETER_BELOW: i32 = 4;
/// Not usable: k is above the configured range.
pub const FSB_PARAMETER_ABOVE: i32 = 5;
/// Not usable: the motion contradicts the model, as on the ground or with a motor that does not obey.
pub const FSB_PARAMETER_CONTRADICTED: i32 = 6;
/// Not usable: the sums are no numbers, the object's memory has been changed from outside. Reset it.
pub const FSB_PARAMETER_FAULTED: i32 = 7;
/// Usable.
pub const FSB_PARAMETER_VALID: i32 = 8;
/// Usable: the k from before the identification began anew, until the new one is valid.
pub const FSB_PARAMETER_HELD: i32 = 9;

/// Position and velocity of an axis at the present control instant. Both are NaN where `status` says that they
/// may not be used.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_state_t {
    /// Position [m] or angle [rad], in the frame of the measurement.
    pub position: f32,
    /// Velocity [m/s] or rate [rad/s].
    pub velocity: f32,
    /// Whether the two may be used, and why not.
    pub status: fsb_state_status_t,
}

/// k, which is 1/mass [1/kg] or 1/inertia [1/(kg m^2)]. `k` and `variance` are NaN where `status` says
/// that they may not be used.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_parameter_t {
    /// Identified k.
    pub k: f32,
    /// Variance of k.
    pub variance: f32,
    /// Whether k may be used, and why not.
    pub status: fsb_parameter_status_t,
}

/// A parameter in the units of an engineer. All NaN where the parameter is not valid.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_parameter_report_t {
    /// Standard deviation of k.
    pub k_sd: f32,
    /// 1/k: mass [kg] or inertia [kg m^2].
    pub inverse: f32,
    /// Standard deviation of 1/k.
    pub inverse_sd: f32,
}

/// Standard deviations of a state, as measurement noise causes it and what residuals show that the model lacks; NaN until the noise
/// is known, and after gaps among the first measurements until 8/lambda of them (of the observer) have come.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_state_sd_t {
    /// Of the position [m or rad].
    pub position: f32,
    /// Of the velocity [m/s or rad/s].
    pub velocity: f32,
}

/// Events since the initialisation, a reset does not clear them. They stop at the largest number.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_counters_t {
    /// Measurements that did not come or were rejected, over all axes.
    pub missed: u32,
    /// Measurements that were infinite or beyond the limit.
    pub rejected_measurements: u32,
    /// Inputs that were not finite or beyond the limit; the axis's mean input of late was used in their place.
    pub rejected_inputs: u32,
}

/// Inner signals of an axis in physical units: for logs and tests, not for control. Not checked for validity.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_diagnostics_t {
    /// Windowed, filtered acceleration, known drift removed [m/s^2 or rad/s^2].
    pub z2: f32,
    /// Windowed, filtered input [N or N m].
    pub z0: f32,
    /// Windowed, filtered one.
    pub zu: f32,
    /// Innovation of the observer at the last measurement [m or rad].
    pub innovation: f32,
    /// Variance of the measurement noise as learned so far, from sample to sample [m^2 or rad^2].
    pub noise_variance: f32,
    /// The same, in the band of the identifier.
    pub noise_variance_in_band: f32,
    /// Sum over the weighted z2 of the axis's parameter, scaled.
    pub numerator: f32,
    /// Sum over the weighted z0, scaled alike: the quotient of the two is the newest k, valid or not.
    pub denominator: f32,
}

impl fsb_state_t {
    pub(crate) const INVALID: Self = Self { position: f32::NAN, velocity: f32::NAN, status: FSB_STATE_UNKNOWN };

    pub(crate) fn new(status: StateStatus, state: Option<AxisState>) -> Self {
        let status = state_code(status);
        match state {
            Some(state) => Self { position: state.position, velocity: state.velocity, status },
            None => Self { status, ..Self::INVALID },
        }
    }
}

/// The code of a state's status.
pub(crate) fn state_code(status: StateStatus) -> fsb_state_status_t {
    match status {
        StateStatus::NotMeasured => FSB_STATE_NOT_MEASURED,
        StateStatus::Settling => FSB_STATE_SETTLING,
        StateStatus::NoParameter => FSB_STATE_NO_PARAMETER,
        StateStatus::Stale => FSB_STATE_STALE,
        StateStatus::Nominal => FSB_STATE_NOMINAL,
        StateStatus::Identified => FSB_STATE_IDENTIFIED,
        StateStatus::Held => FSB_STATE_HELD,
        _ => FSB_STATE_UNKNOWN,
    }
}

impl fsb_parameter_t {
    pub(crate) const INVALID: Self = Self { k: f32::NAN, variance: f32::NAN, status: FSB_PARAMETER_UNKNOWN };

    pub(crate) fn new(status: ParameterStatus, parameter: Option<Parameter>) -> Self {
        let status = parameter_code(status);
        match parameter {
            Some(Parameter { value: k, variance }) => Self { k, variance, status },
            None => Self { status, ..Self::INVALID },
        }
    }
}

/// The code of a parameter's status.
pub(crate) fn parameter_code(status: ParameterStatus) -> fsb_parameter_status_t {
    match status {
        ParameterStatus::Settling => FSB_PARAMETER_SETTLING,
        ParameterStatus::Unexcited => FSB_PARAMETER_UNEXCITED,
        ParameterStatus::Uncertain => FSB_PARAMETER_UNCERTAIN,
        ParameterStatus::BelowRange => FSB_PARAMETER_BELOW,
        ParameterStatus::AboveRange => FSB_PARAMETER_ABOVE,
        ParameterStatus::Contradicted => FSB_PARAMETER_CONTRADICTED,
        ParameterStatus::Faulted => FSB_PARAMETER_FAULTED,
        ParameterStatus::Valid => FSB_PARAMETER_VALID,
        ParameterStatus::Held => FSB_PARAMETER_HELD,
        _ => FSB_PARAMETER_UNKNOWN,
    }
}

impl fsb_parameter_report_t {
    const INVALID: Self = Self { k_sd: f32::NAN, inverse: f32::NAN, inverse_sd: f32::NAN };
}

impl fsb_state_sd_t {
    pub(crate) const INVALID: Self = Self { position: f32::NAN, velocity: f32::NAN };

    pub(crate) fn new(sd: Option<AxisState>) -> Self {
        sd.map_or(Self::INVALID, |sd| Self { position: sd.position, velocity: sd.velocity })
    }
}

impl fsb_counters_t {
    pub(crate) const NONE: Self = Self { missed: 0, rejected_measurements: 0, rejected_inputs: 0 };
}

impl From<Counters> for fsb_counters_t {
    fn from(counters: Counters) -> Self {
        let Counters { missed, rejected_measurements, rejected_inputs } = counters;
        Self { missed, rejected_measurements, rejected_inputs }
    }
}

impl fsb_diagnostics_t {
    pub(crate) const INVALID: Self = Self {
        z2: f32::NAN,
        z0: f32::NAN,
        zu: f32::NAN,
        innovation: f32::NAN,
        noise_variance: f32::NAN,
        noise_variance_in_band: f32::NAN,
        numerator: f32::NAN,
        denominator: f32::NAN,
    };
}

impl From<AxisDiagnostics> for fsb_diagnostics_t {
    fn from(of: AxisDiagnostics) -> Self {
        let [noise_variance, noise_variance_in_band] = of.noise_variance;
        let AxisDiagnostics { z2, z0, zu, innovation, numerator, denominator, .. } = of;
        Self { z2, z0, zu, innovation, noise_variance, noise_variance_in_band, numerator, denominator }
    }
}

/// Standard deviation of k, and mass or inertia with its standard deviation.
///
/// FSB_NOT_VALID (and NaN in `report`) where the parameter is not valid. Uses two square roots: for logs, not
/// for the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_parameter_report(
    parameter: *const fsb_parameter_t,
    report: *mut fsb_parameter_report_t,
) -> fsb_status_t {
    give(report, fsb_parameter_report_t::INVALID, || {
        let fsb_parameter_t { k: value, variance, status } = *borrow(parameter)?;
        if status < FSB_PARAMETER_VALID {
            return Err(FSB_NOT_VALID);
        }
        let parameter = Parameter { value, variance };
        let (inverse, inverse_sd) = parameter.inverse_with_sd();
        Ok([fsb_parameter_report_t { k_sd: parameter.sd(), inverse, inverse_sd }])
    })
}

/// The name of a state status as it stands in this header. Static storage, never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_state_status_name(status: fsb_state_status_t) -> *const c_char {
    static NAMES: &str = concat!(
        "FSB_STATE_UNKNOWN\0\0FSB_STATE_NOT_MEASURED\0FSB_STATE_SETTLING\0FSB_STATE_NO_PARAMETER\0FSB_STATE_STALE\0\0\0\0",
        "FSB_STATE_NOMINAL\0FSB_STATE_IDENTIFIED\0FSB_STATE_HELD\0",
    );
    names::at(NAMES, status)
}

/// The name of a parameter status as it stands in this header. Static storage, never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_parameter_status_name(status: fsb_parameter_status_t) -> *const c_char {
    static NAMES: &str = concat!(
        "FSB_PARAMETER_UNKNOWN\0\0FSB_PARAMETER_SETTLING\0FSB_PARAMETER_UNEXCITED\0FSB_PARAMETER_UNCERTAIN\0",
        "FSB_PARAMETER_BELOW\0FSB_PARAMETER_ABOVE\0FSB_PARAMETER_CONTRADICTED\0FSB_PARAMETER_FAULTED\0FSB_PARAMETER_VALID\0",
        "FSB_PARAMETER_HELD\0",
    );
    names::at(NAMES, status)
}
