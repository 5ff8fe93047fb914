//! How the noise of the velocity falls after the first measurement.
//!
//! The covariance of the error of (ŷ, T v̂) under unit noise obeys P ← (I - L H) F P Fᵀ (I - L H)ᵀ + L Lᵀ with the gains of each sample,
//! l1 = 1 - p² g\[n-1\]/g\[n+1\], T l2 = 1 - 2 p g\[n-1\]/g\[n\] + p² g\[n-1\]/g\[n+1\], g\[n\] = (1 - ρⁿ)(1 - ρⁿ⁺¹).

use super::Sensor;
use fsb_core::Tuning;

/// Standard deviation of the velocity at each sample from the second on, the k being right: time since the first measurement \[s\]
/// and sd \[m/s\], for `seconds`.
pub fn velocity_sd(sensor: &Sensor, tuning: Tuning, seconds: f64) -> impl Iterator<Item = (f64, f64)> {
    let (t, p) = (sensor.period, (-tuning.lambda * sensor.period).exp());
    let opened = move |n: f64| -(-tuning.q * t * n).exp_m1();
    let window = move |n: f64| opened(n) * opened(n + 1.0);
    let (mut yy, mut yv, mut vv) = (1.0, 0.0, 0.0);
    let samples = (seconds / t).ceil() as u64;
    let sensor = *sensor;
    (1..=samples).map(move |n| {
        let at = n as f64;
        let (before, now, after) = (window(at - 1.0), window(at), window(at + 1.0));
        let m = p * p * before / after;
        let l2 = 1.0 - 2.0 * p * before / now + m;
        (yy, yv) = (yy + 2.0 * yv + vv, yv + vv);
        vv += -2.0 * l2 * yv + l2 * l2 * (yy + 1.0);
        yv = m * (yv - l2 * yy) + (1.0 - m) * l2;
        yy = m * m * yy + (1.0 - m) * (1.0 - m);
        (at * t, sensor.noise_sd * vv.sqrt() / t)
    })
}

/// When the velocity is within twice its steady noise \[s after the first measurement\].
#[must_use]
pub fn settled(sensor: &Sensor, tuning: Tuning) -> f64 {
    let steady = super::observer::velocity_sd(sensor, tuning.lambda);
    let slowest = tuning.lambda.min(tuning.q);
    velocity_sd(sensor, tuning, 20.0 / slowest).find(|&(_, sd)| sd <= 2.0 * steady).map_or(20.0 / slowest, |(t, _)| t)
}
