//! Any bytes as a ULog file: refused with the file's name, or replayed.
#![no_main]

use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use fsb_sim_host::replay::lag::Lag;
use fsb_sim_host::replay::{Recording, ReplayOptions, run, ulog};
use libfuzzer_sys::fuzz_target;

static FILE: LazyLock<PathBuf> =
    LazyLock::new(|| std::env::temp_dir().join(format!("fuzz-{}.ulg", std::process::id())));

fuzz_target!(|data: &[u8]| {
    let name = FILE.display().to_string();
    fs::write(&*FILE, data).expect("room for a file");
    let options = ReplayOptions::default();
    match ulog::read(&FILE, None) {
        Ok(flight) => match Recording::of_flight(&name, flight, Lag::Given(0.0), &options, || ()) {
            Ok(recording) => drop(run(&options, &recording.log)),
            Err(error) => assert!(error.to_string().contains(&name), "{error}"),
        },
        Err(error) => assert!(error.to_string().contains(&name), "{error}"),
    }
});
