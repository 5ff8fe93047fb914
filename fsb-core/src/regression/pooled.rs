//! k over all axes, and whether it may be used.

use super::axis::Axis;
use super::design::Common;
use super::reduced::Estimate;
use crate::readout::{Parameter, ParameterStatus};

/// The square of what rounding leaves of k, relative to it: 2^-22.
const ROUNDING2: f32 = 5.7e-14;

/// k̂ and its status.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pooled {
    /// k with every candidate column, of this round.
    pub trial: Estimate,
    newest: Estimate,
    read: bool,
    credible: bool,
    pub status: ParameterStatus,
}

/// k = Σ info k_i / Σ info, and its variance, with the columns that take part at present free on each axis.
pub(super) fn read(axes: &mut [Axis], common: &Common) -> Estimate {
    let mut noisiest = 0.0;
    for axis in axes.iter().filter(|axis| axis.reduced.information() > 0.0) {
        let own = axis.own_variance(common);
        noisiest = if own > noisiest { own } else { noisiest };
    }
    let information: f32 = axes.iter().map(|axis| axis.weight(noisiest, common)).sum();
    let per_information = 1.0 / information;
    // Nothing known, or so little that it has no inverse.
    if information.is_nan() || !per_information.is_finite() {
        return Estimate { value: 0.0, variance: f32::MAX };
    }
    let mut value = 0.0;
    for axis in axes.iter_mut() {
        axis.share = axis.weight(noisiest, common) * per_information;
        value += axis.share * axis.reduced.k();
    }
    let (mut variance, mut answered) = (0.0, 0.0);
    for axis in axes.iter_mut().filter(|axis| axis.share > 0.0) {
        axis.weigh(value, common);
        variance += axis.share * axis.share * axis.k_variance(common);
        if common.gusts.answered > 0.0 {
            answered += axis.share * axis.answered(common);
        }
    }
    if answered > 0.0 {
        answered /= value;
        variance += answered * answered;
    }
    variance += ROUNDING2 * (value * value);
    Estimate { value, variance: if variance.is_finite() { variance } else { f32::MAX } }
}

impl Pooled {
    /// Reads k with the columns that are used, and judges it.
    pub fn settle(&mut self, axes: &mut [Axis], settled: bool, common: &Common) {
        let rule = &common.rule;
        let newest = read(axes, common);
        if newest.value != 0.0 && newest.value.is_finite() {
            self.newest = newest;
            self.read = true;
        }
        let Estimate { value, variance } = self.newest;
        let value2 = value * value;
        let in_range = value >= rule.min && value <= rule.max;
        let limit =
            if self.status == ParameterStatus::Valid { rule.limit_to_stay } else { rule.relative_variance } * value2;
        self.credible = self.read && in_range && variance <= value2;
        self.status = if !settled {
            ParameterStatus::Settling
        } else if !self.read {
            ParameterStatus::Unexcited
        } else if self.newest.value > rule.max {
            ParameterStatus::AboveRange
        } else if !in_range {
            ParameterStatus::BelowRange
        } else if variance <= limit {
            ParameterStatus::Valid
        } else {
            ParameterStatus::Uncertain
        };
    }

    /// k as it was read last, valid or not; zero before.
    pub const fn newest(&self) -> Estimate {
        self.newest
    }

    /// k, where it is valid.
    pub fn valid(&self) -> Option<Parameter> {
        let Estimate { value, variance } = self.newest;
        (self.status == ParameterStatus::Valid).then_some(Parameter { value, variance })
    }

    /// k, where it is in range and its standard deviation is below its value.
    pub const fn credible(&self) -> Option<f32> {
        if self.credible { Some(self.newest.value) } else { None }
    }
}
