//! A smooth motion known in closed form, and the input that makes it: y'' = k f + c.

use fsb_sim_host::twin::Moments;

/// y(t) = 2 + sin 2t + 0.3 cos(5t + 1), the input being what (15) asks for.
#[derive(Clone, Copy, Debug)]
pub struct Smooth {
    /// k of (15).
    pub k: f64,
    /// c [m/s²].
    pub drift: f64,
}

impl Smooth {
    /// y (m).
    pub fn position(&self, t: f64) -> f64 {
        2.0 + (2.0 * t).sin() + 0.3 * (5.0 * t + 1.0).cos()
    }

    /// y' [m/s].
    pub fn velocity(&self, t: f64) -> f64 {
        2.0 * (2.0 * t).cos() - 1.5 * (5.0 * t + 1.0).sin()
    }

    /// f (N).
    pub fn force(&self, t: f64) -> f64 {
        (-4.0 * (2.0 * t).sin() - 7.5 * (5.0 * t + 1.0).cos() - self.drift) / self.k
    }

    /// f' [N/s].
    pub fn force_rate(&self, t: f64) -> f64 {
        (-8.0 * (2.0 * t).cos() + 37.5 * (5.0 * t + 1.0).sin()) / self.k
    }

    /// The mean of f over `[t, t + period)`: f held at it has the true J1.
    pub fn mean_force(&self, t: f64, period: f64) -> f64 {
        self.moments(t, period).j1 / period
    }

    /// The line whose moments over `[t, t + period)` are those of f: its values at both ends.
    pub fn equivalent_line(&self, t: f64, period: f64) -> (f64, f64) {
        let Moments { j1, j2 } = self.moments(t, period);
        let (first, second) = (j1 / period, j2 / (period * period));
        (6.0 * second - 2.0 * first, 4.0 * first - 6.0 * second)
    }

    /// J1, J2 of f over `[t, t + period)`, from what the motion did.
    fn moments(&self, t: f64, period: f64) -> Moments {
        let (v0, v1) = (self.velocity(t), self.velocity(t + period));
        let travel = self.position(t + period) - self.position(t);
        Moments {
            j1: (v1 - v0 - self.drift * period) / self.k,
            j2: (travel - period * v0 - self.drift * period * period / 2.0) / self.k,
        }
    }
}
