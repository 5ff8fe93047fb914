//! A rigid body in f64, driven by a wrench along its own axes: (1)-(9) of the paper with a quaternion in place of (1).

use fsb_core::vehicle::{Attitude, Wrench};
use fsb_sim_host::hexarotor::Quaternion;
use fsb_sim_host::hexarotor::vector::{Matrix, Vector, add_scaled, by_components, cross, difference, scaled, sum};

/// The body and where it is.
#[derive(Clone, Copy, Debug)]
pub struct RigidBody {
    /// kg
    pub mass: f64,
    /// kg m²
    pub inertia: Vector,
    /// Force along the world's axes that nobody tells the estimator \[N\].
    pub disturbance: Vector,
    /// First-order lag of the wrench \[s\], none at zero.
    pub lag: f64,
    /// World frame \[m\].
    pub position: Vector,
    /// World frame \[m/s\].
    pub velocity: Vector,
    /// Body to world.
    pub attitude: Quaternion,
    /// Body frame \[rad/s\].
    pub rates: Vector,
    /// What the actuators do now \[N\], \[N m\].
    pub actual: [Vector; 2],
}

/// m/s²
pub const GRAVITY: f64 = 9.81;

impl Default for RigidBody {
    /// 2.5 kg, the design's moments of inertia, at rest.
    fn default() -> Self {
        Self {
            mass: 2.5,
            inertia: [0.03, 0.035, 0.055],
            disturbance: [0.0; 3],
            lag: 0.0,
            position: [1.0, -2.0, 3.0],
            velocity: [0.0; 3],
            attitude: Quaternion::IDENTITY,
            rates: [0.0; 3],
            actual: [[0.0; 3]; 2],
        }
    }
}

/// x, x', q, ω.
type Derivative = [f64; 13];

impl RigidBody {
    /// A control period later, the wrench being told throughout. Runge-Kutta of order four in steps of at most 1 ms.
    pub fn step(&mut self, told: &Wrench, dt: f64) {
        let told = [told.force, told.torque].map(|v| v.map(f64::from));
        let steps = (dt / 1e-3 - 1e-9).ceil().max(1.0);
        let h = dt / steps;
        for _ in 0..steps as u64 {
            let now = self.wrench_after(&told, 0.0);
            let middle = self.wrench_after(&told, h / 2.0);
            let end = self.wrench_after(&told, h);
            let x = self.pack();
            let k1 = self.derivative(&x, &now);
            let k2 = self.derivative(&moved(&x, h / 2.0, &k1), &middle);
            let k3 = self.derivative(&moved(&x, h / 2.0, &k2), &middle);
            let k4 = self.derivative(&moved(&x, h, &k3), &end);
            let slope: Derivative = std::array::from_fn(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
            self.unpack(&moved(&x, h, &slope));
            self.actual = end;
        }
    }

    fn wrench_after(&self, told: &[Vector; 2], t: f64) -> [Vector; 2] {
        if self.lag == 0.0 {
            return *told;
        }
        let rest = (-t / self.lag).exp();
        [0, 1].map(|i| add_scaled(told[i], rest, difference(self.actual[i], told[i])))
    }

    fn derivative(&self, x: &Derivative, wrench: &[Vector; 2]) -> Derivative {
        let [_, _, _, vx, vy, vz, qw, qx, qy, qz, p, q, r] = *x;
        let attitude = Quaternion([qw, qx, qy, qz]);
        let rates = [p, q, r];
        let force = sum(attitude.rotate(wrench[0]), self.disturbance);
        let [ax, ay, az] = scaled(1.0 / self.mass, force);
        let torque = difference(wrench[1], cross(rates, by_components(self.inertia, rates)));
        let [dw, dx, dy, dz] = attitude.then_in_body(&Quaternion([0.0, p / 2.0, q / 2.0, r / 2.0])).0;
        let [ix, iy, iz] = self.inertia;
        [vx, vy, vz, ax, ay, az - GRAVITY, dw, dx, dy, dz, torque[0] / ix, torque[1] / iy, torque[2] / iz]
    }

    fn pack(&self) -> Derivative {
        let ([x, y, z], [vx, vy, vz], [p, q, r]) = (self.position, self.velocity, self.rates);
        let [a, b, c, d] = self.attitude.0;
        [x, y, z, vx, vy, vz, a, b, c, d, p, q, r]
    }

    fn unpack(&mut self, from: &Derivative) {
        let [x, y, z, vx, vy, vz, a, b, c, d, p, q, r] = *from;
        self.position = [x, y, z];
        self.velocity = [vx, vy, vz];
        self.attitude = Quaternion([a, b, c, d]).normalised();
        self.rates = [p, q, r];
    }
}

fn moved(x: &Derivative, h: f64, slope: &Derivative) -> Derivative {
    std::array::from_fn(|i| x[i] + h * slope[i])
}

/// R by rows, as an estimator takes it.
pub fn matrix(attitude: &Quaternion) -> Attitude {
    Attitude::Matrix(attitude.matrix().map(|row| row.map(|x| x as f32)))
}

/// Of R, for turns of less than 120°.
pub fn quaternion(r: &Matrix) -> Quaternion {
    let w = (1.0 + r[0][0] + r[1][1] + r[2][2]).sqrt() / 2.0;
    let axis = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]].map(|x| x / (4.0 * w));
    Quaternion([w, axis[0], axis[1], axis[2]]).normalised()
}
