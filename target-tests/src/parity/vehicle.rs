//! Ten seconds of a vehicle at any attitude through its estimator.

use core::fmt;

use super::hash::Hash;
use super::{RATE, SECONDS, changed};
use crate::rigid_body::{Conditions, RigidBody};
use crate::vehicle::{FULL, PLAIN, Vehicle, config};
use fsb_core::readout::Memory;
use fsb_core::vehicle::{Attitude, Events, Group, Identified, Measured, VehicleState, Wrench};

/// The tick at which a group is identified anew, at which the loop was late, and at which all begins anew.
const BY_HAND: [u32; 3] = [6500, 7000, 8000];

/// Both flights: not late with everything measured at 1 kHz, and late with lag, a load picked up and fading memory.
pub fn run(change: u32, line: &mut dyn FnMut(fmt::Arguments)) {
    let plain = Conditions { position: [1, 0], faults: true, ..PLAIN };
    fly("vehicle", &plain, Memory::Infinite, change, line);
    fly("late", &Conditions { faults: true, ..FULL }, Memory::Fading { tau: 3.0 }, change, line);
}

fn fly(name: &str, conditions: &Conditions, memory: Memory, change: u32, line: &mut dyn FnMut(fmt::Arguments)) {
    let mut config = config(conditions);
    config.rotation.memory = memory;
    let mut vehicle = Vehicle::new(&config).expect("a good configuration");
    let mut body = RigidBody::new(*conditions);
    let (mut inputs, mut outputs) = (Hash::START, Hash::START);
    let (mut applied, mut first) = (Wrench::default(), true);
    for tick in 0..SECONDS * RATE {
        let (mut measured, told) = body.step();
        if first && let Some([x, ..]) = &mut measured.position {
            *x = changed(*x, change);
            first = false;
        }
        if tick == BY_HAND[0] {
            vehicle.reinitialise(Group::Rotation);
        }
        if tick == BY_HAND[1] {
            vehicle.missed(3);
        }
        if tick == BY_HAND[2] {
            vehicle.reset();
        }
        hash_inputs(&measured, &applied, &mut inputs);
        hash_events(&vehicle.update(&measured, &applied), &mut outputs);
        hash_outputs(&vehicle, &mut outputs);
        applied = told;
        if (tick + 1) % RATE == 0 {
            let second = (tick + 1) / RATE;
            line(format_args!("{name} {second} inputs {:016x} outputs {:016x}", inputs.0, outputs.0));
        }
    }
    last(name, &vehicle, line);
}

fn hash_inputs(measured: &Measured, applied: &Wrench, hash: &mut Hash) {
    hash.floats(measured.position.as_ref().map(<[f32; 3]>::as_slice));
    match &measured.attitude {
        Some(Attitude::Matrix(rows)) => hash.floats(Some(rows.as_flattened())),
        Some(Attitude::Quaternion(q)) => hash.floats(Some(q)),
        _ => hash.word(0),
    }
    applied.force.iter().chain(&applied.torque).for_each(|&value| hash.float(value));
}

fn hash_events(events: &Events, hash: &mut Hash) {
    let all = [
        events.attitude_rejected,
        events.attitude_lost,
        events.position_rejected,
        events.position_jumped,
        events.position_out_of_step,
        events.wrench_rejected,
        events.mass_changed,
        events.inertia_changed,
    ];
    hash.word(all.iter().fold(0, |bits, &happened| 2 * bits + u32::from(happened)));
}

fn hash_outputs(vehicle: &Vehicle, hash: &mut Hash) {
    let VehicleState { position, velocity, attitude, rates } = vehicle.state();
    for vector in [position, velocity, rates] {
        hash.floats(vector.as_ref().map(<[f32; 3]>::as_slice));
    }
    hash.floats(attitude.as_ref().map(|rows| rows.as_flattened()));
    hash_identified(vehicle.mass(), hash);
    vehicle.inertia().into_iter().for_each(|inertia| hash_identified(inertia, hash));
    hash.parameter_status(vehicle.mass_status());
    vehicle.inertia_status().into_iter().for_each(|status| hash.parameter_status(status));
    let model = vehicle.model();
    for value in [model.mass].into_iter().chain(model.inertia) {
        hash.floats(value.as_ref().map(core::slice::from_ref));
    }
    let (translation, rotation) = (vehicle.translation().state_status(), vehicle.rotation().state_status());
    translation.into_iter().chain(rotation).for_each(|status| hash.state_status(status));
    counted(vehicle).into_iter().for_each(|count| hash.word(count));
}

fn hash_identified(identified: Option<Identified>, hash: &mut Hash) {
    let all = identified.map(|known| [known.value, known.variance, known.sd()]);
    hash.floats(all.as_ref().map(<[f32; 3]>::as_slice));
}

fn counted(vehicle: &Vehicle) -> [u32; 8] {
    let of = vehicle.counters();
    [
        of.rejected_attitudes,
        of.lost_attitudes,
        of.rejected_positions,
        of.position_jumps,
        of.positions_out_of_step,
        of.rejected_wrenches,
        of.mass_changes,
        of.inertia_changes,
    ]
}

/// The last outputs, bit by bit.
fn last(name: &str, vehicle: &Vehicle, line: &mut dyn FnMut(fmt::Arguments)) {
    let VehicleState { position, velocity, rates, .. } = vehicle.state();
    for (what, vector) in [("position", position), ("velocity", velocity), ("rates", rates)] {
        match vector {
            Some([x, y, z]) => {
                line(format_args!("{name} {what} {:08x} {:08x} {:08x}", x.to_bits(), y.to_bits(), z.to_bits()));
            }
            None => line(format_args!("{name} {what} none")),
        }
    }
    for (index, known) in [vehicle.mass()].into_iter().chain(vehicle.inertia()).enumerate() {
        match known {
            Some(Identified { value, variance }) => line(format_args!(
                "{name} parameter {index} {:08x} {:08x} about {value:.4}",
                value.to_bits(),
                variance.to_bits()
            )),
            None => line(format_args!("{name} parameter {index} none")),
        }
    }
    line(format_args!("{name} counters {:?}", counted(vehicle)));
}
