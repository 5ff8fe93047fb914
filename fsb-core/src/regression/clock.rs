//! The state that depends on time alone, shared by all axes: windows, weights, gains.

use super::design::Common;
use super::velocity::VelocityWeights;
use crate::identifier::{Coefficients, UnitChain};
use crate::observer::Gains;
use crate::window::Window;

/// Where the estimator is in time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    window: Window,
    pub at: Coefficients,
    pub velocity_at: VelocityWeights,
    pub unit: UnitChain,
    /// The window is fully open: the weights stay.
    settled: bool,
    observer_window: Window,
    pub gains: Gains,
    /// Measurement instants since the first one; stops at its end.
    pub count: u32,
    /// Measurements since the last row.
    pub phase: u32,
    /// Control periods since the last measurement instant.
    pub substep: u32,
    pub started: bool,
}

impl Clock {
    /// Measurements in which the gains change too fast to be held.
    const HURRIED: u32 = 32;

    pub fn start() -> Self {
        Self {
            window: Window::START,
            at: Coefficients::default(),
            velocity_at: VelocityWeights::default(),
            unit: UnitChain::default(),
            settled: false,
            observer_window: Window::START,
            gains: Gains::FIRST,
            count: 0,
            phase: 0,
            substep: 0,
            started: false,
        }
    }

    /// The identifier's window begins anew with the present measurement.
    pub fn begin_window(&mut self) {
        self.window = Window::START;
        self.unit = UnitChain::default();
        self.settled = false;
    }

    /// To the next measurement: its gains.
    pub fn advance(&mut self, common: &Common) {
        self.count = self.count.saturating_add(1);
        if self.count <= Self::HURRIED {
            self.observer_window.step(&common.observer.window);
            self.gains = Gains::at(&self.observer_window, &common.observer);
        } else if self.count.is_multiple_of(common.gains_every) && !self.observer_window.is_settled() {
            self.observer_window.step(&common.observer_stride);
            self.gains = Gains::at(&self.observer_window, &common.observer);
        }
    }

    /// The weights of the present measurement.
    pub fn weigh(&mut self, common: &Common) {
        if !self.settled {
            self.at = Coefficients::at(&self.window, &common.identifier);
            self.velocity_at = VelocityWeights::at(&self.window, &common.velocity);
            self.settled = self.window.is_settled();
            self.window.step(&common.identifier.window);
        }
        self.unit.step(&common.identifier, &self.at);
    }

    /// Whether the sums of this axis's observer and cascades are to be folded: every eighth measurement, in turns.
    pub const fn folds(&self, axis: u32) -> bool {
        self.count.wrapping_add(axis) & 7 == 7
    }
}
