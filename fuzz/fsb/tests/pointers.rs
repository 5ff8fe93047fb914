//! The C interface through raw pointers, as C uses it: good ones, NULL, misaligned, and storage in which anything lies. Small,
//! because it is also run under Miri (`cargo xtask miri`), which sees every access that the language does not define.

#![allow(unsafe_code, reason = "pointers are what is tested")]

use std::alloc::{Layout, alloc, dealloc};
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use fsb::axis::*;
use fsb::rotation::*;
use fsb::status::*;
use fsb::tracking::*;
use fsb::translation::*;
use fsb::values::*;
use fsb::vehicle::values::*;
use fsb::vehicle::*;

/// Storage as a C caller has it, `byte` lying in it, with room to be misaligned in.
struct Storage(*mut u8);

impl Storage {
    const LAYOUT: Layout = Layout::new::<[u64; 4096]>();

    fn filled(byte: u8) -> Self {
        // SAFETY: the size is not zero; so many bytes are there to be written.
        unsafe {
            let base = alloc(Self::LAYOUT);
            assert!(!base.is_null());
            base.write_bytes(byte, Self::LAYOUT.size());
            Self(base)
        }
    }

    fn at<T>(&self, offset: usize) -> *mut T {
        assert!(offset + size_of::<T>() <= Self::LAYOUT.size());
        // SAFETY: within the storage.
        unsafe { self.0.add(offset) }.cast()
    }
}

impl Drop for Storage {
    fn drop(&mut self) {
        // SAFETY: allocated so.
        unsafe { dealloc(self.0, Self::LAYOUT) };
    }
}

/// A flight on one axis: what is handed out is right, and nothing is before it is valid.
#[test]
fn a_flight() {
    let storage = Storage::filled(0xa5);
    let axis: *mut fsb_axis_t = storage.at(0);
    let mut config = fsb_axis_config_default(0.02);
    config.drift = -9.81;
    config.noise_sd = 1e-5;
    let mut name = null();
    let mut parameter = MaybeUninit::<fsb_parameter_t>::uninit();
    let mut state = MaybeUninit::<fsb_state_t>::uninit();
    // SAFETY: every pointer leads to a value of its type; outputs are written before they are read.
    unsafe {
        assert_eq!(fsb_axis_init(axis, &config, &mut name), FSB_OK);
        assert!(name.is_null());
        assert_eq!(fsb_axis_parameter(axis, parameter.as_mut_ptr()), FSB_OK);
        assert!(parameter.assume_init().k.is_nan());
        let (mut z, mut v) = (1.0, 0.0);
        for tick in 0..80 {
            let (measured, force) = (z as f32, if tick % 20 < 10 { 13.0_f32 } else { 11.0 });
            assert_eq!(fsb_axis_measure(axis, &measured), FSB_OK);
            assert_eq!(fsb_axis_apply(axis, &force), FSB_OK);
            let a = f64::from(force) / 1.25 - 9.81;
            z += v * 0.02 + a * 0.0002;
            v += a * 0.02;
        }
        assert_eq!(fsb_axis_parameter(axis, parameter.as_mut_ptr()), FSB_OK);
        let k = parameter.assume_init();
        assert!(k.status == FSB_PARAMETER_VALID && (f64::from(k.k) * 1.25 - 1.0).abs() < 1e-4, "{}", k.k);
        assert_eq!(fsb_axis_state(axis, state.as_mut_ptr()), FSB_OK);
        assert!((f64::from(state.assume_init().velocity) - v).abs() < 1e-3);
        let mut report = MaybeUninit::<fsb_parameter_report_t>::uninit();
        assert_eq!(fsb_parameter_report(&k, report.as_mut_ptr()), FSB_OK);
        assert!((report.assume_init().inverse - 1.25).abs() < 1e-3);
        // A copy goes on from there.
        let copy: *mut fsb_axis_t = storage.at(4096);
        copy.copy_from_nonoverlapping(axis, 1);
        assert_eq!(fsb_axis_measure(copy, &(z as f32)), FSB_OK);
        assert_eq!(fsb_axis_parameter(copy, parameter.as_mut_ptr()), FSB_OK);
        assert_eq!(parameter.assume_init().status, FSB_PARAMETER_VALID);
    }
}

/// NULL and misaligned pointers are named, wherever they are given; the object goes on as if nothing had been.
#[test]
fn wrong_pointers() {
    let storage = Storage::filled(0);
    let axis: *mut fsb_axis_t = storage.at(0);
    let off: *mut fsb_axis_t = storage.at(4097);
    let config = fsb_axis_config_default(0.01);
    let y = [1.0_f32; 2];
    // SAFETY: as above; the address is within y, and never read.
    let y_off: *const f32 = unsafe { y.as_ptr().cast::<u8>().add(1) }.cast();
    let mut state = MaybeUninit::<fsb_state_t>::uninit();
    // SAFETY: NULL, misaligned, or good.
    unsafe {
        assert_eq!(fsb_axis_init(null_mut(), &config, null_mut()), FSB_NULL_POINTER);
        assert_eq!(fsb_axis_init(off, &config, null_mut()), FSB_MISALIGNED);
        assert_eq!(fsb_axis_init(axis, null(), null_mut()), FSB_NULL_POINTER);
        assert_eq!(fsb_axis_init(axis, &config, null_mut()), FSB_OK);
        for (it, expected) in [(null_mut(), FSB_NULL_POINTER), (off, FSB_MISALIGNED)] {
            assert_eq!(fsb_axis_measure(it, &y[0]), expected);
            assert_eq!(fsb_axis_apply(it, &y[0]), expected);
            assert_eq!(fsb_axis_reset(it), expected);
            assert_eq!(fsb_axis_state(it, state.as_mut_ptr()), expected);
            assert!(state.assume_init().position.is_nan());
        }
        assert_eq!(fsb_axis_measure(axis, null()), FSB_NULL_POINTER);
        assert_eq!(fsb_axis_measure(axis, y_off), FSB_MISALIGNED);
        assert_eq!(fsb_axis_apply_ramp(axis, &y[0], null()), FSB_NULL_POINTER);
        assert_eq!(fsb_axis_state(axis, null_mut()), FSB_NULL_POINTER);
        assert_eq!(fsb_axis_counters(axis, null_mut()), FSB_NULL_POINTER);
        // Nothing of that was a measurement.
        assert_eq!(fsb_axis_measure(axis, &y[0]), FSB_OK);
        assert_eq!(fsb_axis_measure(axis, &y[0]), FSB_OUT_OF_STEP);
        assert_eq!(fsb_axis_apply(axis, &y[0]), FSB_OK);
    }
}

/// Whatever lies in storage that was not initialised, or was for something else, is found not to be an object.
#[test]
fn storage_of_anything() {
    for byte in [0x00, 0x01, 0x46, 0xff] {
        let storage = Storage::filled(byte);
        let axis: *mut fsb_axis_t = storage.at(0);
        let mut parameter = MaybeUninit::<fsb_parameter_t>::uninit();
        // SAFETY: storage of the right size, any bytes in it.
        unsafe {
            assert_eq!(fsb_axis_measure(axis, &1.0), FSB_NOT_INITIALISED);
            assert_eq!(fsb_axis_parameter(axis, parameter.as_mut_ptr()), FSB_NOT_INITIALISED);
            assert!(parameter.assume_init().k.is_nan());
        }
    }
    let storage = Storage::filled(0);
    let (axis, rotation): (*mut fsb_axis_t, *mut fsb_rotation_t) = (storage.at(0), storage.at(0));
    let mut config = fsb_rotation_config_default(0.01);
    let mut name = null();
    // SAFETY: as above.
    unsafe {
        assert_eq!(fsb_rotation_init(rotation, &config, null_mut()), FSB_OK);
        assert_eq!(fsb_axis_measure(axis, &1.0), FSB_NOT_INITIALISED);
        config.observer.lambda = -1.0;
        assert_eq!(fsb_rotation_init(rotation, &config, &mut name), FSB_CONFIG_NOT_POSITIVE);
        assert_eq!(CStr::from_ptr(name), c"observer.lambda");
        assert_eq!(fsb_rotation_measure(rotation, [1.0; 3].as_ptr()), FSB_NOT_INITIALISED);
    }
}

/// Three values at a time, in and out, and the controller.
#[test]
fn arrays() {
    let storage = Storage::filled(0x77);
    let translation: *mut fsb_translation_t = storage.at(0);
    let mut config = fsb_translation_config_default(0.01);
    config.nominal = 0.5;
    let mut states = [MaybeUninit::<fsb_state_t>::uninit(); 3];
    let mut bad = MaybeUninit::<fsb_counters_t>::uninit();
    // SAFETY: arrays of three where three are taken or given.
    unsafe {
        assert_eq!(fsb_translation_init(translation, &config, null_mut()), FSB_OK);
        for tick in 0..5 {
            let y = if tick == 0 { [1.0; 3] } else { [1.0, f32::NAN, f32::INFINITY] };
            assert_eq!(fsb_translation_measure(translation, y.as_ptr()), FSB_OK);
            assert_eq!(fsb_translation_apply(translation, [0.0, 1e30, 1.0].as_ptr()), FSB_OK);
        }
        assert_eq!(fsb_translation_states(translation, states.as_mut_ptr().cast()), FSB_OK);
        assert!(states.iter().all(|state| state.assume_init().status >= FSB_STATE_UNKNOWN));
        assert_eq!(fsb_translation_counters(translation, bad.as_mut_ptr()), FSB_OK);
        assert_eq!(bad.assume_init().rejected_inputs, 5);
        let mut body = [f32::NAN; 3];
        let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0_f32];
        assert_eq!(fsb_to_body(identity.as_ptr(), [1.0, 2.0, 3.0].as_ptr(), body.as_mut_ptr()), FSB_OK);
        assert_eq!(body, [1.0, 2.0, 3.0]);
        assert_eq!(fsb_to_body(null(), [1.0, 2.0, 3.0].as_ptr(), body.as_mut_ptr()), FSB_NULL_POINTER);
    }
}

/// The whole vehicle: its estimator with the ring of inputs that wait for late measurements, and what is handed out of it.
#[test]
fn a_vehicle() {
    let storage = Storage::filled(0x3c);
    let vehicle: *mut fsb_vehicle_t = storage.at(0);
    let mut config = fsb_vehicle_config_default(0.02);
    config.mass = fsb_expected_about(2.0);
    config.inertia = [fsb_expected_about(0.02); 3];
    config.translation.latency = 2;
    let mut state = MaybeUninit::<fsb_vehicle_state_t>::uninit();
    let mut inertia = [MaybeUninit::<fsb_identified_t>::uninit(); 3];
    let (mut mass, mut events) = (MaybeUninit::<fsb_identified_t>::uninit(), 0);
    // SAFETY: every pointer leads to a value of its type, or is NULL or misaligned.
    unsafe {
        assert_eq!(fsb_vehicle_reset(vehicle), FSB_NOT_INITIALISED);
        assert_eq!(fsb_vehicle_init(vehicle, &config, null_mut()), FSB_OK);
        assert_eq!(fsb_vehicle_update(vehicle, &fsb_measured_none(), null(), &mut events), FSB_NULL_POINTER);
        for tick in 0..40 {
            let mut measured = fsb_measured_none();
            measured.position = [0.0, 0.0, 1.0];
            measured.attitude_kind = FSB_ATTITUDE_QUATERNION;
            measured.attitude[0] = 1.0;
            let torque = [if tick < 20 { 0.0 } else { f32::NAN }; 3];
            let wrench = fsb_wrench_t { force: [0.0, 0.0, 2.5 * 9.80665], torque };
            assert_eq!(fsb_vehicle_update(vehicle, &measured, &wrench, &mut events), FSB_OK);
            assert_eq!(events & FSB_EVENT_WRENCH_REJECTED != 0, tick >= 20);
        }
        assert_eq!(fsb_vehicle_mass(vehicle, mass.as_mut_ptr()), FSB_OK);
        let mass = mass.assume_init();
        assert!(mass.status == FSB_PARAMETER_VALID && (mass.value - 2.5).abs() < 1e-2, "{}", mass.value);
        assert_eq!(fsb_vehicle_inertia(vehicle, inertia.as_mut_ptr().cast()), FSB_OK);
        assert!(inertia.iter().all(|of| of.assume_init().value.is_nan()), "nothing turned");
        assert_eq!(fsb_vehicle_state(vehicle, state.as_mut_ptr()), FSB_OK);
        assert!((state.assume_init().position[2] - 1.0).abs() < 1e-4);
        assert_eq!(fsb_vehicle_state(vehicle, null_mut()), FSB_NULL_POINTER);
        assert_eq!(fsb_vehicle_missed(vehicle, 5), FSB_OK);
        assert_eq!(fsb_vehicle_reset(storage.at(1)), FSB_MISALIGNED);
    }
}
