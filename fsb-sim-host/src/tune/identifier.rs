//! How the standard deviation of k falls.
//!
//! k̂ = Σ ẑ0 ẑ2/Σ ẑ0² is linear in the noise, which reaches it as σ² var a/(Σ ẑ0²)², a = Σ ẑ0 x1 with x1 the noise of ẑ2. White noise enters the
//! three stages by the weights b1, b2, b3 of the position (design, section 4), so the covariance of (x1, x2, x3, a) obeys a
//! linear recursion: P ← A P Aᵀ + B Bᵀ, q ← A q + ẑ0 P e1, var a ← var a + 2 ẑ0 (A q)1 + ẑ0² P11. It is gone through here for an input of which
//! is known how much it accelerates: exact for that input, and all that is needed of k, for sd(k)/k depends on k f alone.

use super::Sensor;
use fsb_core::Tuning;
use std::f64::consts::{SQRT_2, TAU};

/// An input by the acceleration that it causes: gravity is held, and a sine on top of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excitation {
    /// g \[m/s²\] that the input holds; 0 on an axis that carries no weight.
    pub gravity: f64,
    /// Root mean square of the acceleration \[m/s² or rad/s²\].
    pub acceleration: f64,
    /// Its frequency \[Hz\].
    pub frequency: f64,
}

impl Excitation {
    /// k f at time t: g + √2 a cos(2π f t).
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        self.gravity + SQRT_2 * self.acceleration * (TAU * self.frequency * t).cos()
    }
}

/// sd(k)/k over time.
#[derive(Clone, Debug)]
pub struct Spread {
    sensor: Sensor,
    excitation: Excitation,
    c: f64,
    p: f64,
    alpha: f64,
    rho: f64,
    /// n of the next sample, and e, h there.
    n: u64,
    e: f64,
    h: f64,
    /// k f of the last two intervals.
    held: [f64; 2],
    /// Stages of ẑ0, the last one first.
    input: [f64; 3],
    cov: [[f64; 3]; 3],
    cross: [f64; 3],
    variance: f64,
    information: f64,
}

impl Spread {
    /// Before the first measurement.
    #[must_use]
    pub fn new(sensor: Sensor, tuning: Tuning, excitation: Excitation) -> Self {
        let (c, alpha) = (-(-tuning.lambda * sensor.period).exp_m1(), -(-tuning.q * sensor.period).exp_m1());
        Self {
            sensor,
            excitation,
            c,
            p: 1.0 - c,
            alpha,
            rho: 1.0 - alpha,
            n: 0,
            e: 1.0,
            h: 0.0,
            held: [0.0; 2],
            input: [0.0; 3],
            cov: [[0.0; 3]; 3],
            cross: [0.0; 3],
            variance: 0.0,
            information: 0.0,
        }
    }

    /// Weights of the position and g₋ at this sample.
    fn weights(&self) -> ([f64; 3], f64) {
        let Self { c, p, alpha, rho, e, h, .. } = *self;
        let (h_before, h_after) = (h - alpha / rho * e, h + alpha * e);
        let e_after = e * rho;
        let (g_before, g_after) = (h_before * h, h_after * (h_after + alpha * e_after));
        let scale = 1.0 / (self.sensor.period * p).powi(2);
        let b1 = c * c * scale * g_after;
        let b2 = -2.0 * c * scale * h_after * ((1.0 - rho * rho) * e + c * h);
        let b3 = scale
            * (alpha * alpha * (1.0 + rho) / rho * e * ((1.0 + rho) * e - 1.0)
                + 2.0 * c * (1.0 - rho * rho) / rho * h * e
                + c * c * g_before);
        ([b1, b2, b3], g_before)
    }

    /// A x of the three stages.
    fn pass(&self, x: [f64; 3]) -> [f64; 3] {
        let (c, p) = (self.c, self.p);
        [p * x[0] + c * p * x[1] + c * c * p * x[2], p * x[1] + c * p * x[2], p * x[2]]
    }

    /// One measurement: its time \[s\], and sd(k)/k after it, not finite before there is any information.
    pub fn step(&mut self) -> (f64, f64) {
        let t = self.n as f64 * self.sensor.period;
        let ([b1, b2, b3], g_before) = self.weights();
        let c = self.c;
        // S/T² of an input held over each interval.
        let s = if self.n >= 2 { (self.held[0] + self.held[1]) / 2.0 } else { 0.0 };
        self.input[2] += c * (g_before * s - self.input[2]);
        self.input[1] += c * (self.input[2] - self.input[1]);
        self.input[0] += c * (self.input[1] - self.input[0]);
        let (d3, d2) = (c * b3, c * (b2 + c * b3));
        let b = [c * (b1 + d2), d2, d3];
        let columns: [[f64; 3]; 3] = self.cov.map(|row| self.pass(row));
        let mut next = [[0.0; 3]; 3];
        for j in 0..3 {
            let column = self.pass([columns[0][j], columns[1][j], columns[2][j]]);
            for i in 0..3 {
                next[i][j] = column[i] + b[i] * b[j];
            }
        }
        self.cov = next;
        let weight = if self.n >= 2 { self.input[0] } else { 0.0 };
        let moved = self.pass(self.cross);
        self.variance += weight * (2.0 * moved[0] + weight * self.cov[0][0]);
        self.cross = std::array::from_fn(|i| moved[i] + weight * self.cov[i][0]);
        self.information += weight * weight;
        self.held = [self.excitation.at(t + self.sensor.period / 2.0), self.held[0]];
        self.n += 1;
        self.h += self.alpha * self.e;
        self.e *= self.rho;
        (t, self.sensor.noise_sd * self.variance.max(0.0).sqrt() / self.information)
    }

    /// When two standard deviations first are below `share` of k \[s\], within `seconds`.
    pub fn time_to(mut self, share: f64, seconds: f64) -> Option<f64> {
        loop {
            let (t, sd) = self.step();
            if t > seconds {
                return None;
            }
            if self.n > 3 && 2.0 * sd <= share {
                return Some(t);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Long after the start a sine of its own is worth σ ω² √(T/t)/A, whatever λ is.
    #[test]
    fn in_the_long_run_it_is_noise_over_motion() {
        let sensor = Sensor { noise_sd: 0.01, period: 0.01 };
        let excitation = Excitation { gravity: 0.0, acceleration: 1.5, frequency: 0.5 };
        for lambda in [1.0, 2.0, 6.0] {
            let mut spread = Spread::new(sensor, Tuning::from_lambda(lambda), excitation);
            let (mut t, mut sd) = (0.0, f64::NAN);
            while t < 200.0 {
                (t, sd) = spread.step();
            }
            let expected = 0.01 * (TAU * 0.5).powi(2) * (0.01 / t).sqrt() / 1.5;
            assert!((sd / expected - 1.0).abs() < 0.03, "λ = {lambda}: {sd} against {expected}");
        }
    }
}
