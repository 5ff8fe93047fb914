//! Where the identifier's own states say an axis is (design, section 6), drag included.
//!
//! The identity filtered twice and filtered once, solved for the estimates, C = c + d and σ the slope of `free_state`:
//!
//! (b1 + D bv1) ŷ = k x5 + C u2 - D v2 - x2,
//! σ (1 - D T/2) (ŷ\[n\] - ŷ\[n-1\]) = k x6 + C u3 - D v3 - x3 - \[b2/2 + D (bv2/2 + σ T/2)\] ŷ.

use super::axis::Axis;
use super::clock::Clock;
use super::design::Common;
use super::model::DragModel;

/// No state is this far out (m).
const LARGEST: f32 = 1e9;

/// Puts the axis's observer there, for k and the axis's own D and d as they are. False where the states do not say.
pub(super) fn seed(axis: &mut Axis, k: f32, model: &DragModel, clock: &Clock, common: &Common) -> bool {
    let (at, unit, velocity) = (&clock.at, &clock.unit, &clock.velocity_at);
    let Axis { cascade, velocity: v, own, .. } = &*axis;
    let (drag, drift) = (axis.drag.value, own.drift + axis.disturbance.value);
    let half_t = 0.5 * common.period;
    let twice = k * cascade.x5.value() + drift * unit.u2.value() - drag * v.v2.value() - cascade.x2.value();
    let position = twice / (at.b1 + drag * velocity.bv1);
    let weight = 0.5 * at.b2 + drag * (0.5 * velocity.bv2 + half_t * at.slope);
    let once = k * cascade.x6.value() + drift * unit.u3.value() - drag * v.v3.value() - cascade.x3.value();
    let step = (once - weight * position) / (at.slope * (1.0 - half_t * drag));
    let t_velocity = model.velocity_after(step, axis.moments);
    let sound = position.abs() <= LARGEST && t_velocity.abs() <= LARGEST;
    if sound {
        let residual = (axis.observer.state().measurement() - axis.origin) - position;
        axis.observer.seed(residual, t_velocity, &clock.gains);
        // A late start is forgotten with it.
        axis.settled_at = axis.settled_at.min(clock.count.max(common.state_settle));
    }
    sound
}
