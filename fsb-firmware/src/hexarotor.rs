//! The geometry of a hexarotor with passively tilted rotors (Fig. 1 of the paper): fully actuated.

/// Six rotors on a circle in the body's xy plane, motor i at the angle 60° i from the x axis. Each is tilted about its arm,
/// motors 0, 2, 4 by +`tilt` and 1, 3, 5 by -`tilt`, and neighbours turn in opposite directions. z points up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TiltedHexarotor {
    /// Length of an arm \[m\].
    pub arm: f64,
    /// Tilt of a rotor axis about its arm \[rad\]. Zero cannot be inverted: no sideways force.
    pub tilt: f64,
    /// Reaction torque of a rotor per thrust \[m\].
    pub drag_ratio: f64,
}

impl TiltedHexarotor {
    /// `[i][j]`: component i of the wrench (force, then torque, in the body frame) per newton of motor j.
    pub fn matrix(&self) -> [[f64; 6]; 6] {
        let mut matrix = [[0.0; 6]; 6];
        for motor in 0..6 {
            let angle = core::f64::consts::FRAC_PI_3 * motor as f64;
            let side = if motor % 2 == 0 { 1.0 } else { -1.0 };
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            let (sideways, up) = (side * libm::sin(self.tilt), libm::cos(self.tilt));
            let force = [sin * sideways, -cos * sideways, up];
            // arm x force, and the reaction, which has the sense of the tilt's own yawing moment: the two add up.
            let reaction = -side * self.drag_ratio;
            let torque = [
                self.arm * sin * up + reaction * sin * sideways,
                -self.arm * cos * up - reaction * cos * sideways,
                -self.arm * sideways + reaction * up,
            ];
            for (row, entry) in matrix.iter_mut().zip(force.into_iter().chain(torque)) {
                if let Some(slot) = row.get_mut(motor) {
                    *slot = entry;
                }
            }
        }
        matrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Allocation;

    const BODY: TiltedHexarotor = TiltedHexarotor { arm: 0.25, tilt: 0.35, drag_ratio: 0.02 };

    /// Equal thrusts lift and do nothing else, by symmetry.
    #[test]
    fn equal_thrusts_only_lift() {
        for (component, row) in BODY.matrix().iter().enumerate() {
            let sum: f64 = row.iter().sum();
            let wanted = if component == 2 { 6.0 * libm::cos(0.35) } else { 0.0 };
            assert!((sum - wanted).abs() < 1e-14, "{component}: {sum}");
        }
    }

    /// Motor 0 sits on +x, tilted towards -y: its lift pitches the nose down (negative about y), its side force is -y.
    #[test]
    fn signs_of_motor_0() {
        let of_motor_0 = BODY.matrix().map(|row| row[0]);
        let (s, c) = (libm::sin(0.35), libm::cos(0.35));
        for (got, wanted) in of_motor_0.iter().zip([0.0, -s, c, 0.0, -0.25 * c + 0.02 * s, -0.25 * s - 0.02 * c]) {
            assert!((got - wanted).abs() < 1e-14, "{got} {wanted}");
        }
    }

    #[test]
    fn fully_actuated_where_tilted() {
        assert!(Allocation::new(&BODY.matrix(), 6.0).is_ok());
        assert!(Allocation::new(&TiltedHexarotor { tilt: 0.0, ..BODY }.matrix(), 6.0).is_err());
    }
}
