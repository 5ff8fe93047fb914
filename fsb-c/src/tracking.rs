//! The controller of one axis, and (11).

#![allow(unsafe_op_in_unsafe_fn, reason = "every function passes its caller's contract on")]

use core::ffi::c_char;

use fsb_core::control::{Reference, TrackingConfig, TrackingController, to_body};
use fsb_core::estimator::AxisState;

use crate::config::refusal;
use crate::object::{self, Object, aligned, borrow, check_storage, give, initialised, read, take, unnamed};
use crate::status::{fsb_status_t, of_control};
use crate::values::fsb_state_t;

/// sizeof(fsb_tracking_t).
pub const FSB_TRACKING_SIZE: usize = 32;
/// Alignment of fsb_tracking_t.
pub const FSB_TRACKING_ALIGNMENT: usize = 8;

/// The controller of one axis. Storage of the caller; what is in it is the library's.
#[repr(C)]
pub struct fsb_tracking_t {
    /// Not to be touched. Copying the whole object is fine.
    opaque: [u64; 4],
}

impl Object for fsb_tracking_t {
    type Value = TrackingController;
    const KIND: u32 = 4;
}

const _: () = check_storage::<fsb_tracking_t>(FSB_TRACKING_SIZE, FSB_TRACKING_ALIGNMENT);

/// Gains and limits of an axis's controller. Start from fsb_tracking_config_default.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_tracking_config_t {
    /// Gain of the position error [1/s^2]. 1e-15..1e15.
    pub kp: f64,
    /// Gain of the velocity error [1/s]. 1e-15..1e15.
    pub kd: f64,
    /// Known drift of the axis [m/s^2 or rad/s^2], as in the estimator; the input makes up for it. Up to 1e6.
    pub drift: f64,
    /// The smallest k by which the controller divides. 1e-15..1e15.
    pub k_min: f64,
    /// The largest k by which the controller divides; not below the smallest, up to 1e15.
    pub k_max: f64,
}

/// What an axis shall do now.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_reference_t {
    /// Position [m or rad].
    pub position: f32,
    /// Velocity [m/s or rad/s].
    pub velocity: f32,
    /// Acceleration [m/s^2 or rad/s^2].
    pub acceleration: f32,
}

/// Gains as given, no drift, any k from 1e-6 to 1e9. With the true k a position error e then obeys e'' + kd e' +
/// kp e = 0.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_tracking_config_default(kp: f64, kd: f64) -> fsb_tracking_config_t {
    fsb_tracking_config_t { kp, kd, drift: 0.0, k_min: 1e-6, k_max: 1e9 }
}

/// Starts a controller in the caller's storage.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, or FSB_CONFIG_...: then `*parameter` names the parameter at fault
/// (static storage), and the object is not initialised. Without a fault `*parameter` becomes NULL; `parameter`
/// itself may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_tracking_init(
    controller: *mut fsb_tracking_t,
    config: *const fsb_tracking_config_t,
    parameter: *mut *const c_char,
) -> fsb_status_t {
    let outcome = object::start(controller, || {
        aligned(parameter.cast_const()).map_err(unnamed)?;
        let fsb_tracking_config_t { kp, kd, drift, k_min, k_max } = *borrow(config).map_err(unnamed)?;
        let config = TrackingConfig { kp, kd, drift, parameter_min: k_min, parameter_max: k_max };
        TrackingController::new(&config).map_err(refusal)
    });
    initialised(outcome, parameter)
}

/// Hands out the input [N or N m] that makes the axis follow `reference` from `state`: (acceleration - drift -
/// kd (velocity error) - kp (position error)) / k. `k` is the identified one where it is valid, else the nominal
/// one. `state` may come from another estimator: only its position and velocity are read.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_PARAMETER_OUT_OF_RANGE, FSB_NOT_FINITE (a
/// state that is not valid is NaN); `input` becomes NaN then, where it can be written. What to do instead (hold,
/// descend, hand over) is the caller's decision. For the tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_tracking_input(
    controller: *const fsb_tracking_t,
    reference: *const fsb_reference_t,
    state: *const fsb_state_t,
    k: f32,
    input: *mut f32,
) -> fsb_status_t {
    give(input, f32::NAN, || {
        let fsb_reference_t { position, velocity, acceleration } = *borrow(reference)?;
        let reference = Reference { position, velocity, acceleration };
        let fsb_state_t { position, velocity, .. } = *borrow(state)?;
        let state = AxisState { position, velocity };
        let input = read(controller, |controller| controller.input(&reference, &state, k))?;
        Ok([input.map_err(of_control)?])
    })
}

/// Turns a force from the world frame into the body frame, F = R^T f. `attitude` is the rotation from body to
/// world by rows: attitude[3 i + j] is the component of body axis j along world axis i. `body` may be `world`.
///
/// Errors: FSB_NULL_POINTER, FSB_MISALIGNED. Values are not checked: NaN in, NaN out. For the tick.
/// cbindgen:ptrs-as-arrays=[[attitude;9], [world;3], [body;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fsb_to_body(attitude: *const f32, world: *const f32, body: *mut f32) -> fsb_status_t {
    give(body, f32::NAN, || {
        let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = take(attitude)?;
        let world: [f32; 3] = take(world)?;
        Ok(to_body(&[[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]], &world))
    })
}
