//! Recording a flight on the estimates: samples for drawing, errors, events, sums.

use fsb_core::readout::ParameterStatus;

use super::error::Refused;
use super::flight::{Moment, fly};
pub use super::outcome::{
    ERRORS_EVERY, Errors, Event, Flight, NAMES, ParameterEnd, Sample, StateErrors, TRACKING_FROM, Tracking,
};
use super::pilot::{Belief, CorePilot, Yardstick};
use super::scenario::Scenario;
use super::small_angle::SmallAngle;
use crate::hexarotor::vector::{difference, norm};
use crate::statistics::Squares;

/// Samples kept of a flight for drawing, at most.
const SAMPLES: u64 = 4000;

/// Tracking sums of one pilot.
#[derive(Clone, Copy, Debug)]
struct Sums {
    position: Squares,
    attitude: Squares,
    /// Not a number until there is one.
    height_max: f64,
    position_max: f64,
}

impl Sums {
    fn new() -> Self {
        Self {
            position: Squares::default(),
            attitude: Squares::default(),
            height_max: f64::NAN,
            position_max: f64::NAN,
        }
    }

    fn add(&mut self, moment: &Moment) {
        if moment.t < TRACKING_FROM - 1e-9 {
            return;
        }
        let error = moment.position_error();
        self.position.add(norm(error));
        self.attitude.add(norm(moment.attitude_error()));
        self.height_max = self.height_max.max(error[2].abs());
        self.position_max = self.position_max.max(norm(error));
    }
}

/// How much of a flight is kept beyond its sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Samples, the yardstick's flight, the small-angle model.
    All,
    /// Errors and events.
    Numbers,
}

/// Flies the scenario of `seed` (its draws are made here) on the estimates, and the yardstick beside it where all is kept.
///
/// # Errors
/// [`Refused`] where the scenario with its draws cannot be flown.
pub fn record(scenario: &Scenario, seed: u64, keep: Keep) -> Result<Flight, Refused> {
    let scenario = &scenario.drawn(seed);
    let every = scenario.ticks().div_ceil(SAMPLES).max(1);
    let mut recorder = Recorder::new(scenario, keep, every)?;
    let mut pilot = CorePilot::new(scenario, seed)?;
    let diverged = fly(scenario, seed, &mut pilot, |moment, pilot| recorder.add(moment, pilot))?;
    let mut flight = recorder.finish(diverged);
    if keep == Keep::All {
        yardstick(scenario, seed, every, &mut flight)?;
    }
    Ok(flight)
}

fn yardstick(scenario: &Scenario, seed: u64, every: u64, flight: &mut Flight) -> Result<(), Refused> {
    let (mut sums, mut errors) = (Sums::new(), Vec::with_capacity(flight.samples.len()));
    let diverged = fly(scenario, seed, &mut Yardstick::new(scenario)?, |moment, _| {
        sums.add(moment);
        if moment.tick.is_multiple_of(every) {
            errors.push([norm(moment.position_error()), norm(moment.attitude_error())]);
        }
    })?;
    for (sample, errors) in flight.samples.iter_mut().zip(errors) {
        sample.yardstick = errors;
    }
    let tracking = &mut flight.tracking;
    tracking.yardstick_position_rms = sums.position.rms();
    tracking.yardstick_attitude_rms = sums.attitude.rms();
    tracking.yardstick_height_error_max = sums.height_max;
    tracking.yardstick_position_error_max = sums.position_max;
    if let Some(t) = diverged {
        flight.events.push(Event { t, what: "the yardstick diverged".to_owned() });
    }
    Ok(())
}

struct Recorder {
    keep: Keep,
    every: u64,
    rate: f64,
    samples: Vec<Sample>,
    errors: Vec<Errors>,
    events: Vec<Event>,
    sums: Sums,
    state: [Squares; 3],
    small_angle: Option<(SmallAngle, Vec<Errors>)>,
    last: Option<(Moment, Belief)>,
    saturated: bool,
}

impl Recorder {
    fn new(scenario: &Scenario, keep: Keep, every: u64) -> Result<Self, Refused> {
        let small_angle = if keep == Keep::All { SmallAngle::new(scenario)? } else { None };
        Ok(Self {
            keep,
            every,
            rate: scenario.rate,
            samples: Vec::new(),
            errors: Vec::new(),
            events: Vec::new(),
            sums: Sums::new(),
            state: [Squares::default(); 3],
            small_angle: small_angle.map(|observer| (observer, Vec::new())),
            last: None,
            saturated: false,
        })
    }

    fn add(&mut self, moment: &Moment, pilot: &CorePilot) {
        let belief = pilot.belief();
        self.sums.add(moment);
        self.add_state(moment, &belief);
        self.note(moment, &belief);
        if let Some((observer, _)) = &mut self.small_angle {
            observer.tick(moment);
        }
        if self.keep == Keep::All && moment.tick.is_multiple_of(self.every) {
            self.samples.push(Sample { moment: *moment, belief, yardstick: [f64::NAN; 2] });
        }
        if moment.tick == self.next_errors() {
            let estimates = belief.parameters.map(|parameter| parameter.map(|p| f64::from(p.value)));
            self.errors.push(Errors::of(moment.t, percent(moment, estimates)));
            if let Some((observer, errors)) = &mut self.small_angle {
                let [x, y, z] = observer.inertia();
                errors.push(Errors::of(moment.t, percent(moment, [None, x, y, z])));
            }
        }
        self.last = Some((*moment, belief));
    }

    /// The tick nearest to the time of the next errors: at any rate they keep to [`ERRORS_EVERY`].
    fn next_errors(&self) -> u64 {
        (self.errors.len() as f64 * ERRORS_EVERY * self.rate).round() as u64
    }

    fn add_state(&mut self, moment: &Moment, belief: &Belief) {
        if moment.t < TRACKING_FROM - 1e-9 {
            return;
        }
        let truth = &moment.truth;
        let pairs =
            [(belief.position, truth.position), (belief.velocity, truth.velocity), (belief.rates, truth.body_rates)];
        for (squares, (estimate, truth)) in self.state.iter_mut().zip(pairs) {
            if let Some(estimate) = estimate {
                squares.add(norm(difference(estimate.map(f64::from), truth)));
            }
        }
    }

    /// Notes what has become different since the last tick.
    fn note(&mut self, moment: &Moment, belief: &Belief) {
        let t = moment.t;
        let mut event = |what: String| self.events.push(Event { t, what });
        let Some((before, believed)) = &self.last else { return };
        if before.parameters.mass != moment.parameters.mass {
            event(format!("payload: true mass {} kg", rounded(moment.parameters.mass)));
        }
        for ((name, was), is) in NAMES.iter().zip(believed.status).zip(belief.status) {
            match (was, is) {
                (a, b) if a == b => {}
                (_, ParameterStatus::Valid) => event(format!("{name} valid")),
                (ParameterStatus::Valid, ParameterStatus::Held) => {
                    event(format!("{name} identified anew, the old value held"));
                }
                (ParameterStatus::Valid, other) => event(format!("{name} no longer valid: {other}")),
                _ => {}
            }
        }
        for (name, was, is) in [
            ("position and velocity", believed.velocity.is_some(), belief.velocity.is_some()),
            ("attitude and rates", believed.rates.is_some(), belief.rates.is_some()),
        ] {
            match (was, is) {
                (false, true) => event(format!("{name} usable")),
                (true, false) => event(format!("{name} no longer usable")),
                _ => {}
            }
        }
        for (happened, what) in [
            (belief.events.mass_changed, "a change of the mass noticed"),
            (belief.events.inertia_changed, "a change of the moments of inertia noticed"),
            (belief.events.attitude_lost, "the attitude could not be followed"),
            (belief.events.wrench_rejected, "a wrench rejected"),
        ] {
            if happened {
                event(what.to_owned());
            }
        }
        if moment.saturated && !self.saturated {
            event("rotors at a limit for the first time".to_owned());
            self.saturated = true;
        }
    }

    fn finish(mut self, diverged: Option<f64>) -> Flight {
        if let Some(t) = diverged {
            self.events.push(Event { t, what: "diverged".to_owned() });
        }
        let unknown = ParameterEnd { real: f64::NAN, estimated: None, sd: None, valid: false };
        let mut parameters = [unknown; 4];
        if let Some((moment, belief)) = &self.last {
            for (i, end) in parameters.iter_mut().enumerate() {
                let estimate = belief.parameters[i];
                *end = ParameterEnd {
                    real: truths(moment)[i],
                    estimated: estimate.map(|p| f64::from(p.value)),
                    sd: estimate.map(|p| f64::from(p.sd())),
                    valid: belief.status[i] == ParameterStatus::Valid,
                };
            }
        }
        let [position, velocity, rates] = self.state.map(|squares| squares.rms());
        Flight {
            samples: self.samples,
            errors: self.errors,
            events: self.events,
            parameters,
            tracking: Tracking {
                position_rms: self.sums.position.rms(),
                attitude_rms: self.sums.attitude.rms(),
                yardstick_position_rms: f64::NAN,
                yardstick_attitude_rms: f64::NAN,
                height_error_max: self.sums.height_max,
                yardstick_height_error_max: f64::NAN,
                position_error_max: self.sums.position_max,
                yardstick_position_error_max: f64::NAN,
            },
            state: StateErrors { position_rms: position, velocity_rms: velocity, rates_rms: rates },
            small_angle: self.small_angle.map(|(_, errors)| errors),
            diverged,
            flown: self.last.map_or(0.0, |(moment, _)| moment.t),
        }
    }
}

/// m, I_x, I_y, I_z as they are.
pub fn truths(moment: &Moment) -> [f64; 4] {
    let [x, y, z] = moment.parameters.inertia;
    [moment.parameters.mass, x, y, z]
}

fn percent(moment: &Moment, estimates: [Option<f64>; 4]) -> [Option<f64>; 4] {
    let truths = truths(moment);
    std::array::from_fn(|i| estimates[i].map(|estimate| 100.0 * (estimate / truths[i] - 1.0)))
}

/// To the fourth decimal.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}
