//! Wrench to thrusts and back, by a constant 6 x 6 matrix.

use core::fmt;

/// Motors, and components of a wrench.
const N: usize = 6;

/// A wrench from six thrusts: `wrench = forward * thrusts`, and its inverse.
///
/// A wrench is the body-frame force \[N\] on x, y, z, then the torque \[N m\] about x, y, z.
#[derive(Clone, Copy, Debug)]
pub struct Allocation {
    forward: [[f32; N]; N],
    inverse: [[f32; N]; N],
    thrust_max: f32,
}

/// An allocation was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum AllocationError {
    /// The rotors cannot produce every wrench: the matrix is singular, or has an entry that is not finite.
    Singular,
    /// The largest thrust is not positive and finite.
    ThrustMax,
}

impl fmt::Display for AllocationError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Singular => "the rotors cannot produce every force and torque",
            Self::ThrustMax => "the largest thrust is not a positive number",
        })
    }
}

impl core::error::Error for AllocationError {}

impl Allocation {
    /// `forward[i][j]`: component i of the wrench that motor j produces per newton of its thrust. `thrust_max` \[N\] is
    /// what one motor produces at full duty.
    ///
    /// # Errors
    /// [`AllocationError`]. Pivots below 1e-9 count as singular.
    pub fn new(forward: &[[f64; N]; N], thrust_max: f64) -> Result<Self, AllocationError> {
        if !(thrust_max > 0.0 && thrust_max <= 1e6) {
            return Err(AllocationError::ThrustMax);
        }
        let inverse = inverse(forward).ok_or(AllocationError::Singular)?;
        Ok(Self { forward: rounded(forward), inverse: rounded(&inverse), thrust_max: thrust_max as f32 })
    }

    /// The thrusts \[N\] that produce `wrench`, of any sign and size. Cost: 66 operations.
    pub fn thrusts(&self, wrench: &[f32; N]) -> [f32; N] {
        product(&self.inverse, wrench)
    }

    /// The wrench that `thrusts` \[N\] produce. Cost: 66 operations.
    pub fn wrench(&self, thrusts: &[f32; N]) -> [f32; N] {
        product(&self.forward, thrusts)
    }

    /// What one motor produces at full duty \[N\].
    pub const fn thrust_max(&self) -> f32 {
        self.thrust_max
    }
}

fn product(matrix: &[[f32; N]; N], vector: &[f32; N]) -> [f32; N] {
    matrix.map(|row| row.iter().zip(vector).fold(0.0, |sum, (a, b)| sum + a * b))
}

fn rounded(matrix: &[[f64; N]; N]) -> [[f32; N]; N] {
    matrix.map(|row| row.map(|entry| entry as f32))
}

/// Gauss-Jordan with the largest pivot of the column.
fn inverse(matrix: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut left = *matrix;
    let mut right: [[f64; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    for column in 0..N {
        let size = |row: &usize| left.get(*row).and_then(|row| row.get(column)).map_or(0.0, |entry| entry.abs());
        let pivot_row = (column..N).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        exchange(&mut left, column, pivot_row);
        exchange(&mut right, column, pivot_row);
        let (lefts, rights) = (*left.get(column)?, *right.get(column)?);
        let pivot = *lefts.get(column)?;
        // Written so that NaN fails it.
        if !(pivot.abs() >= 1e-9 && pivot.is_finite()) {
            return None;
        }
        for (row, (l, r)) in left.iter_mut().zip(right.iter_mut()).enumerate() {
            let factor = if row == column { (pivot - 1.0) / pivot } else { l.get(column)? / pivot };
            for (entry, of_pivot) in l.iter_mut().zip(&lefts).chain(r.iter_mut().zip(&rights)) {
                *entry -= factor * of_pivot;
            }
        }
    }
    Some(right)
}

/// `swap`, which could panic.
fn exchange(rows: &mut [[f64; N]; N], a: usize, b: usize) {
    let (Some(&of_a), Some(&of_b)) = (rows.get(a), rows.get(b)) else { return };
    for (index, row) in [(a, of_b), (b, of_a)] {
        if let Some(slot) = rows.get_mut(index) {
            *slot = row;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thrusts_give_the_wrench_back() {
        let mut forward = [[0.0; N]; N];
        for (i, row) in forward.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = if i == j { 0.0 } else { 1.0 + i as f64 - 2.0 * j as f64 * i as f64 };
            }
            row[(i + 2) % N] += 3.0;
        }
        let allocation = Allocation::new(&forward, 5.0).unwrap();
        let wrench = [0.5, -1.0, 14.0, 0.1, -0.2, 0.05];
        for (got, wanted) in allocation.wrench(&allocation.thrusts(&wrench)).iter().zip(wrench) {
            assert!((got - wanted).abs() < 2e-5, "{got} {wanted}");
        }
    }

    /// Coplanar, parallel rotors produce no sideways force.
    #[test]
    fn what_cannot_be_inverted_is_refused() {
        let mut forward = [[0.0; N]; N];
        assert_eq!(Allocation::new(&forward, 5.0).unwrap_err(), AllocationError::Singular);
        forward[2] = [1.0; N];
        assert_eq!(Allocation::new(&forward, 5.0).unwrap_err(), AllocationError::Singular);
        for (i, row) in forward.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        assert_eq!(Allocation::new(&forward, f64::NAN).unwrap_err(), AllocationError::ThrustMax);
        assert_eq!(Allocation::new(&forward, 0.0).unwrap_err(), AllocationError::ThrustMax);
        assert!(Allocation::new(&forward, 5.0).is_ok());
        forward[3][4] = f64::INFINITY;
        assert_eq!(Allocation::new(&forward, 5.0).unwrap_err(), AllocationError::Singular);
    }
}
