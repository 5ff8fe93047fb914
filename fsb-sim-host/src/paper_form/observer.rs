//! The observer: two states (53)-(54) with w̄2, w̄3 where the paper prints w2, w3; outputs (57), (59).
//!
//! x1' = -λ x1 + x2 - w̄2 y,    x2' = -λ x2 - w̄3 y + k h² f + c h²
//!
//! The parameter enters the state, so a change of k acts only on what follows, and what a wrong k left behind fades with λ.

use super::rk4::{Step, ThroughStep, rk4};
use super::window::{Tuning, Window};

/// One axis. States start at zero, at t = 0.
#[derive(Clone, Copy, Debug)]
pub struct Observer {
    tuning: Tuning,
    k: f64,
    drift: f64,
    states: [f64; 2],
    window: Window,
}

impl Observer {
    /// `k` is the parameter to start with, `drift` is c [m/s²].
    pub fn new(tuning: Tuning, k: f64, drift: f64) -> Self {
        Self { tuning, k, drift, states: [0.0; 2], window: Window::at(tuning, 0.0) }
    }

    /// Uses `k` from the next step on.
    pub const fn set_k(&mut self, k: f64) {
        self.k = k;
    }

    /// Integrates one step, y and f given at its start, middle and end.
    pub fn step(&mut self, step: &Step, y: &ThroughStep, f: &ThroughStep) {
        let (lambda, k, drift) = (self.tuning.lambda, self.k, self.drift);
        self.states = rk4(&self.states, step.dt, |i, x| {
            let w = &step.window[i];
            [-lambda * x[0] + x[1] - w.w2_bar * y[i], -lambda * x[1] - w.w3_bar * y[i] + w.w1 * (k * f[i] + drift)]
        });
        self.window = step.window[2];
    }

    /// x1 [m], x2 [m/s]: the states of (53)-(54), as in Fig. 9.
    pub const fn states(&self) -> [f64; 2] {
        self.states
    }

    /// (57): ŷ = x1/h² [m]. `None` at t = 0.
    pub fn position(&self) -> Option<f64> {
        let position = self.states[0] / self.window.w1;
        position.is_finite().then_some(position)
    }

    /// (59): ŷ' = (λ - 2q) ŷ + (x2 + 2q h ŷ)/h² [m/s]. `None` at t = 0.
    pub fn velocity(&self) -> Option<f64> {
        let Tuning { lambda, q } = self.tuning;
        let position = self.position()?;
        let velocity =
            (lambda - 2.0 * q) * position + (self.states[1] + 2.0 * q * self.window.h * position) / self.window.w1;
        velocity.is_finite().then_some(velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::Observer;
    use crate::paper_form::{Identifier, Step, Tuning};

    const K: f64 = 2.0;

    fn y(t: f64) -> f64 {
        3.0 - 1.5 * t + (2.0 * t).sin()
    }

    fn force(t: f64, drift: f64) -> f64 {
        (-4.0 * (2.0 * t).sin() - drift) / K
    }

    fn run(tuning: Tuning, k: f64, drift: f64, dt: f64, seconds: f64) -> (Observer, Identifier) {
        let (mut observer, mut identifier) = (Observer::new(tuning, k, drift), Identifier::new(tuning, drift));
        for n in 0..(seconds / dt).round() as usize {
            let step = Step::new(tuning, n as f64 * dt, dt);
            let (y, f) = (step.sample(y), step.sample(|t| force(t, drift)));
            observer.step(&step, &y, &f);
            identifier.step(&step, &y, &f);
        }
        (observer, identifier)
    }

    /// Position and velocity are exact from the start, whatever y(0) and y'(0) are.
    #[test]
    fn is_exact_on_an_analytic_motion() {
        for (lambda, q) in [(2.0, 1.0), (5.0, 0.5), (1.0, 4.0)] {
            for drift in [0.0, -9.81] {
                for t in [0.1_f64, 1.0, 10.0] {
                    let (observer, _) = run(Tuning { lambda, q }, K, drift, 1e-3, t);
                    let velocity = -1.5 + 2.0 * (2.0 * t).cos();
                    assert!((observer.position().unwrap() - y(t)).abs() < 1e-6, "ŷ, λ = {lambda}, q = {q}, t = {t}");
                    assert!(
                        (observer.velocity().unwrap() - velocity).abs() < 1e-6,
                        "ŷ', λ = {lambda}, q = {q}, t = {t}"
                    );
                }
            }
        }
    }

    /// At t = 0 there is no estimate.
    #[test]
    fn nothing_is_known_at_zero() {
        let observer = Observer::new(Tuning { lambda: 2.0, q: 1.0 }, K, 0.0);
        assert_eq!((observer.position(), observer.velocity()), (None, None));
    }

    /// The observer's states are already in the identifier, for any k: x1 = k x5 - x2, x2 = k x6 - x3 of (38).
    #[test]
    fn identifier_states_hold_the_observer() {
        for k in [K, -0.7] {
            let (observer, identifier) = run(Tuning { lambda: 2.0, q: 1.0 }, k, 0.0, 1e-3, 2.0);
            let x = identifier.states();
            let free = [k * x[4] - x[1], k * x[5] - x[2]];
            for (a, b) in observer.states().iter().zip(free) {
                assert!((a - b).abs() < 1e-13, "{a} against {b}");
            }
        }
    }

    /// A wrong k leaves a trace that fades with λ after the change: (1 + λt) e^(-λt) at most, up to a constant.
    #[test]
    fn a_wrong_parameter_leaves_a_fading_trace() {
        let tuning = Tuning { lambda: 2.0, q: 1.0 };
        let (mut observer, _) = run(tuning, 1.0, 0.0, 1e-3, 1.0);
        observer.set_k(K);
        let mut errors = Vec::new();
        for n in 1000..9000 {
            let step = Step::new(tuning, n as f64 * 1e-3, 1e-3);
            observer.step(&step, &step.sample(y), &step.sample(|t| force(t, 0.0)));
            if [1001, 4000, 8999].contains(&n) {
                errors.push((observer.position().unwrap() - y((n + 1) as f64 * 1e-3)).abs());
            }
        }
        assert!(errors[0] > 0.05, "{errors:?}");
        assert!(errors[1] < 0.05 * errors[0] && errors[2] < 1e-5 * errors[0], "{errors:?}");
    }
}
