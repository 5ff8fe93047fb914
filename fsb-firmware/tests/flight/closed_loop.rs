//! The loop in flight, against the exact plant.

use std::cell::Cell;
use std::convert::Infallible;
use std::rc::Rc;

use crate::course;
use crate::plant::{FULL_DUTY, GEOMETRY, THRUST_MAX, Vehicle};
use embedded_hal::pwm::{ErrorType, SetDutyCycle};
use embedded_hal_mock::eh1::digital::{Mock as Pin, State, Transaction};
use fsb_core::estimator::StateStatus;
use fsb_firmware::{Allocation, ControlLoop, Event, LoopConfig};

const PERIOD: f64 = 1e-3;
const TICKS: usize = 10_000;

/// A motor whose duty the plant reads.
#[derive(Clone, Default)]
struct Motor(Rc<Cell<u16>>);

impl ErrorType for Motor {
    type Error = Infallible;
}

impl SetDutyCycle for Motor {
    fn max_duty_cycle(&self) -> u16 {
        FULL_DUTY
    }
    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.0.set(duty);
        Ok(())
    }
}

/// The vehicle is 20 % heavier and twice as inert as configured, starts off the course and tilted; the loop hands out
/// what it is, and flies the course.
#[test]
fn flies_the_course_and_weighs_the_vehicle() {
    let (mass, inertia) = (1.8, [0.03, 0.03, 0.06]);
    let mut vehicle = Vehicle::new(mass, inertia, [0.4, -0.3, 1.7, 0.1, -0.05, 0.2]);
    let motors: [Motor; 6] = std::array::from_fn(|_| Motor::default());
    let duties = motors.clone();
    let once = [Transaction::set(State::High), Transaction::set(State::Low)];
    let mut marker = Pin::new(&once.into_iter().cycle().take(2 * TICKS).collect::<Vec<_>>());
    let allocation = Allocation::new(&GEOMETRY.matrix(), THRUST_MAX).unwrap();
    let config = LoopConfig::new(PERIOD, 1.5, [0.015, 0.015, 0.03], allocation);
    let mut flight = ControlLoop::new(&config, motors, marker.clone()).unwrap();

    let mut worst = 0.0_f64;
    for tick in 0..TICKS {
        let time = tick as f64 * PERIOD;
        let wanted = course::at(time);
        let report = flight.tick(Some(&vehicle.sample()), &wanted).unwrap();
        assert_eq!(duties.clone().map(|motor| motor.0.get()), report.duties);
        if tick >= TICKS - 2000 {
            for (now, reference) in vehicle.position.iter().zip(&wanted) {
                worst = worst.max((now - f64::from(reference.position)).abs());
            }
        }
        vehicle.step(&report.duties, PERIOD);
    }
    marker.done();

    let known = flight.parameters().map(|parameter| parameter.expect("identified").inverse_with_sd());
    let truth = [mass, inertia[0], inertia[1], inertia[2]];
    for ((value, sd), truth) in known.into_iter().zip(truth) {
        println!("{value} +- {sd}, {truth}");
        assert!((f64::from(value) / truth - 1.0).abs() < 0.01, "{value} +- {sd}, {truth}");
    }
    println!("{worst}");
    assert!(worst < 0.01, "off the course by {worst} m or rad");
    assert_eq!(flight.state_status(), [StateStatus::Identified; 6]);
    let events: Vec<Event> = std::iter::from_fn(|| flight.events().take()).map(|stamped| stamped.event).collect();
    for parameter in 0..4 {
        assert!(events.contains(&Event::ParameterValid(parameter)), "{events:?}");
    }
}
