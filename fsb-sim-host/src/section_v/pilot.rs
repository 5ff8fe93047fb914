//! What flies the loop: from a measured position to a force.

use super::trajectory::Point;
use crate::plant::HeldInputAxis;

/// What is there at one tick. `truth` is for a pilot that is a yardstick; the estimators must not look at it.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// Measured x, y [m].
    pub measured: [f64; 2],
    /// The reference.
    pub reference: [Point; 2],
    /// The plant as it is.
    pub truth: [HeldInputAxis; 2],
}

/// What a pilot believes at one tick; `None` where it hands out no number yet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Belief {
    /// k̂ [1/kg].
    pub k: Option<f64>,
    /// The standard deviation that the pilot itself gives for k̂ [1/kg].
    pub k_sd: Option<f64>,
    /// (position [m], velocity [m/s]) of x and y.
    pub state: [Option<(f64, f64)>; 2],
}

/// An estimator and its controller in the loop.
pub trait Pilot {
    /// One tick: what is seen, to what is believed and the forces [N] held until the next tick.
    fn tick(&mut self, sight: &Sight) -> (Belief, [f64; 2]);
}

/// (70)-(71) in f64: F = (a_d - K_D (v̂ - v_d) - K_P (ŷ - y_d)) / k. Where there is no estimate yet, the measured
/// position and the reference velocity stand in for it.
pub(super) fn certainty_equivalence(sight: &Sight, belief: &Belief, k: f64) -> [f64; 2] {
    [0, 1].map(|i| {
        let to = sight.reference[i];
        let (position, velocity) = belief.state[i].unwrap_or((sight.measured[i], to.velocity));
        (to.acceleration - super::KD * (velocity - to.velocity) - super::KP * (position - to.position)) / k
    })
}
