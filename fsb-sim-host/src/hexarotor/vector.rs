//! Three-vectors and 3 by 3 matrices as plain arrays; a matrix is an array of rows.

/// A vector of three.
pub type Vector = [f64; 3];

/// A 3 by 3 matrix, an array of rows.
pub type Matrix = [Vector; 3];

/// a + s b.
pub fn add_scaled(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

/// a + b.
pub fn sum(a: Vector, b: Vector) -> Vector {
    add_scaled(a, 1.0, b)
}

/// a - b.
pub fn difference(a: Vector, b: Vector) -> Vector {
    add_scaled(a, -1.0, b)
}

/// s a.
pub fn scaled(s: f64, a: Vector) -> Vector {
    a.map(|value| s * value)
}

/// a ∘ b, the product by components.
pub fn by_components(a: Vector, b: Vector) -> Vector {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// a · b.
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b = S(a) b of (4).
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// |a|.
pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// M a.
pub fn product(m: &Matrix, a: Vector) -> Vector {
    m.map(|row| dot(row, a))
}

/// Mᵀ a.
pub fn transposed_product(m: &Matrix, a: Vector) -> Vector {
    add_scaled(add_scaled(scaled(a[0], m[0]), a[1], m[1]), a[2], m[2])
}
