//! The tick, counted, painted or traced; the argument says which. One program, so that what is counted is what is
//! disassembled.
//!
//! | argument | prints |
//! |---|---|
//! | `count` | instructions of every kind of tick, mean and worst over a minute from the start |
//! | `stack` | the stack that a tick has used at most |
//! | `size` | bytes of state and of design |
//! | `trace-blocks`, `trace-singles`, `trace-between`, `trace-one` | nothing: the emulator logs |
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use fsb_core::control::Reference;
use semihosting::{println, process};
use target_tests::board::{instructions, overhead};
use target_tests::cost::Cost;
use target_tests::scenario::{Faults, Scenario};
use target_tests::six::{
    DESIGN_BYTES, STATE_BYTES, Six, one, one_apply, one_measure, raw, six_apply, six_measure, six_parameters,
    six_states,
};
use target_tests::stack::stack_of;
use target_tests::whole_loop::{flight, loop_tick, sample};

/// A minute at 1 kHz.
const TICKS: u32 = 60_000;
/// Long enough for every parameter to become valid and every observer to be seeded.
const TRACED: u32 = 1_500;

#[entry]
fn main() -> ! {
    let arguments = semihosting::experimental::env::args::<128>().expect("arguments");
    let mut arguments = (&arguments).into_iter();
    let _ = arguments.next();
    match arguments.next() {
        Some(Ok("count")) => count(),
        Some(Ok("stack")) => stack(),
        Some(Ok("size")) => {
            println!("state {STATE_BYTES}");
            println!("design {DESIGN_BYTES}");
        }
        Some(Ok("trace-blocks")) => six_ticks(10, 1, TRACED, &mut |_, _| {}),
        Some(Ok("trace-singles")) => six_ticks(1, 1, TRACED, &mut |_, _| {}),
        Some(Ok("trace-between")) => six_ticks(10, 10, TRACED, &mut |_, _| {}),
        Some(Ok("trace-one")) => one_ticks(TRACED, &mut |_| {}),
        _ => {
            println!("which?");
            process::exit(2)
        }
    }
    println!("end");
    process::exit(0)
}

/// Instructions of the parts of a tick.
#[derive(Clone, Copy)]
struct Parts {
    measured: bool,
    measure: u32,
    states: u32,
    parameters: u32,
    apply: u32,
}

/// Ticks as a control loop runs them; `each` is told what every tick took.
fn six_ticks(block: u32, substeps: u32, ticks: u32, each: &mut dyn FnMut(u32, Parts)) {
    let mut six = Six::new(block, substeps);
    let mut scenario = Scenario::new(1e-3, Faults::Without);
    let nothing = overhead();
    for tick in 0..ticks {
        let now = scenario.step();
        let positions = raw(&now);
        let measured = tick.is_multiple_of(substeps);
        let start = instructions();
        if measured {
            let _ = black_box(six_measure(&mut six, &positions));
        }
        let a = instructions();
        let _ = black_box(six_states(&six));
        let b = instructions();
        let _ = black_box(six_parameters(&six));
        let c = instructions();
        six_apply(&mut six, &now.inputs);
        let d = instructions();
        let net = |from: u32, to: u32| to.wrapping_sub(from).saturating_sub(nothing);
        let measure = if measured { net(start, a) } else { 0 };
        each(tick, Parts { measured, measure, states: net(a, b), parameters: net(b, c), apply: net(c, d) });
    }
    let valid = six_parameters(&six).iter().all(Option::is_some);
    assert!(valid, "a parameter did not become valid: this is not the tick it is meant to be");
}

fn one_ticks(ticks: u32, each: &mut dyn FnMut(u32)) {
    let mut one = one();
    let mut scenario = Scenario::new(1e-3, Faults::Without);
    let nothing = overhead();
    for _ in 0..ticks {
        let now = scenario.step();
        let [x, ..] = raw(&now);
        let start = instructions();
        let _ = black_box(one_measure(&mut one, x));
        one_apply(&mut one, now.inputs[0]);
        let end = instructions();
        each(end.wrapping_sub(start).saturating_sub(nothing));
    }
    assert!(one.parameters()[0].is_some(), "the parameter did not become valid");
}

fn count() {
    for (name, block) in [("six_axes_blocks_of_10", 10), ("six_axes_block_1", 1)] {
        let mut tick_cost = Cost::new(name);
        let mut states = Cost::new(if block == 1 { "states_block_1" } else { "states_blocks_of_10" });
        let mut parameters = Cost::new(if block == 1 { "parameters_block_1" } else { "parameters_blocks_of_10" });
        six_ticks(block, 1, TICKS, &mut |tick, parts| {
            tick_cost.add(tick, parts.measure + parts.apply);
            states.add(tick, parts.states);
            parameters.add(tick, parts.parameters);
        });
        tick_cost.print();
        states.print();
        parameters.print();
    }
    let mut between = Cost::new("control_tick_without_measurement");
    six_ticks(10, 10, TICKS, &mut |tick, parts| {
        if !parts.measured {
            between.add(tick, parts.states + parts.apply);
        }
    });
    between.print();
    let (mut alone, mut tick) = (Cost::new("one_axis_block_1"), 0);
    one_ticks(TICKS, &mut |count| {
        alone.add(tick, count);
        tick += 1;
    });
    alone.print();
    whole_loop();
}

fn whole_loop() {
    let mut cost = Cost::new("control_loop_tick");
    let mut flight = flight().expect("a good configuration");
    let mut scenario = Scenario::new(1e-3, Faults::Without);
    let wanted = [Reference::default(); 6];
    let nothing = overhead();
    for tick in 0..TICKS {
        let sample = sample(&scenario.step());
        let start = instructions();
        let _ = black_box(loop_tick(&mut flight, &sample, &wanted));
        let end = instructions();
        cost.add(tick, end.wrapping_sub(start).saturating_sub(nothing));
    }
    cost.print();
}

fn stack() {
    let mut used = [0; 4];
    for (block, substeps) in [(10, 1), (1, 1), (3, 4)] {
        let mut six = Six::new(block, substeps);
        let mut scenario = Scenario::new(1e-3, Faults::Scripted);
        for tick in 0..8_000_u32 {
            let now = scenario.step();
            let positions = raw(&now);
            let mut parts = [0; 4];
            if tick.is_multiple_of(substeps) && now.positions.is_some() {
                parts[0] = stack_of(|| {
                    let _ = black_box(six_measure(&mut six, &positions));
                });
            }
            parts[1] = stack_of(|| {
                let _ = black_box(six_states(&six));
            });
            parts[2] = stack_of(|| {
                let _ = black_box(six_parameters(&six));
            });
            parts[3] = stack_of(|| six_apply(&mut six, &now.inputs));
            for (most, part) in used.iter_mut().zip(parts) {
                *most = part.max(*most);
            }
        }
    }
    for (name, bytes) in ["measure", "states", "parameters", "apply"].iter().zip(used) {
        println!("{name} {bytes}");
    }
}
