//! Least squares by normal equations in f64, rows fading: what the triangle is to say.

use super::super::triangle::{Row, Triangle};

/// u, v, f, y.
pub type Numbers = [f64; 4];

/// Σ of the products of all columns.
#[derive(Clone, Copy, Default)]
pub struct Squares {
    sums: [[f64; 4]; 4],
}

/// Both, from the same rows.
pub fn both(rows: impl Iterator<Item = Numbers>, forgetting: f64) -> (Triangle, Squares) {
    let (mut triangle, mut squares) = (Triangle::default(), Squares::default());
    for row in rows {
        // What both see is in f32.
        let [zu, minus_zv, z0, z2] = row.map(|x| x as f32);
        assert!(triangle.add(&Row { zu, minus_zv, z0, z2 }, forgetting as f32));
        let row = [zu, minus_zv, z0, z2].map(f64::from);
        for (sums, x) in squares.sums.iter_mut().zip(row) {
            for (sum, y) in sums.iter_mut().zip(row) {
                *sum = (1.0 - forgetting) * *sum + x * y;
            }
        }
    }
    (triangle, squares)
}

impl Squares {
    /// Without the columns named, as far as those that are explained by them.
    pub fn without(mut self, columns: &[usize]) -> Self {
        for &c in columns {
            let pivot = self.sums[c];
            if pivot[c] > 0.0 {
                for row in 0..4 {
                    let factor = self.sums[row][c] / pivot[c];
                    self.sums[row].iter_mut().zip(pivot).for_each(|(x, p)| *x -= factor * p);
                }
            }
        }
        self
    }

    pub fn product(&self, a: usize, b: usize) -> f64 {
        self.sums[a][b]
    }
}
