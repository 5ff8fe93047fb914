//! The state that depends on time alone, shared by all axes: windows, gains, weights, covariance.

use super::design::EstimatorDesign;
use crate::identifier::{Coefficients, UnitChain};
use crate::observer::{Gains, NoiseGain};
use crate::readout::NoiseShape;
use crate::window::Window;

/// The observer's part: one step a measurement.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObserverClock {
    window: Window,
    pub gains: Gains,
    pub before: Gains,
    pub noise_gain: NoiseGain,
    /// Measurements since the first one; saturates.
    pub count: u32,
}

impl ObserverClock {
    pub const START: Self = Self {
        window: Window::START,
        gains: Gains::FIRST,
        before: Gains::FIRST,
        noise_gain: NoiseGain::FIRST,
        count: 0,
    };

    /// To the next measurement.
    #[inline(always)]
    pub fn step<const N: usize, const P: usize>(&mut self, design: &EstimatorDesign<N, P>) {
        self.window.step(&design.observer.window);
        self.before = self.gains;
        self.gains = Gains::at(&self.window, &design.observer);
        self.noise_gain.correct(&self.gains);
        self.count = self.count.saturating_add(1);
    }
}

/// The identifier's part: one step a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct IdentifierClock {
    window: Window,
    pub at: Coefficients,
    pub unit: UnitChain,
    pub shape: NoiseShape,
    /// Measurements into the block of the first axis.
    pub position: u32,
    /// Measurements until the identification begins.
    pub delay: u32,
    /// Blocks completed since the reset; saturates.
    pub blocks: u32,
    /// Blocks since the last coarse step.
    pub stride: u32,
    /// Measurements since the identification began, the present one included; saturates.
    pub age: u32,
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
            blocks: 0,
            stride: 0,
            age: 0,
        }
    }

    /// What the first axis's completed block brings: new weights for all axes, and every D-th time a coarse step.
    #[inline(always)]
    pub fn step<const N: usize, const P: usize>(&mut self, design: &EstimatorDesign<N, P>) {
        let identifier = &design.identifier;
        self.at = Coefficients::at(&self.window, identifier);
        self.window.step(&identifier.window);
        if design.any_drift {
            self.unit.step(identifier, &self.at);
        }
        self.stride = if self.blocks == 0 || self.stride + 1 >= design.covariance.steps { 0 } else { self.stride + 1 };
        if self.stride == 0 {
            self.shape.step(&design.covariance);
        }
        self.blocks = self.blocks.saturating_add(1);
    }
}
