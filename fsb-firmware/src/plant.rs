//! A hexarotor to fly against in the emulator and in the tests: the exact solution of (9), (10) with the wrench held over a
//! tick, in f64. Not a model of blades, batteries or wind.

use fsb_firmware::{Attitude, Sample, TiltedHexarotor};

/// Largest thrust of a motor \[N\].
pub const THRUST_MAX: f64 = 6.0;
/// The largest value of a motor's duty.
pub const FULL_DUTY: u16 = 8400;
/// Gravity \[m/s²\].
const G: f64 = 9.81;

/// The geometry of the vehicle.
pub const GEOMETRY: TiltedHexarotor = TiltedHexarotor { arm: 0.25, tilt: 0.35, drag_ratio: 0.02 };

/// Position, attitude and their rates.
#[derive(Clone, Debug)]
pub struct Vehicle {
    /// Mass \[kg\].
    pub mass: f64,
    /// Ix, Iy, Iz \[kg m²\].
    pub inertia: [f64; 3],
    /// x, y, z \[m\], φ, θ, ψ \[rad\].
    pub position: [f64; 6],
    /// Their rates.
    pub velocity: [f64; 6],
    forward: [[f64; 6]; 6],
}

impl Vehicle {
    /// At rest on `position`.
    pub fn new(mass: f64, inertia: [f64; 3], position: [f64; 6]) -> Self {
        Self { mass, inertia, position, velocity: [0.0; 6], forward: GEOMETRY.matrix() }
    }

    /// What the sensors say, without noise.
    pub fn sample(&self) -> Sample {
        let [x, y, z, roll, pitch, yaw] = self.position.map(|p| p as f32);
        Sample {
            position: [Some(x), Some(y), Some(z)],
            angles: [Some(roll), Some(pitch), Some(yaw)],
            attitude: self.attitude().map(|row| row.map(|entry| entry as f32)) as Attitude,
        }
    }

    /// R of (2).
    pub fn attitude(&self) -> [[f64; 3]; 3] {
        let [_, _, _, roll, pitch, yaw] = self.position;
        let ((sr, cr), (sp, cp), (sy, cy)) = (
            (libm::sin(roll), libm::cos(roll)),
            (libm::sin(pitch), libm::cos(pitch)),
            (libm::sin(yaw), libm::cos(yaw)),
        );
        [
            [cp * cy, cy * sr * sp - cr * sy, sr * sy + cr * cy * sp],
            [cp * sy, cr * cy + sr * sp * sy, cr * sp * sy - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    }

    /// `dt` \[s\] ahead with the duties held.
    pub fn step(&mut self, duties: &[u16; 6], dt: f64) {
        let thrusts = duties.map(|duty| f64::from(duty) / f64::from(FULL_DUTY) * THRUST_MAX);
        let wrench = self.forward.map(|row| row.iter().zip(&thrusts).map(|(a, b)| a * b).sum::<f64>());
        let [fx, fy, fz, p, q, r] = wrench;
        let force = self.attitude().map(|[a, b, c]| a * fx + b * fy + c * fz);
        let [ax, ay, az] = force.map(|f| f / self.mass);
        let [ix, iy, iz] = self.inertia;
        let acceleration = [ax, ay, az - G, p / ix, q / iy, r / iz];
        for ((y, v), a) in self.position.iter_mut().zip(&mut self.velocity).zip(acceleration) {
            *y += dt * *v + dt * dt / 2.0 * a;
            *v += dt * a;
        }
    }
}
