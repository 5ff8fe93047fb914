//! The estimator: N axes that share their tunings, and P parameters read out of them.
//!
//! `P = 1` pools all axes into one parameter (1/m from x, y and z); `P = N` gives each axis its own (1/Ix, 1/Iy, 1/Iz).
//!
//! | file | what |
//! |---|---|
//! | `config` | plain data |
//! | `design` | the same, validated and turned into constants |
//! | `configuring` | an estimator being configured, part by part and in place |
//! | `schedule` | who has a turn at which measurement |
//! | `axis` | the state of one axis, and what it does at its turns |
//! | `identify` | its block through the cascade, and into its parameter's sums |
//! | `anew` | the identification begun anew, and what becomes of what is known |
//! | `learning` | learning only when told |
//! | `shared` | the state that depends on time alone: windows, gains, weights, covariance |
//! | `step` | the two calls a tick |
//! | `advance` | what a measurement instant does |
//! | `singles` | the same where blocks are single samples |
//! | `repair` | measurements that did not come, or cannot be right |
//! | `parts` | an estimator without its shape: code that is there once for all shapes |
//! | `expectation` | what the next measurement should be, for a gate in front |
//! | `stored` | what a snapshot holds |
//! | `readings` | what is handed out |
//! | `view` | the same without the shape, for the C interface |
//! | `output` | the types of that |

mod advance;
mod anew;
mod axis;
mod config;
mod configuring;
mod design;
mod expectation;
mod identify;
mod learning;
mod output;
mod parts;
mod readings;
mod repair;
mod schedule;
mod shared;
mod singles;
mod step;
mod stored;
#[cfg(test)]
mod tests;
mod view;

pub use config::{EstimatorConfig, SharedConfig};
pub use configuring::Configuring;
pub use design::EstimatorDesign;
pub use output::{AxisDiagnostics, AxisState, Counters, Learning, OutOfStep, StateStatus};
pub(crate) use output::{IdentifierView, InnovationView, InputShift};
pub use view::View;

use crate::error::ConfigError;
use crate::readout::ParameterState;
use anew::Known;
use axis::Axis;
use config::or_nan;
use design::Shape;
use parts::{Frame, Parts};
use shared::Progress;

/// k of N axes (P parameters), their positions and velocities, from positions and known inputs alone.
///
/// Model (15): `y'' = k f + c` per axis, c known. At a measurement instant call [`measure`](Self::measure) with the
/// positions; compute the control; call [`apply`](Self::apply) with the input that is held until the next control instant.
/// A measurement instant comes every `substeps` control periods, the first with the first call of `measure`. Where
/// `measure` is not called at such an instant, or an axis gives `None`, the axis is predicted and not corrected.
///
/// Non-finite policy: a measurement or an input that is not finite, or larger than its limit, is rejected and counted; a
/// rejected measurement counts as missed, a rejected input is replaced by the axis's mean input of late.
/// What is not valid is not handed out: see [`parameters`](Self::parameters) and [`states`](Self::states).
/// No allocation, no panic, no transcendental, bounded work a call.
// What every measurement touches comes first, within reach of one base address.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Estimator<const N: usize, const P: usize> {
    frame: Frame<[Axis; N]>,
    parameters: [ParameterState; P],
}

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// Axes to a parameter.
    const SHARING: u8 = Shape::of::<N, P>().sharing;

    /// Validates `config` and starts empty.
    ///
    /// # Errors
    /// As [`EstimatorDesign::new`].
    pub fn new(config: &EstimatorConfig<N, P>) -> Result<Self, ConfigError> {
        let mut estimator = Self::unconfigured();
        let mut configuring = estimator.configuring();
        configuring.shared(&config.shared());
        for (index, &drift) in config.drift.iter().enumerate() {
            configuring.drift(index, drift);
        }
        for (index, (&nominal, rule)) in config.nominal.iter().zip(&config.rule).enumerate() {
            configuring.parameter(index, or_nan(nominal), rule);
        }
        configuring.finish()?;
        Ok(estimator)
    }

    /// Takes nothing in and hands nothing out before it is configured: for storage that is there already, see
    /// [`configuring`](Self::configuring).
    #[inline(always)]
    pub fn unconfigured() -> Self {
        Self { frame: Frame::blank(), parameters: [ParameterState::BLANK; P] }
    }

    /// Validates a configuration part by part, and starts empty: what [`new`](Self::new) does, in place.
    #[inline(always)]
    pub fn configuring(&mut self) -> Configuring<'_> {
        Configuring::new(self.parts(), Shape::of::<N, P>())
    }

    /// Starts empty on a design made before.
    pub fn with_design(design: EstimatorDesign<N, P>) -> Self {
        let EstimatorDesign { common, axes, parameters } = design;
        let parameters = parameters.map(|own| ParameterState::start(Self::SHARING, own.nominal, own.rule));
        let axes = axes.map(|own| Axis { own, ..Axis::default() });
        let mut estimator = Self { frame: Frame { progress: Progress::start(&common), axes, common }, parameters };
        estimator.parts().start_axes();
        estimator
    }

    /// Forgets everything but the design and the counters.
    pub fn reset(&mut self) {
        let Frame { common, progress, .. } = &mut self.frame;
        *progress = progress.anew(common);
        for parameter in &mut self.parameters {
            parameter.restart(Self::SHARING);
        }
        self.parts().start_axes();
    }

    /// Forgets everything but the design, the counters and the parameters: those that are valid or held are handed out, and
    /// predicted with, until the new ones are valid. For a measurement that has jumped.
    pub fn restart(&mut self) {
        let Frame { common, progress, .. } = &mut self.frame;
        *progress = progress.anew(common);
        for parameter in &mut self.parameters {
            parameter.hold(Self::SHARING);
        }
        self.parts().start_axes();
    }

    /// Starts the identification anew (section III of the paper: "each reinitialization"), the observer going on. Until
    /// the new k̂ is valid the observer predicts with the nominal parameter, if there is one.
    pub fn reset_identifier(&mut self) {
        self.parts().begin_window(Known::Forgotten);
    }

    /// The identifier's window begins anew, and what has been learned stays: for inputs of late that were not what acted.
    pub(crate) fn reopen_window(&mut self) {
        self.parts().begin_window(Known::Kept);
    }

    /// Starts the identification anew as [`reset_identifier`](Self::reset_identifier) does, without losing what is known: a
    /// parameter that is valid goes on being handed out ([`ParameterStatus::Held`]), and the observer goes on predicting with
    /// it, until the new k̂ is valid.
    ///
    /// [`ParameterStatus::Held`]: crate::readout::ParameterStatus::Held
    pub fn reinitialise_identifier(&mut self) {
        self.parts().begin_window(Known::Held);
    }

    /// What has told that the values held are no longer right may have been a disturbance that goes on.
    pub(crate) fn suspect_disturbance(&mut self) {
        for parameter in &mut self.parameters {
            parameter.suspect();
        }
    }

    /// The same without its shape.
    #[inline(always)]
    fn parts(&mut self) -> Parts<'_> {
        Parts { frame: &mut self.frame, parameters: &mut self.parameters }
    }
}
