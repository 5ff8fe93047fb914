//! The vehicle in six degrees of freedom.
//!
//! | file | what |
//! |---|---|
//! | `config`, `names` | the configuration, and the names of its parameters |
//! | `values` | what goes in and out |
//! | `frame` | z up or z down |

#![allow(unsafe_op_in_unsafe_fn, reason = "every function passes its caller's contract on")]

pub mod config;
pub mod frame;
mod names;
pub mod values;

use core::ffi::c_char;

use fsb_core::estimator::Learning;
use fsb_core::vehicle::{Expected, Group, VehicleEstimator};

use self::config::{fsb_expected_t, fsb_vehicle_config_t};
use self::frame::Frame;
use self::values::{
    bits, fsb_identified_t, fsb_measured_t, fsb_vehicle_counters_t, fsb_vehicle_model_t, fsb_vehicle_state_t,
    fsb_wrench_t,
};
use crate::config::{FSB_LEARNING_CONTACT, FSB_LEARNING_OFF, FSB_LEARNING_ON};
use crate::object::{self, Object, aligned, borrow, change, check_storage, give, initialised, read, take, unnamed};
use crate::status::{FSB_MISALIGNED, FSB_UNKNOWN_VALUE, fsb_status_t};
use crate::values::fsb_diagnostics_t;

/// sizeof(fsb_vehicle_t).
pub const FSB_VEHICLE_SIZE: usize = 10816;
/// Alignment of fsb_vehicle_t.
pub const FSB_VEHICLE_ALIGNMENT: usize = 8;
/// The largest latency that can be configured [control periods]: how many of them an fsb_vehicle_t has room for.
pub const FSB_VEHICLE_MAX_LATENCY: usize = 128;

/// x, y, z: the mass.
pub const FSB_GROUP_TRANSLATION: u32 = 0;
/// The angles about the body's axes: the moments of inertia.
pub const FSB_GROUP_ROTATION: u32 = 1;

/// Mass, moments of inertia, position, velocity, attitude and body rates of a vehicle at any attitude, from positions and
/// attitudes and from what its actuators did. Storage of the caller, static or a member: too large for most stacks.
#[repr(C)]
pub struct fsb_vehicle_t {
    /// Not to be touched. Copying the whole object is fine, and the copy goes on from there.
    opaque: [u64; 1352],
}

/// What is kept in the storage.
pub(crate) struct Vehicle {
    estimator: VehicleEstimator<FSB_VEHICLE_MAX_LATENCY>,
    frame: Frame,
}

impl Object for fsb_vehicle_t {
    type Value = Vehicle;
    const KIND: u32 = 5;
}

const _: () = check_storage::<fsb_vehicle_t>(FSB_VEHICLE_SIZE, FSB_VEHICLE_ALIGNMENT);

/// The configuration for a control period [s], which is not checked here: z up, every period measured and nothing late,
/// lambda 4 for both identifiers, 10 and 20 for the observers of translation and rotation, q half of it, least squares
/// that never forget, valid at 5 %, gravity 9.81, mass within 1 g and 1000 kg, inertia within 1e-7 and 1000 kg m^2, no
/// nominal values (no state before mass and inertia are identified: set `mass` and `inertia` with fsb_expected_about), no
/// lag, changes not looked for.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_vehicle_config_default(period: f64) -> fsb_vehicle_config_t {
    fsb_vehicle_config_t::new(period)
}

/// A mass or moment of inertia of roughly `nominal`: within a tenth and ten times of it.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_expected_about(nominal: f64) -> fsb_expected_t {
    Expected::about(nominal).into()
}

/// Nothing measured: position NaN, no attitude. Fill in what has come. For the tick.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_measured_none() -> fsb_measured_t {
    fsb_measured_t::NONE
}

/// Starts an estimator in the caller's storage. Nothing else may be called with it before; calling it again starts anew.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault as it is
/// written in the configuration ("rotation.observer.lambda"; static storage), and the object is not initialised. Without
/// a fault `*parameter` becomes NULL; `parameter` itself may be NULL. Not for the tick: exponentials in double precision,
/// and about 12 KiB of stack on a Cortex-M4F (an update takes 1.2 KiB).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_init(
    vehicle: *mut fsb_vehicle_t,
    config: *const fsb_vehicle_config_t,
    parameter: *mut *const c_char,
) -> fsb_status_t {
    let outcome = object::start(vehicle, || {
        aligned(parameter.cast_const()).map_err(unnamed)?;
        let (config, frame) = borrow(config).map_err(unnamed)?.to_core()?;
        let estimator = VehicleEstimator::new(&config).map_err(names::refusal)?;
        Ok(Vehicle { estimator, frame })
    });
    initialised(outcome, parameter)
}

/// Forgets everything but the configuration, what was said about learning and the counters. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
/// FSB_NOT_INITIALISED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_reset(vehicle: *mut fsb_vehicle_t) -> fsb_status_t {
    change(vehicle, |Vehicle { estimator, .. }| {
        estimator.reset();
        Ok(())
    })
}

/// Identifies the parameters of a group anew, as after a known change of load: what is known goes on being handed out
/// (FSB_PARAMETER_HELD) and used until the new value is valid. `group`: FSB_GROUP_TRANSLATION or FSB_GROUP_ROTATION.
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_reinitialise(vehicle: *mut fsb_vehicle_t, group: u32) -> fsb_status_t {
    change(vehicle, |Vehicle { estimator, .. }| {
        estimator.reinitialise(match group {
            FSB_GROUP_TRANSLATION => Group::Translation,
            FSB_GROUP_ROTATION => Group::Rotation,
            _ => return Err(FSB_UNKNOWN_VALUE),
        });
        Ok(())
    })
}

/// Whether to learn from now on: FSB_LEARNING_ON, FSB_LEARNING_OFF or, on the ground, FSB_LEARNING_CONTACT. When learning
/// resumes the identification begins anew, what is known being held. Errors: FSB_NULL_POINTER, FSB_MISALIGNED,
/// FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_set_learning(vehicle: *mut fsb_vehicle_t, learning: u32) -> fsb_status_t {
    change(vehicle, |Vehicle { estimator, .. }| {
        estimator.set_learning(match learning {
            FSB_LEARNING_ON => Learning::On,
            FSB_LEARNING_OFF => Learning::Off,
            FSB_LEARNING_CONTACT => Learning::Contact,
            _ => return Err(FSB_UNKNOWN_VALUE),
        });
        Ok(())
    })
}

/// One control period has ended. `measured` is what has arrived by now; `applied` is the force and torque that the
/// actuators held over the period that ends now, or were told where `actuator_lag` is set. Once per control period; what
/// is measured less often or not at all is missing. At the very first call, which ends no period, `applied` does not
/// matter.
///
/// What is not finite, beyond its limit or cannot be true is left out, counted, and told in `*events`, the sum of
/// FSB_EVENT_...; `events` may be NULL. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_UNKNOWN_VALUE
/// (`attitude_kind`); nothing has changed then, and `*events` is 0. For the tick: bounded work.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_update(
    vehicle: *mut fsb_vehicle_t,
    measured: *const fsb_measured_t,
    applied: *const fsb_wrench_t,
    events: *mut u32,
) -> fsb_status_t {
    if !events.is_aligned() {
        return FSB_MISALIGNED;
    }
    let mut happened = 0;
    let status = change(vehicle, |Vehicle { estimator, frame }| {
        let [measured] = take(measured)?;
        let [applied] = take(applied)?;
        happened = bits(&estimator.update(&measured.to_core(*frame)?, &applied.to_core(*frame)));
        Ok(())
    });
    if !events.is_null() {
        give(events, 0, || Ok([happened]));
    }
    status
}

/// The control loop has been late by so many control periods, before the fsb_vehicle_update that ends the last of them: as many
/// updates with nothing measured and with the wrench of the last one, at most those of twice `guard.bridge`. That is the wrench of the
/// period before: where the actuators have been told another one since, as many updates with that one and with nothing measured are
/// right, and this is only nearly so. Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_missed(vehicle: *mut fsb_vehicle_t, periods: u32) -> fsb_status_t {
    change(vehicle, |Vehicle { estimator, .. }| {
        estimator.missed(periods);
        Ok(())
    })
}

/// Hands out position, velocity, attitude and rates now, predicted over what measurements are late. What is not valid is
/// NaN and a status says why.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED; `state` holds NaN then, where it can be written. For the
/// tick: the work grows with the latency.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_state(
    vehicle: *const fsb_vehicle_t,
    state: *mut fsb_vehicle_state_t,
) -> fsb_status_t {
    give(state, fsb_vehicle_state_t::INVALID, || {
        read(vehicle, |Vehicle { estimator, frame }| {
            let statuses = [estimator.translation().state_status(), estimator.rotation().state_status()];
            [fsb_vehicle_state_t::new(&estimator.state(), statuses, *frame)]
        })
    })
}

/// Hands out the mass. What is not valid is NaN and its `status` says why. Errors as fsb_vehicle_state. For the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_mass(vehicle: *const fsb_vehicle_t, mass: *mut fsb_identified_t) -> fsb_status_t {
    give(mass, fsb_identified_t::INVALID, || {
        read(vehicle, |Vehicle { estimator, .. }| [fsb_identified_t::new(estimator.mass_status(), estimator.mass())])
    })
}

/// Hands out the moments of inertia about the body's x, y, z. Errors as fsb_vehicle_state. For the tick.
/// cbindgen:ptrs-as-arrays=[[inertia;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_inertia(
    vehicle: *const fsb_vehicle_t,
    inertia: *mut fsb_identified_t,
) -> fsb_status_t {
    give(inertia, fsb_identified_t::INVALID, || {
        read(vehicle, |Vehicle { estimator, .. }| {
            let ([x, y, z], [a, b, c]) = (estimator.inertia_status(), estimator.inertia());
            [fsb_identified_t::new(x, a), fsb_identified_t::new(y, b), fsb_identified_t::new(z, c)]
        })
    })
}

/// Hands out the mass and the moments of inertia that the state is predicted with, and that a controller may divide by.
/// Errors as fsb_vehicle_state. For the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_model(
    vehicle: *const fsb_vehicle_t,
    model: *mut fsb_vehicle_model_t,
) -> fsb_status_t {
    give(model, fsb_vehicle_model_t::INVALID, || read(vehicle, |Vehicle { estimator, .. }| [estimator.model().into()]))
}

/// Hands out what was rejected, lost or changed. Errors as fsb_vehicle_state; the counters are zero then. For the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_counters(
    vehicle: *const fsb_vehicle_t,
    counters: *mut fsb_vehicle_counters_t,
) -> fsb_status_t {
    give(counters, fsb_vehicle_counters_t::NONE, || {
        read(vehicle, |Vehicle { estimator, .. }| [estimator.counters().into()])
    })
}

/// Hands out inner signals of x, y, z and of the angles about the body's x, y, z, in the axes of FSB_FRAME_Z_UP: for logs
/// and tests. Errors as fsb_vehicle_state. Not for the tick: divisions.
/// cbindgen:ptrs-as-arrays=[[diagnostics;6]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_vehicle_diagnostics(
    vehicle: *const fsb_vehicle_t,
    diagnostics: *mut fsb_diagnostics_t,
) -> fsb_status_t {
    give(diagnostics, fsb_diagnostics_t::INVALID, || {
        read(vehicle, |Vehicle { estimator, .. }| {
            let [x, y, z] = estimator.translation().diagnostics();
            let [a, b, c] = estimator.rotation().diagnostics();
            [x, y, z, a, b, c].map(fsb_diagnostics_t::from)
        })
    })
}
