//! What comes into a tick and what went out.

use fsb_core::estimator::AxisState;

/// R of (2), body to world, by rows: `[i][j]` is the component of body axis j along world axis i.
pub type Attitude = [[f32; 3]; 3];

/// One measurement of the six axes; `None` is a missing one. What is no number, or cannot be true, is not used and told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// x, y, z in the world frame \[m\], z up.
    pub position: [Option<f32>; 3],
    /// φ, θ, ψ \[rad\], without turns taken out: a yaw that goes on from π at -π is a jump of the sensor to the loop.
    pub angles: [Option<f32>; 3],
    /// The same attitude as a matrix. Where it is no rotation, or one of the angles that came with it is not believed, the last good one is
    /// used, for as long as the rotation is bridged. All NaN where there is none.
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
