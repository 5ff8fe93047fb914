//! Where the vehicle shall be: a lying eight with a slow nod on all three angles.

use fsb_core::control::Reference;

/// Amplitude \[m or rad\] and angular frequency \[rad/s\] of each axis, about 0, 0, 2 m and level.
const COURSE: [(f64, f64, f64); 6] =
    [(0.0, 1.0, 0.6), (0.0, 0.5, 1.2), (2.0, 0.3, 0.9), (0.0, 0.08, 1.4), (0.0, 0.08, 1.7), (0.0, 0.2, 1.0)];

/// The reference at `time` \[s\], with its exact derivatives.
pub fn at(time: f64) -> [Reference; 6] {
    COURSE.map(|(centre, amplitude, w)| {
        let (sin, cos) = (libm::sin(w * time), libm::cos(w * time));
        Reference {
            position: (centre + amplitude * sin) as f32,
            velocity: (amplitude * w * cos) as f32,
            acceleration: (-amplitude * w * w * sin) as f32,
        }
    })
}
