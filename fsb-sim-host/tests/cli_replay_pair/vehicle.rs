//! A vehicle that turns while it pushes: k f along its own z, held between irregular stamps, drag and disturbance, measured at other
//! irregular times. Stepped finely enough (50 µs, midpoint rule) that its own error is below 1e-8 m.

use std::fmt::Write as _;

/// What flies, and how it is recorded.
pub struct Vehicle {
    pub mass: f64,
    pub drag: [f64; 3],
    pub disturbance: [f64; 3],
    /// The input acts so much later than its stamps say (s).
    pub lag: f64,
    /// Standard deviation of the positions (m).
    pub noise: f64,
    pub seconds: f64,
    /// Motion samples that are lost.
    pub lost: fn(f64) -> bool,
}

impl Default for Vehicle {
    fn default() -> Self {
        Self { mass: 1.3, drag: [0.0; 3], disturbance: [0.0; 3], lag: 0.0, noise: 0.0, seconds: 8.0, lost: |_| false }
    }
}

pub const GRAVITY: f64 = 9.81;
const FINE: f64 = 5e-5;

/// Reproducible irregularity in -0.5..0.5, and nearly normal noise from twelve of it.
struct Chance(u64);

impl Chance {
    fn even(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum()
    }
}

/// Body to world: yaw, then pitch and roll, as a quaternion.
fn attitude(t: f64) -> [f64; 4] {
    let half = [0.25 * (1.3 * t).sin(), 0.2 * (0.9 * t + 1.0).cos(), 0.4 * (0.5 * t).sin()].map(|angle| angle / 2.0);
    let [(sr, cr), (sp, cp), (sy, cy)] = half.map(f64::sin_cos);
    [cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy]
}

/// The third column of the rotation matrix.
fn up([w, x, y, z]: [f64; 4]) -> [f64; 3] {
    [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)]
}

impl Vehicle {
    fn thrust(&self, t: f64) -> f64 {
        self.mass * (GRAVITY + 1.6 * (2.1 * t).sin() + 0.5 * (0.7 * t).cos())
    }

    /// The two files: motion at some 100 Hz, input at some 400 Hz.
    pub fn record(&self) -> (String, String) {
        let mut chance = Chance(17);
        let mut stamps = vec![0.0];
        while stamps[stamps.len() - 1] < self.seconds {
            stamps.push(stamps[stamps.len() - 1] + 0.0025 * (1.0 + 0.4 * chance.even()));
        }
        let held: Vec<f64> = stamps.iter().map(|&t| self.thrust(t)).collect();
        let mut input = String::from("t,thrust_N,other\n");
        for (t, f) in stamps.iter().zip(&held) {
            writeln!(input, "{t},{f},7").unwrap();
        }
        let mut motion = String::from("t,x,y,z,qw,qx,qy,qz,vx_ref,vy_ref,vz_ref\n");
        let (mut y, mut v, mut acting, mut next) = ([0.4, -0.3, 1.0], [0.3, 0.1, -0.2], 0, 0.004);
        let mut step = 0u64;
        loop {
            let t = step as f64 * FINE;
            if t > self.seconds {
                break;
            }
            if t >= next {
                if !(self.lost)(t) {
                    let noisy = y.map(|y: f64| y + self.noise * chance.normal());
                    let row = [&[t][..], &noisy, &attitude(t), &v].concat();
                    let row: Vec<String> = row.iter().map(f64::to_string).collect();
                    writeln!(motion, "{}", row.join(",")).unwrap();
                }
                next += 0.01 * (1.0 + 0.5 * chance.even());
            }
            let middle = t + FINE / 2.0;
            while stamps.get(acting + 1).is_some_and(|&stamp| stamp + self.lag <= middle) {
                acting += 1;
            }
            let direction = up(attitude(middle));
            for i in 0..3 {
                let weight = if i == 2 { GRAVITY } else { 0.0 };
                let known = held[acting] * direction[i] / self.mass - weight + self.disturbance[i];
                let half = v[i] + FINE / 2.0 * (known - self.drag[i] * v[i]);
                let acceleration = known - self.drag[i] * half;
                y[i] += FINE * v[i] + FINE * FINE / 2.0 * acceleration;
                v[i] += FINE * acceleration;
            }
            step += 1;
        }
        (motion, input)
    }
}
