//! What an update takes: what was measured, and what the actuators were told.

use crate::attitude::rotation::{self, Matrix};

/// R(η) of (2), which turns body into world coordinates, in one of its forms.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Attitude {
    /// By rows: entry \[i\]\[j\] is the component of body axis j along world axis i.
    Matrix([[f32; 3]; 3]),
    /// Unit quaternion w, x, y, z. q and -q are the same.
    Quaternion([f32; 4]),
    /// Roll φ, pitch θ, yaw ψ of (2) (rad): yaw about z, then pitch about the new y, then roll about the new x.
    #[cfg(any(feature = "euler", feature = "micromath"))]
    Euler([f32; 3]),
}

impl Attitude {
    /// By rows. What is no rotation remains none.
    pub(super) fn matrix(&self) -> Matrix {
        match *self {
            Self::Matrix(matrix) => matrix,
            Self::Quaternion(quaternion) => {
                let [w, x, y, z] = quaternion;
                let norm2 = w * w + x * x + y * y + z * z;
                // The formula takes a quaternion that is not of length one for another rotation, instead of none.
                if (norm2 - 1.0).abs() <= 0.01 { rotation::from_quaternion(quaternion) } else { [[f32::NAN; 3]; 3] }
            }
            #[cfg(feature = "euler")]
            Self::Euler(angles) => crate::attitude::euler::with_libm(angles),
            #[cfg(all(feature = "micromath", not(feature = "euler")))]
            Self::Euler(angles) => crate::attitude::euler::with_micromath(angles),
        }
    }
}

/// What was measured, and has arrived by now.
///
/// A group's measurements come every `substeps` updates from the first one on. A position in between is not taken, which is told
/// ([`Events::position_out_of_step`](super::Events::position_out_of_step)); an attitude in between turns the force and is not taken otherwise. Where as many in succession as make
/// a jump ([`GuardConfig::jump_after`](crate::guard::GuardConfig::jump_after)) came in between and none when one was due, the group starts anew in step with them, its parameters held: a
/// control period has been lost, or the sensor's clock is another one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Measured {
    /// x, y, z in the world frame, z up (m).
    pub position: Option<[f32; 3]>,
    /// Body to world.
    pub attitude: Option<Attitude>,
}

/// Force (N) and torque (N m) on the body about its centre of mass, along the body's axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Wrench {
    /// F (N), gravity not included.
    pub force: [f32; 3],
    /// τ (N m), the gyroscopic moment not included.
    pub torque: [f32; 3],
}
