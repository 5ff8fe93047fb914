//! The gains of the BIBO bounds (61)-(64) of the observer, corrected (`docs/errata.md`).
//!
//! sup|x2| <= γ21 sup|y| + γ22 sup|f|,    sup|x1| <= γ11 sup|y| + γ12 sup|f|
//!
//! With u = e^(-qt) in (0, 1]: b11 = 2 (1-u) (λ - (λ-2q) u) and b21 = -(λ-2q)² u² + 2 (λ-q)² u - λ².
//! All functions: λ, q > 0 [1/s]; k any finite number; the drift counts as part of k f.

/// max|b11(t)| over t >= 0 [1/s]: 2λ for q <= λ, 2q²/(2q-λ) beyond. The paper takes 2λ throughout.
pub fn max_b11(lambda: f64, q: f64) -> f64 {
    if q > lambda { 2.0 * q * q / (2.0 * q - lambda) } else { 2.0 * lambda }
}

/// max|b21(t)| over t >= 0 [1/s²]: max(λ², 2q²), as in (62). The extremum in between, at u = (λ-q)²/(λ-2q)² when q > 2λ/3,
/// never exceeds q² in size where it is positive, and lies between the end values where it is not.
pub fn max_b21(lambda: f64, q: f64) -> f64 {
    (lambda * lambda).max(2.0 * q * q)
}

/// γ21 = max|b21|/λ, (62) [1/s].
pub fn gamma21(lambda: f64, q: f64) -> f64 {
    max_b21(lambda, q) / lambda
}

/// γ22 = |k|/λ, (63); the paper leaves the modulus out.
pub fn gamma22(lambda: f64, k: f64) -> f64 {
    k.abs() / lambda
}

/// γ11 = (max|b11| + γ21)/λ: (64) with the correct maximum.
pub fn gamma11(lambda: f64, q: f64) -> f64 {
    (max_b11(lambda, q) + gamma21(lambda, q)) / lambda
}

/// γ12 = γ22/λ, (64).
pub fn gamma12(lambda: f64, k: f64) -> f64 {
    gamma22(lambda, k) / lambda
}

/// A γ21 linear in q: 3λ + q [1/s]; sharper than (62) for q > 1.5 λ.
///
/// |b21| <= λ² (1-u)² + 4qλ u(1-u) + 2q² u|2u-1|, and ∫u(1-u) dt = 1/2q, ∫u|2u-1| dt = 1/2q.
pub fn gamma21_linear(lambda: f64, q: f64) -> f64 {
    3.0 * lambda + q
}

/// A γ11 linear in q: 5 + (2 + q/λ)/e. By the kernel e^(-λs) (b11 + s b21) of y in x1, with s e^(-λs) <= 1/(e λ).
pub fn gamma11_linear(lambda: f64, q: f64) -> f64 {
    5.0 + (2.0 + q / lambda) / std::f64::consts::E
}

#[cfg(test)]
mod tests {
    use super::{max_b11, max_b21};
    use crate::paper_form::{Tuning, Window};

    /// Both maxima against a dense search over t.
    #[test]
    fn maxima_are_those_found_by_search() {
        let lambda = 1.7;
        for ratio in [0.05, 0.3, 0.5, 0.66, 0.67, 0.9, 1.0, 1.1, 1.5, 2.0, 5.0, 10.0, 20.0] {
            let q = ratio * lambda;
            let (mut b11, mut b21) = (0.0_f64, 0.0_f64);
            for i in 0..=100_000 {
                let t = f64::from(i) * 20.0 / q / 1e5;
                let b = Window::at(Tuning { lambda, q }, t).input_matrix(1.0);
                b11 = b11.max(b[0][0].abs());
                b21 = b21.max(b[1][0].abs());
            }
            assert!((b11 / max_b11(lambda, q) - 1.0).abs() < 1e-6, "b11 at q = {ratio} λ: {b11}");
            assert!((b21 / max_b21(lambda, q) - 1.0).abs() < 1e-6, "b21 at q = {ratio} λ: {b21}");
        }
    }
}
