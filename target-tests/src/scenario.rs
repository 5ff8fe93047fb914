//! A flight of six axes as positions and inputs: integers, and IEEE additions and multiplications in f64, so that every
//! machine computes the same bits.

use crate::random::Random;

/// k of x, y, z, φ, θ, ψ: 1/m [1/kg] and 1/I [1/(kg m²)].
pub const K: [f64; 6] = [0.7, 0.7, 0.7, 70.0, 65.0, 35.0];
/// Known drift c.
pub const DRIFT: [f64; 6] = [0.0, 0.0, -9.81, 0.0, 0.0, 0.0];
/// Largest excitation as an acceleration, of translation and rotation [m/s², rad/s²].
const EXCITATION: [f64; 6] = [2.0, 1.5, 1.0, 8.0, 8.0, 4.0];
/// Half period of the excitation's square wave, in ticks.
const HALF_PERIOD: [u32; 6] = [371, 293, 457, 89, 107, 151];
/// Largest noise of a measurement [m, rad].
const NOISE: [f64; 6] = [1e-3, 1e-3, 1e-3, 2e-4, 2e-4, 2e-4];

/// Bad data, by tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faults {
    /// None.
    Without,
    /// A missed measurement, rejected measurements and inputs, an instant without a measurement.
    Scripted,
}

/// What a control loop would have at a tick.
#[derive(Clone, Copy, Debug)]
pub struct Tick {
    /// `None` for an instant at which nothing was measured at all.
    pub positions: Option<[Option<f32>; 6]>,
    /// Force [N], torque [N m], held until the next tick.
    pub inputs: [f32; 6],
}

/// The vehicle, its excitation and its sensors.
#[derive(Clone, Debug)]
pub struct Scenario {
    period: f64,
    faults: Faults,
    tick: u32,
    position: [f64; 6],
    velocity: [f64; 6],
    random: Random,
}

impl Scenario {
    /// At `period` [s] a tick.
    pub fn new(period: f64, faults: Faults) -> Self {
        Self {
            period,
            faults,
            tick: 0,
            position: [0.4, -0.3, 3.0, 0.05, -0.02, 0.3],
            velocity: [0.3, 0.1, -0.2, 0.1, 0.0, -0.1],
            random: Random::START,
        }
    }

    /// The number of the tick that comes next.
    pub const fn tick(&self) -> u32 {
        self.tick
    }

    /// The present tick; the vehicle then moves to the next one.
    pub fn step(&mut self) -> Tick {
        let tick = self.tick;
        self.tick += 1;
        let (mut positions, mut inputs) = ([None; 6], [0.0; 6]);
        for axis in 0..6 {
            let noise = self.random.uniform() * NOISE[axis];
            positions[axis] = Some((self.position[axis] + noise) as f32);
            let sign = if (tick / HALF_PERIOD[axis]).is_multiple_of(2) { 1.0 } else { -1.0 };
            // Held near the origin by a spring and a damper, so that the flight may last.
            let wanted = sign * EXCITATION[axis] - 1.0 * self.position[axis] - 1.4 * self.velocity[axis] - DRIFT[axis];
            let input = (wanted * (1.0 / K[axis])) as f32;
            inputs[axis] = input;
            let acceleration = K[axis] * f64::from(input) + DRIFT[axis];
            self.position[axis] += self.period * self.velocity[axis] + 0.5 * self.period * self.period * acceleration;
            self.velocity[axis] += self.period * acceleration;
        }
        let mut positions = Some(positions);
        if self.faults == Faults::Scripted {
            spoil(tick, &mut positions, &mut inputs);
        }
        Tick { positions, inputs }
    }
}

/// The bad data. Missing at once, one after the other, and in a row.
fn spoil(tick: u32, positions: &mut Option<[Option<f32>; 6]>, inputs: &mut [f32; 6]) {
    let Some(samples) = positions else { return };
    match tick {
        2000..=2003 => samples[1] = None,
        3000 => samples[4] = Some(f32::NAN),
        3300 => samples[3] = Some(f32::NEG_INFINITY),
        4000 => samples[0] = Some(2e5),
        5000 => inputs[2] = f32::NAN,
        5500 => inputs[5] = -3e38,
        6000..=6020 => *positions = None,
        _ => {}
    }
}
