//! The paper's rotational model on the same flight: Euler angles as positions, (10), no gyroscopic term. It looks on and
//! steers nothing; for comparison.

use fsb_core::readout::ParameterRule;
use fsb_core::vehicle::{Expected, GroupConfig};
use fsb_core::{Estimator, EstimatorConfig};

use super::error::Refused;
use super::flight::Moment;
use super::reference::narrow;
use super::scenario::Scenario;

/// Three axes η'' = τ/I, identified with the tuning of the scenario's rotation.
#[derive(Clone, Debug)]
pub struct SmallAngle {
    estimator: Estimator<3, 3>,
    substeps: u64,
    /// The last Euler angles, to follow them beyond ±π [rad].
    angles: Option<[f64; 3]>,
}

impl SmallAngle {
    /// For `scenario`; `None` where its attitude comes late, which this model does not make up for.
    ///
    /// # Errors
    /// What the core refuses.
    pub fn new(scenario: &Scenario) -> Result<Option<Self>, Refused> {
        let settings = scenario.estimator.estimator(scenario);
        let GroupConfig { substeps, latency, block, identifier, observer, noise_sd, readout, memory, .. } =
            settings.rotation;
        if latency > 0 {
            return Ok(None);
        }
        let max_relative_sd = settings.rotation.max_relative_sd;
        let config = EstimatorConfig {
            substeps,
            block,
            identifier,
            observer,
            noise_sd,
            readout,
            memory,
            nominal: settings.inertia.map(|expected| expected.nominal.map(|inertia| 1.0 / inertia)),
            rule: settings.inertia.map(|Expected { min, max, .. }| ParameterRule {
                min: 1.0 / max,
                max: 1.0 / min,
                max_relative_sd,
            }),
            parameter_settle: settings.rotation.parameter_settle,
            ..EstimatorConfig::<3, 3>::new(scenario.period())
        };
        let estimator = Estimator::new(&config).map_err(|error| Refused::Core("estimator.rotation", error))?;
        Ok(Some(Self { estimator, substeps: u64::from(substeps), angles: None }))
    }

    /// Looks at one tick.
    pub fn tick(&mut self, moment: &Moment) {
        if moment.tick.is_multiple_of(self.substeps) {
            let angles = moment.attitude.map(|attitude| self.followed(attitude.euler()));
            let measured = angles.map_or([None; 3], |angles| narrow(angles).map(Some));
            // Every measurement instant is a multiple of the substeps.
            let _ = self.estimator.measure(&measured);
        }
        self.estimator.apply(&moment.applied.torque);
    }

    /// The angles without jumps of a turn.
    fn followed(&mut self, euler: [f64; 3]) -> [f64; 3] {
        let turn = std::f64::consts::TAU;
        let angles = match self.angles {
            Some(before) => std::array::from_fn(|i| euler[i] + turn * ((before[i] - euler[i]) / turn).round()),
            None => euler,
        };
        self.angles = Some(angles);
        angles
    }

    /// I_x, I_y, I_z [kg m²], where valid.
    pub fn inertia(&self) -> [Option<f64>; 3] {
        self.estimator.parameters().map(|k| k.map(|k| 1.0 / f64::from(k.value)))
    }
}
