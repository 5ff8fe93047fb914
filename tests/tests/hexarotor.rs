//! The hexarotor against motions known in closed form, its allocation against geometry done by hand.

#[path = "hexarotor/air.rs"]
mod air;
#[path = "hexarotor/allocation.rs"]
mod allocation;
#[path = "hexarotor/attitude.rs"]
mod attitude;
#[path = "hexarotor/configuration.rs"]
mod configuration;
#[path = "hexarotor/limits.rs"]
mod limits;
#[path = "hexarotor/payload.rs"]
mod payload;
#[path = "hexarotor/rotation.rs"]
mod rotation;
#[path = "hexarotor/rotors.rs"]
mod rotors;
#[path = "hexarotor/translation.rs"]
mod translation;

use fsb_sim_host::hexarotor::vector::{Vector, difference, norm};
use fsb_sim_host::hexarotor::{Hexarotor, HexarotorConfig};

/// 1 kHz.
const TICK: f64 = 1e-3;

fn built(config: &HexarotorConfig) -> Hexarotor {
    Hexarotor::new(config).unwrap()
}

/// Flies `seconds` with the commands held.
fn fly(vehicle: &mut Hexarotor, commands: [f64; 6], seconds: f64) {
    for _ in 0..(seconds / TICK).round() as u64 {
        vehicle.step(&commands, TICK);
    }
}

#[track_caller]
fn close(found: Vector, expected: Vector, within: f64) {
    let off = norm(difference(found, expected));
    assert!(off <= within, "{found:?}, expected {expected:?}: off by {off:e}");
}
