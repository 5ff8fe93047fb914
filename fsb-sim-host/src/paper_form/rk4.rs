//! The classical fourth-order Runge-Kutta step. It looks at the start, the middle and the end of a step and nowhere else,
//! so a step is described by what holds at those three times.

use super::window::{Tuning, Window};

/// A signal at the start, the middle and the end of a step.
pub type ThroughStep = [f64; 3];

/// A step of length `dt` and the window through it.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// [s]
    pub dt: f64,
    /// The window at the start, the middle and the end.
    pub window: [Window; 3],
}

impl Step {
    /// The step from `t` to `t + dt` [s].
    pub fn new(tuning: Tuning, t: f64, dt: f64) -> Self {
        Self { dt, window: [0.0, 0.5, 1.0].map(|part| Window::at(tuning, t + part * dt)) }
    }

    /// `signal` at the three times of this step.
    pub fn sample(&self, signal: impl Fn(f64) -> f64) -> ThroughStep {
        self.window.map(|w| signal(w.t))
    }
}

/// `x` one step of `dt` later, for x' = `derivative`(i, x) with i = 0, 1, 2 at the start, the middle and the end of the step.
pub fn rk4<const N: usize>(x: &[f64; N], dt: f64, derivative: impl Fn(usize, &[f64; N]) -> [f64; N]) -> [f64; N] {
    let ahead = |slope: &[f64; N], by: f64| std::array::from_fn(|i| x[i] + by * slope[i]);
    let a = derivative(0, x);
    let b = derivative(1, &ahead(&a, dt / 2.0));
    let c = derivative(1, &ahead(&b, dt / 2.0));
    let d = derivative(2, &ahead(&c, dt));
    std::array::from_fn(|i| x[i] + dt / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
}

#[cfg(test)]
mod tests {
    use super::rk4;

    /// x' = -x + cos t from 0: x = (cos t + sin t - e^(-t))/2. Halving the step divides the error by 16.
    #[test]
    fn is_of_fourth_order() {
        let error = |steps: usize| {
            let dt = 2.0 / steps as f64;
            let mut x = [0.0];
            for n in 0..steps {
                let t = n as f64 * dt;
                x = rk4(&x, dt, |i, x| [-x[0] + (t + i as f64 * dt / 2.0).cos()]);
            }
            (x[0] - (2f64.cos() + 2f64.sin() - (-2f64).exp()) / 2.0).abs()
        };
        let ratio = error(20) / error(40);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }
}
