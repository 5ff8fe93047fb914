//! The prediction with drag against the equation of motion, integrated.

use super::super::DragModel;
use crate::Tuning;
use crate::moments::InputMoments;
use crate::observer::ObserverDesign;

/// y'' = k (f0 + (f1 - f0) t/T) - D y' + c from y = 0 over `share` of T; position beyond constant velocity, and velocity times T.
fn integrated(k: f64, drag: f64, c: f64, [f0, f1]: [f64; 2], velocity: f64, period: f64, share: f64) -> (f64, f64) {
    const STEPS: u32 = 200;
    let dt = period * share / f64::from(STEPS);
    let pull = |t: f64, v: f64| k * (f0 + (f1 - f0) * t / period) - drag * v + c;
    let (mut y, mut v) = (0.0, velocity);
    for n in 0..STEPS {
        let t = f64::from(n) * dt;
        let k1 = pull(t, v);
        let k2 = pull(t + dt / 2.0, v + dt / 2.0 * k1);
        let k3 = pull(t + dt / 2.0, v + dt / 2.0 * k2);
        let k4 = pull(t + dt, v + dt * k3);
        y += dt * (v + dt / 6.0 * (k1 + k2 + k3));
        v += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    (y - velocity * period * share, v * period)
}

/// Over a period or a part of it, for inputs that go linearly: all but (D T)⁴/24 of the motion, or of the growth where D is
/// negative.
#[test]
fn a_braked_motion() {
    let period = 0.1;
    let design = ObserverDesign::new(Tuning::from_lambda(1.0), period).expect("valid");
    for delta in [-0.25, -0.1, 0.0, 0.05, 0.1, 0.25] {
        for (k, c, inputs, velocity) in [
            (0.8, 0.0, [0.0, 0.0], 2.0),
            (0.8, -9.81, [0.0, 0.0], 0.0),
            (0.8, 0.0, [10.0, 10.0], 0.0),
            (0.8, 0.0, [-10.0, 15.0], 0.0),
            (0.8, 3.0, [20.0, 5.0], -1.5),
        ] {
            for share in [0.25, 0.6, 1.0] {
                let drag = delta / period;
                let model = DragModel::new(k as f32, drag as f32, c as f32, &design);
                // The moments of the part, in units of the whole period.
                let [f0, f1] = inputs;
                let end = f0 + (f1 - f0) * share;
                let moments = InputMoments {
                    j1: (share * (f0 + end) / 2.0) as f32,
                    j2: (share * share * (2.0 * f0 + end) / 6.0) as f32,
                };
                let model = if share < 1.0 { model.within(share as f32) } else { model };
                let w = velocity * period;
                let motion = model.motion(w as f32, moments);
                let (position, t_velocity) = integrated(k, drag, c, inputs, velocity, period, share);
                let size = w.abs() + period * period * (k * f0.abs().max(f1.abs()) + c.abs());
                let x: f64 = (delta * share).abs();
                let bound = size * (x.powi(4) / 24.0 * libm::exp(x) + 3e-7);
                let got = [f64::from(motion.j2), w + f64::from(motion.j1)];
                for (got, expected) in got.into_iter().zip([position, t_velocity]) {
                    assert!((got - expected).abs() <= bound, "{delta}, {inputs:?}, {share}: {got} for {expected}");
                }
            }
        }
    }
}
