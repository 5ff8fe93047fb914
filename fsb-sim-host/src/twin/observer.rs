//! The observer in sampled time, (45)-(59), as a textbook predictor-corrector:
//!
//! ŷ⁻ = ŷ + T v̂ + k J2 + c T²/2,    v̂⁻ = v̂ + k J1 + c T,    r = y - ŷ⁻,    ŷ = ŷ⁻ + l1 r,    v̂ = v̂⁻ + l2 r
//!
//! l1 = 1 - p² g[n-1]/g[n+1],    T l2 = 1 - 2p g[n-1]/g[n] + p² g[n-1]/g[n+1],    p = e^(-λT)
//!
//! At n = 1, l1 = T l2 = 1: the second measurement removes whatever was assumed at the first.

use super::TwinWindow;

/// One axis.
#[derive(Clone, Copy, Debug)]
pub struct TwinObserver {
    p: f64,
    period: f64,
    window: TwinWindow,
    k: f64,
    drift: f64,
    /// Sample index of the newest tick; `None` before the first measurement.
    n: Option<i64>,
    position: f64,
    velocity: f64,
    innovation: Option<f64>,
}

impl TwinObserver {
    /// λ, q [1/s], `period` [s] positive; `drift` is c [m/s²].
    pub fn new(lambda: f64, q: f64, period: f64, k: f64, drift: f64) -> Self {
        Self {
            p: (-lambda * period).exp(),
            period,
            window: TwinWindow::new(q, period),
            k,
            drift,
            n: None,
            position: 0.0,
            velocity: 0.0,
            innovation: None,
        }
    }

    /// Uses `k` from the next tick on.
    pub const fn set_k(&mut self, k: f64) {
        self.k = k;
    }

    /// One tick: the moments over the interval that ended now, and the measurement `y` [m] or `None` where it is missing
    /// (predict, do not correct). Returns position [m] and velocity [m/s] from the second measurement on.
    ///
    /// The window starts with the first measurement; if the one right after it is missing, it starts again with the next.
    pub fn update(&mut self, y: Option<f64>, j1: f64, j2: f64) -> Option<(f64, f64)> {
        self.innovation = None;
        match (self.n, y) {
            (None, None) => {}
            (None, Some(y)) => {
                (self.position, self.velocity) = (y, 0.0);
                self.n = Some(0);
            }
            (Some(0), None) => self.n = None,
            (Some(before), y) => {
                self.position +=
                    self.period * self.velocity + self.k * j2 + self.drift * self.period * self.period / 2.0;
                self.velocity += self.k * j1 + self.drift * self.period;
                let n = before + 1;
                self.n = Some(n);
                if let Some(y) = y {
                    let (l1, l2) = self.gains(n);
                    let innovation = y - self.position;
                    self.position += l1 * innovation;
                    self.velocity += l2 * innovation;
                    self.innovation = Some(innovation);
                }
            }
        }
        self.estimate()
    }

    /// Position [m] and velocity [m/s] at the newest tick; `None` before the second measurement.
    pub fn estimate(&self) -> Option<(f64, f64)> {
        self.n.filter(|&n| n > 0).map(|_| (self.position, self.velocity))
    }

    /// r = y - ŷ⁻ [m] of the newest tick; `None` where nothing was corrected.
    pub const fn innovation(&self) -> Option<f64> {
        self.innovation
    }

    /// l1 [1] and l2 [1/s] at sample `n` >= 1.
    pub fn gains(&self, n: i64) -> (f64, f64) {
        let (p, h) = (self.p, |shift: i64| self.window.h(n + shift));
        // The common factor of two neighbouring g cancelled, so that no ratio is 0/0.
        let one_apart = h(-1) / h(1);
        let two_apart = h(-1) * h(0) / (h(1) * h(2));
        let l1 = 1.0 - p * p * two_apart;
        (l1, (1.0 - 2.0 * p * one_apart + p * p * two_apart) / self.period)
    }
}

/// The observer for a k that is not known yet: the responses to y and to f kept apart, so that every estimate is that of
/// the k it is asked for, as if it had been known from the start.
#[derive(Clone, Copy, Debug)]
pub struct RetroactiveObserver {
    without_input: TwinObserver,
    to_unit_k: TwinObserver,
}

impl RetroactiveObserver {
    /// As [`TwinObserver::new`], without k.
    pub fn new(lambda: f64, q: f64, period: f64, drift: f64) -> Self {
        Self {
            without_input: TwinObserver::new(lambda, q, period, 0.0, drift),
            to_unit_k: TwinObserver::new(lambda, q, period, 1.0, 0.0),
        }
    }

    /// As [`TwinObserver::update`], without a result.
    pub fn update(&mut self, y: Option<f64>, j1: f64, j2: f64) {
        self.without_input.update(y, j1, j2);
        self.to_unit_k.update(y.map(|_| 0.0), j1, j2);
    }

    /// Position [m] and velocity [m/s] for the parameter `k`; `None` before the second measurement.
    pub fn estimate(&self, k: f64) -> Option<(f64, f64)> {
        let (y, f) = (self.without_input.estimate()?, self.to_unit_k.estimate()?);
        Some((y.0 + k * f.0, y.1 + k * f.1))
    }
}

#[cfg(test)]
mod tests {
    use super::TwinObserver;

    /// λ, q → 0: the gains of the least-squares line through all samples so far.
    #[test]
    fn tends_to_the_expanding_memory_filter() {
        let period = 0.01;
        let observer = TwinObserver::new(1e-7, 1e-7, period, 1.0, 0.0);
        for n in 1..200_i64 {
            let (l1, l2) = observer.gains(n);
            let (a, b) = (n as f64 + 1.0, n as f64 + 2.0);
            assert!((l1 - 2.0 * (2.0 * n as f64 + 1.0) / (a * b)).abs() < 1e-6, "n = {n}");
            assert!((period * l2 - 6.0 / (a * b)).abs() < 1e-6, "n = {n}");
        }
    }

    /// n → ∞: the fading-memory filter, l1 = 1 - p², T l2 = (1 - p)².
    #[test]
    fn settles_at_the_fading_memory_filter() {
        let (lambda, period) = (2.0, 0.01);
        let (l1, l2) = TwinObserver::new(lambda, 1.0, period, 1.0, 0.0).gains(100_000);
        let p = (-lambda * period).exp();
        assert!((l1 - (1.0 - p * p)).abs() < 1e-14 && (period * l2 - (1.0 - p).powi(2)).abs() < 1e-14);
    }

    /// The second measurement is dead-beat, and the window waits for two measurements in a row.
    #[test]
    fn starts_with_two_measurements_in_a_row() {
        let mut observer = TwinObserver::new(2.0, 1.0, 0.1, 1.0, 0.0);
        assert_eq!(observer.update(None, 0.0, 0.0), None);
        assert_eq!(observer.update(Some(9.0), 0.0, 0.0), None);
        assert_eq!(observer.update(None, 0.0, 0.0), None);
        assert_eq!(observer.update(Some(3.0), 0.0, 0.0), None);
        let (position, velocity) = observer.update(Some(3.5), 0.0, 0.0).unwrap();
        assert!((position - 3.5).abs() < 1e-15 && (velocity - 5.0).abs() < 1e-13);
    }
}
