//! The differential equations of the rigid body, (1)-(9) with a quaternion in place of (1).

use super::attitude::Quaternion;
use super::config::DragConfig;
use super::rotors::Actuation;
use super::vector::{Vector, add_scaled, by_components, cross, difference, norm, scaled, sum};
use super::vehicle::State;
use crate::paper_form::rk4;

/// What does not change within a tick.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    pub mass: f64,
    pub inertia: Vector,
    pub gravity: f64,
    pub drag: DragConfig,
    /// Whether any part of `drag` but the angular one is there.
    pub feels_air: bool,
    pub wind: Vector,
}

impl Body {
    /// `state` one step of `dt` [s] later, `through` being the actuation at the start, the middle and the end.
    pub fn step(&self, state: &mut State, through: &[Actuation; 3], dt: f64) {
        let next = rk4(&pack(state), dt, |i, x| self.derivative(x, &through[i]));
        unpack(&next, state);
        state.attitude = state.attitude.normalised();
    }

    fn derivative(&self, x: &[f64; 13], actuation: &Actuation) -> [f64; 13] {
        let [_, _, _, vx, vy, vz, qw, qx, qy, qz, p, q, r] = *x;
        let (velocity, attitude, rates) = ([vx, vy, vz], Quaternion([qw, qx, qy, qz]), [p, q, r]);
        let mut force = actuation.wrench.force;
        if self.feels_air {
            force = sum(force, self.drag_force(&attitude, velocity));
        }
        let [ax, ay, az] = scaled(1.0 / self.mass, attitude.rotate(force));
        let spin = sum(by_components(self.inertia, rates), actuation.momentum);
        let torque = difference(actuation.wrench.torque, by_components(self.drag.angular, rates));
        let [tx, ty, tz] = difference(torque, cross(rates, spin));
        let [ix, iy, iz] = self.inertia;
        // q' = q ⊗ (0, ω)/2
        let [dw, dx, dy, dz] = attitude.then_in_body(&Quaternion([0.0, p / 2.0, q / 2.0, r / 2.0])).0;
        [vx, vy, vz, ax, ay, az - self.gravity, dw, dx, dy, dz, tx / ix, ty / iy, tz / iz]
    }

    fn drag_force(&self, attitude: &Quaternion, velocity: Vector) -> Vector {
        let through_air = attitude.rotate_back(difference(velocity, self.wind));
        let per_speed = add_scaled(self.drag.linear, norm(through_air), self.drag.quadratic);
        scaled(-1.0, by_components(per_speed, through_air))
    }
}

fn pack(state: &State) -> [f64; 13] {
    let ([x, y, z], [vx, vy, vz], [p, q, r]) = (state.position, state.velocity, state.body_rates);
    let [a, b, c, d] = state.attitude.0;
    [x, y, z, vx, vy, vz, a, b, c, d, p, q, r]
}

fn unpack(from: &[f64; 13], state: &mut State) {
    let [x, y, z, vx, vy, vz, a, b, c, d, p, q, r] = *from;
    state.position = [x, y, z];
    state.velocity = [vx, vy, vz];
    state.attitude = Quaternion([a, b, c, d]);
    state.body_rates = [p, q, r];
}
