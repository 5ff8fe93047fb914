//! The Cramér-Rao bound of k.
//!
//! Raw positions y_i = y0 + v0 t_i + k φ(t_i) + σ ξ_i, white normal noise, φ the response of a unit mass at rest to the
//! known force. With y0 and v0 unknown, an axis tells Σ φ⊥²/σ² of k, φ⊥ being what of φ a straight line does not explain;
//! axes that share k add up. No unbiased estimator has a variance below the inverse; the batch fit of y0, v0, k attains it.

/// What one axis's samples tell of k, for noise of variance one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisInformation {
    count: f64,
    t: f64,
    phi: f64,
    tt: f64,
    t_phi: f64,
    phi_phi: f64,
}

impl AxisInformation {
    /// A sample at `t` [s] where the unit response is `phi` [m per unit of k].
    pub fn add(&mut self, t: f64, phi: f64) {
        // Sums about the running mean, so that nothing large is subtracted from anything large.
        self.count += 1.0;
        let (dt, dphi) = (t - self.t, phi - self.phi);
        self.t += dt / self.count;
        self.phi += dphi / self.count;
        self.tt += dt * (t - self.t);
        self.t_phi += dt * (phi - self.phi);
        self.phi_phi += dphi * (phi - self.phi);
    }

    /// Σ φ⊥² [m² per unit of k²]; zero of fewer than three samples.
    pub fn information(&self) -> f64 {
        if self.count < 3.0 { 0.0 } else { self.phi_phi - self.t_phi * self.t_phi / self.tt }
    }

    /// The bound of the standard deviation of k from `axes` that share it, noise `sigma` [m] on each; infinite where they
    /// tell nothing.
    pub fn k_sd(sigma: f64, axes: &[Self]) -> f64 {
        sigma / axes.iter().map(Self::information).sum::<f64>().sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::AxisInformation;

    /// The inverse of the 5 by 5 Fisher matrix of (y0, v0 of x, y0, v0 of y, k), by elimination, last diagonal element.
    #[test]
    fn equals_the_inverse_of_the_fisher_matrix() {
        let responses: [fn(f64) -> f64; 2] = [|t| t * t - 0.3 * t.sin(), |t| 40.0 + (3.0 * t).cos()];
        let mut matrix = [[0.0_f64; 5]; 5];
        let mut axes = [AxisInformation::default(); 2];
        for n in 0..500 {
            let t = f64::from(n) * 0.01;
            for (i, response) in responses.iter().enumerate() {
                let mut row = [0.0; 5];
                (row[2 * i], row[2 * i + 1], row[4]) = (1.0, t, response(t));
                for a in 0..5 {
                    for b in 0..5 {
                        matrix[a][b] += row[a] * row[b];
                    }
                }
                axes[i].add(t, response(t));
            }
        }
        // Eliminating the first four leaves the Schur complement, the inverse of the last diagonal element of the inverse.
        for pivot in 0..4 {
            let row = matrix[pivot];
            for below in &mut matrix[pivot + 1..] {
                let factor = below[pivot] / row[pivot];
                below.iter_mut().zip(row).for_each(|(value, above)| *value -= factor * above);
            }
        }
        let expected = 0.2 / matrix[4][4].sqrt();
        let bound = AxisInformation::k_sd(0.2, &axes);
        assert!((bound / expected - 1.0).abs() < 1e-9, "{bound} against {expected}");
    }

    #[test]
    fn a_straight_line_tells_nothing() {
        let mut axis = AxisInformation::default();
        assert!(AxisInformation::k_sd(1.0, &[axis]).is_infinite());
        for n in 0..100 {
            axis.add(f64::from(n), 3.0 - 0.5 * f64::from(n));
        }
        assert!(axis.information().abs() < 1e-9);
    }
}
