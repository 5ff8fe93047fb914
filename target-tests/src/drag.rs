//! A flight of three axes with drag and a constant disturbance, in f64 as in `scenario`.

use crate::random::Random;

/// 1/m [1/kg].
const K: f64 = 0.7;
/// D [1/s].
const DRAG: [f64; 3] = [0.4, 0.5, 0.3];
/// Known drift c [m/s²].
pub const DRIFT: [f64; 3] = [0.0, 0.0, -9.81];
/// d [m/s²].
const DISTURBANCE: [f64; 3] = [0.2, -0.3, 0.1];
/// An acceleration [m/s²] that changes its sign after so many seconds.
const EXCITATION: [(f64, f64); 3] = [(2.0, 1.7), (1.5, 1.3), (1.0, 2.1)];
/// Largest noise of a position [m].
const NOISE: f64 = 1e-3;

/// The vehicle and its sensor.
#[derive(Clone, Debug)]
pub struct DragFlight {
    period: f64,
    /// Whether some data are bad.
    faults: bool,
    tick: u32,
    position: [f64; 3],
    velocity: [f64; 3],
    random: Random,
}

impl DragFlight {
    /// At `period` \[s\] a tick.
    pub fn new(period: f64, faults: bool) -> Self {
        let (position, velocity) = ([0.4, -0.3, 3.0], [0.3, 0.1, -0.2]);
        Self { period, faults, tick: 0, position, velocity, random: Random::START }
    }

    /// What is measured now, and the forces from now on. The vehicle then moves to the next tick.
    pub fn step(&mut self) -> ([Option<f32>; 3], [f32; 3]) {
        let (tick, dt) = (self.tick, self.period);
        self.tick += 1;
        let (mut positions, mut inputs) = ([None; 3], [0.0; 3]);
        for axis in 0..3 {
            let (x, v) = (self.position[axis], self.velocity[axis]);
            positions[axis] = Some((x + NOISE * self.random.uniform()) as f32);
            let (size, half) = EXCITATION[axis];
            let sign = if ((f64::from(tick) * dt / half) as u32).is_multiple_of(2) { 1.0 } else { -1.0 };
            let input = ((sign * size - x - 1.4 * v - DRIFT[axis]) / K) as f32;
            inputs[axis] = input;
            let pushed = K * f64::from(input) + DRIFT[axis] + DISTURBANCE[axis];
            let middle = v + 0.5 * dt * (pushed - DRAG[axis] * v);
            self.position[axis] += dt * middle;
            self.velocity[axis] += dt * (pushed - DRAG[axis] * middle);
        }
        if self.faults {
            match tick {
                200..=204 => positions[1] = None,
                300 => positions[2] = Some(f32::NAN),
                400 => positions[0] = Some(2e5),
                500 => inputs[2] = f32::NAN,
                600..=610 => positions = [None; 3],
                _ => {}
            }
        }
        (positions, inputs)
    }
}
