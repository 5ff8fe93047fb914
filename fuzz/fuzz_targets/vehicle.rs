//! Any calls of the whole vehicle, through its C interface: what is handed out as usable is numbers.
#![no_main]

use core::mem::zeroed;
use core::ptr::{null, null_mut};

use fsb::status::FSB_OK;
use fsb::values::*;
use fsb::vehicle::values::*;
use fsb::vehicle::*;
use fuzz::Bytes;
use libfuzzer_sys::fuzz_target;

/// Storage as a C caller has it.
#[repr(C, align(16))]
struct Storage([u8; size_of::<fsb_vehicle_t>()]);

fuzz_target!(|data: &[u8]| {
    let _ = run(&mut Bytes(data));
});

fn run(bytes: &mut Bytes<'_>) -> Option<()> {
    let mut storage = Storage([0; size_of::<fsb_vehicle_t>()]);
    let it: *mut fsb_vehicle_t = storage.0.as_mut_ptr().cast();
    start(it, bytes)?;
    let mut tick = 0_u32;
    loop {
        let choice = bytes.byte()?;
        // SAFETY: pointers are good or NULL; that is the contract.
        unsafe {
            match choice & 31 {
                0 => start(it, bytes)?,
                1 => drop(fsb_vehicle_reset(it)),
                2 => drop(fsb_vehicle_reinitialise(it, u32::from(bytes.byte()? & 3))),
                3 => drop(fsb_vehicle_set_learning(it, u32::from(bytes.byte()? & 3))),
                4 => drop(fsb_vehicle_missed(it, u32::from(bytes.byte()?))),
                5 => drop(fsb_vehicle_update(it, null(), null(), null_mut())),
                6..10 => {
                    let mut measured = fsb_measured_none();
                    measured.position = bytes.numbers()?;
                    measured.attitude_kind = u32::from(bytes.byte()? & 3);
                    measured.attitude = bytes.numbers()?;
                    let wrench = fsb_wrench_t { force: bytes.numbers()?, torque: bytes.numbers()? };
                    let mut events = 0;
                    fsb_vehicle_update(it, &measured, &wrench, &mut events);
                }
                // A stretch of a flight.
                _ => {
                    for _ in 0..=bytes.byte()? >> 2 {
                        tick += 1;
                        fly(it, tick, choice);
                    }
                }
            }
        }
        judge(it);
    }
}

fn start(it: *mut fsb_vehicle_t, bytes: &mut Bytes<'_>) -> Option<()> {
    let mut config = fsb_vehicle_config_default(0.005);
    config.frame = u32::from(bytes.byte()? % 3);
    config.mass = fsb_expected_about(2.0);
    config.inertia = [0.02, 0.02, 0.04].map(|nominal| fsb_expected_about(nominal));
    let bits = bytes.byte()?;
    for group in [&mut config.translation, &mut config.rotation] {
        group.latency = u32::from(bits & 3);
        group.substeps = 1 + u32::from(bits >> 2 & 1);
        group.block = [1, 4, 10, 0][usize::from(bits >> 3 & 3)];
        group.guard.frozen_after = u32::from(bits >> 5);
    }
    if bits & 128 != 0 {
        config.actuator_lag = f64::from(bytes.number()?);
        config.mass.nominal = f64::from(bytes.number()?);
        config.change.relative = f64::from(bytes.number()?);
    }
    let mut name = null();
    // SAFETY: room for one; a name to be written.
    let outcome = unsafe { fsb_vehicle_init(it, &config, &mut name) };
    assert_eq!(outcome == FSB_OK, name.is_null());
    Some(())
}

/// A vehicle that is being shaken, at rest in the mean.
fn fly(it: *mut fsb_vehicle_t, tick: u32, choice: u8) {
    let t = tick as f32 * 0.005;
    let wave = |frequency: f32| (frequency * t + f32::from(choice)).sin();
    let mut measured = fsb_measured_none();
    measured.position = [wave(1.0), wave(1.3), 1.0 + 0.1 * wave(2.0)];
    measured.attitude_kind = FSB_ATTITUDE_QUATERNION;
    let half = 0.1 * wave(3.0);
    measured.attitude[0] = (1.0 - half * half).sqrt();
    measured.attitude[1] = half;
    let wrench = fsb_wrench_t { force: [0.0, wave(1.0), 20.0 + wave(2.0)], torque: [0.1 * wave(5.0), 0.0, 0.01] };
    let mut events = 0;
    // SAFETY: all of it is there.
    unsafe {
        fsb_vehicle_update(it, &measured, &wrench, &mut events);
    }
}

fn judge(it: *const fsb_vehicle_t) {
    // SAFETY: an object or storage of zeros; outputs of plain numbers.
    unsafe {
        let mut state = zeroed::<fsb_vehicle_state_t>();
        if fsb_vehicle_state(it, &mut state) != FSB_OK {
            return;
        }
        if state.translation_status >= FSB_STATE_NOMINAL {
            assert!(state.position.iter().chain(&state.velocity).all(|x| x.is_finite()));
        }
        if state.rotation_status >= FSB_STATE_NOMINAL {
            assert!(state.rates.iter().all(|x| x.is_finite()));
            assert!(state.attitude.iter().all(|x| x.abs() < 1.01));
        }
        let (mut mass, mut inertia) = (zeroed::<fsb_identified_t>(), zeroed::<[fsb_identified_t; 3]>());
        assert_eq!(fsb_vehicle_mass(it, &mut mass), FSB_OK);
        assert_eq!(fsb_vehicle_inertia(it, inertia.as_mut_ptr()), FSB_OK);
        for (of, nominal) in [(mass, 2.0), (inertia[0], 0.02), (inertia[1], 0.02), (inertia[2], 0.04)] {
            if of.status >= FSB_PARAMETER_VALID {
                assert!(of.value >= 0.099 * nominal && of.value <= 10.01 * nominal, "{} of {nominal}", of.value);
                assert!(of.variance >= 0.0 && of.variance.is_finite());
            } else {
                assert!(of.value.is_nan() && of.variance.is_nan());
            }
        }
        let mut model = zeroed::<fsb_vehicle_model_t>();
        assert_eq!(fsb_vehicle_model(it, &mut model), FSB_OK);
    }
}
