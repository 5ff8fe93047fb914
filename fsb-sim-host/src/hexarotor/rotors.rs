//! The rotors between two ticks: commands held, the lag solved exactly.

use super::config::{LagOn, RotorConfig};
use super::frame::{Frame, Wrench, spin};
use super::vector::{Vector, add_scaled, sum};

/// What the rotors do to the body at one time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Actuation {
    /// Thrusts and drag torques, and the reaction -h' to the change of the rotors' own angular momentum.
    pub wrench: Wrench,
    /// h, the rotors' own angular momentum in the body frame [kg m²/s].
    pub momentum: Vector,
}

/// Speeds or thrusts, whichever lags, and where they go.
#[derive(Clone, Debug)]
pub struct Rotors {
    config: RotorConfig,
    /// Ω [rad/s] or T [N].
    level: [f64; 6],
    /// What `level` tends to.
    target: [f64; 6],
    /// A length of time [s] and what is left of a difference after it.
    decay: (f64, f64),
}

impl Rotors {
    pub fn new(config: &RotorConfig, thrust: f64) -> Self {
        // Without a lag the thrusts are the commands to the last bit: no way through Ω.
        let lag_on = if config.time_constant > 0.0 { config.lag_on } else { LagOn::Thrust };
        let config = RotorConfig { lag_on, ..*config };
        let mut rotors = Self { config, level: [0.0; 6], target: [0.0; 6], decay: (0.0, 1.0) };
        rotors.command(&[thrust; 6]);
        rotors.level = rotors.target;
        rotors
    }

    /// New commands [N], within the limits.
    pub fn command(&mut self, thrusts: &[f64; 6]) {
        self.target = match self.config.lag_on {
            LagOn::Speed => thrusts.map(|thrust| (thrust / self.config.thrust_coefficient).sqrt()),
            LagOn::Thrust => *thrusts,
        };
        if !self.lags() {
            self.level = self.target;
        }
    }

    /// Whether the thrusts change between ticks.
    pub fn lags(&self) -> bool {
        self.config.time_constant > 0.0
    }

    /// Moves `dt` [s] ahead: level = target + (level - target) e^(-dt/T_r).
    pub fn advance(&mut self, dt: f64) {
        if !self.lags() {
            return;
        }
        if self.decay.0 != dt {
            self.decay = (dt, (-dt / self.config.time_constant).exp());
        }
        for (level, target) in self.level.iter_mut().zip(self.target) {
            *level = target + (*level - target) * self.decay.1;
        }
    }

    /// Thrusts [N].
    pub fn thrusts(&self) -> [f64; 6] {
        match self.config.lag_on {
            LagOn::Speed => self.level.map(|speed| self.config.thrust_coefficient * speed * speed),
            LagOn::Thrust => self.level,
        }
    }

    /// Speeds Ω [rad/s].
    pub fn speeds(&self) -> [f64; 6] {
        match self.config.lag_on {
            LagOn::Speed => self.level,
            LagOn::Thrust => self.level.map(|thrust| (thrust / self.config.thrust_coefficient).sqrt()),
        }
    }

    /// What acts on the body now.
    pub fn actuation(&self, frame: &Frame) -> Actuation {
        let mut wrench = frame.wrench(&self.thrusts());
        let mut momentum = [0.0; 3];
        // Only with a lag on the speed, see the check of the configuration.
        if self.config.inertia > 0.0 {
            let mut change = [0.0; 3];
            for (i, axis) in frame.axes().iter().enumerate() {
                let inertia = spin(i) * self.config.inertia;
                momentum = add_scaled(momentum, inertia * self.level[i], *axis);
                change =
                    add_scaled(change, -inertia * (self.target[i] - self.level[i]) / self.config.time_constant, *axis);
            }
            wrench.torque = sum(wrench.torque, change);
        }
        Actuation { wrench, momentum }
    }
}
