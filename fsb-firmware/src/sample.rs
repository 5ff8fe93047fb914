//! What comes into a tick and what went out.

use fsb_core::estimator::AxisState;

/// R of (2), body to world, by rows: `[i][j]` is the component of body axis j along world axis i.
pub type Attitude = [[f32; 3]; 3];

/// One measurement of the six axes; `None` (or NaN) is a missing one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// x, y, z in the world frame \[m\], z up.
    pub position: [Option<f32>; 3],
    /// φ, θ, ψ \[rad\].
    pub angles: [Option<f32>; 3],
    /// The same attitude as a matrix. Where an entry is not finite the last good matrix is used.
    pub attitude: Attitude,
}

/// What a tick did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Duty of each motor, as set.
    pub duties: [u16; 6],
    /// Bit i: motor i was asked for more than it has, or for less than nothing.
    pub saturated: u8,
    /// World-frame force \[N\] and torque \[N m\] that the motors deliver, as the estimators were told.
    pub input: [f32; 6],
    /// x, y, z, φ, θ, ψ with their rates, as used; `None` where none may be used.
    pub states: [Option<AxisState>; 6],
}
