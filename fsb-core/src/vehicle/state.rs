//! The state now: that of the estimators, and what was applied since the measurements they know were true.

use super::estimator::VehicleEstimator;
use super::gyroscopic::Gyroscopic;
use super::output::VehicleState;
use super::triple::{difference, positions, rates};
use crate::attitude::rotation::{self, Matrix};
use crate::estimator::{AxisState, Learning};
use crate::moments::InputMoments;

/// The rotation on its way from the newest attitude to now.
struct Ahead {
    angles: [f32; 3],
    rates: [f32; 3],
    attitude: Matrix,
}

impl<const D: usize> VehicleEstimator<D> {
    /// Position, velocity, attitude and body rates now.
    ///
    /// What is late is predicted with the model exactly as the forces and torques waiting say; the attitude on the way, and so
    /// the direction of the force, with the body rates estimated. Cost: about 150 operations, about 250 more per period of the
    /// attitude's latency, and 15 per further period of the position's.
    pub fn state(&self) -> VehicleState {
        let measured = self.angles.attitude();
        let mut ahead = self.newest_rotation();
        let mut force = [InputMoments::ZERO; 3];
        let mut periods = 0;
        for period in self.forces.iter() {
            extend(&mut force, period);
            periods += 1;
        }
        let mut actual = self.actual;
        let mut attitude = ahead.as_ref().map(|ahead| ahead.attitude).or(measured);
        for wrench in self.wrenches.iter() {
            let (course, then) = self.actuators.follow(wrench, actual);
            actual = Some(then);
            let from = attitude;
            ahead = ahead.and_then(|ahead| self.advance(ahead, self.actuators.torque(&course)));
            attitude = ahead.as_ref().map(|ahead| ahead.attitude).or(attitude);
            if let (Some(from), Some(to)) = (from, attitude) {
                extend(&mut force, &self.actuators.force(&course, &from, &to));
            }
            periods += 1;
        }
        let translation = self.translation.states_after(&force, periods);
        let late = self.wrenches.iter().next().is_some();
        VehicleState {
            position: positions(&translation),
            velocity: rates(&translation),
            attitude: match &ahead {
                Some(ahead) => Some(ahead.attitude),
                None if self.attitude_measured && !late => measured,
                None => None,
            },
            rates: ahead.map(|ahead| ahead.rates),
        }
    }

    /// The rotation at the time of the newest attitude, which is corrected by what the observer knows better.
    fn newest_rotation(&self) -> Option<Ahead> {
        let states: [Option<AxisState>; 3] = self.rotation.states();
        let (angles, rates) = (positions(&states)?, rates(&states)?);
        let attitude = turned(&self.angles.attitude()?, &difference(&angles, &self.angles.angles()))?;
        Some(Ahead { angles, rates, attitude })
    }

    /// Over one control period. `None` where that turns by more than can be followed: with moments of inertia that are far off
    /// the gyroscopic moment may let the rates grow beyond all bounds.
    fn advance(&self, mut ahead: Ahead, mut torque: [InputMoments; 3]) -> Option<Ahead> {
        let before = ahead.angles;
        let mut k = [0.0; 3];
        // In contact nothing that acts is known.
        if self.rotation.learning() != Learning::Contact {
            k = self.reciprocals()?;
            Gyroscopic::add(&mut torque, &ahead.rates, &k, 0.5 * self.period);
        }
        for (((angle, rate), input), k) in ahead.angles.iter_mut().zip(&mut ahead.rates).zip(&torque).zip(k) {
            let gain = k * self.period;
            *angle += self.period * (*rate + gain * input.j2);
            *rate += gain * input.j1;
        }
        ahead.attitude = turned(&ahead.attitude, &difference(&ahead.angles, &before))?;
        Some(ahead)
    }
}

fn turned(attitude: &Matrix, by: &[f32; 3]) -> Option<Matrix> {
    rotation::exponential(by).map(|by| rotation::product(attitude, &by))
}

fn extend(sum: &mut [InputMoments; 3], part: &[InputMoments; 3]) {
    for (sum, part) in sum.iter_mut().zip(part) {
        sum.extend(part);
    }
}
