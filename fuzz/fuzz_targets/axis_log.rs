//! Any bytes as an axis log: refused with a word about where, or replayed.
#![no_main]

use fsb_sim_host::replay::{AxisLog, ReplayOptions, run};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    match AxisLog::from_reader("fuzz.csv", data) {
        Ok(log) => drop(run(&ReplayOptions::default(), &log)),
        Err(error) => assert!(error.to_string().contains("fuzz.csv")),
    }
});
