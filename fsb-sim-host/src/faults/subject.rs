//! Who is tested.

use fsb_core::guard::{GuardConfig, Guarded};
use fsb_core::readout::Memory;
use fsb_core::{ConfigError, Estimator, EstimatorConfig};

use super::flight::{DRIFT, MASS};

/// Which of the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `Guarded`.
    Guarded,
    /// `Estimator`.
    Bare,
}

/// One of the two, at work.
#[derive(Clone, Debug)]
pub(super) enum Subject {
    Guarded(Box<Guarded<1, 1>>),
    Bare(Box<Estimator<1, 1>>),
}

/// Defaults, a first mass that is 15 % too high, and an input limit of twice the weight and a half.
pub(super) fn config(period: f64) -> EstimatorConfig<1, 1> {
    EstimatorConfig {
        drift: [DRIFT],
        nominal: [Some(1.0 / (1.15 * MASS))],
        input_limit: INPUT_LIMIT,
        memory: Memory::Infinite,
        ..EstimatorConfig::new(period)
    }
}

/// The largest force that the motors can give [N].
pub(super) const INPUT_LIMIT: f64 = 32.0;

impl Subject {
    pub fn new(kind: Kind, config: &EstimatorConfig<1, 1>, guard: &GuardConfig) -> Result<Self, ConfigError> {
        Ok(match kind {
            Kind::Guarded => Self::Guarded(Box::new(Guarded::new(config, guard)?)),
            Kind::Bare => Self::Bare(Box::new(Estimator::new(config)?)),
        })
    }

    /// Whether it was used. Calls that are out of step, of which there are none here, use nothing.
    pub fn measure(&mut self, position: Option<f32>) -> bool {
        match self {
            Self::Guarded(it) => it.measure(&[position]).is_ok_and(|[verdict]| verdict.is_used()),
            Self::Bare(it) => {
                let missed = it.counters().missed;
                it.measure(&[position]).is_ok() && it.counters().missed == missed
            }
        }
    }

    /// Whether it was used as it is.
    pub fn apply(&mut self, force: f32) -> bool {
        let rejected = self.estimator().counters().rejected_inputs;
        match self {
            Self::Guarded(it) => it.apply(&[force]),
            Self::Bare(it) => it.apply(&[force]),
        }
        self.estimator().counters().rejected_inputs == rejected
    }

    /// v̂ [m/s].
    pub fn velocity(&self) -> Option<f64> {
        let [state] = match self {
            Self::Guarded(it) => it.states(),
            Self::Bare(it) => it.states(),
        };
        state.map(|state| f64::from(state.velocity))
    }

    /// k̂ [1/kg].
    pub fn k(&self) -> Option<f64> {
        self.estimator().parameters()[0].map(|k| f64::from(k.value))
    }

    fn estimator(&self) -> &Estimator<1, 1> {
        match self {
            Self::Guarded(it) => it,
            Self::Bare(it) => it,
        }
    }
}
