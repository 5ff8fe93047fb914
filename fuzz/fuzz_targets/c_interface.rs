//! Any calls of the C interface, with pointers that are good, null or misaligned.
#![no_main]

use core::ptr::null_mut;

use fsb::axis::*;
use fsb::status::FSB_OK;
use fsb::values::*;
use fuzz::Bytes;
use libfuzzer_sys::fuzz_target;

/// Storage as a C caller has it, with room to be misaligned in.
#[repr(C, align(16))]
struct Storage([u8; 4096]);

fuzz_target!(|data: &[u8]| {
    let _ = run(&mut Bytes(data));
});

fn run(bytes: &mut Bytes<'_>) -> Option<()> {
    let mut storage = Storage([0; 4096]);
    // What lies in memory before. (A forged object, or one that another one was put on top of, is a broken contract.)
    storage.0.fill(bytes.byte()?);
    assert!(size_of::<fsb_axis_t>() + 8 <= storage.0.len());
    loop {
        let choice = bytes.byte()?;
        let base = storage.0.as_mut_ptr();
        let it: *mut fsb_axis_t = match choice >> 5 {
            0 => null_mut(),
            // SAFETY: within the storage; misaligned.
            1 => unsafe { base.add(usize::from(choice & 7) | 1) }.cast(),
            _ => base.cast(),
        };
        // SAFETY: the storage is large enough at any of these addresses, or the address is null; that is the contract.
        unsafe {
            match choice & 31 {
                0..3 => {
                    let mut config = fsb_axis_config_default(f64::from(bytes.number()?.abs()) + 1e-3);
                    config.substeps = u32::from(bytes.byte()? & 3);
                    config.block = u32::from(bytes.byte()? & 7);
                    config.drift = f64::from(bytes.number()?);
                    config.nominal = f64::from(bytes.number()?);
                    let mut name = core::ptr::null();
                    let status = fsb_axis_init(it, &config, &mut name);
                    assert!((status == FSB_OK) == name.is_null() || it.is_null() || choice >> 5 == 1);
                }
                3..12 => drop(fsb_axis_measure(it, &bytes.number()?)),
                12..21 => drop(fsb_axis_apply(it, &bytes.number()?)),
                21 => drop(fsb_axis_apply_ramp(it, &bytes.number()?, &bytes.number()?)),
                22 => drop(fsb_axis_reset(it)),
                23 => drop(fsb_axis_reset_identifier(it)),
                24 => drop(fsb_axis_reinitialise_identifier(it)),
                25 => drop(fsb_axis_set_learning(it, u32::from(bytes.byte()?))),
                26 => {
                    let mut state = core::mem::zeroed::<fsb_state_t>();
                    if fsb_axis_state(it, &mut state) == FSB_OK && state.status >= FSB_STATE_NOMINAL {
                        assert!(state.position.is_finite() && state.velocity.is_finite());
                    }
                }
                27 => {
                    let mut parameter = core::mem::zeroed::<fsb_parameter_t>();
                    if fsb_axis_parameter(it, &mut parameter) == FSB_OK && parameter.status >= FSB_PARAMETER_VALID {
                        assert!(parameter.k.is_finite() && parameter.k > 0.0 && parameter.variance >= 0.0);
                        let mut report = core::mem::zeroed::<fsb_parameter_report_t>();
                        assert_eq!(fsb_parameter_report(&parameter, &mut report), FSB_OK);
                    }
                }
                28 => drop(fsb_axis_counters(it, null_mut())),
                29 => drop(fsb_axis_measure(it, core::ptr::null())),
                30 => drop(fsb_axis_state(it, null_mut())),
                _ => drop(fsb_axis_parameter(it, null_mut())),
            }
        }
    }
}
