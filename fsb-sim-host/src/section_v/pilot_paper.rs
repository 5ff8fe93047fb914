//! The paper's eight-state form in f64 in the loop, with the derivative-based observer (66)-(67) looking on.

use super::pilot::{Belief, Pilot, Sight, certainty_equivalence};
use super::scenario::{EPSILON_OBSERVER, K_RANGE, K0, Scenario};
use crate::paper_form::{AdbConfig, AdbEstimator, ConfigError, PaperEstimator};

/// The paper's estimator, flying.
#[derive(Clone, Debug)]
pub struct PaperPilot {
    estimator: PaperEstimator,
    forces: [f64; 2],
}

impl PaperPilot {
    /// Section V with the settings of [`Scenario::paper_config`].
    ///
    /// # Errors
    /// What the estimator refuses.
    pub fn new(scenario: &Scenario) -> Result<Self, ConfigError> {
        Ok(Self { estimator: PaperEstimator::new(scenario.paper_config(), &[0.0, 0.0])?, forces: [0.0; 2] })
    }

    /// x1, x2 of (53)-(54) of an axis.
    pub fn observer_states(&self, axis: usize) -> Option<[f64; 2]> {
        self.estimator.observer_states(axis)
    }
}

impl Pilot for PaperPilot {
    fn tick(&mut self, sight: &Sight) -> (Belief, [f64; 2]) {
        self.estimator.update(&sight.measured, &self.forces);
        let state = [0, 1].map(|i| self.estimator.position(i).zip(self.estimator.velocity(i)));
        let belief = Belief { k: self.estimator.k(), k_sd: None, state };
        // As in the core's loop, a k̂ that cannot be right is not divided by.
        let k = self.estimator.k_in_use();
        let k = if k >= K_RANGE.0 && k <= K_RANGE.1 { k } else { K0 };
        self.forces = certainty_equivalence(sight, &belief, k);
        (belief, self.forces)
    }
}

/// The paper's loop with both observers on the same data: Figs. 8 and 9.
#[derive(Clone, Debug)]
pub struct ComparedPilot {
    /// What flies.
    pub paper: PaperPilot,
    /// What looks on, x and y, with the k of the paper's form.
    pub adb: [AdbEstimator; 2],
    /// What looks on with the real k from the start.
    pub adb_real_k: [AdbEstimator; 2],
}

impl ComparedPilot {
    /// As [`PaperPilot::new`].
    ///
    /// # Errors
    /// What the estimators refuse.
    pub fn new(scenario: &Scenario) -> Result<Self, ConfigError> {
        let adb = |k0| {
            let period = scenario.period();
            AdbEstimator::new(AdbConfig { period, substeps: 1, epsilon: EPSILON_OBSERVER, k0, drift: 0.0 })
        };
        Ok(Self {
            paper: PaperPilot::new(scenario)?,
            adb: [adb(K0)?, adb(K0)?],
            adb_real_k: [adb(super::K)?, adb(super::K)?],
        })
    }
}

impl Pilot for ComparedPilot {
    fn tick(&mut self, sight: &Sight) -> (Belief, [f64; 2]) {
        // The k that was in use over the interval that ends now, as for the FSB observer.
        let k = self.paper.estimator.k_in_use();
        for (i, (adb, adb_real_k)) in self.adb.iter_mut().zip(&mut self.adb_real_k).enumerate() {
            adb.set_k(k);
            adb.update(sight.measured[i], self.paper.forces[i]);
            adb_real_k.update(sight.measured[i], self.paper.forces[i]);
        }
        self.paper.tick(sight)
    }
}
