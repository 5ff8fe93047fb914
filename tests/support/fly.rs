//! Flights of built-in scenarios with entries overridden.

use fsb_sim_host::fly::record::Errors;
use fsb_sim_host::fly::{Flight, Keep, Scenario, load, record};

/// The built-in scenario `name` with `overrides`.
pub fn scenario(name: &str, overrides: &[&str]) -> Scenario {
    let overrides: Vec<String> = overrides.iter().map(|&entry| entry.to_owned()).collect();
    load(name, &overrides).unwrap()
}

/// It flown with `seed`, the yardstick beside it; nothing may diverge.
pub fn fly(name: &str, overrides: &[&str], seed: u64) -> Flight {
    let flight = record(&scenario(name, overrides), seed, Keep::All).unwrap();
    let of = flight.tracking;
    println!(
        "{name} {overrides:?}, seed {seed}: rms {:.2} mm (yardstick {:.2}), largest {:.1} mm, {:.2} mrad ({:.2}), velocity {:.1} mm/s",
        1e3 * of.position_rms,
        1e3 * of.yardstick_position_rms,
        1e3 * of.position_error_max,
        1e3 * of.attitude_rms,
        1e3 * of.yardstick_attitude_rms,
        1e3 * flight.state.velocity_rms
    );
    assert_eq!(flight.diverged, None, "{name}");
    flight
}

/// Largest magnitude of the error of parameter `index` in percent from `from` (s) to `to` (s); infinite where there is no
/// estimate.
pub fn worst(errors: &[Errors], index: usize, from: f64, to: f64) -> f64 {
    let inside = errors.iter().filter(|e| (from - 1e-6..to + 1e-6).contains(&e.t));
    inside.map(|e| e.all()[index].map_or(f64::INFINITY, f64::abs)).fold(0.0, f64::max)
}
