//! The vehicle's estimator and the regression with drag, counted or measured; the argument says which. A program of its own, so
//! that neither changes what the compiler makes of `tick`; for the same reason the functions that are counted are here, as one that is
//! exported from the library would be in every program.
//!
//! | argument | prints |
//! |---|---|
//! | `count` | instructions of every kind of call, mean and worst |
//! | `size` | bytes of what is kept |
//! | `stack` | the stack that a call has used at most |
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use fsb_core::estimator::{AxisState, OutOfStep};
use fsb_core::vehicle::{Attitude, Events, Measured, VehicleEstimator, VehicleState, Wrench};
use semihosting::{println, process};
use target_tests::board::{instructions, overhead};
use target_tests::cost::Cost;
use target_tests::drag::DragFlight;
use target_tests::random::Random;
use target_tests::rigid_body::{Conditions, RigidBody};
use target_tests::stack::stack_of;
use target_tests::vehicle::{Drag, FULL, PLAIN, Vehicle, drag_config, vehicle};

/// Half a minute at 1 kHz, from the start.
const TICKS: u32 = 30_000;

#[entry]
fn main() -> ! {
    let arguments = semihosting::experimental::env::args::<128>().expect("arguments");
    let mut arguments = (&arguments).into_iter();
    let _ = arguments.next();
    match arguments.next() {
        Some(Ok("count")) => count(),
        Some(Ok("stack")) => stack(),
        Some(Ok("size")) => {
            println!("vehicle {}", size_of::<VehicleEstimator<1>>());
            println!("drag_estimator {}", size_of::<Drag>());
        }
        _ => {
            println!("which?");
            process::exit(2)
        }
    }
    println!("end");
    process::exit(0)
}

fn count() {
    fly(&PLAIN, "vehicle_update", "vehicle_state");
    fly(&FULL, "vehicle_update_with_everything", "vehicle_state_with_everything");
    any_bits(&FULL, "vehicle_update_any_bits", "vehicle_state_any_bits");
    regress(1e-3, TICKS, "drag_tick_1000_hz");
    regress(1e-2, TICKS / 10, "drag_tick_100_hz");
}

fn fly(conditions: &Conditions, update_name: &'static str, state_name: &'static str) {
    let (mut update, mut state) = (Cost::new(update_name), Cost::new(state_name));
    let mut vehicle = vehicle(conditions);
    let mut body = RigidBody::new(*conditions);
    let mut applied = Wrench::default();
    let nothing = overhead();
    for tick in 0..TICKS {
        let (measured, told) = body.step();
        let start = instructions();
        let _ = black_box(vehicle_update(&mut vehicle, &measured, &applied));
        let middle = instructions();
        let _ = black_box(vehicle_state(&vehicle));
        let end = instructions();
        update.add(tick, middle.wrapping_sub(start).saturating_sub(nothing));
        state.add(tick, end.wrapping_sub(middle).saturating_sub(nothing));
        applied = told;
    }
    update.print();
    state.print();
    let valid = vehicle.mass().is_some() && vehicle.inertia().iter().all(Option::is_some);
    assert!(valid, "a parameter did not become valid: these are not the updates they are meant to be");
    let noticed = vehicle.counters().mass_changes > 0;
    assert!(noticed == conditions.loaded_at.is_some(), "the load should have been noticed, and nothing else");
}

/// In turns a quarter of a second of flight and one in which half of what comes is any bits.
fn any_bits(conditions: &Conditions, update_name: &'static str, state_name: &'static str) {
    let (mut update, mut state) = (Cost::new(update_name), Cost::new(state_name));
    let mut vehicle = vehicle(conditions);
    let mut body = RigidBody::new(*conditions);
    let mut applied = Wrench::default();
    let mut random = Random::START;
    let nothing = overhead();
    for tick in 0..TICKS {
        let (mut measured, told) = body.step();
        let mut spoil = |values: &mut [f32]| {
            for value in values {
                if random.word() & 1 == 0 {
                    *value = f32::from_bits(random.word());
                }
            }
        };
        if tick & 256 != 0 {
            spoil(&mut applied.force);
            spoil(&mut applied.torque);
            if let Some(position) = &mut measured.position {
                spoil(position);
            }
            let mut quaternion = [1.0, 0.0, 0.0, 0.0];
            spoil(&mut quaternion);
            if measured.attitude.is_some() && tick & 3 == 0 {
                measured.attitude = Some(Attitude::Quaternion(quaternion));
            }
        }
        let start = instructions();
        let _ = black_box(vehicle_update(&mut vehicle, &measured, &applied));
        let middle = instructions();
        let _ = black_box(vehicle_state(&vehicle));
        let end = instructions();
        update.add(tick, middle.wrapping_sub(start).saturating_sub(nothing));
        state.add(tick, end.wrapping_sub(middle).saturating_sub(nothing));
        applied = told;
    }
    update.print();
    state.print();
    let counters = vehicle.counters();
    let kinds = [counters.rejected_positions, counters.rejected_attitudes, counters.rejected_wrenches];
    assert!(kinds.iter().all(|&count| count > 100), "too little was wrong");
}

fn stack() {
    let mut used = [0; 2];
    for conditions in [PLAIN, FULL] {
        let conditions = Conditions { faults: true, ..conditions };
        let mut vehicle = vehicle(&conditions);
        let mut body = RigidBody::new(conditions);
        let mut applied = Wrench::default();
        for _ in 0..7_000 {
            let (measured, told) = body.step();
            let update = stack_of(|| {
                let _ = black_box(vehicle_update(&mut vehicle, &measured, &applied));
            });
            let state = stack_of(|| {
                let _ = black_box(vehicle_state(&vehicle));
            });
            used = [used[0].max(update), used[1].max(state)];
            applied = told;
        }
    }
    for (name, bytes) in ["update", "state"].iter().zip(used) {
        println!("{name} {bytes}");
    }
}

/// A tick: measured, states read, forces applied.
fn regress(period: f64, ticks: u32, name: &'static str) {
    let mut cost = Cost::new(name);
    let mut drag = Drag::new(&drag_config(period)).expect("a good configuration");
    let mut flight = DragFlight::new(period, false);
    let nothing = overhead();
    for tick in 0..ticks {
        let (positions, forces) = flight.step();
        let start = instructions();
        let _ = black_box(drag_measure(&mut drag, &positions));
        let _ = black_box(drag_states(&drag));
        drag_apply(&mut drag, &forces);
        let end = instructions();
        cost.add(tick, end.wrapping_sub(start).saturating_sub(nothing));
    }
    cost.print();
    let told = drag.terms().iter().all(|of| of.drag.value().is_some() && of.disturbance.value().is_some());
    assert!(
        drag.parameter().is_some() && told,
        "something was not identified: these are not the ticks they are meant to be"
    );
}

/// The update, by itself so that it can be counted and disassembled.
#[inline(never)]
#[unsafe(no_mangle)]
fn vehicle_update(vehicle: &mut Vehicle, measured: &Measured, applied: &Wrench) -> Events {
    vehicle.update(measured, applied)
}

/// What the controller reads.
#[inline(never)]
#[unsafe(no_mangle)]
fn vehicle_state(vehicle: &Vehicle) -> VehicleState {
    vehicle.state()
}

/// The regression: a tick's first half.
#[inline(never)]
#[unsafe(no_mangle)]
fn drag_measure(drag: &mut Drag, positions: &[Option<f32>; 3]) -> Result<(), OutOfStep> {
    drag.measure(positions)
}

/// The regression: a tick's second half.
#[inline(never)]
#[unsafe(no_mangle)]
fn drag_apply(drag: &mut Drag, inputs: &[f32; 3]) {
    drag.apply(inputs);
}

/// What the controller reads.
#[inline(never)]
#[unsafe(no_mangle)]
fn drag_states(drag: &Drag) -> [Option<AxisState>; 3] {
    drag.states()
}
