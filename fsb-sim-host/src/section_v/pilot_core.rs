//! The f32 core in the loop: estimator and controller of `fsb_core`, as a flight controller would call them.

use fsb_core::control::{Reference, TrackingConfig, TrackingController};
use fsb_core::estimator::AxisState;
use fsb_core::{ConfigError, Estimator};

use super::pilot::{Belief, Pilot, Sight};
use super::scenario::{K_RANGE, K0, KD, KP, Scenario};
use super::trajectory::Point;

/// Two axes that share k, all in f32.
#[derive(Clone, Debug)]
pub struct CorePilot {
    estimator: Estimator<2, 1>,
    controller: TrackingController,
    forces: [f32; 2],
}

impl CorePilot {
    /// Section V with the settings of [`Scenario::core_config`].
    ///
    /// # Errors
    /// What the core refuses.
    pub fn new(scenario: &Scenario) -> Result<Self, ConfigError> {
        Self::with_estimator(Estimator::new(&scenario.core_config())?)
    }

    /// With an estimator of other settings.
    ///
    /// # Errors
    /// None that the constants of Section V could cause.
    pub fn with_estimator(estimator: Estimator<2, 1>) -> Result<Self, ConfigError> {
        let gains = TrackingConfig { kp: KP, kd: KD, drift: 0.0, parameter_min: K_RANGE.0, parameter_max: K_RANGE.1 };
        Ok(Self { estimator, controller: TrackingController::new(&gains)?, forces: [0.0; 2] })
    }
}

impl Pilot for CorePilot {
    fn tick(&mut self, sight: &Sight) -> (Belief, [f64; 2]) {
        let measured = sight.measured.map(|y| y as f32);
        // Cannot be out of step: one input follows each measurement.
        let _ = self.estimator.measure(&measured.map(Some));
        let [parameter] = self.estimator.parameters();
        let states = self.estimator.states();
        let k = parameter.map_or(K0 as f32, |known| known.value);
        for (i, force) in self.forces.iter_mut().enumerate() {
            let to = in_f32(&sight.reference[i]);
            let state = states[i].unwrap_or(AxisState { position: measured[i], velocity: to.velocity });
            // A force that cannot be computed leaves the last one standing.
            *force = self.controller.input(&to, &state, k).unwrap_or(*force);
        }
        self.estimator.apply(&self.forces);
        let belief = Belief {
            k: parameter.map(|known| f64::from(known.value)),
            k_sd: parameter.map(|known| f64::from(known.sd())),
            state: states.map(|state| state.map(|s| (f64::from(s.position), f64::from(s.velocity)))),
        };
        (belief, self.forces.map(f64::from))
    }
}

fn in_f32(point: &Point) -> Reference {
    Reference {
        position: point.position as f32,
        velocity: point.velocity as f32,
        acceleration: point.acceleration as f32,
    }
}
