//! One flight: plant, sensors and a pilot.

use fsb_core::vehicle::Wrench;

use super::error::Refused;
use super::pilot::{Pilot, Sight};
use super::reference::{Wanted, narrow};
use super::scenario::Scenario;
use crate::hexarotor::vector::{Vector, difference, norm};
use crate::hexarotor::{Hexarotor, Quaternion, State, TrueParameters};
use crate::sensors::Sensor;

/// One tick of a flight.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Ticks since the start.
    pub tick: u64,
    /// [s]
    pub t: f64,
    /// What shall be flown.
    pub wanted: Wanted,
    /// The vehicle as it is.
    pub truth: State,
    /// m and I as they are.
    pub parameters: TrueParameters,
    /// A position that arrives at this tick [m].
    pub position: Option<Vector>,
    /// An attitude that arrives at this tick.
    pub attitude: Option<Quaternion>,
    /// Thrusts commanded from here to the next tick, within their limits [N].
    pub thrusts: [f64; 6],
    /// What the pilot wanted did not fit in these limits.
    pub saturated: bool,
    /// The wrench of these thrusts, as the pilot is told [N, N m].
    pub applied: Wrench,
}

impl Moment {
    /// x - x_d [m].
    pub fn position_error(&self) -> Vector {
        difference(self.truth.position, self.wanted.position.value)
    }

    /// The turn from the reference to the attitude, a rotation vector in the reference's frame [rad].
    pub fn attitude_error(&self) -> Vector {
        self.wanted.attitude.inverse().then_in_body(&self.truth.attitude).rotation_vector()
    }

    /// Whether it is farther off than `scenario` allows, or not even finite.
    fn diverged(&self, scenario: &Scenario) -> bool {
        let within = norm(self.position_error()) <= scenario.limits.position
            && norm(self.attitude_error()) <= scenario.limits.attitude
            && norm(self.truth.velocity).is_finite()
            && norm(self.truth.body_rates).is_finite();
        !within
    }
}

/// Flies `scenario`, draws made, with the sensors of `seed`, and shows every tick, the first and the last included, to
/// `watch`. Gives the time at which the flight diverged and ended, if it did [s].
///
/// # Errors
/// [`Refused`] where vehicle or sensors cannot be as they are given.
pub fn fly<P: Pilot>(
    scenario: &Scenario,
    seed: u64,
    pilot: &mut P,
    mut watch: impl FnMut(&Moment, &P),
) -> Result<Option<f64>, Refused> {
    let mut vehicle = Hexarotor::new(&scenario.plant).map_err(|error| error.within("plant"))?;
    let period = scenario.period();
    // Different streams for the two sensors; neighbouring seeds have nothing in common there.
    let stream = seed.wrapping_mul(2);
    let mut position_sensor =
        Sensor::new(&scenario.sensors.position, period, stream).map_err(|error| error.within("sensors.position"))?;
    let mut attitude_sensor = Sensor::new(&scenario.sensors.attitude, period, stream.wrapping_add(1))
        .map_err(|error| error.within("sensors.attitude"))?;
    let mut applied = Wrench::default();
    for tick in 0..=scenario.ticks() {
        let t = tick as f64 / scenario.rate;
        let (truth, parameters) = (*vehicle.state(), vehicle.true_parameters());
        let wanted = Wanted::at(&scenario.reference, t);
        let position = position_sensor.tick(&truth.position).map(|measurement| measurement.value);
        let attitude = attitude_sensor.tick(&truth.attitude).map(|measurement| measurement.value);
        let sight = Sight { reference: wanted.in_f32(), position, attitude, applied, truth, parameters };
        let wrench = pilot.tick(&sight);
        let allocation = vehicle.allocate(wrench.force.map(f64::from), wrench.torque.map(f64::from));
        let (thrusts, saturated) = (allocation.thrusts, allocation.saturated);
        let told = vehicle.wrench(&thrusts);
        applied = Wrench { force: narrow(told.force), torque: narrow(told.torque) };
        let moment = Moment { tick, t, wanted, truth, parameters, position, attitude, thrusts, saturated, applied };
        watch(&moment, pilot);
        if moment.diverged(scenario) {
            return Ok(Some(t));
        }
        vehicle.step(&thrusts, period);
    }
    Ok(None)
}
