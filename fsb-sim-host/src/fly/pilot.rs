//! What flies the loop: from what is measured to a wrench.

use fsb_core::control::{Motion, VehicleController, VehicleReference};
use fsb_core::readout::ParameterStatus;
use fsb_core::vehicle::{Attitude, Events, Identified, Measured, VehicleEstimator, VehicleState, Wrench};

use super::bus::Bus;
use super::error::Refused;
use super::reference::{narrow, narrow_matrix};
use super::scenario::Scenario;
use crate::hexarotor::vector::Vector;
use crate::hexarotor::{Quaternion, State, TrueParameters};

/// Control periods of latency that the pilot's estimator can make up for.
pub const LATEST: usize = 256;

/// What is there at one tick. `truth` and `parameters` are for a pilot that is a yardstick; the estimator must not look at
/// them.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// What shall be flown.
    pub reference: VehicleReference,
    /// A position that arrives at this tick [m].
    pub position: Option<Vector>,
    /// An attitude that arrives at this tick.
    pub attitude: Option<Quaternion>,
    /// What the rotors were told over the period that ends now.
    pub applied: Wrench,
    /// The vehicle as it is.
    pub truth: State,
    /// m and I as they are.
    pub parameters: TrueParameters,
}

/// What flies. The wrench [N, N m] it gives is in the body frame, before the limits of the rotors.
pub trait Pilot {
    /// One tick.
    fn tick(&mut self, sight: &Sight) -> Wrench;
}

/// What the estimator hands out at one tick; `None` where it is no number yet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belief {
    /// m [kg], I_x, I_y, I_z [kg m²].
    pub parameters: [Option<Identified>; 4],
    /// Why they may be used or not.
    pub status: [ParameterStatus; 4],
    /// World frame [m].
    pub position: Option<[f32; 3]>,
    /// World frame [m/s].
    pub velocity: Option<[f32; 3]>,
    /// Body to world, by rows.
    pub attitude: Option<[[f32; 3]; 3]>,
    /// Body frame [rad/s].
    pub rates: Option<[f32; 3]>,
    /// What the update of this tick told.
    pub events: Events,
}

/// The f32 core in the loop, as a flight controller would call it. Where a state is not usable yet, the last measurement
/// stands in for position and attitude, and the reference for velocity and rates; before the first measurement the reference
/// stands in for all.
#[derive(Clone, Debug)]
pub struct CorePilot {
    bus: Bus,
    estimator: VehicleEstimator<LATEST>,
    controller: VehicleController,
    /// In place of parameters neither identified nor guessed.
    guess: [f32; 4],
    measured: (Option<[f32; 3]>, Option<[[f32; 3]; 3]>),
    state: VehicleState,
    events: Events,
    wrench: Wrench,
}

impl CorePilot {
    /// Of a scenario; the faults of its bus are those of `seed`.
    ///
    /// # Errors
    /// What the core refuses, and shares of faults that are none.
    pub fn new(scenario: &Scenario, seed: u64) -> Result<Self, Refused> {
        let config = scenario.estimator.estimator(scenario);
        let latest = config.translation.latency.max(config.rotation.latency);
        if latest as usize > LATEST {
            return Err(Refused::TooLate(latest, LATEST));
        }
        if config.translation.latency < config.rotation.latency {
            return Err(Refused::AttitudeLater(config.rotation.latency, config.translation.latency));
        }
        let [mass, ix, iy, iz] = [config.mass, config.inertia[0], config.inertia[1], config.inertia[2]];
        let guess = [mass, ix, iy, iz].map(|p| p.nominal.unwrap_or((p.min * p.max).sqrt()) as f32);
        Ok(Self {
            bus: Bus::new(&scenario.bus, seed)?,
            estimator: VehicleEstimator::new(&config).map_err(|error| Refused::Core("estimator", error))?,
            controller: scenario.control.controller(scenario.plant.gravity)?,
            guess,
            measured: (None, None),
            state: VehicleState::default(),
            events: Events::default(),
            wrench: Wrench::default(),
        })
    }

    /// What it believes now.
    pub fn belief(&self) -> Belief {
        let (state, [x, y, z]) = (&self.state, self.estimator.inertia());
        let [sx, sy, sz] = self.estimator.inertia_status();
        Belief {
            parameters: [self.estimator.mass(), x, y, z],
            status: [self.estimator.mass_status(), sx, sy, sz],
            position: state.position,
            velocity: state.velocity,
            attitude: state.attitude,
            rates: state.rates,
            events: self.events,
        }
    }
}

impl Pilot for CorePilot {
    fn tick(&mut self, sight: &Sight) -> Wrench {
        let position = self.bus.position(sight.position.map(narrow));
        let attitude = self.bus.attitude(sight.attitude.map(|attitude| attitude.0.map(|value| value as f32)));
        let measured = Measured { position, attitude: attitude.map(Attitude::Quaternion) };
        self.events = self.estimator.update(&measured, &self.bus.wrench(&sight.applied));
        self.state = self.estimator.state();
        self.measured.0 = position.or(self.measured.0);
        let matrix = |q: [f32; 4]| narrow_matrix(&Quaternion(q.map(f64::from)).matrix());
        self.measured.1 = attitude.map(matrix).or(self.measured.1);
        let (state, model, to) = (&self.state, self.estimator.model(), &sight.reference);
        let motion = Motion {
            position: state.position.or(self.measured.0).unwrap_or(to.position),
            velocity: state.velocity.unwrap_or(to.velocity),
            attitude: state.attitude.or(self.measured.1).unwrap_or(to.attitude),
            rates: state.rates.unwrap_or(to.rates),
        };
        let [mass, ix, iy, iz] = self.guess;
        let [x, y, z] = model.inertia;
        let inertia = [x.unwrap_or(ix), y.unwrap_or(iy), z.unwrap_or(iz)];
        // A wrench that cannot be computed leaves the last one standing.
        if let Ok(wrench) = self.controller.wrench(to, &motion, model.mass.unwrap_or(mass), inertia) {
            self.wrench = wrench;
        }
        self.wrench
    }
}

/// The same law on the true parameters and the true state.
#[derive(Clone, Debug)]
pub struct Yardstick {
    controller: VehicleController,
    wrench: Wrench,
}

impl Yardstick {
    /// Of a scenario.
    ///
    /// # Errors
    /// Names the gain that the controller refuses.
    pub fn new(scenario: &Scenario) -> Result<Self, Refused> {
        let controller = scenario.control.controller(scenario.plant.gravity)?;
        Ok(Self { controller, wrench: Wrench::default() })
    }
}

impl Pilot for Yardstick {
    fn tick(&mut self, sight: &Sight) -> Wrench {
        let (state, TrueParameters { mass, inertia }) = (&sight.truth, sight.parameters);
        let motion = Motion {
            position: narrow(state.position),
            velocity: narrow(state.velocity),
            attitude: narrow_matrix(&state.attitude.matrix()),
            rates: narrow(state.body_rates),
        };
        if let Ok(wrench) = self.controller.wrench(&sight.reference, &motion, mass as f32, narrow(inertia)) {
            self.wrench = wrench;
        }
        self.wrench
    }
}
