//! The plant: thrust commands in, motion out.

use super::allocation::{Allocation, Allocator, Attainable};
use super::attitude::Quaternion;
use super::body::Body;
use super::config::{DragConfig, HexarotorConfig, Payload, PayloadStep};
use super::error::ParameterError;
use super::frame::{Frame, Wrench};
use super::rotors::Rotors;
use super::vector::{Vector, sum};
use super::wind::Wind;

/// Two times closer than this [s] are the same.
const SAME_TIME: f64 = 1e-9;

/// Where the vehicle is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// t [s], the sum of all steps, exact to its last digit or two.
    pub time: f64,
    /// x in the world frame, z up [m].
    pub position: Vector,
    /// x' in the world frame [m/s].
    pub velocity: Vector,
    /// From body to world coordinates.
    pub attitude: Quaternion,
    /// ω in the body frame [rad/s].
    pub body_rates: Vector,
}

/// What an estimator is to find.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrueParameters {
    /// m with payload [kg].
    pub mass: f64,
    /// I_x, I_y, I_z with payload [kg m²].
    pub inertia: [f64; 3],
}

/// A hexarotor in flight.
#[derive(Clone, Debug)]
pub struct Hexarotor {
    config: HexarotorConfig,
    allocator: Allocator,
    rotors: Rotors,
    wind: Wind,
    payload: Payload,
    /// How many of the configured steps of the payload have been taken.
    payloads_taken: usize,
    state: State,
    /// What rounding has left out of `state.time` [s]: added up plainly, 10 h of 1 kHz would be off by more than a tick.
    time_rest: f64,
}

impl Hexarotor {
    /// At rest, or as `start` of the configuration says, at t = 0.
    ///
    /// # Errors
    /// Names the first parameter that cannot be right.
    pub fn new(config: &HexarotorConfig) -> Result<Self, ParameterError> {
        config.check()?;
        let start = &config.start;
        let frame = Frame::new(&config.frame, &config.rotor);
        let allocator = Allocator::new(frame, [config.rotor.thrust_min, config.rotor.thrust_max]);
        let mut vehicle = Self {
            config: config.clone(),
            rotors: Rotors::new(&config.rotor, config.rotor.thrust_min),
            allocator,
            wind: Wind::new(&config.wind),
            payload: Payload::default(),
            payloads_taken: 0,
            state: State {
                time: 0.0,
                position: start.position,
                velocity: start.velocity,
                attitude: Quaternion::from_euler(start.attitude),
                body_rates: start.body_rates,
            },
            time_rest: 0.0,
        };
        vehicle.follow_payload();
        let hover = vehicle.allocate([0.0, 0.0, vehicle.weight()], [0.0; 3]).thrusts;
        vehicle.rotors = Rotors::new(&config.rotor, hover[0]);
        Ok(vehicle)
    }

    /// Where it is now.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Moves `dt` [s] ahead with the commands [N] held, each within its limits (T_min for a NaN). Wind and payload are held
    /// too; the integration takes equal steps of at most `max_step`. A `dt` that is not positive and finite moves nothing.
    pub fn step(&mut self, thrust_commands: &[f64; 6], dt: f64) {
        if !(dt > 0.0 && dt.is_finite()) {
            return;
        }
        self.rotors.command(&thrust_commands.map(|command| self.allocator.limited(command)));
        let body = self.body();
        // A tick of just max_step is one step, whatever the rounding of their ratio.
        let steps = (dt / self.config.max_step * (1.0 - 1e-12)).ceil().max(1.0);
        let step = dt / steps;
        let frame = self.allocator.frame();
        let mut now = self.rotors.actuation(frame);
        for _ in 0..steps as u64 {
            let through = if self.rotors.lags() {
                self.rotors.advance(step / 2.0);
                let middle = self.rotors.actuation(frame);
                self.rotors.advance(step / 2.0);
                [now, middle, self.rotors.actuation(frame)]
            } else {
                [now; 3]
            };
            body.step(&mut self.state, &through, step);
            now = through[2];
        }
        self.advance_time(dt);
        self.wind.advance(dt);
        self.follow_payload();
    }

    /// The wrench that the given thrusts [N] have on the body, without the rotors' own momentum and without drag.
    pub fn wrench(&self, thrusts: &[f64; 6]) -> Wrench {
        self.allocator.frame().wrench(thrusts)
    }

    /// The thrusts of a force [N] and a torque [N m] in the body frame, see [`Allocator::allocate`].
    pub fn allocate(&self, force_body: Vector, torque_body: Vector) -> Allocation {
        self.allocator.allocate(force_body, torque_body)
    }

    /// Allocation and limits.
    pub fn allocator(&self) -> &Allocator {
        &self.allocator
    }

    /// What can be done with the present mass; `None` if the rotors cannot carry it.
    pub fn attainable(&self) -> Option<Attainable> {
        self.allocator.attainable(self.weight())
    }

    /// Thrusts of the rotors now [N]; they differ from the commands by the lag.
    pub fn thrusts(&self) -> [f64; 6] {
        self.rotors.thrusts()
    }

    /// Speeds of the rotors now [rad/s].
    pub fn rotor_speeds(&self) -> [f64; 6] {
        self.rotors.speeds()
    }

    /// Velocity of the air in the world frame, held over the coming tick [m/s].
    pub fn wind(&self) -> Vector {
        self.wind.velocity()
    }

    /// From now on the vehicle carries `payload` and nothing else. The velocities stay: what is picked up moves as the
    /// vehicle does when it is attached, and what is dropped takes its momentum along.
    ///
    /// # Errors
    /// Names the first parameter that cannot be right; then nothing changes.
    pub fn set_payload(&mut self, payload: Payload) -> Result<(), ParameterError> {
        payload.check().map_err(|error| error.within("payload"))?;
        self.payload = payload;
        Ok(())
    }

    /// m and I at present.
    pub fn true_parameters(&self) -> TrueParameters {
        TrueParameters {
            mass: self.config.mass + self.payload.mass,
            inertia: sum(self.config.inertia, self.payload.inertia),
        }
    }

    /// Kahan's sum.
    fn advance_time(&mut self, dt: f64) {
        let wanted = dt + self.time_rest;
        let time = self.state.time + wanted;
        self.time_rest = wanted - (time - self.state.time);
        self.state.time = time;
    }

    fn weight(&self) -> f64 {
        self.true_parameters().mass * self.config.gravity
    }

    fn follow_payload(&mut self) {
        let due = |step: &&PayloadStep| step.at <= self.state.time + SAME_TIME;
        for step in self.config.payload[self.payloads_taken..].iter().take_while(due) {
            self.payload = step.payload;
            self.payloads_taken += 1;
        }
    }

    fn body(&self) -> Body {
        let TrueParameters { mass, inertia } = self.true_parameters();
        let DragConfig { linear, quadratic, .. } = self.config.drag;
        Body {
            mass,
            inertia,
            gravity: self.config.gravity,
            drag: self.config.drag,
            feels_air: linear.iter().chain(&quadratic).any(|&c| c > 0.0),
            wind: self.wind.velocity(),
        }
    }
}
