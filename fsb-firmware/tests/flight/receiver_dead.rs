//! Nothing comes: from the start, for a while, on some axes.

use crate::receiver::{Flight, SECOND, config};
use fsb_core::estimator::StateStatus;
use fsb_core::guard::Verdict;
use fsb_firmware::{Event, Sample};

/// The tick at which flights are [`under_way`](Flight::under_way).
const FAILS: u32 = 10 * SECOND;
/// Control periods that the guards bridge, of translation and rotation.
const BRIDGE: [u32; 2] = [1000, 500];

fn each(tick: u32, axes: std::ops::Range<u8>, event: impl Fn(u8) -> Event) -> impl Iterator<Item = (u32, Event)> {
    axes.map(move |axis| (tick, event(axis))).collect::<Vec<_>>().into_iter()
}

fn missing(axis: u8) -> Event {
    Event::MeasurementRejected(axis, Verdict::Missing)
}

fn stale(axis: u8) -> Event {
    Event::StateLost(axis, StateStatus::Stale)
}

fn held(axis: u8) -> Event {
    Event::StateUsable(axis, StateStatus::Held)
}

/// The fallback from the first tick on, and it is told once the time is over that a gap may take. The flight begins when the
/// receiver does.
#[test]
fn from_the_start() {
    let mut flight = Flight::new(&config());
    flight.fly(3 * SECOND, |_| None);
    let never = |axis| Event::StateLost(axis, StateStatus::NotMeasured);
    let mut told: Vec<_> = [(BRIDGE[1], Event::AttitudeLost)].into();
    told.extend(each(BRIDGE[1], 3..6, never).chain(each(BRIDGE[0], 0..3, never)));
    assert_eq!(flight.events(), told);
    assert_eq!(flight.control.state_status(), [StateStatus::NotMeasured; 6]);
    // The fallback is its weight, and it started at rest.
    assert!(flight.vehicle.velocity.iter().all(|v| v.abs() < 0.01), "{:?}", flight.vehicle);

    let now = flight.tick;
    flight.fly(100, Some);
    let usable = |axis| Event::StateUsable(axis, StateStatus::Nominal);
    let mut told: Vec<_> = [(now, Event::AttitudeUsable)].into();
    told.extend(each(now + 1, 0..6, usable));
    assert_eq!(flight.events(), told);
    flight.recovers(10);
}

/// A gap that is bridged: the vehicle flies on what is predicted, and hardly leaves its course.
#[test]
fn for_a_twentieth_and_almost_half_a_second() {
    for (ticks, most) in [(50, 1e-3), (490, 1e-2)] {
        let mut flight = Flight::under_way(&config());
        flight.fly(ticks, |_| None);
        // Told once it is longer than `missing_after`; no state is lost.
        assert_eq!(flight.events(), each(FAILS + 20, 0..6, missing).collect::<Vec<_>>(), "{ticks}");
        assert!(flight.off[0] < most && flight.off[1] < most, "{:?}", flight.off);
        let back = flight.tick + SECOND - 1;
        flight.fly(SECOND, Some);
        assert_eq!(flight.events(), each(back, 0..6, Event::MeasuredAgain).collect::<Vec<_>>(), "{ticks}");
        assert!(flight.off[0] < most && flight.off[1] < most, "{:?}", flight.off);
        flight.recovers(8);
        assert_eq!(flight.events(), []);
    }
}

/// Longer than is bridged. Without an attitude nothing holds the vehicle upright, and it drifts away; the states are right again
/// with the second sample, the vehicle is upright again within a second, and flies back.
#[test]
fn for_five_seconds() {
    let mut flight = Flight::under_way(&config());
    flight.fly(5 * SECOND, |_| None);
    let lost = FAILS + BRIDGE[1];
    let mut told: Vec<_> = each(FAILS + 20, 0..6, missing).collect();
    told.push((lost, Event::AttitudeLost));
    told.extend(each(lost, 3..6, stale).chain(each(lost, 1..4, Event::ParameterHeld)));
    let lost = FAILS + BRIDGE[0];
    told.extend(each(lost, 0..3, stale).chain([(lost, Event::ParameterHeld(0))]));
    assert_eq!(flight.events(), told);
    println!("off {:?}", flight.off);

    let back = flight.tick;
    flight.fly(100, Some);
    let mut told: Vec<_> = [(back, Event::AttitudeUsable)].into();
    told.extend(each(back + 1, 0..6, held));
    assert_eq!(flight.events(), told);
    flight.fly(900, Some);
    flight.fly(1, Some);
    assert!(flight.off[1] < 0.1, "{:?}", flight.off);
    assert!(flight.error[0] < 1e-3 && flight.error[1] < 1e-2, "{:?}", flight.error);
    flight.recovers(25);
}

/// Without an attitude for a minute the vehicle is kilometres away, and fast: what can be asked is that nothing is handed out meanwhile,
/// that the states are right when the receiver is back, and that it is held upright and brakes.
#[test]
fn for_a_minute() {
    let mut flight = Flight::under_way(&config());
    flight.fly(60 * SECOND, |_| None);
    let lost = |event: &Event| matches!(event, Event::StateLost(..) | Event::AttitudeLost);
    assert_eq!(flight.events().iter().filter(|(_, event)| lost(event)).count(), 7);
    assert!(flight.last.unwrap().states.iter().all(Option::is_none));
    let falls = flight.vehicle.velocity[2];
    flight.fly(2 * SECOND, Some);
    flight.fly(1, Some);
    println!("off {:?}, states off {:?}", flight.off, flight.error);
    assert!(flight.off[1] < 0.5, "{:?}", flight.off);
    // At 15 km an f32 has a resolution of a millimetre.
    assert!(flight.error[0] < 5e-3 && flight.error[1] < 0.1, "{:?}", flight.error);
    flight.fly(8 * SECOND, Some);
    assert!(flight.off[1] < 0.5 && flight.vehicle.velocity[2] > 0.7 * falls, "{falls} {:?}", flight.vehicle);
    assert_eq!(flight.control.state_status(), [StateStatus::Identified; 6]);
}

/// The position alone, as where the attitude is a filter's on board: for a minute the vehicle is upright, goes on at the speed it
/// had, and flies back.
#[test]
fn the_position_for_a_minute() {
    let mut flight = Flight::under_way(&config());
    let before = flight.vehicle.velocity;
    flight.fly(60 * SECOND, |sample| Some(Sample { position: [None; 3], ..sample }));
    let lost = FAILS + BRIDGE[0];
    let mut told: Vec<_> = each(FAILS + 20, 0..3, missing).collect();
    told.extend(each(lost, 0..3, stale).chain([(lost, Event::ParameterHeld(0))]));
    assert_eq!(flight.events(), told);
    assert!(flight.off[1] < 1e-3, "{:?}", flight.off);
    // The second that was bridged has changed it.
    let speed = |v: [f64; 6]| v[..3].iter().map(|v| v * v).sum::<f64>().sqrt();
    let [before, after] = [speed(before), speed(flight.vehicle.velocity)];
    assert!((after - before).abs() < 0.2, "{before} {after}");
    let back = flight.tick;
    flight.fly(100, Some);
    assert_eq!(flight.events(), each(back + 1, 0..3, held).collect::<Vec<_>>());
    flight.recovers(40);
}

/// Where x alone is missing, y and z are flown as ever, and so is the attitude.
#[test]
fn one_axis_for_five_seconds() {
    let mut flight = Flight::under_way(&config());
    flight.fly(5 * SECOND, |mut sample| {
        sample.position[0] = None;
        Some(sample)
    });
    assert_eq!(flight.events(), [(FAILS + 20, missing(0)), (FAILS + BRIDGE[0], stale(0))]);
    let off = |axis: usize, flight: &Flight| {
        let wanted = crate::course::at(f64::from(flight.tick) * crate::receiver::PERIOD);
        (flight.vehicle.position[axis] - f64::from(wanted[axis].position)).abs()
    };
    assert!((1..6).all(|axis| off(axis, &flight) < 1e-3), "{:?}", flight.vehicle);
    let back = flight.tick;
    flight.fly(50, Some);
    assert_eq!(flight.events(), [(back, held(0)), (back, Event::ParameterHeld(0))]);
    flight.recovers(15);
}

/// The three positions begin together: where one has never come, none has a state, and all three have the fallback.
#[test]
fn one_axis_from_the_start() {
    let mut flight = Flight::new(&config());
    flight.fly(2 * SECOND, |mut sample| {
        sample.position[2] = None;
        Some(sample)
    });
    let told = flight.events();
    let never = |axis| (BRIDGE[0], Event::StateLost(axis, StateStatus::NotMeasured));
    assert!(told.contains(&never(0)) && told.contains(&never(1)), "{told:?}");
    assert!(told.contains(&(BRIDGE[0], stale(2))), "{told:?}");
    assert!(told.contains(&(20, missing(2))), "{told:?}");
    let states = flight.last.unwrap().states;
    assert!(states[..3].iter().all(Option::is_none) && states[3..].iter().all(Option::is_some), "{states:?}");
    assert!(flight.vehicle.velocity[..3].iter().all(|v| v.abs() < 0.05), "{:?}", flight.vehicle);
    flight.recovers(10);
}

/// Positions come, and no attitude: no force can be pointed. The fallback's is along the body's axes, and the mass is not learned from what
/// nobody knows.
#[test]
fn the_attitude_for_five_seconds() {
    let no_attitude = [[f32::NAN; 3]; 3];
    let mut flight = Flight::under_way(&config());
    flight.fly(5 * SECOND, |sample| Some(Sample { angles: [None; 3], attitude: no_attitude, ..sample }));
    let lost = FAILS + BRIDGE[1] - 1;
    let told = flight.events();
    assert_eq!(told[0], (FAILS, Event::AttitudeRejected));
    assert!(told.contains(&(lost + 1, Event::AttitudeLost)), "{told:?}");
    assert!((3..6).all(|axis| told.contains(&(lost + 1, stale(axis)))), "{told:?}");
    let mass = 1.0 / flight.control.parameters()[0].unwrap().value;
    assert!((mass - 1.5).abs() < 1e-3, "{mass}");
    let states = flight.last.unwrap().states;
    assert!(states[..3].iter().all(Option::is_some) && states[3..].iter().all(Option::is_none), "{states:?}");
    let back = flight.tick;
    flight.fly(50, Some);
    let told = flight.events();
    assert_eq!(told[0], (back, Event::AttitudeUsable));
    assert!((3..6).all(|axis| told.contains(&(back + 1, held(axis)))), "{told:?}");
    flight.recovers(25);
}

/// Angles come, and their matrix does not: the attitude is flown on, the position is not.
#[test]
fn the_matrix_for_five_seconds() {
    let mut flight = Flight::under_way(&config());
    flight.fly(5 * SECOND, |sample| Some(Sample { attitude: [[0.0; 3]; 3], ..sample }));
    assert_eq!(flight.events(), [(FAILS, Event::AttitudeRejected), (FAILS + BRIDGE[1], Event::AttitudeLost)]);
    assert!(flight.off[1] < 1e-3, "{:?}", flight.off);
    let back = flight.tick;
    flight.fly(50, Some);
    assert_eq!(flight.events(), [(back, Event::AttitudeUsable), (back, Event::ParameterHeld(0))]);
    flight.recovers(15);
}
