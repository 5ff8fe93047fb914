//! Six axes: two estimators with their own tunings, six controllers.

use crate::config::{LoopConfig, LoopConfigError};
use crate::events::{Event, Events};
use crate::sample::Sample;
use fsb_core::control::{ControlError, Reference, TrackingController};
use fsb_core::estimator::{AxisState, Estimator, OutOfStep};
use fsb_core::readout::{Parameter, ParameterStatus};

/// The parameter of each axis among 1/m, 1/Ix, 1/Iy, 1/Iz.
const PARAMETER_OF: [usize; 6] = [0, 0, 0, 1, 2, 3];

#[derive(Debug)]
pub(crate) struct Axes {
    pub translation: Estimator<3, 1>,
    pub rotation: Estimator<3, 3>,
    controllers: [TrackingController; 6],
    nominal: [Option<f32>; 4],
    fallback: [f32; 6],
    /// As of the tick before, to tell what is new.
    status: [ParameterStatus; 4],
    rejected: u32,
    refused: [Option<ControlError>; 6],
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
        Ok(Self {
            translation: Estimator::new(t).map_err(LoopConfigError::Translation)?,
            rotation: Estimator::new(r).map_err(LoopConfigError::Rotation)?,
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
            status: [ParameterStatus::Settling; 4],
            rejected: 0,
            refused: [None; 6],
        })
    }

    pub fn measure(&mut self, sample: &Sample) -> Result<(), OutOfStep> {
        self.translation.measure(&sample.position)?;
        self.rotation.measure(&sample.angles)
    }

    pub fn apply(&mut self, &[x, y, z, p, q, r]: &[f32; 6]) {
        self.translation.apply(&[x, y, z]);
        self.rotation.apply(&[p, q, r]);
    }

    pub fn states(&self) -> [Option<AxisState>; 6] {
        let ([x, y, z], [p, q, r]) = (self.translation.states(), self.rotation.states());
        [x, y, z, p, q, r]
    }

    pub fn parameters(&self) -> [Option<Parameter>; 4] {
        let ([mass], [x, y, z]) = (self.translation.parameters(), self.rotation.parameters());
        [mass, x, y, z]
    }

    /// (11) before the rotation, and (13): world-frame force and torque.
    pub fn input(
        &mut self,
        states: &[Option<AxisState>; 6],
        wanted: &[Reference; 6],
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

    /// Tells what has changed since the last call.
    pub fn report(&mut self, tick: u32, events: &mut Events) {
        let ([mass], [x, y, z]) = (self.translation.parameter_status(), self.rotation.parameter_status());
        let status = [mass, x, y, z];
        for (index, (now, before)) in status.iter().zip(&self.status).enumerate() {
            match (*before == ParameterStatus::Valid, *now == ParameterStatus::Valid) {
                (false, true) => events.push(tick, Event::ParameterValid(index as u8)),
                (true, false) => events.push(tick, Event::ParameterLost(index as u8, *now)),
                _ => {}
            }
        }
        self.status = status;
        let rejected = [self.translation.counters(), self.rotation.counters()]
            .iter()
            .fold(0_u32, |sum, counters| sum.wrapping_add(counters.rejected_measurements));
        if rejected != self.rejected {
            events.push(tick, Event::MeasurementRejected(rejected.wrapping_sub(self.rejected)));
        }
        self.rejected = rejected;
    }

    pub fn reset(&mut self) {
        self.translation.reset();
        self.rotation.reset();
        self.status = [ParameterStatus::Settling; 4];
        self.refused = [None; 6];
    }
}
