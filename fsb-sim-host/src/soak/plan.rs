//! What is flown, over and over, ten minutes long: sines for 450 s, half a minute of holding one point, then the sensor
//! falls silent: the horizontal axis without input, the vertical one on constant thrust, positions without noise. In
//! silence every filter decays towards zero; that is where subnormal numbers would be born.

use crate::plant::HeldInputAxis;

/// k of the plant [1/kg].
pub(super) const K: f64 = 0.8;
/// c of the axes [m/s²]: none, and gravity, as f32 has it.
pub(super) const DRIFT: [f32; 2] = [0.0, -9.81];
/// About where the axes move [m].
pub(super) const CENTRE: [f64; 2] = [0.0, 3.0];

const CYCLE: f64 = 600.0;
const SINES_UNTIL: f64 = 450.0;
const SILENT_FROM: f64 = 480.0;
/// Amplitude [m] and angular frequency [rad/s]; the frequencies have no common measure.
const SINES: [[(f64, f64); 2]; 2] = [[(2.0, 0.7), (0.5, 2.236)], [(0.8, 1.1), (0.2, 3.317)]];
const KP: f64 = 6.0;
const KD: f64 = 5.0;

/// Whether the sensor is without noise and the controller off at `t` [s].
pub(super) fn is_silent(t: f64) -> bool {
    t % CYCLE >= SILENT_FROM
}

/// Forces [N] from `t` [s] on. The controller sees the true state: the estimators are watched here, they do not fly.
pub(super) fn forces(t: f64, plant: &[HeldInputAxis; 2]) -> [f32; 2] {
    std::array::from_fn(|i| {
        let axis = &plant[i];
        if is_silent(t) {
            return (-axis.drift / axis.k) as f32;
        }
        let mut acceleration = -axis.drift - KD * axis.velocity - KP * (axis.position - CENTRE[i]);
        if t % CYCLE < SINES_UNTIL {
            for (amplitude, omega) in SINES[i] {
                let (sin, cos) = (omega * t).sin_cos();
                acceleration += amplitude * ((KP - omega * omega) * sin + KD * omega * cos);
            }
        }
        (acceleration / axis.k) as f32
    })
}
