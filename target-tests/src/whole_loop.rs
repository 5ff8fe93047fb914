//! The whole control loop, its tick as a function of its own.

use crate::peripherals::{Motor, Pin};
use crate::scenario::Tick;
use fsb_core::control::Reference;
use fsb_firmware::{Allocation, ControlLoop, LoopConfig, Report, Sample, TiltedHexarotor};

/// With peripherals that cost next to nothing.
pub type Flight = ControlLoop<Motor, Pin>;

/// A hexarotor of 1.5 kg at 1 kHz; `None` where its configuration is refused.
pub fn flight() -> Option<Flight> {
    let geometry = TiltedHexarotor { arm: 0.25, tilt: 0.35, drag_ratio: 0.02 };
    let allocation = Allocation::new(&geometry.matrix(), 6.0).ok()?;
    let config = LoopConfig::new(1e-3, 1.5, [0.015, 0.015, 0.03], allocation);
    ControlLoop::new(&config, [Motor::default(); 6], Pin::default()).ok()
}

/// A tick of the loop.
#[inline(never)]
#[unsafe(no_mangle)]
pub fn loop_tick(flight: &mut Flight, sample: &Sample, wanted: &[Reference; 6]) -> Option<Report> {
    flight.tick(Some(sample), wanted).ok()
}

/// The scenario's measurement, at level attitude.
pub fn sample(tick: &Tick) -> Sample {
    let [x, y, z, p, q, r] = tick.positions.unwrap_or([None; 6]);
    let attitude = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Sample { position: [x, y, z], angles: [p, q, r], attitude }
}
