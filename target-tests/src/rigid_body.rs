//! A flight in six degrees of freedom as a vehicle's estimator sees it: IEEE additions, multiplications and divisions in f64, so that
//! every machine computes the same bits.

use fsb_core::vehicle::{Attitude, Measured, Wrench};

use crate::random::Random;

/// m [kg] and I_x, I_y, I_z [kg m²].
pub const MASS: f64 = 2.5;
/// See [`MASS`].
pub const INERTIA: [f64; 3] = [0.03, 0.035, 0.055];
/// g [m/s²].
const GRAVITY: f64 = 9.81;
/// dt [s].
const PERIOD: f64 = 1e-3;
/// τ [s] of the actuators, where they lag.
pub const LAG: f64 = 0.02;
/// e^(-dt/τ)
const LAG_DECAY: f64 = 0.951_229_424_500_714;
/// Largest noise of a position [m] and of an attitude [rad].
const NOISE: [f64; 2] = [1e-3, 2e-4];
/// Excitation: an acceleration [m/s², rad/s²] that changes its sign after so many ticks.
const EXCITATION: [(f64, u32); 6] = [(3.0, 371), (2.5, 293), (1.5, 457), (20.0, 89), (20.0, 107), (10.0, 151)];
/// The most that a measurement can be late, in ticks, is one less.
const MEMORY: usize = 32;

type Vector = [f64; 3];
type Matrix = [Vector; 3];

/// What a flight is like.
#[derive(Clone, Copy, Debug, Default)]
pub struct Conditions {
    /// The actuators lag by [`LAG`].
    pub lag: bool,
    /// Ticks from one position to the next, and by which it is late.
    pub position: [u32; 2],
    /// The same of attitudes.
    pub attitude: [u32; 2],
    /// The tick at which the mass becomes half as much again, and the moments of inertia.
    pub loaded_at: Option<u32>,
    /// Attitudes are quaternions, else matrices.
    pub quaternions: bool,
    /// What is missing, absurd or not finite.
    pub faults: bool,
}

/// The vehicle, the forces that hold it near the origin, and its sensors.
#[derive(Clone, Debug)]
pub struct RigidBody {
    conditions: Conditions,
    tick: u32,
    position: Vector,
    velocity: Vector,
    /// w, x, y, z
    attitude: [f64; 4],
    rates: Vector,
    /// Force and torque at the end of the period before.
    actual: [Vector; 2],
    positions: [Vector; MEMORY],
    attitudes: [[f64; 4]; MEMORY],
    random: Random,
}

impl RigidBody {
    /// At rest near the origin.
    pub fn new(conditions: Conditions) -> Self {
        Self {
            conditions,
            tick: 0,
            position: [0.4, -0.3, 3.0],
            velocity: [0.3, 0.1, -0.2],
            attitude: [1.0, 0.0, 0.0, 0.0],
            rates: [0.0; 3],
            actual: [[0.0, 0.0, MASS * GRAVITY], [0.0; 3]],
            positions: [[0.0; 3]; MEMORY],
            attitudes: [[1.0, 0.0, 0.0, 0.0]; MEMORY],
            random: Random::START,
        }
    }

    /// What has arrived now, and what the actuators are told from now on. The vehicle then moves to the next tick.
    pub fn step(&mut self) -> (Measured, Wrench) {
        let tick = self.tick;
        let slot = tick as usize % MEMORY;
        self.positions[slot] = self.position.map(|x| x + NOISE[0] * self.random.uniform());
        let turn = [0; 3].map(|_| NOISE[1] * self.random.uniform());
        self.attitudes[slot] = turned(self.attitude, turn);
        let mut measured = self.measured();
        let mut told = self.wanted();
        if self.conditions.faults {
            spoil(tick, &mut measured, &mut told);
        }
        let sound = told.force.iter().chain(&told.torque).all(|x| x.abs() < 1e5);
        if sound {
            self.fly(&told);
        } else {
            self.fly(&self.wanted());
        }
        self.tick += 1;
        (measured, told)
    }

    fn measured(&self) -> Measured {
        let due = |[every, late]: [u32; 2]| {
            (self.tick >= late && self.tick.is_multiple_of(every)).then(|| (self.tick - late) as usize % MEMORY)
        };
        let position = due(self.conditions.position).map(|slot| self.positions[slot].map(|x| x as f32));
        let attitude = due(self.conditions.attitude).map(|slot| {
            let q = self.attitudes[slot];
            if self.conditions.quaternions {
                Attitude::Quaternion(q.map(|x| x as f32))
            } else {
                Attitude::Matrix(matrix(q).map(|row| row.map(|x| x as f32)))
            }
        });
        Measured { position, attitude }
    }

    /// A spring and a damper to the origin and to level, and the excitation.
    fn wanted(&self) -> Wrench {
        let sign = |axis: usize| if (self.tick / EXCITATION[axis].1).is_multiple_of(2) { 1.0 } else { -1.0 };
        let [w, x, y, z] = self.attitude;
        let tilt = [2.0 * w * x, 2.0 * w * y, 2.0 * w * z];
        let (mut world, mut torque) = ([0.0; 3], [0.0; 3]);
        for axis in 0..3 {
            let pull = 1.0 * self.position[axis] + 1.4 * self.velocity[axis];
            world[axis] = MASS * (sign(axis) * EXCITATION[axis].0 - pull);
            let turn = 40.0 * tilt[axis] + 9.0 * self.rates[axis];
            torque[axis] = INERTIA[axis] * (sign(axis + 3) * EXCITATION[axis + 3].0 - turn);
        }
        world[2] += MASS * GRAVITY;
        let r = matrix(self.attitude);
        let mut force = [0.0; 3];
        for (axis, force) in force.iter_mut().enumerate() {
            *force = r[0][axis] * world[0] + r[1][axis] * world[1] + r[2][axis] * world[2];
        }
        Wrench { force: force.map(|x| x as f32), torque: torque.map(|x| x as f32) }
    }

    /// One period: the torque turns the body by the rates in the middle, and the force pushes it along the attitude there.
    fn fly(&mut self, told: &Wrench) {
        let told = [told.force.map(f64::from), told.torque.map(f64::from)];
        let mut means = told;
        if self.conditions.lag {
            let e0 = LAG / PERIOD * (1.0 - LAG_DECAY);
            for ((mean, told), actual) in means.iter_mut().zip(&told).zip(&mut self.actual) {
                for ((mean, told), actual) in mean.iter_mut().zip(told).zip(actual) {
                    let rest = *actual - told;
                    *mean = told + e0 * rest;
                    *actual = told + LAG_DECAY * rest;
                }
            }
        }
        let load = if self.conditions.loaded_at.is_some_and(|tick| self.tick >= tick) { 1.5 } else { 1.0 };
        let [force, torque] = means;
        let [p, q, r] = self.rates;
        let [ix, iy, iz] = INERTIA.map(|x| load * x);
        let gyroscopic = [(iz - iy) * q * r, (ix - iz) * r * p, (iy - ix) * p * q];
        let mut turn = [0.0; 3];
        for axis in 0..3 {
            let step = PERIOD * (torque[axis] - gyroscopic[axis]) / (load * INERTIA[axis]);
            turn[axis] = PERIOD * (self.rates[axis] + 0.5 * step);
            self.rates[axis] += step;
        }
        let r = matrix(turned(self.attitude, turn.map(|x| 0.5 * x)));
        self.attitude = turned(self.attitude, turn);
        for (axis, [x, y, z]) in r.into_iter().enumerate() {
            let gravity = if axis == 2 { GRAVITY } else { 0.0 };
            let step = PERIOD * ((x * force[0] + y * force[1] + z * force[2]) / (load * MASS) - gravity);
            self.position[axis] += PERIOD * (self.velocity[axis] + 0.5 * step);
            self.velocity[axis] += step;
        }
    }
}

/// The quaternion turned about the body's axes by a small angle (rad).
fn turned([w, x, y, z]: [f64; 4], turn: Vector) -> [f64; 4] {
    let [a, b, c] = turn.map(|x| 0.5 * x);
    let square = a * a + b * b + c * c;
    // cos and sin x/x to the fourth order.
    let (cosine, sine) = (1.0 - 0.5 * square + square * square / 24.0, 1.0 - square / 6.0);
    let [a, b, c] = [sine * a, sine * b, sine * c];
    let q = [
        w * cosine - x * a - y * b - z * c,
        x * cosine + w * a + y * c - z * b,
        y * cosine + w * b + z * a - x * c,
        z * cosine + w * c + x * b - y * a,
    ];
    let [w, x, y, z] = q;
    // One step of Newton's towards length one.
    let length = 1.5 - 0.5 * (w * w + x * x + y * y + z * z);
    q.map(|x| length * x)
}

/// R by rows.
fn matrix([w, x, y, z]: [f64; 4]) -> Matrix {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// The bad data: absent once and in a row, not finite, absurd, no rotation at all, one that cannot be followed.
fn spoil(tick: u32, measured: &mut Measured, told: &mut Wrench) {
    match tick {
        1500..=1560 => measured.position = None,
        1990..=2030 => measured.attitude = None,
        2500 => measured.position = Some([f32::NAN, 0.0, 0.0]),
        2600 => measured.position = Some([0.0, 1e9, 0.0]),
        2700 => measured.position = Some([40.0, 40.0, 40.0]),
        3001 => measured.attitude = Some(Attitude::Quaternion([f32::NAN, 0.0, 0.0, 0.0])),
        3101 => measured.attitude = Some(Attitude::Matrix([[1.0, 0.0, 0.0]; 3])),
        3201 | 6000..=6020 => measured.attitude = Some(Attitude::Quaternion([0.0, 1.0, 0.0, 0.0])),
        4000 => told.force[1] = f32::NAN,
        4100 => told.torque[2] = f32::INFINITY,
        _ => {}
    }
}
