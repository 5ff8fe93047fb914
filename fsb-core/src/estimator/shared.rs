//! The state that depends on time alone, shared by all axes: windows, gains, weights, covariance.

use super::design::EstimatorDesign;
use crate::identifier::{Coefficients, UnitChain};
use crate::observer::Gains;
use crate::readout::NoiseShape;
use crate::window::Window;

/// The observer's part: one step a measurement.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObserverClock {
    window: Window,
    pub gains: Gains,
    pub before: Gains,
    /// Measurement instants since the first one; saturates.
    pub count: u32,
    /// Measurements until the gains are renewed.
    until: u32,
    /// The window moves with the renewals, not with the measurements.
    striding: bool,
}

impl ObserverClock {
    /// Measurements in which the gains change too fast to be held.
    const HURRIED: u32 = 32;

    pub const fn start(first: u32) -> Self {
        Self {
            window: Window::START,
            gains: Gains::FIRST,
            before: Gains::FIRST,
            count: 0,
            until: first,
            striding: false,
        }
    }

    /// To the next measurement.
    #[inline(always)]
    pub fn step<const N: usize, const P: usize>(&mut self, design: &EstimatorDesign<N, P>) {
        self.before = self.gains;
        self.count = self.count.saturating_add(1);
        let due = self.until == 0;
        self.until = if due { design.schedule.gains_every - 1 } else { self.until - 1 };
        if self.striding {
            if due && !self.window.is_settled() {
                self.window.step(&design.observer_stride);
                self.gains = Gains::at(&self.window, &design.observer);
            }
        } else {
            self.window.step(&design.observer.window);
            // The first ones at once, the next in turns with an estimator that has another turn.
            if self.count < 4 || (self.count ^ design.schedule.turn) & 1 == 0 {
                self.gains = Gains::at(&self.window, &design.observer);
            }
            self.striding = due && self.count >= Self::HURRIED;
        }
    }
}

/// The identifier's part: one step a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct IdentifierClock {
    window: Window,
    pub at: Coefficients,
    pub unit: UnitChain,
    pub shape: NoiseShape,
    /// The present measurement's place in the block of the first axis.
    pub position: u32,
    /// Measurements until the identification begins.
    pub delay: u32,
    /// Measurements since the identification began; saturates.
    pub age: u32,
    /// Blocks for which weights have been computed; saturates.
    pub blocks: u32,
    /// Blocks since the last coarse step.
    pub stride: u32,
    /// The window is fully open: the weights stay.
    settled: bool,
}

impl IdentifierClock {
    pub fn start(turn: u32) -> Self {
        Self {
            window: Window::START,
            at: Coefficients::default(),
            unit: UnitChain::default(),
            shape: NoiseShape::START,
            position: 0,
            delay: turn,
            age: 0,
            blocks: 0,
            stride: 0,
            settled: false,
        }
    }

    /// The weights for the present block, for all axes, and every D-th time a coarse step.
    #[inline(always)]
    pub fn step<const N: usize, const P: usize>(&mut self, design: &EstimatorDesign<N, P>) {
        let identifier = &design.identifier;
        let last = design.covariance.steps - 1;
        self.stride = if self.blocks == 0 || self.stride >= last { 0 } else { self.stride + 1 };
        if self.stride == 0 {
            self.shape.step(&self.window, &design.covariance);
        }
        if !self.settled {
            self.at = Coefficients::at(&self.window, identifier);
            self.settled = self.window.is_settled();
            self.window.step(&identifier.window);
        }
        if design.any_drift {
            self.unit.step(identifier, &self.at);
        }
        self.blocks = self.blocks.saturating_add(1);
    }
}
