//! Identifier and observer on sampled data, as they fly a loop in Section V: eight states an axis, and one k.
//!
//! Until ε of the parameter the observer runs on k0; from then on it is given the newest k with every step. What k0 left in
//! the observer's states fades with λ, as it does in the paper.

use thiserror::Error;

use super::adb::{chord, reached};
use super::identifier::{Identifier, absolute_ratio};
use super::observer::Observer;
use super::rk4::Step;
use super::window::Tuning;

/// A parameter that makes no sense.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{name} = {value}: must be {needs}")]
pub struct ConfigError {
    /// The field's name.
    pub name: &'static str,
    /// What was given.
    pub value: f64,
    /// What is wanted.
    pub needs: &'static str,
}

/// Which axes (44) is read from when several share one k.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ParameterFrom {
    /// The first axis alone. The paper's choice: of (15) it selects i = 1, 4, 5, 6, so the mass comes from the x axis.
    #[default]
    FirstAxis,
    /// All axes: the sums of their integrals.
    AllAxes,
}

/// How a [`PaperEstimator`] runs. The default is Section V at 10 kHz.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperConfig {
    /// λ [1/s], positive.
    pub lambda: f64,
    /// q [1/s], positive.
    pub q: f64,
    /// No position or velocity before this time [s], positive.
    pub epsilon_observer: f64,
    /// No parameter before this time [s], positive; until then the observer runs on `k0`.
    pub epsilon_parameter: f64,
    /// Nominal k, used before `epsilon_parameter`.
    pub k0: f64,
    /// T [s], positive.
    pub period: f64,
    /// Runge-Kutta steps per period, at least 1.
    pub substeps: u32,
    /// Where k comes from.
    pub parameter_from: ParameterFrom,
}

impl Default for PaperConfig {
    fn default() -> Self {
        Self {
            lambda: 2.0,
            q: 1.0,
            epsilon_observer: 0.1,
            epsilon_parameter: 1.0,
            k0: 1.0,
            period: 1e-4,
            substeps: 1,
            parameter_from: ParameterFrom::FirstAxis,
        }
    }
}

/// The paper's estimator for axes that share one parameter.
#[derive(Clone, Debug)]
pub struct PaperEstimator {
    config: PaperConfig,
    identifiers: Vec<Identifier>,
    observers: Vec<Observer>,
    y_before: Vec<f64>,
    samples: u64,
}

impl PaperEstimator {
    /// One axis for each known drift c [m/s²] in `drifts`; `&[0.0, 0.0]` for x and y of Section V. The first sample is t = 0.
    ///
    /// # Errors
    /// Names the field that is out of range, or `axes` when there is none.
    pub fn new(config: PaperConfig, drifts: &[f64]) -> Result<Self, ConfigError> {
        positive("lambda", config.lambda)?;
        positive("q", config.q)?;
        positive("epsilon_observer", config.epsilon_observer)?;
        positive("epsilon_parameter", config.epsilon_parameter)?;
        positive("period", config.period)?;
        positive("substeps", f64::from(config.substeps))?;
        positive("axes", drifts.len() as f64)?;
        let tuning = Tuning { lambda: config.lambda, q: config.q };
        Ok(Self {
            config,
            identifiers: drifts.iter().map(|&drift| Identifier::new(tuning, drift)).collect(),
            observers: drifts.iter().map(|&drift| Observer::new(tuning, config.k0, drift)).collect(),
            y_before: vec![0.0; drifts.len()],
            samples: 0,
        })
    }

    /// Takes one sample of every axis: positions `y` [m] and the inputs `f_held_before` [N] that acted since the sample
    /// before (ignored with the first). Both in the order of the axes; what is missing or over is left out.
    pub fn update(&mut self, y: &[f64], f_held_before: &[f64]) {
        if self.samples > 0 {
            self.advance(y, f_held_before);
        }
        for (before, &y) in self.y_before.iter_mut().zip(y) {
            *before = y;
        }
        self.samples += 1;
    }

    fn advance(&mut self, y: &[f64], f: &[f64]) {
        let PaperConfig { lambda, q, period, substeps, .. } = self.config;
        let start = (self.samples - 1) as f64 * period;
        let parts = f64::from(substeps);
        let k = self.k_in_use();
        for part in 0..substeps {
            let from = f64::from(part) / parts;
            let step = Step::new(Tuning { lambda, q }, start + from * period, period / parts);
            let axes = self.identifiers.iter_mut().zip(&mut self.observers).zip(&self.y_before).zip(y).zip(f);
            for ((((identifier, observer), &y_before), &y), &f) in axes {
                let (y, f) = (chord(y_before, y, from, 1.0 / parts), [f; 3]);
                observer.set_k(k);
                identifier.step(&step, &y, &f);
                observer.step(&step, &y, &f);
            }
        }
    }

    /// (44). `None` before ε of the parameter, and while no input has acted.
    pub fn k(&self) -> Option<f64> {
        if !reached(self.samples, self.config.period, self.config.epsilon_parameter) {
            return None;
        }
        match self.config.parameter_from {
            ParameterFrom::FirstAxis => self.identifiers.first().and_then(Identifier::k),
            ParameterFrom::AllAxes => absolute_ratio(&self.identifiers),
        }
    }

    /// The k that the observer and a controller use: [`Self::k`], or `k0` while there is none.
    pub fn k_in_use(&self) -> f64 {
        self.k().unwrap_or(self.config.k0)
    }

    /// ŷ [m] of an axis. `None` before ε of the observer, or where there is no such axis.
    pub fn position(&self, axis: usize) -> Option<f64> {
        self.switched_on(axis)?.position()
    }

    /// ŷ' [m/s] of an axis. `None` before ε of the observer, or where there is no such axis.
    pub fn velocity(&self, axis: usize) -> Option<f64> {
        self.switched_on(axis)?.velocity()
    }

    fn switched_on(&self, axis: usize) -> Option<&Observer> {
        let observer = self.observers.get(axis)?;
        reached(self.samples, self.config.period, self.config.epsilon_observer).then_some(observer)
    }

    /// ẑ2 - c ẑu of an axis; without drift this is ẑ2 of (38). Times λ³ it is a filtered acceleration [m/s²].
    pub fn z2(&self, axis: usize) -> Option<f64> {
        self.identifiers.get(axis).map(Identifier::z2_without_drift)
    }

    /// ẑ0 of an axis. Times λ³ it is a filtered force [N].
    pub fn z0(&self, axis: usize) -> Option<f64> {
        self.identifiers.get(axis).map(Identifier::z0)
    }

    /// x1, x2 of (53)-(54) of an axis, as in Fig. 9.
    pub fn observer_states(&self, axis: usize) -> Option<[f64; 2]> {
        self.observers.get(axis).map(Observer::states)
    }

    /// The six states (38) of an axis.
    pub fn identifier_states(&self, axis: usize) -> Option<[f64; 6]> {
        self.identifiers.get(axis).map(Identifier::states)
    }
}

/// Refuses what is not a positive finite number.
pub(super) fn positive(name: &'static str, value: f64) -> Result<(), ConfigError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(ConfigError { name, value, needs: "a positive finite number" })
    }
}

#[cfg(test)]
mod tests;
