//! Any text as a scenario: refused with a word about where, or flown.
#![no_main]

use std::path::Path;

use fsb_sim_host::fly::{Keep, parse, record};
use libfuzzer_sys::fuzz_target;

/// Ticks that are flown in a moment.
const SHORT: u64 = 300;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    // After the last `$` come entries overridden.
    let (text, overrides) = text.rsplit_once('$').unwrap_or((text, ""));
    let overrides: Vec<String> = overrides.lines().map(str::to_owned).collect();
    match parse("fuzz", Path::new("fuzz.toml"), text, &overrides) {
        Ok(mut scenario) => {
            scenario.duration = scenario.duration.min(SHORT as f64 / scenario.rate);
            // What was sound for longer may not be for less: it is said so then.
            if let Ok(flight) = record(&scenario, 1, Keep::Numbers) {
                let errors = flight.errors.iter().flat_map(|errors| errors.all()).flatten();
                assert!(errors.into_iter().all(f64::is_finite));
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
