//! What a snapshot may hold of an observer, each condition broken by itself.

use super::{Gains, Model, Observer};

/// Position, innovation and motion in a period, each beyond the bound alone.
#[test]
fn within_bounds() {
    let gains = Gains { m1: 0.5, t_l2: 0.1 };
    let within = |y: f32, innovation: f32, motion: f32| {
        let mut observer = Observer::default();
        observer.start(y);
        observer.seed(innovation * gains.m1, motion, &gains);
        observer.is_within(10.0)
    };
    assert!(within(10.0, 10.0, 10.0) && within(-10.0, -10.0, -10.0) && within(0.0, 0.0, 0.0));
    for bad in [10.1, -10.1, f32::NAN] {
        assert!(!within(bad, 0.0, 0.0) && !within(0.0, bad, 0.0) && !within(0.0, 0.0, bad), "{bad}");
    }
}

/// k T² of a k within 0..=1e15, and a drift that is none or the axis's own.
#[test]
fn models() {
    let period2 = 1e-6_f32;
    let sound = |k: f32, c_t2: f32| Model { k_t2: k * period2, c_t2 }.is_sound(-9.81e-6, period2);
    for k in [0.0, 1e-6, 0.8, 5000.0, 1e15] {
        assert!(sound(k, 0.0) && sound(k, -9.81e-6), "{k}");
        assert!(!sound(k, 9.81e-6) && !sound(k, f32::NAN), "{k}");
    }
    for k in [-1e-6, -0.8, 1.1e15, f32::NAN] {
        assert!(!sound(k, 0.0) && !sound(k, -9.81e-6), "{k}");
    }
}
