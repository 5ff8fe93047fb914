//! R of (2) from roll φ, pitch θ and yaw ψ.

use super::rotation::Matrix;

/// (2): R = Rz(ψ) Ry(θ) Rx(φ), by rows, from (sin, cos) of φ, θ and ψ.
const fn matrix([(sr, cr), (sp, cp), (sy, cy)]: [(f32, f32); 3]) -> Matrix {
    [
        [cp * cy, cy * sr * sp - cr * sy, sr * sy + cr * cy * sp],
        [cp * sy, cr * cy + sr * sp * sy, cr * sp * sy - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
}

/// R(η) of (2), body to world, by rows, from η = (φ, θ, ψ) (rad). No entry is off by more than 2e-7 for angles up to π.
/// An angle that is not finite gives entries that are none. Uses `libm`: a few hundred operations.
#[cfg(feature = "euler")]
pub fn with_libm(angles: [f32; 3]) -> [[f32; 3]; 3] {
    matrix(angles.map(libm::sincosf))
}

/// The same by `micromath`: no entry is off by more than 2.5e-3 for angles up to π, which on a hovering vehicle is 2.5e-3 of
/// its weight as a force along the wrong axis. About 60 operations.
#[cfg(feature = "micromath")]
pub fn with_micromath(angles: [f32; 3]) -> [[f32; 3]; 3] {
    // By path: as a method it would be the standard library's wherever that is linked, and host and target would differ.
    matrix(angles.map(<f32 as micromath::F32Ext>::sin_cos))
}
