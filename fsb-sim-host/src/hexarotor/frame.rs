//! Arms and tilts: from six thrusts to the wrench on the body, and back.
//!
//! Rotor i = 0..5 sits at angle ψ = 60° i, at p = L (cos ψ, sin ψ, 0), its thrust along n = (σ sin β sin ψ, -σ sin β cos ψ,
//! cos β), σ = +1, -1, +1, …: e3 turned about the arm by σ β. It turns about n with the sign σ, so its drag acts on the
//! body with -σ κ T n. A column of the allocation is (n, p × n - σ κ n), that is
//!
//! ```text
//! (σ sβ sψ, -σ sβ cψ, cβ;  (L cβ - κ sβ) sψ, -(L cβ - κ sβ) cψ, -σ (L sβ + κ cβ))
//! ```
//!
//! Around the six rotors these rows are different harmonics, hence orthogonal: the lengths √3 sβ (F_x, F_y), √6 cβ (F_z),
//! √3 (L cβ - κ sβ) (τ_x, τ_y), √6 (L sβ + κ cβ) (τ_z) are the singular values, and the inverse is the transpose with each
//! column divided by the square of the length.

use super::config::{FrameConfig, RotorConfig};
use super::vector::{Vector, add_scaled, cross};

/// Force [N] and torque about the centre of mass [N m], both in the body frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// F of (6).
    pub force: Vector,
    /// τ of (5).
    pub torque: Vector,
}

impl Wrench {
    /// (F, τ) as six numbers.
    pub fn components(&self) -> [f64; 6] {
        let ([a, b, c], [d, e, f]) = (self.force, self.torque);
        [a, b, c, d, e, f]
    }
}

/// The six rotors in the body frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    arm: f64,
    axes: [Vector; 6],
    matrix: [[f64; 6]; 6],
    inverse: [[f64; 6]; 6],
}

impl Frame {
    /// Of a checked configuration.
    pub(super) fn new(frame: &FrameConfig, rotor: &RotorConfig) -> Self {
        let (sin, cos) = frame.tilt.sin_cos();
        let mut axes = [[0.0; 3]; 6];
        let mut matrix = [[0.0; 6]; 6];
        for (i, axis) in axes.iter_mut().enumerate() {
            let (sin_arm, cos_arm) = (i as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
            *axis = [spin(i) * sin * sin_arm, -spin(i) * sin * cos_arm, cos];
            let lever = [frame.arm * cos_arm, frame.arm * sin_arm, 0.0];
            let torque = add_scaled(cross(lever, *axis), -spin(i) * rotor.drag_ratio, *axis);
            let column = Wrench { force: *axis, torque }.components();
            matrix.iter_mut().zip(column).for_each(|(row, value)| row[i] = value);
        }
        let squares = matrix.map(|row| row.iter().map(|value| value * value).sum::<f64>());
        let inverse = std::array::from_fn(|i| std::array::from_fn(|j| matrix[j][i] / squares[j]));
        Self { arm: frame.arm, axes, matrix, inverse }
    }

    /// Rows F_x, F_y, F_z, τ_x, τ_y, τ_z, columns rotors: wrench per thrust [1] and [m].
    pub fn matrix(&self) -> &[[f64; 6]; 6] {
        &self.matrix
    }

    /// The inverse of [`Self::matrix`]: rows rotors.
    pub fn inverse(&self) -> &[[f64; 6]; 6] {
        &self.inverse
    }

    /// Directions of the thrusts in the body frame.
    pub fn axes(&self) -> &[Vector; 6] {
        &self.axes
    }

    /// Singular values of the allocation for F_x, F_y, F_z and τ_x, τ_y, τ_z, torques divided by L so that all are without
    /// a unit.
    pub fn singular_values(&self) -> [f64; 6] {
        let lengths = self.matrix.map(|row| row.iter().map(|value| value * value).sum::<f64>().sqrt());
        std::array::from_fn(|i| if i < 3 { lengths[i] } else { lengths[i] / self.arm })
    }

    /// Condition number: the largest of [`Self::singular_values`] by the smallest.
    pub fn condition(&self) -> f64 {
        let values = self.singular_values();
        values.iter().fold(0.0, |a: f64, &b| a.max(b)) / values.iter().fold(f64::INFINITY, |a, &b| a.min(b))
    }

    /// The wrench of six thrusts [N].
    pub fn wrench(&self, thrusts: &[f64; 6]) -> Wrench {
        let [a, b, c, d, e, f] = self.matrix.map(|row| inner(&row, thrusts));
        Wrench { force: [a, b, c], torque: [d, e, f] }
    }

    /// The six thrusts [N] of a wrench, without limits.
    pub fn thrusts(&self, wrench: &Wrench) -> [f64; 6] {
        let wanted = wrench.components();
        self.inverse.map(|row| inner(&row, &wanted))
    }
}

fn inner(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// σ of rotor `i`: the sign of its tilt and of its rotation about its thrust.
pub(super) fn spin(i: usize) -> f64 {
    if i.is_multiple_of(2) { 1.0 } else { -1.0 }
}
