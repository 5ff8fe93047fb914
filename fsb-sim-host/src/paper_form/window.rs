//! The window h(t) = 1 - e^(-qt) and the functions of time it makes of y: (39)-(43), (60).

/// λ and q, both [1/s], both positive. The paper uses λ = 2, q = λ/2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Cut-off frequency of the invariant filter G(s) = 1/(s + λ), (28).
    pub lambda: f64,
    /// The real frequency shift of (17).
    pub q: f64,
}

/// The coefficients of y at time t: w_i(t) in the paper is the field here times y(t).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// t [s], >= 0.
    pub t: f64,
    /// e^(-qt).
    pub e: f64,
    /// h(t) = 1 - e^(-qt).
    pub h: f64,
    /// (39): h². Also the coefficient of f in z0.
    pub w1: f64,
    /// (42): 4q (e^(-2qt) - e^(-qt)).
    pub w2: f64,
    /// (43): 2q² (2 e^(-2qt) - e^(-qt)).
    pub w3: f64,
    /// (40): w2 - 2λ w1.
    pub w2_bar: f64,
    /// (41): w3 - λ w2 + λ² w1.
    pub w3_bar: f64,
}

impl Window {
    /// The window at `t` [s].
    pub fn at(Tuning { lambda, q }: Tuning, t: f64) -> Self {
        let e = (-q * t).exp();
        let h = -(-q * t).exp_m1();
        let w1 = h * h;
        let w2 = -4.0 * q * e * h;
        let w3 = 2.0 * q * q * e * (2.0 * e - 1.0);
        let w2_bar = w2 - 2.0 * lambda * w1;
        let w3_bar = w3 - lambda * w2 + lambda * lambda * w1;
        Self { t, e, h, w1, w2, w3, w2_bar, w3_bar }
    }

    /// B(t) of (60), rows x1, x2, columns y, f: b11 = -w̄2, b21 = -w̄3, b22 = k h².
    pub fn input_matrix(&self, k: f64) -> [[f64; 2]; 2] {
        [[-self.w2_bar, 0.0], [-self.w3_bar, k * self.w1]]
    }

    /// C(t) of (60), rows ŷ, ŷ', columns x1, x2. `None` at t = 0, where it is infinite.
    pub fn output_matrix(&self, Tuning { lambda, q }: Tuning) -> Option<[[f64; 2]; 2]> {
        let per_h2 = 1.0 / self.w1;
        per_h2.is_finite().then(|| [[per_h2, 0.0], [per_h2 * (lambda + 2.0 * q * self.e / self.h), per_h2]])
    }
}

#[cfg(test)]
mod tests {
    use super::{Tuning, Window};

    /// B(t) against (60) as printed, and h, w2, w3 against (39)-(43) as printed.
    #[test]
    fn agrees_with_the_printed_formulas() {
        for (lambda, q) in [(2.0, 1.0), (0.5, 3.0), (7.0, 0.2)] {
            for t in [0.0, 1e-3, 0.1, 0.7, 3.0, 40.0] {
                let w = Window::at(Tuning { lambda, q }, t);
                let (e1, e2) = ((-q * t).exp(), (-2.0 * q * t).exp());
                let b11 = (2.0 * lambda - 4.0 * q) * e2 + (4.0 * q - 4.0 * lambda) * e1 + 2.0 * lambda;
                let b21 = (4.0 * q * lambda - 4.0 * q * q - lambda * lambda) * e2
                    + (2.0 * q * q + 2.0 * lambda * lambda - 4.0 * q * lambda) * e1
                    - lambda * lambda;
                let b = w.input_matrix(1.7);
                let size = (lambda + q).powi(2);
                assert!((b[0][0] - b11).abs() < 1e-13 * size && (b[1][0] - b21).abs() < 1e-13 * size);
                assert!((b[1][1] - 1.7 * (1.0 - e1).powi(2)).abs() < 1e-14 && b[0][1] == 0.0);
                assert!((w.w2 - 4.0 * q * (e2 - e1)).abs() < 1e-13 * size);
                assert!((w.w3 - 2.0 * q * q * (2.0 * e2 - e1)).abs() < 1e-13 * size);
            }
        }
    }

    /// w2 and w3 are what δ_q² makes of s²: for y = e^(at) the operator gives h² y'', and so must w1'' + w2' + w3.
    #[test]
    fn the_three_functions_are_the_windowed_second_derivative() {
        let tuning = Tuning { lambda: 2.0, q: 1.3 };
        let y = |t: f64| (0.7 * t).exp();
        let step = 1e-4;
        for t in [0.2, 0.9, 2.5] {
            let at = |shift: f64| {
                let w = Window::at(tuning, t + shift);
                (w.w1 * y(t + shift), w.w2 * y(t + shift), w.w3 * y(t + shift))
            };
            let (before, here, after) = (at(-step), at(0.0), at(step));
            let w1_twice = (after.0 - 2.0 * here.0 + before.0) / (step * step);
            let w2_once = (after.1 - before.1) / (2.0 * step);
            let truth = Window::at(tuning, t).w1 * 0.49 * y(t);
            assert!((w1_twice + w2_once + here.2 - truth).abs() < 1e-6, "t = {t}");
        }
    }

    /// C(t) is (57) and (59), and there is none at t = 0.
    #[test]
    fn output_matrix_is_the_two_outputs() {
        let tuning = Tuning { lambda: 2.0, q: 1.0 };
        assert!(Window::at(tuning, 0.0).output_matrix(tuning).is_none());
        for t in [0.05_f64, 0.4, 6.0] {
            let (x1, x2) = (0.3, -1.1);
            let h = 1.0 - (-t).exp();
            let y = x1 / (h * h);
            let v = (2.0 - 2.0) * y + (x2 + 2.0 * h * y) / (h * h);
            let c = Window::at(tuning, t).output_matrix(tuning).unwrap();
            assert!((c[0][0] * x1 + c[0][1] * x2 - y).abs() < 1e-12 * y.abs());
            assert!((c[1][0] * x1 + c[1][1] * x2 - v).abs() < 1e-11 * v.abs());
        }
    }
}
