//! What the loop asks of its peripherals, call by call.

use crate::plant::{GEOMETRY, THRUST_MAX, Vehicle};
use embedded_hal_mock::eh1::MockError;
use embedded_hal_mock::eh1::delay::{CheckedDelay, Transaction as Wait};
use embedded_hal_mock::eh1::digital::{Mock as Pin, State, Transaction as Set};
use embedded_hal_mock::eh1::pwm::{Mock as Motor, Transaction as Duty};
use fsb_core::control::Reference;
use fsb_core::estimator::StateStatus;
use fsb_core::guard::Verdict;
use fsb_core::vehicle::Group;
use fsb_firmware::{Allocation, ControlLoop, Event, LoopConfig, LoopConfigError, LoopError, Sample};
use std::io::ErrorKind;

const FULL: u16 = 1000;
/// The configured mass [kg].
const MASS: f64 = 1.5;
const HERE: [Reference; 6] = [Reference { position: 0.0, velocity: 0.0, acceleration: 0.0 }; 6];

fn config() -> LoopConfig {
    let allocation = Allocation::new(&GEOMETRY.matrix(), THRUST_MAX).unwrap();
    LoopConfig::new(1e-3, MASS, [0.015, 0.015, 0.03], allocation)
}

/// The duty at which six equally tilted motors carry the configured mass.
fn hover() -> u16 {
    (MASS * 9.81 / (6.0 * GEOMETRY.tilt.cos()) / THRUST_MAX * f64::from(FULL)).round() as u16
}

fn marker(ticks: usize) -> Pin {
    let once = [Set::set(State::High), Set::set(State::Low)];
    Pin::new(&once.into_iter().cycle().take(2 * ticks).collect::<Vec<_>>())
}

fn motor(duties: &[u16]) -> Motor {
    let calls = duties.iter().flat_map(|&duty| [Duty::max_duty_cycle(FULL), Duty::set_duty_cycle(duty)]);
    Motor::new(&calls.collect::<Vec<_>>())
}

fn motors(duties: &[u16]) -> [Motor; 6] {
    std::array::from_fn(|_| motor(duties))
}

fn done(parts: ([Motor; 6], Pin)) {
    let (motors, mut pin) = parts;
    motors.into_iter().for_each(|mut motor| motor.done());
    pin.done();
}

fn level() -> Sample {
    Vehicle::new(MASS, [0.015, 0.015, 0.03], [0.0; 6]).sample()
}

fn events(flight: &mut ControlLoop<Motor, Pin>) -> Vec<(u32, Event)> {
    std::iter::from_fn(|| flight.events().take()).map(|stamped| (stamped.tick, stamped.event)).collect()
}

/// What is told of two good samples, one a tick.
fn begun() -> Vec<(u32, Event)> {
    let usable = (0..6).map(|axis| (1, Event::StateUsable(axis, StateStatus::Nominal)));
    [(0, Event::AttitudeUsable)].into_iter().chain(usable).collect()
}

/// On the spot and at rest the motors carry the weight, each with its sixth; the marker is high once a tick, and the
/// delay is asked for once after each.
#[test]
fn hovers_paced_by_a_delay() {
    let mut flight = ControlLoop::new(&config(), motors(&[hover(); 3]), marker(3)).unwrap();
    let mut delay = CheckedDelay::new(&[Wait::delay_ns(990_000), Wait::delay_ns(990_000), Wait::delay_ns(990_000)]);
    let mut left = 3;
    flight
        .run(&mut delay, 990_000, || {
            left -= 1;
            (left >= 0).then_some((None, HERE))
        })
        .unwrap();
    delay.done();
    done(flight.release());
}

/// Far below where it shall be, every motor gives all it has, which is reported once, and so is its end.
#[test]
fn saturation_is_bounded_and_reported_once() {
    let duties = [hover(), FULL, FULL, hover()];
    let mut flight = ControlLoop::new(&config(), motors(&duties), marker(4)).unwrap();
    let mut high = HERE;
    high[2].position = 50.0;
    // No state before the second sample: the first tick is the fallback.
    assert_eq!(flight.tick(Some(&level()), &high).unwrap().saturated, 0);
    assert_eq!(flight.tick(Some(&level()), &high).unwrap().saturated, 0b11_1111);
    let report = flight.tick(Some(&level()), &high).unwrap();
    let lift = 6.0 * THRUST_MAX * GEOMETRY.tilt.cos();
    assert!((f64::from(report.input[2]) - lift).abs() < 1e-4, "{report:?}");
    flight.reset();
    flight.tick(None, &high).unwrap();
    let mut told = begun();
    told.extend([(1, Event::Saturated(0b11_1111)), (3, Event::Reset), (3, Event::SaturationOver)]);
    assert_eq!(events(&mut flight), told);
    done(flight.release());
}

/// One broken motor keeps neither the others from their duty nor the marker from going down.
#[test]
fn a_failing_motor_is_named() {
    let broken = MockError::Io(ErrorKind::NotConnected);
    let failing = [Duty::max_duty_cycle(FULL), Duty::set_duty_cycle(hover()).with_error(broken.clone())];
    let motors = std::array::from_fn(|index| if index == 4 { Motor::new(&failing) } else { motor(&[hover()]) });
    let mut flight = ControlLoop::new(&config(), motors, marker(1)).unwrap();
    assert_eq!(flight.tick(None, &HERE), Err(LoopError::Motor(4, broken)));
    done(flight.release());
}

#[test]
fn a_failing_marker_does_not_stop_the_motors() {
    let broken = MockError::Io(ErrorKind::NotConnected);
    let pin = Pin::new(&[Set::set(State::High).with_error(broken.clone()), Set::set(State::Low)]);
    let mut flight = ControlLoop::new(&config(), motors(&[hover()]), pin).unwrap();
    assert_eq!(flight.tick(None, &HERE), Err(LoopError::Marker(broken)));
    done(flight.release());
}

/// Samples that cannot be right are told and change no duty.
#[test]
fn bad_samples_are_told() {
    let mut flight = ControlLoop::new(&config(), motors(&[hover(); 3]), marker(3)).unwrap();
    for _ in 0..2 {
        flight.tick(Some(&level()), &HERE).unwrap();
    }
    let mut bad = level();
    bad.position[1] = Some(f32::INFINITY);
    bad.angles[0] = Some(1e9);
    bad.angles[1] = Some(f32::NAN);
    bad.attitude[1][1] = f32::NAN;
    flight.tick(Some(&bad), &HERE).unwrap();
    let rejected = |axis, verdict| (2, Event::MeasurementRejected(axis, verdict));
    let mut told = begun();
    told.extend([
        rejected(1, Verdict::NonFinite),
        rejected(3, Verdict::BeyondLimit),
        rejected(4, Verdict::NonFinite),
        (2, Event::AttitudeRejected),
    ]);
    assert_eq!(events(&mut flight), told);
    let [of_translation, of_rotation] = flight.rejections();
    assert_eq!((of_translation.non_finite, of_rotation.non_finite, of_rotation.beyond_limit), (1, 1, 1));
    assert_eq!(flight.counters().map(|counters| counters.missed), [1, 2]);
    done(flight.release());
}

#[test]
fn a_sample_between_two_instants_is_not_used() {
    let mut config = config();
    (config.translation.substeps, config.rotation.substeps) = (2, 2);
    let mut flight = ControlLoop::new(&config, motors(&[hover(); 4]), marker(4)).unwrap();
    flight.tick(Some(&level()), &HERE).unwrap();
    flight.tick(Some(&level()), &HERE).unwrap();
    flight.tick(Some(&level()), &HERE).unwrap();
    flight.tick(Some(&level()), &HERE).unwrap();
    let told: Vec<_> = events(&mut flight).into_iter().filter(|(_, e)| matches!(e, Event::SampleEarly(_))).collect();
    let wanted =
        [1, 3].map(|tick| [Group::Translation, Group::Rotation].map(|group| (tick, Event::SampleEarly(group))));
    assert_eq!(told, wanted.as_flattened());
    done(flight.release());
}

#[test]
fn a_wrong_configuration_is_named() {
    let refused = |change: fn(&mut LoopConfig)| {
        let mut config = config();
        change(&mut config);
        let (motors, pin) = (motors(&[]), marker(0));
        let error = ControlLoop::new(&config, motors.clone(), pin.clone()).err();
        done((motors, pin));
        error.expect("refused").to_string()
    };
    assert_eq!(refused(|c| c.rotation.period = 2e-3), LoopConfigError::PeriodsDiffer.to_string());
    assert_eq!(refused(|c| c.translation.block = 0), "translation: block must be at least 1");
    assert_eq!(refused(|c| c.rotation.turn = 10), "rotation: turn is out of range");
    assert_eq!(refused(|c| c.controllers[4].kp = 0.0), "controller of axis 4: kp must be positive");
    assert_eq!(refused(|c| c.rotation_guard.bridge = 0.0), "rotation: guard.bridge must be positive");
    assert_eq!(refused(|c| c.missing_after = -1.0), LoopConfigError::MissingAfter.to_string());
    assert_eq!(refused(|c| c.missing_after = 66.0), LoopConfigError::MissingAfter.to_string());
    assert_eq!(refused(|c| c.missing_after = f64::NAN), LoopConfigError::MissingAfter.to_string());
    assert_eq!(refused(|c| c.fallback[2] = f32::NAN), LoopConfigError::Fallback.to_string());
}
