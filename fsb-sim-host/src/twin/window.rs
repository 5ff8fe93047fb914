//! The sampled window: e[n] = ρ^n, h[n] = 1 - ρ^n, g[n] = h[n] h[n+1] with ρ = e^(-qT).
//!
//! In sampled time the frequency shift (21) is z → z/ρ, and (σ - 1)(ρσ - 1) does what δ_q² does in (20): it removes the
//! initial position and velocity. In time it is multiplication by g, which vanishes at n = 0 and n = -1.

/// The window of one q and one period.
#[derive(Clone, Copy, Debug)]
pub struct TwinWindow {
    q_period: f64,
}

impl TwinWindow {
    /// `q` [1/s] and `period` [s], both positive.
    pub const fn new(q: f64, period: f64) -> Self {
        Self { q_period: q * period }
    }

    /// e[n] = ρ^n.
    pub fn e(&self, n: i64) -> f64 {
        (-self.q_period * n as f64).exp()
    }

    /// h[n] = 1 - ρ^n, to full relative precision; negative for n < 0.
    pub fn h(&self, n: i64) -> f64 {
        -(-self.q_period * n as f64).exp_m1()
    }

    /// g[n] = h[n] h[n+1].
    pub fn g(&self, n: i64) -> f64 {
        self.h(n) * self.h(n + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::TwinWindow;

    /// Multiplication by g is (σ - 1)(ρσ - 1), where σ multiplies by ρ^n: ρ ρ^2n - (1 + ρ) ρ^n + 1.
    #[test]
    fn window_is_the_annihilating_operator() {
        let (q, period) = (1.3, 0.05);
        let window = TwinWindow::new(q, period);
        let rho = (-q * period).exp();
        for n in [-1, 0, 1, 2, 10, 300] {
            let sigma = rho.powi(n);
            let operator = (sigma - 1.0) * (rho * sigma - 1.0);
            assert!((window.g(i64::from(n)) - operator).abs() < 1e-14, "n = {n}");
        }
        assert_eq!((window.g(-1), window.g(0)), (0.0, 0.0));
    }

    /// T → 0: g → h(t)² of (39).
    #[test]
    fn tends_to_the_window_of_the_paper() {
        let gap = |period: f64| {
            let t = 0.7;
            (TwinWindow::new(2.0, period).g((t / period).round() as i64) - (1.0 - (-2.0 * t).exp()).powi(2)).abs()
        };
        let ratio = gap(1e-3) / gap(1e-4);
        assert!(gap(1e-4) < 1e-4 && (9.0..11.0).contains(&ratio), "{ratio}");
    }
}
