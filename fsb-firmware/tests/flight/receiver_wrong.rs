//! What comes is wrong: no numbers, the same for ever, elsewhere, late; and an estimator that starts anew in flight.

use crate::receiver::{Flight, PERIOD, SECOND, config};
use fsb_core::estimator::StateStatus;
use fsb_core::guard::Verdict;
use fsb_core::vehicle::Group;
use fsb_firmware::{Event, Sample};

const FAILS: u32 = 10 * SECOND;

fn rejected(tick: u32, verdict: Verdict) -> Vec<(u32, Event)> {
    (0..6).map(|axis| (tick, Event::MeasurementRejected(axis, verdict))).collect()
}

/// Twenty of every fifty samples, for five seconds: told once.
#[test]
fn bursts_of_no_numbers() {
    let mut flight = Flight::under_way(&config());
    let mut count = 0;
    flight.fly(5 * SECOND, |sample| {
        count += 1;
        let nan = Sample { position: [Some(f32::NAN); 3], angles: [Some(f32::NAN); 3], attitude: [[f32::NAN; 3]; 3] };
        Some(if count % 50 < 20 { nan } else { sample })
    });
    let mut told = rejected(FAILS, Verdict::NonFinite);
    told.push((FAILS, Event::AttitudeRejected));
    assert_eq!(flight.events(), told);
    assert!(flight.off[0] < 1e-2 && flight.off[1] < 1e-3, "{:?}", flight.off);
    let of_reason = flight.control.rejections().map(|rejections| rejections.non_finite);
    assert_eq!(of_reason, [6000; 2]);
    flight.recovers(3);
}

/// The receiver gives what it gave last, for three seconds: noticed after 50 ms, and never taken for a sensor that lives, however
/// often the estimators have started anew meanwhile. It takes two samples that differ.
#[test]
fn frozen_altogether() {
    let mut flight = Flight::under_way(&config());
    let mut last = None;
    flight.fly(3 * SECOND, |sample| {
        last = last.or(Some(sample));
        last
    });
    let mut told = rejected(FAILS + 51, Verdict::Frozen);
    told.push((FAILS + 51, Event::AttitudeRejected));
    let lost =
        |tick, axes: std::ops::Range<u8>| axes.map(move |axis| (tick, Event::StateLost(axis, StateStatus::Stale)));
    told.push((FAILS + 551, Event::AttitudeLost));
    told.extend(lost(FAILS + 551, 3..6).chain((1..4).map(|index| (FAILS + 551, Event::ParameterHeld(index)))));
    told.extend(lost(FAILS + 1051, 0..3).chain([(FAILS + 1051, Event::ParameterHeld(0))]));
    assert_eq!(flight.events(), told);
    // Nor is it by a reset.
    flight.control.reset();
    flight.fly(400, |_| last);
    let told = flight.events();
    assert_eq!(told[0], (FAILS + 3 * SECOND, Event::Reset));
    assert!(!told.iter().any(|(_, event)| matches!(event, Event::StateUsable(..) | Event::AttitudeUsable)), "{told:?}");

    let back = flight.tick;
    flight.fly(100, Some);
    let mut told = vec![(back + 1, Event::AttitudeUsable)];
    told.extend((0..6).map(|axis| (back + 2, Event::StateUsable(axis, StateStatus::Nominal))));
    assert_eq!(flight.events(), told);
    flight.recovers(20);
}

/// Positions alone, the attitude being alive.
#[test]
fn frozen_positions() {
    let mut flight = Flight::under_way(&config());
    let mut last = None;
    flight.fly(5 * SECOND, |sample| {
        let position = *last.get_or_insert(sample.position);
        Some(Sample { position, ..sample })
    });
    let mut told = rejected(FAILS + 51, Verdict::Frozen);
    told.truncate(3);
    told.extend((0..3).map(|axis| (FAILS + 1051, Event::StateLost(axis, StateStatus::Stale))));
    told.push((FAILS + 1051, Event::ParameterHeld(0)));
    assert_eq!(flight.events(), told);
    assert!(flight.off[1] < 1e-3, "{:?}", flight.off);
    flight.recovers(20);
}

/// All zeros, as a receiver may give that has lost its signal: a jump to there is taken for one, and then they repeat.
#[test]
fn zeros() {
    let mut flight = Flight::under_way(&config());
    let zeros = Sample { position: [Some(0.0); 3], angles: [Some(0.0); 3], attitude: [[0.0; 3]; 3] };
    flight.fly(5 * SECOND, |_| Some(zeros));
    let told = flight.events();
    for axis in 0..6 {
        let (mut frozen, mut lost) = (false, false);
        for (tick, event) in &told {
            frozen |= *event == Event::MeasurementRejected(axis, Verdict::Frozen) && *tick <= FAILS + 52;
            lost |= *event == Event::StateLost(axis, StateStatus::Stale);
        }
        assert!(frozen && lost, "{axis} {told:?}");
    }
    assert!(told.contains(&(FAILS, Event::AttitudeRejected)), "{told:?}");
    assert!(flight.last.unwrap().states.iter().all(Option::is_none));
    flight.recovers(30);
}

/// Positions are 3 m elsewhere from now on: ten in a row that agree are the receiver's new origin. The vehicle flies where it
/// shall be by the receiver, and nothing is identified anew.
#[test]
fn a_jump_that_stays() {
    let mut flight = Flight::under_way(&config());
    let before = flight.control.parameters();
    let jumped = |mut sample: Sample| {
        sample.position[0] = sample.position[0].map(|x| x + 3.0);
        Some(sample)
    };
    flight.fly(100, jumped);
    let told = flight.events();
    let [first, (tick, Event::Jumped(0, by))] = told[..] else { panic!("{told:?}") };
    assert_eq!(first, (FAILS, Event::MeasurementRejected(0, Verdict::Improbable)));
    assert_eq!(tick, FAILS + 9);
    assert!((by - 3.0).abs() < 2e-3, "{by}");
    for (now, before) in flight.control.parameters().iter().zip(before) {
        let (now, before) = (now.unwrap().value, before.unwrap().value);
        assert!((now / before - 1.0).abs() < 1e-4, "{now} {before}");
    }
    flight.fly(15 * SECOND, jumped);
    flight.fly(2 * SECOND, jumped);
    assert!((flight.off[0] - 3.0).abs() < 0.02 && flight.off[1] < 1e-3, "{:?}", flight.off);
    assert!(!flight.events().iter().any(|(_, event)| matches!(event, Event::StateLost(..) | Event::ParameterHeld(_))));
    // And back.
    flight.recovers(15);
}

/// Single outliers of 3 m are told and move nothing.
#[test]
fn outliers() {
    let mut flight = Flight::under_way(&config());
    let mut count = 0;
    flight.fly(5 * SECOND, |mut sample| {
        count += 1;
        if count % 100 < 5 {
            sample.position[1] = sample.position[1].map(|y| y + 3.0);
            sample.angles[2] = sample.angles[2].map(|psi| psi + 1.0);
        }
        Some(sample)
    });
    let told = flight.events();
    let wanted = [
        (FAILS, Event::MeasurementRejected(1, Verdict::Improbable)),
        (FAILS, Event::MeasurementRejected(5, Verdict::Improbable)),
        // Its matrix is of the same attitude.
        (FAILS, Event::AttitudeRejected),
    ];
    assert_eq!(told, wanted);
    assert!(flight.off[0] < 5e-3 && flight.off[1] < 1e-3, "{:?}", flight.off);
    flight.recovers(3);
}

/// After an outage the first sample is the last one of before: what it does to the velocity is found within 20 ms.
#[test]
fn an_old_sample_after_an_outage() {
    let mut flight = Flight::under_way(&config());
    let old = flight.vehicle.sample();
    flight.fly(3 * SECOND, |_| None);
    flight.events();
    let back = flight.tick;
    flight.fly(1, |_| Some(old));
    flight.fly(50, Some);
    let told = flight.events();
    for axis in [0, 1, 2, 5] {
        let pushed = |(tick, event): &(u32, Event)| {
            matches!(event, Event::Pushed(which, _) if *which == axis) && *tick < back + 20
        };
        assert!(told.iter().any(pushed), "{axis} {told:?}");
    }
    flight.fly(100, Some);
    assert!(flight.error[0] < 1e-3 && flight.error[1] < 2e-2, "{:?}", flight.error);
    flight.recovers(20);
}

/// A reset in flight: the fallback for one tick, then the nominal parameters, then the identified ones.
#[test]
fn a_reset_in_flight() {
    let mut flight = Flight::under_way(&config());
    flight.control.reset();
    flight.fly(1, Some);
    assert!(flight.last.unwrap().states.iter().all(Option::is_none));
    flight.fly(5 * SECOND, Some);
    let told = flight.events();
    assert_eq!(told[0], (FAILS, Event::Reset));
    let usable = (0..6).map(|axis| (FAILS + 1, Event::StateUsable(axis, StateStatus::Nominal)));
    assert_eq!(told[1..7], usable.collect::<Vec<_>>());
    assert!((0..4).all(|index| told.iter().any(|(_, event)| *event == Event::ParameterValid(index))), "{told:?}");
    assert!(flight.off[0] < 0.1 && flight.off[1] < 0.05, "{:?}", flight.off);
    flight.recovers(8);
}

/// A receiver of 100 Hz that is one tick late from some time on: all of it is early or late, none is used, and the loop says so; then it
/// starts anew in step with it.
#[test]
fn out_of_step() {
    let mut config = config();
    for substeps in [&mut config.translation.substeps, &mut config.rotation.substeps] {
        *substeps = 10;
    }
    (config.translation.block, config.rotation.block, config.rotation.turn) = (1, 1, 0);
    (config.translation_guard.frozen_after, config.rotation_guard.frozen_after) = (5, 5);
    let mut flight = Flight::new(&config);
    let mut tick = 0;
    let receiver = |late: u32| {
        move |sample| {
            tick += 1;
            (tick % 10 == 1 + late).then_some(sample)
        }
    };
    flight.fly(10 * SECOND, receiver(0));
    flight.events();
    flight.fly(3 * SECOND, receiver(3));
    let told = flight.events();
    assert_eq!(told[0], (FAILS + 3, Event::SampleEarly(Group::Translation)));
    assert_eq!(told[1], (FAILS + 3, Event::SampleEarly(Group::Rotation)));
    let count = |wanted: fn(&Event) -> bool| told.iter().filter(|(_, event)| wanted(event)).count();
    assert_eq!(count(|event| matches!(event, Event::SampleEarly(_))), 2);
    assert_eq!(count(|event| matches!(event, Event::StateLost(..))), 6);
    assert_eq!(count(|event| matches!(event, Event::StateUsable(..))), 6);
    flight.fly(15 * SECOND, receiver(3));
    flight.fly(2 * SECOND, receiver(3));
    println!("{:?} {:?} s", flight.off, f64::from(flight.tick) * PERIOD);
    assert!(flight.off[0] < 0.02 && flight.off[1] < 0.02, "{:?}", flight.off);
}

/// Frames of a slow port, 38 a second in a loop of 1 kHz, then none for three seconds.
#[test]
fn a_slow_receiver_dies() {
    let mut config = config();
    config.missing_after = 0.1;
    for guard in [&mut config.translation_guard, &mut config.rotation_guard] {
        guard.frozen_after = 4;
    }
    let mut flight = Flight::new(&config);
    let mut tick = 0;
    let mut slow = |sample| {
        tick += 1;
        (tick % 26 == 1).then_some(sample)
    };
    flight.fly(18 * SECOND, &mut slow);
    flight.fly(2 * SECOND, &mut slow);
    let before = flight.off;
    let told = flight.events();
    assert!(!told.iter().any(|(_, event)| matches!(event, Event::MeasurementRejected(..))), "{told:?}");
    flight.fly(3 * SECOND, |_| None);
    let told = flight.events();
    let lost = told.iter().filter(|(_, event)| matches!(event, Event::StateLost(..))).count();
    let missed =
        told.iter().filter(|(_, event)| matches!(event, Event::MeasurementRejected(_, Verdict::Missing))).count();
    assert_eq!((missed, lost), (6, 6), "{told:?}");
    flight.fly(30 * SECOND, &mut slow);
    flight.fly(2 * SECOND, &mut slow);
    println!("off {before:?} before, {:?} after", flight.off);
    assert!(flight.off.iter().zip(before).all(|(after, before)| *after < 1.5 * before), "{:?}", flight.off);
}
