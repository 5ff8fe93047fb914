//! An estimator behind the gates.

use super::config::{GuardConfig, GuardDesign};
use super::gate::Gate;
use super::verdict::{Rejections, Verdict};
use crate::error::ConfigError;
use crate::estimator::{Estimator, EstimatorConfig, OutOfStep};
use crate::moments::InputMoments;
use core::ops::Deref;

/// An [`Estimator`] that is shown only what can be true. Its read-outs are those of the estimator, by `Deref`.
///
/// Non-finite policy: rejected and counted, see [`Verdict`]. Cost of the gate: about 35 operations an axis and measurement.
#[derive(Clone, Copy, Debug)]
pub struct Guarded<const N: usize, const P: usize> {
    estimator: Estimator<N, P>,
    design: GuardDesign,
    expecting: Gate,
    gates: [Gate; N],
    verdicts: [Verdict; N],
    rejections: Rejections,
    /// Measurement instants since the first; saturates.
    instants: u8,
}

impl<const N: usize, const P: usize> Guarded<N, P> {
    /// Measurement instants before innovations are judged: the dead-beat start makes the first ones large.
    const FIRST: u8 = 6;

    /// Validates both.
    ///
    /// # Errors
    /// As [`EstimatorDesign::new`](crate::EstimatorDesign::new) and [`GuardDesign::new`].
    pub fn new(config: &EstimatorConfig<N, P>, guard: &GuardConfig) -> Result<Self, ConfigError> {
        let estimator = Estimator::new(config)?;
        let period = config.period * f64::from(config.substeps);
        let design = GuardDesign::new(guard, config.observer, period)?;
        let expecting = Gate::expecting(config.noise_sd.map(|sd| estimator.innovation_step_variance((sd * sd) as f32)));
        Ok(Self {
            estimator,
            design,
            expecting,
            gates: [expecting; N],
            verdicts: [Verdict::Missing; N],
            rejections: Rejections::default(),
            instants: 0,
        })
    }

    /// As [`Estimator::measure`]; returns what became of each measurement.
    ///
    /// # Errors
    /// As [`Estimator::measure`].
    pub fn measure(&mut self, positions: &[Option<f32>; N]) -> Result<[Verdict; N], OutOfStep> {
        self.estimator.in_step()?;
        let expected = self.estimator.expected();
        let limit = self.estimator.position_limit();
        let settled = self.instants >= Self::FIRST;
        let mut given = [f32::NAN; N];
        let mut moved = [0.0; N];
        let each = self.gates.iter_mut().zip(&mut self.verdicts).zip(&expected).zip(&mut moved);
        for ((((gate, verdict), expected), moved), (position, given)) in each.zip(positions.iter().zip(&mut given)) {
            *verdict = match *position {
                Some(y) => gate.judge(y, *expected, limit, settled, &self.design),
                None => {
                    gate.miss();
                    Verdict::Missing
                }
            };
            self.rejections.count(*verdict);
            if verdict.is_used() {
                *given = position.unwrap_or(f32::NAN);
            }
            if let Verdict::Jumped(by) = *verdict {
                *moved = by;
            }
        }
        if self.verdicts.iter().any(|v| matches!(v, Verdict::Jumped(_))) {
            self.estimator.translate(&moved);
        }
        self.estimator.measure_raw(&given)?;
        if self.instants < Self::FIRST && self.estimator.has_started() {
            self.instants += 1;
        }
        Ok(self.verdicts)
    }

    /// As [`Estimator::apply`].
    pub fn apply(&mut self, inputs: &[f32; N]) {
        self.count_late();
        self.estimator.apply(inputs);
    }

    /// As [`Estimator::apply_ramp`].
    pub fn apply_ramp(&mut self, from: &[f32; N], to: &[f32; N]) {
        self.count_late();
        self.estimator.apply_ramp(from, to);
    }

    /// As [`Estimator::apply_moments`].
    pub fn apply_moments(&mut self, moments: &[InputMoments; N]) {
        self.count_late();
        self.estimator.apply_moments(moments);
    }

    /// An input that goes past a measurement instant at which nothing came.
    fn count_late(&mut self) {
        if self.estimator.has_started() && self.estimator.is_due() {
            for (gate, verdict) in self.gates.iter_mut().zip(&mut self.verdicts) {
                gate.miss();
                *verdict = Verdict::Missing;
                self.rejections.count(*verdict);
            }
        }
    }

    /// As [`Estimator::reset`]; what was learned of the noise goes as well.
    pub fn reset(&mut self) {
        self.estimator.reset();
        self.gates = [self.expecting; N];
        self.verdicts = [Verdict::Missing; N];
        self.instants = 0;
    }

    /// As [`Estimator::reinitialise_identifier`].
    pub fn reinitialise_identifier(&mut self) {
        self.estimator.reinitialise_identifier();
    }

    /// As [`Estimator::reset_identifier`].
    pub fn reset_identifier(&mut self) {
        self.estimator.reset_identifier();
    }

    /// What became of the measurements at the last instant.
    pub const fn verdicts(&self) -> [Verdict; N] {
        self.verdicts
    }

    /// What was not used, and why.
    pub const fn rejections(&self) -> Rejections {
        self.rejections
    }
}

impl<const N: usize, const P: usize> Deref for Guarded<N, P> {
    type Target = Estimator<N, P>;

    fn deref(&self) -> &Estimator<N, P> {
        &self.estimator
    }
}
