//! The names of the configuration's parameters.

use core::ffi::CStr;

use fsb_core::ConfigError;

use crate::config::Refusal;
use crate::status::of_config;

/// Text that ends as C expects.
macro_rules! text {
    ($($part:literal),+) => {
        match CStr::from_bytes_with_nul(concat!($($part,)+ "\0").as_bytes()) {
            Ok(text) => text,
            Err(_) => c"configuration",
        }
    };
}

/// A name in either group.
macro_rules! groups {
    ($($name:literal),+ $(,)?) => {
        [$([text!("translation.", $name), text!("rotation.", $name)]),+]
    };
}

static OF_GROUPS: [[&CStr; 2]; 20] = groups![
    "substeps",
    "latency",
    "block",
    "identifier.lambda",
    "identifier.q",
    "observer.lambda",
    "observer.q",
    "noise_sd",
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
];

static OTHERS: [&CStr; 12] = [
    c"period",
    c"gravity",
    c"mass.nominal",
    c"mass.min",
    c"mass.max",
    c"inertia.nominal",
    c"inertia.min",
    c"inertia.max",
    c"actuator_lag",
    c"change.relative",
    c"change.sigmas",
    c"change.hold_off",
];

/// The code of a refused configuration, and the core's name of the parameter as the field is called in C.
pub(super) fn refusal(error: ConfigError) -> Refusal {
    (of_config(error), c_name(error.parameter()))
}

fn c_name(name: &str) -> &'static CStr {
    match name {
        "translation.memory.tau" => return c"translation.memory_tau",
        "rotation.memory.tau" => return c"rotation.memory_tau",
        _ => {}
    }
    let same = |text: &&&'static CStr| text.to_bytes() == name.as_bytes();
    OF_GROUPS.as_flattened().iter().chain(&OTHERS).find(same).copied().unwrap_or(c"configuration")
}
