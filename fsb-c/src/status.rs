//! Status codes and their names.

use core::ffi::c_char;

use fsb_core::ConfigError;
use fsb_core::control::ControlError;

use crate::names;

/// What a function returns: FSB_OK, or why it did not do what it was asked for.
pub type fsb_status_t = i32;

/// Done.
pub const FSB_OK: i32 = 0;
/// A pointer that must not be NULL is NULL.
pub const FSB_NULL_POINTER: i32 = 1;
/// A pointer is not aligned for its type.
pub const FSB_MISALIGNED: i32 = 2;
/// The object was not initialised, its initialisation failed, it was initialised as something else or by another
/// version of the library, or its storage was overwritten.
pub const FSB_NOT_INITIALISED: i32 = 3;
/// A measurement was given before as many inputs as `substeps` were applied since the last one. Nothing has changed.
pub const FSB_OUT_OF_STEP: i32 = 4;
/// The parameter is outside the range by which the controller may divide, or NaN.
pub const FSB_PARAMETER_OUT_OF_RANGE: i32 = 5;
/// The reference, the state or the resulting input is not finite.
pub const FSB_NOT_FINITE: i32 = 6;
/// The value asked for is not valid at present.
pub const FSB_NOT_VALID: i32 = 7;
/// An argument is none of the constants that it may be. Nothing has changed.
pub const FSB_UNKNOWN_VALUE: i32 = 8;
/// Configuration: NaN or infinite.
pub const FSB_CONFIG_NOT_FINITE: i32 = 16;
/// Configuration: zero or negative where a positive value is needed.
pub const FSB_CONFIG_NOT_POSITIVE: i32 = 17;
/// Configuration: negative where zero or more is needed.
pub const FSB_CONFIG_NEGATIVE: i32 = 18;
/// Configuration: outside the documented range.
pub const FSB_CONFIG_OUT_OF_RANGE: i32 = 19;
/// Configuration: a rate [1/s] times the period it runs at exceeds 1. Lower the rate or sample faster.
pub const FSB_CONFIG_TOO_FAST: i32 = 20;
/// Configuration: a rate [1/s] times the period it runs at is below 1e-6.
pub const FSB_CONFIG_TOO_SLOW: i32 = 21;
/// Configuration: the lower limit of a pair is not below the upper one.
pub const FSB_CONFIG_INVERTED_RANGE: i32 = 22;
/// Configuration: a count that must be at least one is zero.
pub const FSB_CONFIG_ZERO: i32 = 23;
/// Configuration: refused for another reason.
pub const FSB_CONFIG_REFUSED: i32 = 31;

/// The code of a refused configuration.
pub(crate) fn of_config(error: ConfigError) -> fsb_status_t {
    match error {
        ConfigError::NonFinite(_) => FSB_CONFIG_NOT_FINITE,
        ConfigError::NonPositive(_) => FSB_CONFIG_NOT_POSITIVE,
        ConfigError::Negative(_) => FSB_CONFIG_NEGATIVE,
        ConfigError::OutOfRange(_) => FSB_CONFIG_OUT_OF_RANGE,
        ConfigError::TooFastForPeriod(_) => FSB_CONFIG_TOO_FAST,
        ConfigError::TooSlowForPeriod(_) => FSB_CONFIG_TOO_SLOW,
        ConfigError::InvertedRange(_) => FSB_CONFIG_INVERTED_RANGE,
        ConfigError::Zero(_) => FSB_CONFIG_ZERO,
        _ => FSB_CONFIG_REFUSED,
    }
}

/// The code of an input that could not be computed.
pub(crate) fn of_control(error: ControlError) -> fsb_status_t {
    match error {
        ControlError::ParameterOutOfRange => FSB_PARAMETER_OUT_OF_RANGE,
        _ => FSB_NOT_FINITE,
    }
}

/// The name of a status code as it stands in this header, "FSB_OK"; "FSB_UNKNOWN" for a number that is none.
/// Static storage, never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_status_name(status: fsb_status_t) -> *const c_char {
    names::at(NAMES, status)
}

/// What stands for no status, then those from 0 on, each with a zero behind it.
static NAMES: &str = concat!(
    "FSB_UNKNOWN\0FSB_OK\0FSB_NULL_POINTER\0FSB_MISALIGNED\0FSB_NOT_INITIALISED\0FSB_OUT_OF_STEP\0",
    "FSB_PARAMETER_OUT_OF_RANGE\0FSB_NOT_FINITE\0FSB_NOT_VALID\0FSB_UNKNOWN_VALUE\0\0\0\0\0\0\0\0",
    "FSB_CONFIG_NOT_FINITE\0FSB_CONFIG_NOT_POSITIVE\0FSB_CONFIG_NEGATIVE\0FSB_CONFIG_OUT_OF_RANGE\0",
    "FSB_CONFIG_TOO_FAST\0FSB_CONFIG_TOO_SLOW\0FSB_CONFIG_INVERTED_RANGE\0FSB_CONFIG_ZERO\0\0\0\0\0\0\0\0",
    "FSB_CONFIG_REFUSED\0",
);
