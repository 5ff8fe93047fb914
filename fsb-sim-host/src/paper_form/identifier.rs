//! The identifier: six states (38), outputs ẑ2, ẑ0, read-out (44).
//!
//! A known drift c adds c h² to the windowed y'': ẑ2 = k ẑ0 + c ẑu with ẑu = G³ h², three further states (the paper drops c
//! after (15)). Not normalised: ẑ2 and ẑ0 carry the factor 1/λ³ of G³ and the units m s and N s³.

use super::rk4::{Step, ThroughStep, rk4};
use super::window::Tuning;

/// One axis. States start at zero, at t = 0.
#[derive(Clone, Copy, Debug)]
pub struct Identifier {
    lambda: f64,
    drift: f64,
    /// x1..x6, then the three states of ẑu, then the two integrals of (44).
    states: [f64; 11],
}

impl Identifier {
    /// `drift` is c [m/s²], -g on the vertical axis.
    pub const fn new(tuning: Tuning, drift: f64) -> Self {
        Self { lambda: tuning.lambda, drift, states: [0.0; 11] }
    }

    /// Integrates one step, y and f given at its start, middle and end.
    pub fn step(&mut self, step: &Step, y: &ThroughStep, f: &ThroughStep) {
        let (lambda, drift) = (self.lambda, self.drift);
        self.states = rk4(&self.states, step.dt, |i, x| {
            let (w, y, f) = (&step.window[i], y[i], f[i]);
            [
                -lambda * x[0] + x[1] + w.w1 * y,
                -lambda * x[1] + x[2] + w.w2_bar * y,
                -lambda * x[2] + w.w3_bar * y,
                -lambda * x[3] + x[4],
                -lambda * x[4] + x[5],
                -lambda * x[5] + w.w1 * f,
                -lambda * x[6] + x[7],
                -lambda * x[7] + x[8],
                -lambda * x[8] + w.w1,
                (x[0] - drift * x[6]).abs(),
                x[3].abs(),
            ]
        });
    }

    /// x1..x6 of (38).
    pub fn states(&self) -> [f64; 6] {
        std::array::from_fn(|i| self.states[i])
    }

    /// ẑ2 = x1, drift included.
    pub const fn z2(&self) -> f64 {
        self.states[0]
    }

    /// ẑ0 = x4.
    pub const fn z0(&self) -> f64 {
        self.states[3]
    }

    /// ẑu = G³ h²: what a unit drift leaves in ẑ2.
    pub const fn zu(&self) -> f64 {
        self.states[6]
    }

    /// ẑ2 - c ẑu, which equals k ẑ0.
    pub const fn z2_without_drift(&self) -> f64 {
        self.states[0] - self.drift * self.states[6]
    }

    /// ∫|ẑ2 - c ẑu| dτ and ∫|ẑ0| dτ: numerator and denominator of (44). Both grow without bound.
    pub const fn integrals(&self) -> (f64, f64) {
        (self.states[9], self.states[10])
    }

    /// (44): |k|; the sign is lost. `None` while nothing has acted on the axis.
    pub fn k(&self) -> Option<f64> {
        absolute_ratio(std::slice::from_ref(self))
    }
}

/// (44) over several axes that share k: the sums of the integrals. `None` while nothing has acted on any of them.
pub fn absolute_ratio(axes: &[Identifier]) -> Option<f64> {
    let (numerator, denominator) =
        axes.iter().map(Identifier::integrals).fold((0.0, 0.0), |sum, axis| (sum.0 + axis.0, sum.1 + axis.1));
    (denominator > 0.0).then(|| numerator / denominator)
}

#[cfg(test)]
mod tests {
    use super::{Identifier, absolute_ratio};
    use crate::paper_form::{Step, Tuning};

    const TUNING: Tuning = Tuning { lambda: 2.0, q: 1.0 };

    /// y = 3 - 1.5 t + sin 2t, so y'' = -4 sin 2t; f is what makes y'' = k f + c.
    fn run(k: f64, drift: f64, seconds: f64, dt: f64) -> Identifier {
        let mut identifier = Identifier::new(TUNING, drift);
        for n in 0..(seconds / dt).round() as usize {
            let step = Step::new(TUNING, n as f64 * dt, dt);
            let y = step.sample(|t| 3.0 - 1.5 * t + (2.0 * t).sin());
            let f = step.sample(|t| (-4.0 * (2.0 * t).sin() - drift) / k);
            identifier.step(&step, &y, &f);
        }
        identifier
    }

    /// ẑ2 - c ẑu = k ẑ0 with no trace of y(0) and y'(0), and (44) gives k.
    #[test]
    fn is_exact_on_an_analytic_motion() {
        for (k, drift) in [(2.0, 0.0), (0.6, -9.81), (35.0, 4.0)] {
            for (seconds, dt) in [(0.3, 1e-4), (1.0, 1e-3), (8.0, 1e-3)] {
                let identifier = run(k, drift, seconds, dt);
                let residual = identifier.z2_without_drift() - k * identifier.z0();
                assert!(residual.abs() < 1e-10, "residual {residual}");
                let error = identifier.k().unwrap() / k - 1.0;
                assert!(error.abs() < 1e-6, "k = {k}, c = {drift}, {seconds} s: {error}");
            }
        }
    }

    /// ẑu is the step response of G³ to h²: at q t >> 1 and λ t >> 1 it is 1/λ³.
    #[test]
    fn unit_chain_settles_at_its_gain() {
        assert!((run(2.0, 0.0, 40.0, 1e-3).zu() - 1.0 / 8.0).abs() < 1e-12);
    }

    /// A negative k comes back positive: (44) cannot see the sign.
    #[test]
    fn absolute_ratio_loses_the_sign() {
        let identifier = run(-2.0, 0.0, 3.0, 1e-3);
        assert!((identifier.k().unwrap() - 2.0).abs() < 1e-7);
    }

    /// An axis on which nothing acts is no evidence; pooled with an excited one it adds none.
    #[test]
    fn nothing_acting_is_no_estimate() {
        let idle = Identifier::new(TUNING, 0.0);
        assert_eq!(idle.k(), None);
        let pooled = absolute_ratio(&[idle, run(2.0, 0.0, 3.0, 1e-3)]).unwrap();
        assert!((pooled - 2.0).abs() < 1e-7);
    }
}
