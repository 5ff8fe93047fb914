//! Rotation matrices: products, and the exponential of a rotation vector as a polynomial.

/// By rows.
pub(crate) type Matrix = [[f32; 3]; 3];

/// R of the unit quaternion w + xi + yj + zk.
pub(crate) fn from_quaternion([w, x, y, z]: [f32; 4]) -> Matrix {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// A v. Cost: 15 operations.
#[inline(always)]
pub(crate) fn apply(a: &Matrix, v: &[f32; 3]) -> [f32; 3] {
    let ([[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]], [x, y, z]) = (*a, *v);
    [xx * x + xy * y + xz * z, yx * x + yy * y + yz * z, zx * x + zy * y + zz * z]
}

/// A B. Cost: 45 operations.
pub(crate) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let [[b00, b01, b02], [b10, b11, b12], [b20, b21, b22]] = *b;
    a.map(|[x, y, z]| [x * b00 + y * b10 + z * b20, x * b01 + y * b11 + z * b21, x * b02 + y * b12 + z * b22])
}

/// exp of the rotation vector `turn` (rad), I + a S + b S²; `None` beyond 2 rad, and for NaN. To 1e-6 up to 1 rad, 6e-5 up
/// to 2 rad. Cost: about 45 operations.
pub(crate) fn exponential(turn: &[f32; 3]) -> Option<Matrix> {
    let [x, y, z] = *turn;
    let q = x * x + y * y + z * z;
    // Written so that NaN fails it.
    let near = q <= 4.0;
    if !near {
        return None;
    }
    // sin θ/θ and (1 - cos θ)/θ².
    let a = 1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q * (1.0 / 5040.0 - q * (1.0 / 362_880.0))));
    let b = 0.5 - q * (1.0 / 24.0 - q * (1.0 / 720.0 - q * (1.0 / 40_320.0 - q * (1.0 / 3_628_800.0))));
    let (bxy, bxz, byz) = (b * x * y, b * x * z, b * y * z);
    let (ax, ay, az) = (a * x, a * y, a * z);
    Some([
        [1.0 - b * (y * y + z * z), bxy - az, bxz + ay],
        [bxy + az, 1.0 - b * (x * x + z * z), byz - ax],
        [bxz - ay, byz + ax, 1.0 - b * (x * x + y * y)],
    ])
}
