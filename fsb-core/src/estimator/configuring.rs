//! An estimator being configured, in place and without its shape: the code is there once for all numbers of axes, and no
//! estimator is moved.

use super::config::SharedConfig;
use super::design::{AxisDesign, Common, ParameterDesign, Shape};
use super::parts::{Frame, Parts};
use super::shared::Progress;
use crate::checks::Checks;
use crate::error::ConfigError;
use crate::readout::{ParameterRule, ParameterState};

/// To be given what the axes share, then the drift of every axis and the rule of every parameter; it is an estimator once
/// [`finish`](Self::finish) says so.
pub struct Configuring<'a> {
    parts: Parts<'a>,
    shape: Shape,
    checks: Checks,
}

impl<'a> Configuring<'a> {
    #[inline(always)]
    pub(super) const fn new(parts: Parts<'a>, shape: Shape) -> Self {
        Self { parts, shape, checks: Checks::new() }
    }

    /// What does not depend on the number of axes. Comes first.
    #[inline(never)]
    pub fn shared(&mut self, config: &SharedConfig) {
        let Frame { common, progress, .. } = &mut *self.parts.frame;
        common.fill(config, self.shape, &mut self.checks);
        *progress = Progress::start(common);
    }

    /// The known drift c of an axis; see [`super::EstimatorConfig::drift`].
    #[inline(never)]
    pub fn drift(&mut self, axis: usize, drift: f64) {
        let Frame { common, axes, .. } = &mut *self.parts.frame;
        if let Some(axis) = axes.get_mut(axis) {
            axis.own = AxisDesign::new(drift, common, &mut self.checks);
        }
    }

    /// What predicts with a parameter before it is known, NaN where nothing shall, and what makes it valid; see
    /// [`super::EstimatorConfig::nominal`].
    #[inline(never)]
    pub fn parameter(&mut self, index: usize, nominal: f64, rule: &ParameterRule) {
        let own = ParameterDesign::new(nominal, rule, &mut self.checks);
        if let Some(parameter) = self.parts.parameters.get_mut(index) {
            *parameter = ParameterState::start(self.shape.sharing, own.nominal, own.rule);
        }
    }

    /// Starts the estimator.
    ///
    /// # Errors
    /// As [`super::EstimatorDesign::new`], of what was given first. The estimator then takes nothing in and hands nothing out,
    /// until it is configured anew.
    #[inline(never)]
    pub fn finish(mut self) -> Result<(), ConfigError> {
        self.parts.start_axes();
        let outcome = self.checks.outcome();
        if outcome.is_err() {
            self.parts.frame.common.position_limit = Common::NOTHING;
        }
        outcome
    }
}
