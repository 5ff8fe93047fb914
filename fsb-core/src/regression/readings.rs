//! What is handed out.

use super::axis::{Axis, Source};
use super::output::{AxisTerms, DragDiagnostics, Term};
use super::reduced::Estimate;
use super::{DragEstimator, Identify};
use crate::estimator::{AxisState, Counters, StateStatus};
use crate::readout::{Parameter, ParameterStatus};

impl<const N: usize> DragEstimator<N> {
    /// k̂, where it is valid.
    pub fn parameter(&self) -> Option<Parameter> {
        self.pooled.valid()
    }

    /// Why k̂ is valid or not.
    pub const fn parameter_status(&self) -> ParameterStatus {
        self.pooled.status
    }

    /// D and d of each axis, and whether the data tell. Uses square roots: for reports.
    pub fn terms(&self) -> [AxisTerms; N] {
        let valid = self.pooled.valid().is_some();
        self.axes.each_ref().map(|axis| {
            let Identify { drag, disturbance } = axis.own.identify;
            AxisTerms {
                drag: term(drag, valid && axis.used.drag, axis.drag),
                disturbance: term(disturbance, valid && axis.used.disturbance, axis.disturbance),
            }
        })
    }

    /// The mean square of the regression's residual on each axis (m²/s⁴), over all rows, with what is used at present; `None`
    /// before there is a row.
    pub fn residual_variance(&self) -> [Option<f32>; N] {
        let k = self.pooled.newest().value;
        self.axes.each_ref().map(|axis| {
            let count = axis.triangle.count();
            let used = axis.triangle.keep(axis.used.disturbance, axis.used.drag, self.common.row_rate2);
            let variance = used.residual(k) * self.common.per_scale2 / count;
            (count > 0.0 && variance.is_finite()).then_some(variance)
        })
    }

    /// The states at the present control instant that may be used: predicted from the last measurement instant with what
    /// was applied since.
    pub fn states(&self) -> [Option<AxisState>; N] {
        let t = self.clock.substep as f32 * self.common.substep_share;
        self.axes.each_ref().map(|axis| self.is_usable(axis).then(|| self.state(axis, t)))
    }

    fn is_usable(&self, axis: &Axis) -> bool {
        let predicted = matches!(axis.source, Source::Identified | Source::Nominal);
        axis.measured && predicted && self.clock.count >= axis.settled_at
    }

    fn state(&self, axis: &Axis, t: f32) -> AxisState {
        let (gains, observer) = (&self.clock.gains, axis.observer.state());
        let w = observer.t_velocity();
        if self.clock.substep == 0 {
            return AxisState {
                position: observer.position(0.0, gains),
                velocity: observer.velocity(&self.common.observer),
            };
        }
        let motion = axis.model.within(t).motion(w, axis.moments);
        AxisState {
            position: observer.position(t * w + motion.j2, gains),
            velocity: (w + motion.j1) * self.common.observer.per_period,
        }
    }

    /// Why a state may be used or not.
    pub fn state_status(&self) -> [StateStatus; N] {
        self.axes.each_ref().map(|axis| match axis.source {
            _ if !axis.measured => StateStatus::NotMeasured,
            _ if self.clock.count < axis.settled_at => StateStatus::Settling,
            Source::Identified => StateStatus::Identified,
            Source::Nominal => StateStatus::Nominal,
            Source::Provisional | Source::Nothing => StateStatus::NoParameter,
        })
    }

    /// The regression's inner signals: for logs and tests, not for control.
    pub fn diagnostics(&self) -> [DragDiagnostics; N] {
        let k = self.pooled.credible();
        let scale = self.common.identifier.scale;
        self.axes.each_ref().map(|axis| {
            let row = axis.row(&self.clock);
            let (z2, z0, zv, zu) = (row.z2 / scale, row.z0 / scale, -row.minus_zv / scale, row.zu / scale);
            let explained = |k| k * z0 - axis.drag.value * zv + axis.disturbance.value * zu;
            DragDiagnostics {
                z2,
                z0,
                zv,
                zu,
                residual: k.map_or(0.0, |k| z2 - explained(k)),
                innovation: axis.observer.state().innovation(),
            }
        })
    }

    /// What has been missed or rejected.
    pub const fn counters(&self) -> Counters {
        self.counters
    }
}

fn term(asked: bool, known: bool, estimate: Estimate) -> Term {
    match (asked, known) {
        (false, _) => Term::NotAsked,
        (true, false) => Term::NotObservable,
        (true, true) => Term::Known { value: estimate.value, sd: libm::sqrtf(estimate.variance) },
    }
}
