//! Ten seconds of flight at 1 kHz through three configurations, the vehicle's estimator and the regression with drag, told as a line
//! a second with the hash of every output bit so far, and the last outputs in full.

mod drag;
mod hash;
mod vehicle;

use core::fmt;

use self::hash::Hash;
use crate::scenario::{Faults, Scenario, Tick};
use crate::six::{Six, configs};
use fsb_core::estimator::{AxisDiagnostics, AxisState, Counters};
use fsb_core::readout::{Memory, Parameter, Readout};
use fsb_core::{Estimator, EstimatorConfig};

const SECONDS: u32 = 10;
const RATE: u32 = 1000;
/// Ticks at which one estimator's identification, then the other one entirely, begins anew.
const RESETS: [u32; 2] = [7000, 7500];

/// Runs all configurations and hands each line to `line`. `change` is added to the bits of the first measured position:
/// 0 is the flight, anything else shows that a bit is seen.
pub fn run(change: u32, line: &mut dyn FnMut(fmt::Arguments)) {
    let (translation, rotation) = configs(10, 1);
    fly("blocks", &translation, &rotation, change, line);
    let (translation, rotation) = configs(1, 1);
    fly("singles", &translation, &rotation, change, line);
    let (mut translation, mut rotation) = configs(4, 3);
    translation.readout = Readout::AbsoluteRatio;
    translation.memory = Memory::Fading { tau: 3.0 };
    rotation.memory = Memory::Fading { tau: 1.5 };
    rotation.noise_sd = Some(1e-4);
    rotation.nominal = [None; 3];
    fly("ramps", &translation, &rotation, change, line);
    vehicle::run(change, line);
    drag::run(change, line);
    line(format_args!("end"));
}

/// The number so many ulps away.
fn changed(value: f32, ulps: u32) -> f32 {
    f32::from_bits(value.to_bits().wrapping_add(ulps))
}

fn fly(
    name: &str,
    translation: &EstimatorConfig<3, 1>,
    rotation: &EstimatorConfig<3, 3>,
    change: u32,
    line: &mut dyn FnMut(fmt::Arguments),
) {
    let mut six = Six {
        translation: Estimator::new(translation).expect("a good configuration"),
        rotation: Estimator::new(rotation).expect("a good configuration"),
    };
    let substeps = translation.substeps;
    let mut scenario = Scenario::new(1e-3, Faults::Scripted);
    let (mut inputs, mut outputs) = (Hash::START, Hash::START);
    let mut before = [0.0; 6];
    for tick in 0..SECONDS * RATE {
        let mut now = scenario.step();
        if tick == 0
            && let Some([Some(first), ..]) = &mut now.positions
        {
            *first = changed(*first, change);
        }
        if tick == RESETS[0] {
            six.rotation.reset_identifier();
        }
        if tick == RESETS[1] {
            six.translation.reset();
        }
        hash_inputs(&now, &mut inputs);
        step(&mut six, &now, &before, substeps, tick, &mut outputs);
        before = now.inputs;
        if (tick + 1) % RATE == 0 {
            let second = (tick + 1) / RATE;
            line(format_args!("{name} {second} inputs {:016x} outputs {:016x}", inputs.0, outputs.0));
        }
    }
    last(name, &six, line);
}

/// One control tick, and all it puts out.
fn step(six: &mut Six, now: &Tick, before: &[f32; 6], substeps: u32, tick: u32, hash: &mut Hash) {
    if tick.is_multiple_of(substeps)
        && let Some([x, y, z, p, q, r]) = now.positions
    {
        let accepted = six.translation.measure(&[x, y, z]).is_ok() && six.rotation.measure(&[p, q, r]).is_ok();
        hash.word(u32::from(accepted));
    }
    hash_outputs(six, hash);
    let ([x, y, z, p, q, r], [x0, y0, z0, p0, q0, r0]) = (now.inputs, *before);
    if substeps == 1 {
        six.translation.apply(&[x, y, z]);
        six.rotation.apply(&[p, q, r]);
    } else {
        six.translation.apply_ramp(&[x0, y0, z0], &[x, y, z]);
        six.rotation.apply_ramp(&[p0, q0, r0], &[p, q, r]);
    }
}

fn hash_inputs(tick: &Tick, hash: &mut Hash) {
    for sample in tick.positions.iter().flatten() {
        hash.word(u32::from(sample.is_some()));
        hash.float(sample.unwrap_or(0.0));
    }
    tick.inputs.iter().for_each(|&input| hash.float(input));
}

fn hash_outputs(six: &Six, hash: &mut Hash) {
    let (t, r) = (&six.translation, &six.rotation);
    for state in t.states().iter().chain(&r.states()).chain(&t.state_sd()).chain(&r.state_sd()) {
        hash.state(state.as_ref());
    }
    t.state_status().iter().chain(&r.state_status()).for_each(|status| hash.state_status(*status));
    for parameter in t.parameters().iter().chain(&r.parameters()) {
        hash.parameter(parameter.as_ref());
    }
    t.parameter_status().iter().chain(&r.parameter_status()).for_each(|status| hash.parameter_status(*status));
    t.diagnostics().iter().chain(&r.diagnostics()).for_each(|axis| hash_diagnostics(axis, hash));
    for Counters { missed, rejected_measurements, rejected_inputs, .. } in [t.counters(), r.counters()] {
        [missed, rejected_measurements, rejected_inputs].iter().for_each(|&count| hash.word(count));
    }
}

fn hash_diagnostics(axis: &AxisDiagnostics, hash: &mut Hash) {
    let AxisDiagnostics { z2, z0, zu, innovation, noise_variance: [fine, band], numerator, denominator } = *axis;
    [z2, z0, zu, innovation, fine, band, numerator, denominator].iter().for_each(|&value| hash.float(value));
}

/// The last outputs, bit by bit.
fn last(name: &str, six: &Six, line: &mut dyn FnMut(fmt::Arguments)) {
    let (t, r) = (&six.translation, &six.rotation);
    for (axis, state) in t.states().iter().chain(&r.states()).enumerate() {
        match state {
            Some(AxisState { position, velocity }) => {
                line(format_args!("{name} state {axis} {:08x} {:08x}", position.to_bits(), velocity.to_bits()));
            }
            None => line(format_args!("{name} state {axis} none")),
        }
    }
    for (index, parameter) in t.parameters().iter().chain(&r.parameters()).enumerate() {
        match parameter {
            Some(Parameter { value, variance, .. }) => line(format_args!(
                "{name} parameter {index} {:08x} {:08x} about {value:.4}",
                value.to_bits(),
                variance.to_bits()
            )),
            None => line(format_args!("{name} parameter {index} none")),
        }
    }
    for (which, counters) in [t.counters(), r.counters()].iter().enumerate() {
        let Counters { missed, rejected_measurements, rejected_inputs, .. } = counters;
        line(format_args!("{name} counters {which} {missed} {rejected_measurements} {rejected_inputs}"));
    }
}
