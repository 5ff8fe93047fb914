//! The axis model (15) with the input held between ticks.

/// y'' = k f + c, input held over each step. The step is the closed-form solution, so the only error is f64 rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldInputAxis {
    /// y [m] or [rad].
    pub position: f64,
    /// y' [m/s] or [rad/s].
    pub velocity: f64,
    /// k: 1/m [1/kg] or 1/I [1/(kg m²)]. Any finite value.
    pub k: f64,
    /// c: known constant drift [m/s²] or [rad/s²]; -g on a vertical axis with z up.
    pub drift: f64,
}

impl HeldInputAxis {
    /// Moves `dt` [s] ahead with the input held at `f` [N] or [N m].
    pub fn step(&mut self, f: f64, dt: f64) {
        let acceleration = self.k * f + self.drift;
        self.position += dt * self.velocity + dt * dt / 2.0 * acceleration;
        self.velocity += dt * acceleration;
    }
}

#[cfg(test)]
mod tests {
    use super::HeldInputAxis;

    /// Free fall from rest at 100 m: y = 100 - g t²/2, v = -g t.
    #[test]
    fn falls_on_a_parabola() {
        let mut axis = HeldInputAxis { position: 100.0, velocity: 0.0, k: 3.0, drift: -9.81 };
        for _ in 0..1000 {
            axis.step(0.0, 1e-3);
        }
        assert!((axis.position - (100.0 - 9.81 / 2.0)).abs() < 1e-11, "{axis:?}");
        assert!((axis.velocity + 9.81).abs() < 1e-12, "{axis:?}");
    }

    /// One long step equals many short ones under the same input.
    #[test]
    fn step_length_does_not_matter() {
        let start = HeldInputAxis { position: 3.0, velocity: -1.5, k: 0.7, drift: -9.81 };
        let (mut long, mut short) = (start, start);
        long.step(20.0, 0.5);
        for _ in 0..500 {
            short.step(20.0, 1e-3);
        }
        assert!((long.position - short.position).abs() < 1e-12 && (long.velocity - short.velocity).abs() < 1e-12);
    }
}
