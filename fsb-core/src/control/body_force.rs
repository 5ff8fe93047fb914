//! The rotation in (11).

/// F = R(η)ᵀ f: a force in the world frame, expressed in the body frame.
///
/// `attitude` is R of (2), body to world, by rows: `attitude[i][j]` is the component of body axis j along world axis i.
/// Cost: 15 operations.
pub fn to_body(attitude: &[[f32; 3]; 3], force: &[f32; 3]) -> [f32; 3] {
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = *attitude;
    let [x, y, z] = *force;
    [xx * x + yx * y + zx * z, xy * x + yy * y + zy * z, xz * x + yz * y + zz * z]
}
