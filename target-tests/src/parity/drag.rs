//! Ten seconds of the regression with drag and disturbance, at 1 kHz and at 100 Hz.

use core::fmt;

use super::hash::Hash;
use super::{SECONDS, changed};
use crate::drag::DragFlight;
use crate::vehicle::{Drag, drag_config};
use fsb_core::readout::Memory;
use fsb_core::regression::{DragDiagnostics, Term};

/// Both rates. The slow one forgets.
pub fn run(change: u32, line: &mut dyn FnMut(fmt::Arguments)) {
    fly("drag-1000", 1000, Memory::Infinite, change, line);
    fly("drag-100", 100, Memory::Fading { tau: 5.0 }, change, line);
}

fn fly(name: &str, rate: u32, memory: Memory, change: u32, line: &mut dyn FnMut(fmt::Arguments)) {
    let mut config = drag_config(1.0 / f64::from(rate));
    config.memory = memory;
    let mut drag = Drag::new(&config).expect("a good configuration");
    let mut flight = DragFlight::new(config.period, true);
    let (mut inputs, mut outputs) = (Hash::START, Hash::START);
    for tick in 0..SECONDS * rate {
        let (mut positions, forces) = flight.step();
        if tick == 0
            && let [Some(x), ..] = &mut positions
        {
            *x = changed(*x, change);
        }
        for position in &positions {
            inputs.floats(position.as_ref().map(core::slice::from_ref));
        }
        inputs.floats(Some(&forces));
        outputs.word(u32::from(drag.measure(&positions).is_ok()));
        hash_outputs(&drag, &mut outputs);
        drag.apply(&forces);
        if (tick + 1) % rate == 0 {
            let second = (tick + 1) / rate;
            line(format_args!("{name} {second} inputs {:016x} outputs {:016x}", inputs.0, outputs.0));
        }
    }
    last(name, &drag, line);
}

fn hash_outputs(drag: &Drag, hash: &mut Hash) {
    drag.states().iter().for_each(|state| hash.state(state.as_ref()));
    drag.state_status().into_iter().for_each(|status| hash.state_status(status));
    hash.parameter(drag.parameter().as_ref());
    hash.parameter_status(drag.parameter_status());
    for terms in drag.terms() {
        for term in [terms.drag, terms.disturbance] {
            match term {
                Term::Known { value, sd } => hash.floats(Some(&[value, sd])),
                Term::NotObservable => hash.word(2),
                _ => hash.word(3),
            }
        }
    }
    for variance in drag.residual_variance() {
        hash.floats(variance.as_ref().map(core::slice::from_ref));
    }
    for DragDiagnostics { z2, z0, zv, zu, residual, innovation } in drag.diagnostics() {
        hash.floats(Some(&[z2, z0, zv, zu, residual, innovation]));
    }
    let counters = drag.counters();
    for count in [counters.missed, counters.rejected_measurements, counters.rejected_inputs] {
        hash.word(count);
    }
}

/// The last outputs, bit by bit.
fn last(name: &str, drag: &Drag, line: &mut dyn FnMut(fmt::Arguments)) {
    match drag.parameter() {
        Some(k) => line(format_args!(
            "{name} parameter {:08x} {:08x} about {:.4}",
            k.value.to_bits(),
            k.variance.to_bits(),
            k.value
        )),
        None => line(format_args!("{name} parameter none")),
    }
    for (axis, terms) in drag.terms().iter().enumerate() {
        for (what, term) in [("drag", terms.drag), ("disturbance", terms.disturbance)] {
            match term.value() {
                Some(value) => line(format_args!("{name} {what} {axis} {:08x} about {value:.3}", value.to_bits())),
                None => line(format_args!("{name} {what} {axis} none")),
            }
        }
    }
}
