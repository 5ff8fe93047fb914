//! k, linear drag D and a constant disturbance d, identified together (design, section 9).
//!
//! Model per axis i, k shared by all of them: `y'' = k f - D_i y' + c_i + d_i`. The window and the cascade of the identifier
//! filter any further regressor, and the identity becomes linear regression:
//!
//! `ẑ2 - c ẑu = k ẑ0 - D ẑv + d ẑu`.
//!
//! Who wants only k uses [`crate::Estimator`] and pays nothing for this.
//!
//! | file | what |
//! |---|---|
//! | `config`, `design` | plain data; the same, validated and turned into constants |
//! | `velocity` | ẑv |
//! | `triangle` | the rows of one axis as an upper triangle, by Givens rotations |
//! | `reduced` | the same when it is read: columns left out, k, D and d with their variances |
//! | `turns` | who does what between two rows: columns that can be told, k, D and d |
//! | `pooled` | k over all axes, and its status |
//! | `gusts` | what accelerations that nobody told do to all of these |
//! | `model` | prediction and observer with drag |
//! | `seed` | position and velocity out of the identifier's own states |
//! | `axis`, `clock` | the state of one axis; the state that depends on time alone |
//! | `step`, `readings`, `output` | the calls of a tick, and what is handed out |

mod axis;
mod clock;
mod config;
mod design;
mod gusts;
mod model;
mod output;
mod pooled;
mod readings;
mod reduced;
mod seed;
mod step;
#[cfg(test)]
mod tests;
mod triangle;
mod turns;
mod velocity;

pub use config::{DragConfig, Identify};
pub use model::{DragModel, DragObserver};
pub use output::{AxisTerms, DragDiagnostics, Term};
pub use reduced::{Estimate, Reduced};
pub use triangle::{Row, Triangle};
pub use velocity::{VelocityCascade, VelocityDesign, VelocityWeights};

use crate::error::ConfigError;
use crate::estimator::Counters;
use axis::Axis;
use clock::Clock;
use design::{AxisDesign, Common};
use pooled::Pooled;

/// k, drag and disturbance of N axes (1 to 8) that share k, their positions and velocities.
///
/// Calls as for [`crate::Estimator`]: [`measure`](Self::measure) at a measurement instant, compute the control,
/// [`apply`](Self::apply). A measurement instant comes every `substeps` control periods.
///
/// A term that the data cannot tell counts as zero and is reported [`Term::NotObservable`]. In hover
/// that is every D and d, and k is the one that holds the vehicle against gravity; that they may be another than zero
/// ([`DragConfig::drag_prior_sd`], [`DragConfig::disturbance_prior_sd`]) is in the standard deviation of k. The state does not suffer: what acts
/// constantly beside k f is predicted with, be it told from k or not.
///
/// Non-finite policy: a measurement or an input that is not finite, or larger than its limit, is rejected and counted; a
/// rejected measurement counts as missed and is predicted, a rejected input is replaced by the axis's mean input of late.
/// No allocation, no panic, no transcendental, bounded work a call.
/// Cost: per measurement and axis some 110 operations, and about 400 per row of the regression (every 0.1/λ), spread over
/// the measurements in between.
#[derive(Clone, Copy, Debug)]
pub struct DragEstimator<const N: usize> {
    common: Common,
    axes: [Axis; N],
    clock: Clock,
    pooled: Pooled,
    counters: Counters,
}

impl<const N: usize> DragEstimator<N> {
    const SHAPE: () = assert!(N >= 1 && N <= 8, "1 to 8 axes");

    /// Validates `config` and starts empty.
    ///
    /// # Errors
    /// Names the first parameter that cannot be right.
    pub fn new(config: &DragConfig<N>) -> Result<Self, ConfigError> {
        const { Self::SHAPE };
        let common = Common::new(config)?;
        let mut axes = [Axis::default(); N];
        for (axis, (&c, &identify)) in axes.iter_mut().zip(config.drift.iter().zip(&config.identify)) {
            *axis = Axis::start(AxisDesign::new(c, identify)?);
        }
        let mut estimator =
            Self { common, axes, clock: Clock::start(), pooled: Pooled::default(), counters: Counters::default() };
        estimator.reset();
        Ok(estimator)
    }

    /// Forgets everything but the design and the counters.
    pub fn reset(&mut self) {
        self.clock = Clock::start();
        self.pooled = Pooled::default();
        for axis in &mut self.axes {
            *axis = Axis::start(axis.own);
            axis.follow_nominal(&self.common);
        }
    }
}
