//! The gyroscopic moment τ_g = -ω × I ω of (8), taken as an input beside the torque: I ω' = τ + τ_g.

/// τ_g (N m) at the body rates ω (rad/s).
pub(super) fn moment(inertia: &[f32; 3], rates: &[f32; 3]) -> [f32; 3] {
    let ([ix, iy, iz], [p, q, r]) = (*inertia, *rates);
    [(iy - iz) * q * r, (iz - ix) * r * p, (ix - iy) * p * q]
}

/// τ_g in the middle of a control period that begins with the body rates `rates` and through which `torque` acts on the
/// mean: to second order of the period. `k` is 1/I.
pub(super) fn in_the_middle(
    inertia: &[f32; 3],
    k: &[f32; 3],
    rates: &[f32; 3],
    torque: &[f32; 3],
    half_period: f32,
) -> [f32; 3] {
    let mut middle = *rates;
    let turning = moment(inertia, rates);
    for (((rate, k), applied), own) in middle.iter_mut().zip(k).zip(torque).zip(turning) {
        *rate += half_period * (k * (applied + own));
    }
    moment(inertia, &middle)
}
