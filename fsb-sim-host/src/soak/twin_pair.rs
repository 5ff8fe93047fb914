//! The f64 twin of the soaked estimator: identifier, least squares and observer of two axes.

use fsb_core::estimator::EstimatorConfig;

use super::plan::DRIFT;
use crate::twin::{Moments, TwinIdentifier, TwinLeastSquares, TwinObserver};

#[derive(Clone, Debug)]
pub(super) struct TwinPair {
    period: f64,
    identifiers: [TwinIdentifier; 2],
    observers: [TwinObserver; 2],
    read_out: TwinLeastSquares,
}

impl TwinPair {
    /// With the tunings, the drift and the nominal parameter of `config`.
    pub fn new(config: &EstimatorConfig<2, 1>) -> Self {
        let (identifier, observer, period) = (config.identifier, config.observer, config.period);
        let k0 = config.nominal[0].unwrap_or(0.0);
        Self {
            period,
            identifiers: [0, 1].map(|_| TwinIdentifier::new(identifier.lambda, identifier.q, period, 1)),
            observers: config.drift.map(|c| TwinObserver::new(observer.lambda, observer.q, period, k0, c)),
            read_out: TwinLeastSquares::new(None, period),
        }
    }

    /// A measurement of both axes and the forces that acted before it.
    pub fn update(&mut self, measured: &[f32; 2], forces: &[f32; 2]) {
        let mut outputs = [(0.0, 0.0); 2];
        for (i, (&y, &f)) in measured.iter().zip(forces).enumerate() {
            let Moments { j1, j2 } = Moments::held(f64::from(f), self.period);
            self.observers[i].update(Some(f64::from(y)), j1, j2);
            if let Some(out) = self.identifiers[i].sample(f64::from(y), j1, j2) {
                outputs[i] = (out.z2_without_drift(f64::from(DRIFT[i])), out.z0);
            }
        }
        self.read_out.add(&outputs);
    }

    /// The k that the observers use from now on.
    pub fn set_k(&mut self, k: f64) {
        for observer in &mut self.observers {
            observer.set_k(k);
        }
    }

    pub fn k(&self) -> Option<f64> {
        self.read_out.k()
    }

    pub fn states(&self) -> [Option<(f64, f64)>; 2] {
        [self.observers[0].estimate(), self.observers[1].estimate()]
    }
}
