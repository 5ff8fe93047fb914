//! PX4's frames, world north-east-down and body forward-right-down, into ours, east-north-up and forward-left-up.

use crate::replay::flight::quaternion::Quaternion;
use std::f64::consts::FRAC_1_SQRT_2;

/// A vector of the world.
pub fn to_world([north, east, down]: [f64; 3]) -> [f64; 3] {
    [east, north, -down]
}

/// A vector of the body.
pub fn to_body([forward, right, down]: [f64; 3]) -> [f64; 3] {
    [forward, -right, -down]
}

/// An attitude, body to world: half a turn about the bisector of north and east, after PX4's, after half a turn about the
/// forward axis.
pub fn to_attitude(px4: Quaternion) -> Quaternion {
    let world = Quaternion([0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0]);
    let body = Quaternion([0.0, 1.0, 0.0, 0.0]);
    world.after(px4).after(body)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vector turned by PX4's attitude and then carried over is the one carried over and turned by ours.
    #[test]
    fn both_ways_meet() {
        let px4 = Quaternion::normalised([0.83, 0.31, -0.42, 0.19]).unwrap();
        let body = [0.3, -1.2, 2.5];
        let (one, other) = (to_world(px4.turn(body)), to_attitude(px4).turn(to_body(body)));
        assert!(one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-14), "{one:?} {other:?}");
        // Level and pointing north: thrust, which is -z in PX4's body, points up.
        let up = to_attitude(Quaternion::LEVEL).turn(to_body([0.0, 0.0, -1.0]));
        assert!(up[0].abs() < 1e-15 && up[1].abs() < 1e-15 && (up[2] - 1.0).abs() < 1e-15);
        // Forward is north.
        assert!((to_attitude(Quaternion::LEVEL).turn(to_body([1.0, 0.0, 0.0]))[1] - 1.0).abs() < 1e-15);
    }
}
