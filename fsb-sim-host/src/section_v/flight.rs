//! One flight of Section V: plant, noise and a pilot.

use super::noise::Noise;
use super::pilot::{Belief, Pilot, Sight};
use super::scenario::{K, Scenario};
use super::trajectory::{Point, reference};
use crate::plant::HeldInputAxis;

/// One tick of a flight.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Ticks since the start.
    pub tick: u64,
    /// [s]
    pub t: f64,
    /// Measured x, y [m].
    pub measured: [f64; 2],
    /// The reference.
    pub reference: [Point; 2],
    /// The plant as it is.
    pub truth: [HeldInputAxis; 2],
    /// What the pilot believes.
    pub belief: Belief,
    /// Forces [N] from here to the next tick.
    pub forces: [f64; 2],
}

impl Moment {
    /// Position [m] and velocity [m/s] estimation errors of an axis; `None` where nothing is estimated.
    pub fn state_error(&self, axis: usize) -> Option<(f64, f64)> {
        let (truth, (position, velocity)) = (self.truth[axis], self.belief.state[axis]?);
        Some((position - truth.position, velocity - truth.velocity))
    }
}

/// Flies `scenario` with `pilot` through the noise of `seed` and shows every tick, the first and the last included, to
/// `watch`.
pub fn fly<P: Pilot>(scenario: &Scenario, seed: u64, pilot: &mut P, mut watch: impl FnMut(&Moment, &P)) {
    let mut noise = Noise::new(scenario.sigma, seed);
    let period = scenario.period();
    let mut truth =
        scenario.initial_state().map(|(position, velocity)| HeldInputAxis { position, velocity, k: K, drift: 0.0 });
    for tick in 0..=scenario.ticks() {
        let t = tick as f64 * period;
        let [dx, dy] = noise.next_pair();
        let measured = [truth[0].position + dx, truth[1].position + dy];
        let reference = reference(t);
        let (belief, forces) = pilot.tick(&Sight { measured, reference, truth });
        watch(&Moment { tick, t, measured, reference, truth, belief, forces }, pilot);
        for (axis, force) in truth.iter_mut().zip(forces) {
            axis.step(force, period);
        }
    }
}

/// The moments of a flight, every `every`-th of them and the last.
pub fn record<P: Pilot>(scenario: &Scenario, seed: u64, pilot: &mut P, every: u64) -> Vec<Moment> {
    let (last, every) = (scenario.ticks(), every.max(1));
    let mut moments = Vec::new();
    fly(scenario, seed, pilot, |moment, _| {
        if moment.tick % every == 0 || moment.tick == last {
            moments.push(*moment);
        }
    });
    moments
}
