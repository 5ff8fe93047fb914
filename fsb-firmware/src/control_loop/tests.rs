//! The number of a tick decides nothing.

extern crate std;

use super::*;
use crate::events::StampedEvent;
use core::convert::Infallible;
use embedded_hal::digital::ErrorType as PinError;
use embedded_hal::pwm::ErrorType;
use plant::{FULL_DUTY, GEOMETRY, THRUST_MAX, Vehicle};
use std::vec::Vec;

#[path = "../plant.rs"]
mod plant;

struct Still;

impl ErrorType for Still {
    type Error = Infallible;
}

impl SetDutyCycle for Still {
    fn max_duty_cycle(&self) -> u16 {
        FULL_DUTY
    }
    fn set_duty_cycle(&mut self, _: u16) -> Result<(), Infallible> {
        Ok(())
    }
}

impl PinError for Still {
    type Error = Infallible;
}

impl OutputPin for Still {
    fn set_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
    fn set_high(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// Four seconds in the air from the tick `first` on, without a receiver for the second one and a half of them.
fn fly(first: u32) -> (Vec<Report>, Vec<StampedEvent>) {
    let mut vehicle = Vehicle::new(1.8, [0.03, 0.03, 0.06], [0.1, -0.2, 1.7, 0.1, -0.05, 0.2]);
    let allocation = Allocation::new(&GEOMETRY.matrix(), THRUST_MAX).unwrap();
    let config = LoopConfig::new(1e-3, 1.5, [0.015, 0.015, 0.03], allocation);
    let mut flight = ControlLoop::new(&config, [Still, Still, Still, Still, Still, Still], Still).unwrap();
    flight.tick = first;
    let (mut reports, mut events) = (Vec::new(), Vec::new());
    for tick in 0..4000 {
        let sample = vehicle.sample();
        let seen = !(1000..2500).contains(&tick);
        let report = flight.tick(seen.then_some(&sample), &[Reference::default(); 6]).unwrap();
        vehicle.step(&report.duties, 1e-3);
        reports.push(report);
        events.extend(core::iter::from_fn(|| flight.events().take()));
    }
    (reports, events)
}

/// The counter of ticks wraps in the middle of an outage, just when states are lost, when they are back: the same bits as in a flight that begins
/// at zero, and the same events with the numbers wrapped.
#[test]
fn the_tick_wraps() {
    let (reports, events) = fly(0);
    assert!(events.len() > 30, "{events:?}");
    for before in [1, 1100, 1500, 2000, 2501] {
        let first = 0_u32.wrapping_sub(before);
        let (wrapped, told) = fly(first);
        assert!(wrapped == reports, "{before}");
        let expected: Vec<_> = events.iter().map(|e| StampedEvent { tick: e.tick.wrapping_add(first), ..*e }).collect();
        assert_eq!(told, expected, "{before}");
        assert!(told.iter().any(|stamped| stamped.tick < 4000) && told.iter().any(|stamped| stamped.tick > 1 << 31));
    }
}
