//! What an estimator hands out at every tick, without its shape: the code is there once for all numbers of axes.
//!
//! Where all estimators of a program have the same number of axes the compiler finds out, and writes the loops out axis by axis.
//! It is not to know: hence `black_box`.

use super::Estimator;
use super::axis::{Axis, Source};
use super::output::{AxisState, Counters, StateStatus};
use super::parts::Frame;
use crate::readout::{Parameter, ParameterState, ParameterStatus};
use core::hint::black_box;

/// An estimator of any shape, to be read.
#[derive(Clone, Copy)]
pub struct View<'a> {
    frame: &'a Frame<[Axis]>,
    parameters: &'a [ParameterState],
}

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// The same without its shape.
    #[inline(always)]
    pub fn view(&self) -> View<'_> {
        View { frame: &self.frame, parameters: &self.parameters }
    }
}

impl View<'_> {
    /// Hands out [`Estimator::state_status`] and [`Estimator::states`], axis by axis.
    #[inline(always)]
    pub fn states(&self, mut each: impl FnMut(StateStatus, Option<AxisState>)) {
        let Frame { common, progress, axes } = self.frame;
        let gains = progress.observer.gains;
        let count = progress.observer.count;
        let per_period = common.observer.per_period;
        // Time since the last measurement instant over T.
        let t = progress.substep as f32 * common.substep_share;
        let half_t2 = 0.5 * t * t;
        for axis in black_box(axes) {
            let status = match axis.source {
                _ if !axis.measured => StateStatus::NotMeasured,
                _ if count < axis.settled_at => StateStatus::Settling,
                Source::Identified => StateStatus::Identified,
                Source::Nominal => StateStatus::Nominal,
                Source::Held => StateStatus::Held,
                Source::Provisional | Source::Nothing => StateStatus::NoParameter,
            };
            let state = (count >= axis.usable_at).then(|| {
                let (w, model, input) = (axis.observer.t_velocity(), &axis.model, &axis.moments);
                let (position, t_velocity) = if progress.substep == 0 {
                    (axis.observer.corrected(&gains), w)
                } else {
                    let moved = t * w + model.k_t2 * input.j2 + model.c_t2 * half_t2;
                    (axis.observer.position(moved, &gains), w + model.k_t2 * input.j1 + model.c_t2 * t)
                };
                AxisState { position, velocity: t_velocity * per_period }
            });
            each(status, state);
        }
    }

    /// Hands out [`Estimator::parameter_status`] and [`Estimator::parameters`], one by one.
    #[inline(always)]
    pub fn parameters(&self, mut each: impl FnMut(ParameterStatus, Option<Parameter>)) {
        for parameter in self.parameters {
            each(parameter.status, parameter.valid());
        }
    }

    /// [`Estimator::counters`].
    #[inline(always)]
    pub const fn counters(&self) -> Counters {
        self.frame.progress.counters
    }
}
