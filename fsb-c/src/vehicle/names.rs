//! The names of the configuration's parameters.
//!
//! In one piece: texts of their own would stand in a section with all others, which the linker keeps as a whole in programs that
//! use nothing of this.

use core::ffi::c_char;

use fsb_core::ConfigError;

use crate::config::Refusal;
use crate::names::named;
use crate::status::of_config;

macro_rules! texts {
    ([$($of_group:literal),+ $(,)?], [$($other:literal),+ $(,)?]) => {
        concat!(
            $("translation.", $of_group, "\0",)+
            $("rotation.", $of_group, "\0",)+
            $($other, "\0",)+
        )
    };
}

/// The core's names, each with a zero behind it; where a field is called otherwise in C its name follows, after an equals sign.
static NAMES: &str = texts!(
    [
        "substeps",
        "latency",
        "block",
        "readout",
        "identifier.lambda",
        "identifier.q",
        "observer.lambda",
        "observer.q",
        "noise_sd",
        "disturbance_sd",
        "max_relative_sd",
        "max_misfit",
        "parameter_settle",
        "state_settle",
        "measurement_limit",
        "input_limit",
        "guard.sigmas",
        "guard.acceleration",
        "guard.floor",
        "guard.jump_after",
        "guard.bridge",
        "guard.frozen_after",
    ],
    [
        "translation.memory.tau",
        "=translation.memory_tau",
        "rotation.memory.tau",
        "=rotation.memory_tau",
        "period",
        "frame",
        "gravity",
        "mass.nominal",
        "mass.min",
        "mass.max",
        "inertia.nominal",
        "inertia.min",
        "inertia.max",
        "actuator_lag",
        "change.relative",
        "change.sigmas",
        "change.hold_off",
    ]
);

/// The code of a refused configuration, and the core's name of the parameter as the field is called in C.
pub(super) fn refusal(error: ConfigError) -> Refusal {
    (of_config(error), c_name(error.parameter()))
}

/// A name of the configuration as C text.
pub(super) fn c_name(name: &str) -> *const c_char {
    named(NAMES, name)
}
