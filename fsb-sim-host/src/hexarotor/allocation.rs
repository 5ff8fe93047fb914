//! A wrench to thrusts within limits, and which wrenches are attainable.
//!
//! The attainable wrenches are the image of a box, thrusts from T_min to T_max, under an invertible map. So a wrench is
//! attainable exactly if its six thrusts lie in the box, and how far one can go from a wrench in a direction is where a
//! straight line leaves the box: six divisions, no search.

use serde::Serialize;

use super::frame::{Frame, Wrench};
use super::vector::Vector;

/// What [`Allocator::allocate`] gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allocation {
    /// Thrusts [N], within their limits.
    pub thrusts: [f64; 6],
    /// Whether the wrench had to be cut back; what is left of it is [`Frame::wrench`] of the thrusts.
    pub saturated: bool,
}

/// The frame with the limits of its rotors.
#[derive(Clone, Debug, PartialEq)]
pub struct Allocator {
    frame: Frame,
    /// T_min, T_max [N].
    limits: [f64; 2],
}

/// What the vehicle can do, each component alone unless stated; `[low, high]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Attainable {
    /// All thrusts at their most along body z, by the weight.
    pub thrust_to_weight: f64,
    /// F_z with no lateral force and no torque [N].
    pub vertical_force: [f64; 2],
    /// F_x and F_y while F_z carries the weight, no torque [N].
    pub lateral_force: [[f64; 2]; 2],
    /// The lateral force that is there in every direction while F_z carries the weight, no torque [N]; the least is along
    /// the arms, and with T_min = 0 it is at most tan β/2 of the weight.
    pub lateral_force_any_direction: f64,
    /// τ_x, τ_y, τ_z while F_z carries the weight [N m].
    pub torque: [[f64; 2]; 3],
}

impl Allocator {
    pub(super) fn new(frame: Frame, limits: [f64; 2]) -> Self {
        Self { frame, limits }
    }

    /// The geometry.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// `value` within the limits of a thrust [N]; T_min for a NaN.
    pub fn limited(&self, value: f64) -> f64 {
        // max and min pass over a NaN, clamp would keep it.
        value.max(self.limits[0]).min(self.limits[1])
    }

    /// The thrusts of a body force [N] and torque [N m]. What does not fit is cut back in this order: the lateral force by a
    /// factor, the vertical force up or down, the torque by a factor. So a vehicle at its limits keeps its attitude first and
    /// its height second. A component that is no finite number counts as zero and as saturated.
    pub fn allocate(&self, force: Vector, torque: Vector) -> Allocation {
        let finite = |v: Vector| v.map(|value| if value.is_finite() { value } else { 0.0 });
        let mut saturated = !force.iter().chain(&torque).all(|value| value.is_finite());
        let ([x, y, z], torque) = (finite(force), finite(torque));
        let [low, high] = self.limits;
        let part = |force, torque| self.frame.thrusts(&Wrench { force, torque });

        let mut turning = part([0.0; 3], torque);
        let (least, most) = extremes(&turning);
        if most - least > high - low {
            turning = turning.map(|value| value * (high - low) / (most - least));
            saturated = true;
        }
        let (least, most) = extremes(&turning);
        let wanted = part([0.0, 0.0, z], [0.0; 3])[0];
        let lifting = wanted.min(high - most).max(low - least);
        let base = turning.map(|value| value + lifting);
        let lateral = part([x, y, 0.0], [0.0; 3]);
        let share = self.way(&base, &lateral).min(1.0);
        saturated |= lifting != wanted || share < 1.0;
        let thrusts = std::array::from_fn(|i| self.limited(base[i] + share * lateral[i]));
        Allocation { thrusts, saturated }
    }

    /// The distance of the thrusts of `wrench` to the nearest limit [N]; negative if the wrench is not attainable.
    pub fn headroom(&self, wrench: &Wrench) -> f64 {
        let (least, most) = extremes(&self.frame.thrusts(wrench));
        (least - self.limits[0]).min(self.limits[1] - most)
    }

    /// The largest s for which `from` + s `direction` is attainable; `None` if `from` is not, infinite if `direction` is zero.
    pub fn reach(&self, from: &Wrench, direction: &Wrench) -> Option<f64> {
        let base = self.frame.thrusts(from);
        let inside = base.iter().all(|value| (self.limits[0]..=self.limits[1]).contains(value));
        inside.then(|| self.way(&base, &self.frame.thrusts(direction)))
    }

    /// What can be done at the given weight m g [N]; `None` if the rotors cannot carry it, or cannot be so weak.
    pub fn attainable(&self, weight: f64) -> Option<Attainable> {
        let hover = Wrench { force: [0.0, 0.0, weight], torque: [0.0; 3] };
        let unit = |index: usize, sign: f64| {
            let mut both = [[0.0; 3]; 2];
            both[index / 3][index % 3] = sign;
            Wrench { force: both[0], torque: both[1] }
        };
        let range = |index| Some([-self.reach(&hover, &unit(index, -1.0))?, self.reach(&hover, &unit(index, 1.0))?]);
        let vertical_force = self.limits.map(|thrust| self.frame.wrench(&[thrust; 6]).force[2]);
        // Along arm 2 or 1 some rotor has all of its sine: the worst direction.
        let [x, y] = [range(0)?, range(1)?];
        Some(Attainable {
            thrust_to_weight: vertical_force[1] / weight,
            vertical_force,
            lateral_force: [x, y],
            lateral_force_any_direction: y[1].min(-y[0]),
            torque: [range(3)?, range(4)?, range(5)?],
        })
    }

    /// How often `direction` can be added to `base` before a thrust leaves its limits; zero or more.
    fn way(&self, base: &[f64; 6], direction: &[f64; 6]) -> f64 {
        let [low, high] = self.limits;
        let ways = base.iter().zip(direction).map(|(&at, &by)| {
            if by == 0.0 { f64::INFINITY } else { (if by > 0.0 { high - at } else { low - at }) / by }
        });
        ways.fold(f64::INFINITY, f64::min).max(0.0)
    }
}

fn extremes(values: &[f64; 6]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)))
}
