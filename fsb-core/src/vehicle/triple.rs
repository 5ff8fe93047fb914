//! Three numbers, one for each axis of a group.

use crate::estimator::AxisState;

pub(super) fn positions(states: &[Option<AxisState>; 3]) -> Option<[f32; 3]> {
    all(states.map(|state| state.map(|s| s.position)))
}

pub(super) fn rates(states: &[Option<AxisState>; 3]) -> Option<[f32; 3]> {
    all(states.map(|state| state.map(|s| s.velocity)))
}

pub(super) fn difference([ax, ay, az]: &[f32; 3], [bx, by, bz]: &[f32; 3]) -> [f32; 3] {
    [ax - bx, ay - by, az - bz]
}

/// All three, or nothing.
pub(super) fn all<T>([x, y, z]: [Option<T>; 3]) -> Option<[T; 3]> {
    Some([x?, y?, z?])
}

pub(super) fn each(values: Option<[f32; 3]>) -> [Option<f32>; 3] {
    values.map_or([None; 3], |values| values.map(Some))
}

/// Written so that NaN fails it.
pub(super) fn within(values: &[f32; 3], limit: f32) -> bool {
    values.iter().all(|x| x.abs() <= limit)
}
