//! A vertical axis that swings between 1 and 3 m, exactly, its controller seeing the truth: what the estimators are fed with
//! cannot make the flight another one.

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use crate::plant::HeldInputAxis;

/// m [kg].
pub const MASS: f64 = 1.3;
pub(super) const DRIFT: f64 = -9.81;
const KP: f64 = 6.0;
const KD: f64 = 5.0;
/// Angular frequency of the swing [rad/s], nearly.
const OMEGA: f64 = 1.3;

/// One tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tick {
    /// The position with its noise [m].
    pub measured: f32,
    /// The force held until the next tick [N].
    pub force: f32,
    /// The true velocity [m/s].
    pub velocity: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Flight {
    pub axis: HeldInputAxis,
    period: f64,
    generator: Pcg64,
    noise: f64,
    /// Sine and cosine of the swing's phase.
    phase: [f64; 2],
}

impl Flight {
    /// `period` [s]; `noise` is the standard deviation of a measurement [m].
    pub fn new(period: f64, noise: f64, seed: u64) -> Self {
        let axis = HeldInputAxis { position: 2.0, velocity: 0.0, k: 1.0 / MASS, drift: DRIFT };
        Self { axis, period, generator: Pcg64::seed_from_u64(seed), noise, phase: [0.0, 1.0] }
    }

    pub fn next(&mut self) -> Tick {
        let [sine, cosine] = self.phase;
        let HeldInputAxis { position, velocity, .. } = self.axis;
        let acceleration =
            -DRIFT - KD * (velocity - OMEGA * cosine) - KP * (position - 2.0 - sine) - OMEGA * OMEGA * sine;
        let force = (acceleration / self.axis.k) as f32;
        let normal: f64 = StandardNormal.sample(&mut self.generator);
        self.axis.step(f64::from(force), self.period);
        self.turn();
        Tick { measured: (position + self.noise * normal) as f32, force, velocity }
    }

    /// By the tangent of half the angle: the sine of one machine is not that of another to the last bit.
    fn turn(&mut self) {
        let half = 0.5 * OMEGA * self.period;
        let scale = 1.0 / (1.0 + half * half);
        let (sin, cos) = (2.0 * half * scale, (1.0 - half * half) * scale);
        let [sine, cosine] = self.phase;
        self.phase = [sine * cos + cosine * sin, cosine * cos - sine * sin];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It swings about 2 m, by a metre, in 2π/1.3 s.
    #[test]
    fn it_swings() {
        let mut flight = Flight::new(0.01, 0.0, 1);
        let (mut least, mut most) = (f64::MAX, f64::MIN);
        for n in 0..6000 {
            let (t, position) = (f64::from(n) * 0.01, flight.axis.position);
            assert!(t < 5.0 || (position - 2.0 - (OMEGA * t).sin()).abs() < 0.05, "{t}: {position}");
            (least, most) = (least.min(position), most.max(position));
            flight.next();
        }
        assert!(least < 1.1 && most > 2.9 && most < 3.5 && least > 0.5, "{least} to {most}");
    }
}
