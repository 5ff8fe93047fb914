//! A rigid body flown on its true state, and what its sensors say.

use crate::rigid_body::{GRAVITY, RigidBody, matrix, quaternion};
use fsb_core::vehicle::{Measured, VehicleState, Wrench};
use fsb_sim_host::hexarotor::Quaternion;
use fsb_sim_host::hexarotor::vector::{Vector, add_scaled, by_components, cross, difference, scaled, sum};
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// Where to be.
#[derive(Clone, Copy, Debug)]
pub struct Course {
    /// Amplitudes of roll, pitch and yaw \[rad\].
    pub angles: Vector,
    /// Amplitudes along the world's axes \[m\].
    pub path: Vector,
}

impl Course {
    /// In place.
    pub const HOVER: Self = Self { angles: [0.0; 3], path: [0.0; 3] };
    /// ±0.4 rad roll and pitch, ±0.8 rad yaw, on the move.
    pub const AGGRESSIVE: Self = Self { angles: [0.4, 0.4, 0.8], path: [1.0, 1.0, 0.5] };

    fn angles_at(&self, t: f64) -> Vector {
        by_components(self.angles, [0.37, 0.29, 0.23].map(|f| (TAU * f * t).sin()))
    }

    fn path_at(&self, t: f64) -> Vector {
        by_components(self.path, [0.2, 0.15, 0.25].map(|f| (TAU * f * t).sin()))
    }
}

/// The body, its pilot and its sensors.
pub struct Flight {
    /// The truth.
    pub body: RigidBody,
    /// Control period \[s\].
    pub period: f64,
    /// Standard deviation \[m\].
    pub position_noise: f64,
    /// Standard deviation about each axis \[rad\].
    pub attitude_noise: f64,
    course: Course,
    /// What the pilot takes the mass and the moments of inertia for.
    believed: RigidBody,
    start: Vector,
    rng: Pcg64,
    ticks: u64,
}

impl Flight {
    /// Without noise.
    pub fn new(body: RigidBody, course: Course, period: f64, seed: u64) -> Self {
        let rng = Pcg64::seed_from_u64(seed);
        let (position_noise, attitude_noise) = (0.0, 0.0);
        Self {
            body,
            period,
            position_noise,
            attitude_noise,
            course,
            believed: body,
            start: body.position,
            rng,
            ticks: 0,
        }
    }

    /// Time \[s\].
    pub fn t(&self) -> f64 {
        self.ticks as f64 * self.period
    }

    fn normals(&mut self) -> Vector {
        [(); 3].map(|()| self.rng.sample(StandardNormal))
    }

    /// Position and attitude now.
    pub fn measure(&mut self) -> Measured {
        let (sp, sa) = (self.position_noise, self.attitude_noise);
        let position = add_scaled(self.body.position, sp, self.normals());
        let turn = Quaternion::from_rotation_vector(scaled(sa, self.normals()));
        let attitude = matrix(&self.body.attitude.then_in_body(&turn));
        Measured { position: Some(position.map(|x| x as f32)), attitude: Some(attitude) }
    }

    /// (11) and (13) on the true state, with what the pilot believes of mass and inertia.
    pub fn pilot(&self) -> Wrench {
        self.pilot_on(&self.body)
    }

    /// The same on what `body` is taken for.
    pub fn pilot_on(&self, body: &RigidBody) -> Wrench {
        let t = self.t();
        let away = difference(body.position, sum(self.start, self.course.path_at(t)));
        let wanted = sum(add_scaled(scaled(-4.0, away), -4.0, body.velocity), [0.0, 0.0, GRAVITY]);
        let force = body.attitude.rotate_back(scaled(self.believed.mass, wanted));
        let to = Quaternion::from_euler(self.course.angles_at(t));
        let turn = to.inverse().then_in_body(&body.attitude).rotation_vector();
        let rates_wanted = {
            let later = Quaternion::from_euler(self.course.angles_at(t + 1e-3));
            scaled(1e3, to.inverse().then_in_body(&later).rotation_vector())
        };
        let alpha = add_scaled(scaled(-64.0, turn), -16.0, difference(body.rates, rates_wanted));
        let inertia = self.believed.inertia;
        let torque = sum(by_components(inertia, alpha), cross(body.rates, by_components(inertia, body.rates)));
        Wrench { force: force.map(|x| x as f32), torque: torque.map(|x| x as f32) }
    }

    /// The body as the estimator sees it: the truth where it says nothing.
    pub fn seen(&self, state: &VehicleState) -> RigidBody {
        let wide = |v: Option<[f32; 3]>, truth: Vector| v.map_or(truth, |v| v.map(f64::from));
        RigidBody {
            position: wide(state.position, self.body.position),
            velocity: wide(state.velocity, self.body.velocity),
            rates: wide(state.rates, self.body.rates),
            attitude: state.attitude.map_or(self.body.attitude, |r| quaternion(&r.map(|row| row.map(f64::from)))),
            ..self.body
        }
    }

    /// A control period under `wrench`.
    pub fn step(&mut self, wrench: &Wrench) {
        self.body.step(wrench, self.period);
        self.ticks += 1;
    }
}
