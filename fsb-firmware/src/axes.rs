//! Six axes: two estimators behind gates, with their own tunings, and six controllers.

use crate::config::{LoopConfig, LoopConfigError};
use crate::events::{Event, Events};
use crate::sample::Sample;
use crate::watch::{Patience, Watch};
use fsb_core::control::{ControlError, Reference, TrackingController};
use fsb_core::estimator::{AxisState, Learning};
use fsb_core::guard::{Guarded, Verdict};
use fsb_core::readout::{Parameter, ParameterStatus};
use fsb_core::vehicle::Group;

/// The parameter of each axis among 1/m, 1/Ix, 1/Iy, 1/Iz.
const PARAMETER_OF: [usize; 6] = [0, 0, 0, 1, 2, 3];

#[derive(Debug)]
pub(crate) struct Axes {
    pub translation: Guarded<3, 1>,
    pub rotation: Guarded<3, 3>,
    controllers: [TrackingController; 6],
    nominal: [Option<f32>; 4],
    fallback: [f32; 6],
    of_translation: Watch<3>,
    of_rotation: Watch<3>,
    /// As of the tick before, to tell what is new.
    status: [ParameterStatus; 4],
    refused: [Option<ControlError>; 6],
    /// By group: samples come between its instants, and it was told.
    early: [bool; 2],
}

impl Axes {
    pub fn new(config: &LoopConfig) -> Result<Self, LoopConfigError> {
        let (t, r) = (&config.translation, &config.rotation);
        if t.period != r.period || t.substeps != r.substeps {
            return Err(LoopConfigError::PeriodsDiffer);
        }
        if !config.fallback.iter().all(|input| input.is_finite()) {
            return Err(LoopConfigError::Fallback);
        }
        let [a, b, c, d, e, f] = &config.controllers;
        let controller =
            |axis, of| TrackingController::new(of).map_err(|error| LoopConfigError::Controller(axis, error));
        let [mass] = t.nominal;
        let [x, y, z] = r.nominal;
        let (of_translation, of_rotation) = (&config.translation_guard, &config.rotation_guard);
        let translation = Guarded::new(t, of_translation).map_err(LoopConfigError::Translation)?;
        let rotation = Guarded::new(r, of_rotation).map_err(LoopConfigError::Rotation)?;
        Ok(Self {
            translation,
            rotation,
            controllers: [
                controller(0, a)?,
                controller(1, b)?,
                controller(2, c)?,
                controller(3, d)?,
                controller(4, e)?,
                controller(5, f)?,
            ],
            nominal: [mass, x, y, z].map(|k| k.map(|k| k as f32)),
            fallback: config.fallback,
            of_translation: Watch::new(0, patience(config, of_translation.bridge)?),
            of_rotation: Watch::new(3, patience(config, of_rotation.bridge)?),
            status: [ParameterStatus::Settling; 4],
            refused: [None; 6],
            early: [false; 2],
        })
    }

    /// What has come at this tick, if anything has. Returns whether its angles may be trusted, and what came with them: none that
    /// came was turned away.
    pub fn measure(&mut self, sample: Option<&Sample>, tick: u32, events: &mut Events) -> bool {
        let positions = sample.map(|sample| &sample.position);
        let angles = sample.map(|sample| &sample.angles);
        let [translation_early, rotation_early] = &mut self.early;
        match measure(&mut self.translation, positions) {
            Came::Instant(verdicts) => {
                self.of_translation.note(&verdicts, tick, events);
                *translation_early &= positions.is_none();
            }
            Came::Early => tell_early(translation_early, Group::Translation, tick, events),
            Came::Nothing => {}
        }
        match measure(&mut self.rotation, angles) {
            Came::Instant(verdicts) => {
                self.of_rotation.note(&verdicts, tick, events);
                *rotation_early &= angles.is_none();
                return verdicts.iter().all(|verdict| verdict.is_used() || *verdict == Verdict::Missing);
            }
            Came::Early => tell_early(rotation_early, Group::Rotation, tick, events),
            Came::Nothing => {}
        }
        true
    }

    /// Where forces point nowhere known they explain no motion.
    pub fn point(&mut self, known: bool) {
        self.translation.set_learning(if known { Learning::On } else { Learning::Contact });
    }

    pub fn apply(&mut self, &[x, y, z, p, q, r]: &[f32; 6]) {
        self.translation.apply(&[x, y, z]);
        self.rotation.apply(&[p, q, r]);
    }

    /// Told as well, where one has come or gone.
    pub fn states(&mut self, tick: u32, events: &mut Events) -> [Option<AxisState>; 6] {
        let (of_translation, of_rotation) = (self.translation.states(), self.rotation.states());
        self.of_translation.compare(&of_translation, || self.translation.state_status(), tick, events);
        self.of_rotation.compare(&of_rotation, || self.rotation.state_status(), tick, events);
        let ([x, y, z], [p, q, r]) = (of_translation, of_rotation);
        [x, y, z, p, q, r]
    }

    pub fn parameters(&self) -> [Option<Parameter>; 4] {
        let ([mass], [x, y, z]) = (self.translation.parameters(), self.rotation.parameters());
        [mass, x, y, z]
    }

    /// (11) before the rotation, and (13): world-frame force and torque. Where the force cannot be `pointed` it is the fallback.
    pub fn input(
        &mut self,
        states: &[Option<AxisState>; 6],
        wanted: &[Reference; 6],
        pointed: bool,
        tick: u32,
        events: &mut Events,
    ) -> [f32; 6] {
        let parameters = self.parameters();
        let mut input = self.fallback;
        let axes = input.iter_mut().zip(states).zip(wanted).zip(&self.controllers).zip(&mut self.refused);
        for (axis, ((((out, state), reference), controller), refused)) in axes.enumerate() {
            let index = PARAMETER_OF.get(axis).copied().unwrap_or(0);
            let known = parameters.get(index).copied().flatten().map(|parameter| parameter.value);
            let Some(k) = known.or(self.nominal.get(index).copied().flatten()) else { continue };
            let Some(state) = state else { continue };
            if index == 0 && !pointed {
                continue;
            }
            match controller.input(reference, state, k) {
                Ok(value) => {
                    *out = value;
                    *refused = None;
                }
                Err(error) => {
                    if *refused != Some(error) {
                        events.push(tick, Event::ControlRefused(axis as u8, error));
                    }
                    *refused = Some(error);
                }
            }
        }
        input
    }

    /// Tells what has changed of the parameters since the last call.
    pub fn report(&mut self, tick: u32, events: &mut Events) {
        let ([mass], [x, y, z]) = (self.translation.parameter_status(), self.rotation.parameter_status());
        let status = [mass, x, y, z];
        for ((now, before), index) in status.iter().zip(&self.status).zip(0..) {
            if now == before {
                continue;
            }
            let usable = |status| matches!(status, ParameterStatus::Valid | ParameterStatus::Held);
            match now {
                ParameterStatus::Valid => events.push(tick, Event::ParameterValid(index)),
                ParameterStatus::Held => events.push(tick, Event::ParameterHeld(index)),
                _ if usable(*before) => events.push(tick, Event::ParameterLost(index, *now)),
                _ => {}
            }
        }
        self.status = status;
    }

    pub fn reset(&mut self) {
        self.translation.reset();
        self.rotation.reset();
        self.of_translation.reset();
        self.of_rotation.reset();
        self.status = [ParameterStatus::Settling; 4];
        self.refused = [None; 6];
        self.early = [false; 2];
    }
}

/// What a tick was for a group.
enum Came<const N: usize> {
    /// A measurement instant, and what became of each measurement.
    Instant([Verdict; N]),
    /// A sample between two instants.
    Early,
    /// Between two instants, or before the first sample.
    Nothing,
}

fn measure<const N: usize, const P: usize>(group: &mut Guarded<N, P>, measured: Option<&[Option<f32>; N]>) -> Came<N> {
    let positions = match measured {
        Some(positions) => positions,
        // Nothing came at an instant.
        None if group.has_started() && group.is_due() => &[None; N],
        None => return Came::Nothing,
    };
    group.measure(positions).map_or(Came::Early, Came::Instant)
}

fn tell_early(told: &mut bool, group: Group, tick: u32, events: &mut Events) {
    if !*told {
        *told = true;
        events.push(tick, Event::SampleEarly(group));
    }
}

/// For a group that bridges gaps of `bridge` \[s\], which has been validated.
fn patience(config: &LoopConfig, bridge: f64) -> Result<Patience, LoopConfigError> {
    let of = &config.translation;
    let period = of.period * f64::from(of.substeps);
    if !(config.missing_after >= 0.0 && config.missing_after <= 65_534.0 * period) {
        return Err(LoopConfigError::MissingAfter);
    }
    Ok(Patience {
        // `as` takes what is larger to the largest.
        missing: libm::round(config.missing_after / period) as u16,
        quiet: libm::round(1.0 / period) as u16,
        start: libm::round(bridge / of.period) as u32,
    })
}
