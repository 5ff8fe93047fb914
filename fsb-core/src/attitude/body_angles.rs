//! Angles about the body's axes at any attitude: the turns between successive measurements, added up.
//!
//! With R the attitude, body to world, D = R\[n-1\]ᵀ R\[n\] and a = ½ vee(D - Dᵀ), of length sin θ,
//!
//! ϑ\[n\] = ϑ\[n-1\] + a (1 + |a|²/6 + 3|a|⁴/40 + 15|a|⁶/336).
//!
//! ϑ' is the body rate up to coning, so ϑ'' = ω' at any attitude, where the Euler angles of (10) only do near level. No
//! trigonometry: the series of arcsin θ/sin θ is good to 2e-6 of a turn of 0.3 rad, which is the most that is taken.

use super::rotation::{self, Matrix};
use crate::accumulator::Accumulator;
use crate::snapshot::stored;
use core::fmt;

/// An attitude was not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum AttitudeError {
    /// Not finite, or not a rotation to 1 %. Nothing has changed: the next attitude brings both turns.
    NotARotation,
    /// A turn of more than 0.3 rad since the last one. The angles go on from the new attitude without it: what is estimated
    /// from them has to begin anew.
    TurnTooLarge,
}

impl fmt::Display for AttitudeError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::NotARotation => "the attitude is not finite, or no rotation",
            Self::TurnTooLarge => "the attitude has turned by more than 0.3 rad since the last one",
        })
    }
}

impl core::error::Error for AttitudeError {}

/// ϑ, in rad. Zero at the first attitude.
///
/// Non-finite policy: refused, see [`AttitudeError`]. Cost: about 90 operations a measurement.
#[derive(Clone, Copy, Debug, Default)]
pub struct BodyAngles {
    attitude: Option<Matrix>,
    angles: [Accumulator; 3],
}

impl BodyAngles {
    /// sin² of the largest turn taken.
    const LARGEST: f32 = 0.0873;
    /// How far a product of two rows may be from 0 or 1.
    const TOLERANCE: f32 = 0.01;

    /// Takes the attitude R, body to world, by rows, and returns the angles about the body's x, y and z.
    ///
    /// # Errors
    /// [`AttitudeError`]; give the estimator a missing measurement then.
    pub fn turn_to(&mut self, attitude: &[[f32; 3]; 3]) -> Result<[f32; 3], AttitudeError> {
        if !is_rotation(attitude, Self::TOLERANCE) {
            return Err(AttitudeError::NotARotation);
        }
        let Some(before) = self.attitude.replace(*attitude) else {
            return Ok(self.angles());
        };
        let turn = turned(&before, attitude);
        let [x, y, z] = turn.axis;
        let sine2 = x * x + y * y + z * z;
        // The cosine tells a small turn from one by nearly π.
        if turn.trace < 2.0 || sine2 > Self::LARGEST {
            return Err(AttitudeError::TurnTooLarge);
        }
        let stretch = 1.0 + sine2 * (1.0 / 6.0 + sine2 * (0.075 + sine2 * (15.0 / 336.0)));
        for (angle, a) in self.angles.iter_mut().zip(turn.axis) {
            angle.add_folded(a * stretch);
        }
        Ok(self.angles())
    }

    /// The same for the unit quaternion w + xi + yj + zk that turns body vectors into world vectors.
    ///
    /// # Errors
    /// As [`turn_to`](Self::turn_to).
    pub fn turn_to_quaternion(&mut self, quaternion: [f32; 4]) -> Result<[f32; 3], AttitudeError> {
        let [w, x, y, z] = quaternion;
        let norm2 = w * w + x * x + y * y + z * z;
        // Written so that NaN fails it.
        let unit = (norm2 - 1.0).abs() <= Self::TOLERANCE;
        if !unit {
            return Err(AttitudeError::NotARotation);
        }
        self.turn_to(&rotation::from_quaternion(quaternion))
    }

    /// A turn about the body's axes (rad) that is known otherwise, where an attitude is missing: the next one taken is then
    /// compared with the attitude this leads to. Before the first attitude, and for a turn of more than 0.3 rad, nothing
    /// happens.
    pub fn turn_by(&mut self, turn: &[f32; 3]) {
        let [x, y, z] = *turn;
        let square = x * x + y * y + z * z;
        if let Some(attitude) = self.attitude
            && square <= 0.09
            && let Some(by) = rotation::exponential(turn)
        {
            self.attitude = Some(rotation::product(&attitude, &by));
            for (angle, a) in self.angles.iter_mut().zip(turn) {
                angle.add_folded(*a);
            }
        }
    }

    /// Moves the origin of the angles: from now on they are larger by `by` (rad). The attitude stays.
    pub(crate) fn translate(&mut self, by: &[f32; 3]) {
        for (angle, by) in self.angles.iter_mut().zip(by) {
            angle.add_folded(*by);
        }
    }

    /// R, body to world, by rows: the last attitude taken, and the turns given since.
    pub const fn attitude(&self) -> Option<[[f32; 3]; 3]> {
        self.attitude
    }

    /// The angles at the last attitude taken, and the turns given since.
    pub fn angles(&self) -> [f32; 3] {
        self.angles.map(|angle| angle.value())
    }
}

stored!(BodyAngles { attitude, angles });

impl BodyAngles {
    /// What a prediction over a gap may add to a measured attitude's tolerance.
    const DRIFT: f32 = 0.01;

    /// Of a state that was stored.
    pub(crate) fn is_sound(&self) -> bool {
        self.attitude.iter().all(|attitude| is_rotation(attitude, Self::TOLERANCE + Self::DRIFT))
            && self.angles.iter().all(|angle| angle.value().abs() <= 1e9)
    }
}

/// a = ½ vee(D - Dᵀ) and the trace of D = Aᵀ B.
struct Turn {
    axis: [f32; 3],
    trace: f32,
}

fn turned(a: &[[f32; 3]; 3], b: &[[f32; 3]; 3]) -> Turn {
    let [[a00, a01, a02], [a10, a11, a12], [a20, a21, a22]] = *a;
    let [[b00, b01, b02], [b10, b11, b12], [b20, b21, b22]] = *b;
    let d21 = a02 * b01 + a12 * b11 + a22 * b21;
    let d12 = a01 * b02 + a11 * b12 + a21 * b22;
    let d02 = a00 * b02 + a10 * b12 + a20 * b22;
    let d20 = a02 * b00 + a12 * b10 + a22 * b20;
    let d10 = a01 * b00 + a11 * b10 + a21 * b20;
    let d01 = a00 * b01 + a10 * b11 + a20 * b21;
    let trace =
        (a00 * b00 + a10 * b10 + a20 * b20) + (a01 * b01 + a11 * b11 + a21 * b21) + (a02 * b02 + a12 * b12 + a22 * b22);
    Turn { axis: [0.5 * (d21 - d12), 0.5 * (d02 - d20), 0.5 * (d10 - d01)], trace }
}

/// Rows of length one, at right angles, right-handed. Written so that NaN fails it.
fn is_rotation(r: &[[f32; 3]; 3], tolerance: f32) -> bool {
    let [x, y, z] = r;
    let near = |value: f32, wanted: f32| (value - wanted).abs() <= tolerance;
    let dot = |a: &[f32; 3], b: &[f32; 3]| {
        let ([a0, a1, a2], [b0, b1, b2]) = (*a, *b);
        a0 * b0 + a1 * b1 + a2 * b2
    };
    let ([x0, x1, x2], [y0, y1, y2]) = (*x, *y);
    let cross = [x1 * y2 - x2 * y1, x2 * y0 - x0 * y2, x0 * y1 - x1 * y0];
    near(dot(x, x), 1.0)
        && near(dot(y, y), 1.0)
        && near(dot(x, y), 0.0)
        && near(dot(&cross, z), 1.0)
        && near(dot(z, z), 1.0)
}
