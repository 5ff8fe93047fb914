//! The estimator: N axes that share their tunings, and P parameters read out of them.
//!
//! `P = 1` pools all axes into one parameter (1/m from x, y and z); `P = N` gives each axis its own (1/Ix, 1/Iy, 1/Iz).
//!
//! | file | what |
//! |---|---|
//! | `config` | plain data |
//! | `design` | the same, validated and turned into constants |
//! | `schedule` | who has a turn at which measurement |
//! | `axis` | the state of one axis, and what it does at its turns |
//! | `shared` | the state that depends on time alone: windows, gains, weights, covariance |
//! | `step` | the two calls a tick |
//! | `advance` | what a measurement instant does |
//! | `readings` | what is handed out |
//! | `output` | the types of that |

mod advance;
mod axis;
mod config;
mod design;
mod output;
mod readings;
mod schedule;
mod shared;
mod step;

pub use config::EstimatorConfig;
pub use design::EstimatorDesign;
pub use output::{AxisDiagnostics, AxisState, Counters, OutOfStep, StateStatus};

use crate::error::ConfigError;
use crate::readout::ParameterState;
use axis::{Axis, Clocks};
use shared::{IdentifierClock, ObserverClock};

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
#[derive(Clone, Copy, Debug)]
pub struct Estimator<const N: usize, const P: usize> {
    design: EstimatorDesign<N, P>,
    observer: ObserverClock,
    identifier: IdentifierClock,
    axes: [Axis; N],
    parameters: [ParameterState; P],
    /// Control periods since the last measurement instant.
    substep: u32,
    started: bool,
    /// Every axis has been measured and not been lost.
    all_measured: bool,
    /// The next measurement can go the quick way.
    steady: bool,
    counters: Counters,
}

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// Validates `config` and starts empty.
    ///
    /// # Errors
    /// As [`EstimatorDesign::new`].
    pub fn new(config: &EstimatorConfig<N, P>) -> Result<Self, ConfigError> {
        Ok(Self::with_design(EstimatorDesign::new(config)?))
    }

    /// Starts empty on a design made before.
    pub fn with_design(design: EstimatorDesign<N, P>) -> Self {
        Self {
            observer: ObserverClock::START,
            identifier: IdentifierClock::start(design.common.schedule.turn),
            axes: [Axis::start(design.common.noise); N],
            parameters: [ParameterState::START; P],
            substep: 0,
            started: false,
            all_measured: false,
            steady: false,
            counters: Counters::default(),
            design,
        }
    }

    /// Forgets everything but the design and the counters.
    pub fn reset(&mut self) {
        *self = Self { counters: self.counters, ..Self::with_design(self.design) };
    }

    /// Starts the identification anew (section III of the paper: "each reinitialization"), the observer going on. Until
    /// the new k̂ is valid the observer predicts with the nominal parameter, if there is one.
    pub fn reset_identifier(&mut self) {
        let next = if self.started { self.observer.count.saturating_add(1) } else { 0 };
        self.identifier = IdentifierClock::start(next.saturating_add(self.design.common.schedule.turn));
        self.parameters = [ParameterState::START; P];
        self.steady = false;
        for (index, axis) in self.axes.iter_mut().enumerate() {
            axis.reset_identifier(self.design.common.noise);
            if let Some(own) = self.design.own(index) {
                let clocks = Clocks { identifier: &self.identifier, observer: &self.observer };
                axis.change_source(&ParameterState::START, &own, clocks, &self.design.common);
            }
        }
    }
}
