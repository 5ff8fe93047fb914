//! The yardstick of Fig. 6: the controller that knows k and sees position and velocity as they are.

use super::pilot::{Belief, Pilot, Sight, certainty_equivalence};

/// Knows everything.
#[derive(Clone, Copy, Debug, Default)]
pub struct IdealPilot;

impl Pilot for IdealPilot {
    fn tick(&mut self, sight: &Sight) -> (Belief, [f64; 2]) {
        let state = sight.truth.map(|axis| Some((axis.position, axis.velocity)));
        let belief = Belief { k: Some(super::K), k_sd: None, state };
        (belief, certainty_equivalence(sight, &belief, super::K))
    }
}
