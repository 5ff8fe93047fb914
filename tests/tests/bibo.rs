//! Boundedness: the states of the FSB observer obey (61)-(64) for any bounded input, those of the ADB observer do not.

use fsb_sim_host::paper_form::bibo::{gamma11, gamma11_linear, gamma12, gamma21, gamma21_linear, gamma22};
use fsb_sim_host::paper_form::{AdbObserver, Observer, Step, Tuning, Window};
use proptest::prelude::*;

/// What drives the two inputs.
#[derive(Clone, Copy, Debug)]
enum Shape {
    /// Random levels of random length.
    Levels,
    /// Always at a bound, random sign of random length.
    Bang,
    /// At the bound with the sign that pushes x2 up; then x1 follows.
    Adverse,
    /// A constant at the bound.
    Constant,
}

/// A small generator for inputs: the seed is drawn, and printed on failure, by proptest.
struct Levels(u64);

impl Levels {
    /// In [-1, 1).
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Largest |x1|, |x2| of the observer over `lengths` of 1/λ, for |y| <= 1·`y_max`, |f| <= `f_max`.
fn largest_states(tuning: Tuning, k: f64, bounds: [f64; 2], shape: Shape, seed: u64, lengths: f64) -> [f64; 2] {
    let dt = 0.05 / tuning.lambda.max(tuning.q);
    let mut observer = Observer::new(tuning, k, 0.0);
    let (mut random, mut level, mut left) = (Levels(seed), [0.0; 2], 0);
    let mut largest = [0.0_f64; 2];
    for n in 0..(lengths / tuning.lambda / dt) as usize {
        let t = n as f64 * dt;
        if left == 0 {
            left = (random.next().abs() * 200.0) as usize + 1;
            level = std::array::from_fn(|_| random.next());
        }
        left -= 1;
        let part = match shape {
            Shape::Levels => level,
            Shape::Bang => level.map(f64::signum),
            Shape::Adverse => {
                let b = Window::at(tuning, t + dt / 2.0).input_matrix(k);
                [b[1][0].signum(), b[1][1].signum()]
            }
            Shape::Constant => [-1.0, k.signum()],
        };
        let step = Step::new(tuning, t, dt);
        observer.step(&step, &[part[0] * bounds[0]; 3], &[part[1] * bounds[1]; 3]);
        for (largest, x) in largest.iter_mut().zip(observer.states()) {
            *largest = if x.is_finite() { largest.max(x.abs()) } else { f64::INFINITY };
        }
    }
    largest
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, rng_seed: proptest::test_runner::RngSeed::Fixed(64), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn states_obey_the_bounds(
        lambda in 0.1..20.0_f64, ratio in 0.05..20.0_f64, k in -10.0..10.0_f64, y_max in 0.0..50.0_f64, f_max in 0.0..50.0_f64,
        shape in prop_oneof![Just(Shape::Levels), Just(Shape::Bang), Just(Shape::Adverse), Just(Shape::Constant)], seed: u64,
    ) {
        let q = ratio * lambda;
        let x = largest_states(Tuning { lambda, q }, k, [y_max, f_max], shape, seed, 30.0);
        // Rounding only: a constant input reaches its bound from below.
        let room = 1.0 + 1e-9;
        let by_force = [gamma12(lambda, k) * f_max, gamma22(lambda, k) * f_max];
        prop_assert!(x[1] <= room * (gamma21(lambda, q) * y_max + by_force[1]), "(61), x2 = {}", x[1]);
        prop_assert!(x[0] <= room * (gamma11(lambda, q) * y_max + by_force[0]), "(64), x1 = {}", x[0]);
        prop_assert!(x[1] <= room * (gamma21_linear(lambda, q) * y_max + by_force[1]), "linear in q, x2 = {}", x[1]);
        prop_assert!(x[0] <= room * (gamma11_linear(lambda, q) * y_max + by_force[0]), "linear in q, x1 = {}", x[0]);
    }
}

/// The bounds are not idle: a constant input reaches those of x2 and of f in x1 to a per cent, and the adverse one comes
/// within a factor of 2 of the bound linear in q where (62) is far off.
#[test]
fn bounds_are_reached() {
    let (lambda, k) = (2.0, -3.0);
    let near = Tuning { lambda, q: 1.0 };
    let x = largest_states(near, k, [1.0, 0.0], Shape::Constant, 0, 30.0);
    assert!(x[1] > 0.99 * gamma21(lambda, near.q), "{x:?}");
    let x = largest_states(near, k, [0.0, 1.0], Shape::Constant, 0, 30.0);
    assert!(x[1] > 0.99 * gamma22(lambda, k) && x[0] > 0.99 * gamma12(lambda, k), "{x:?}");
    let far = Tuning { lambda, q: 40.0 };
    let x = largest_states(far, k, [1.0, 0.0], Shape::Adverse, 0, 5.0);
    assert!(x[1] > 0.5 * gamma21_linear(lambda, far.q) && x[1] < 0.03 * gamma21(lambda, far.q), "{x:?}");
}

/// States of both observers after `seconds` of a constant position and force.
fn constant_input(y: f64, f: f64, k: f64, seconds: f64) -> ([f64; 2], [f64; 2]) {
    let (tuning, dt) = (Tuning { lambda: 2.0, q: 1.0 }, 1e-2);
    let (mut fsb, mut adb) = (Observer::new(tuning, k, 0.0), AdbObserver::new(k, 0.0));
    for n in 0..(seconds / dt).round() as usize {
        let t = n as f64 * dt;
        fsb.step(&Step::new(tuning, t, dt), &[y; 3], &[f; 3]);
        adb.step(t, dt, &[y; 3], &[f; 3]);
    }
    (fsb.states(), adb.states())
}

/// On a constant position the ADB states are 2 y t and -y t²; on a constant force -k f t³/3 and -k f t⁴/12. The same input
/// leaves the FSB states where they were.
#[test]
fn derivative_based_states_grow_without_bound() {
    let (y, f, k) = (3.0, 0.5, 2.0);
    for t in [10.0, 20.0, 40.0, 80.0] {
        let ([_, x2_fsb], adb) = constant_input(y, 0.0, k, t);
        assert!((adb[0] / (2.0 * y * t) - 1.0).abs() < 1e-9 && (adb[1] / (-y * t * t) - 1.0).abs() < 1e-9, "{adb:?}");
        assert!(x2_fsb.abs() <= gamma21(2.0, 1.0) * y * (1.0 + 1e-9));
        let (fsb, adb) = constant_input(0.0, f, k, t);
        assert!((adb[0] / (-k * f * t.powi(3) / 3.0) - 1.0).abs() < 1e-9, "{adb:?}");
        assert!((adb[1] / (-k * f * t.powi(4) / 12.0) - 1.0).abs() < 1e-9, "{adb:?}");
        assert!(
            fsb[0].abs() <= gamma12(2.0, k) * f * (1.0 + 1e-9) && fsb[1].abs() <= gamma22(2.0, k) * f * (1.0 + 1e-9)
        );
    }
    let (once, twice) = (constant_input(y, 0.0, k, 50.0), constant_input(y, 0.0, k, 100.0));
    assert!((twice.1[1] / once.1[1] - 4.0).abs() < 1e-9 && (twice.1[0] / once.1[0] - 2.0).abs() < 1e-9);
    assert!((twice.0[1] / once.0[1] - 1.0).abs() < 1e-9, "FSB: {:?}, {:?}", once.0, twice.0);
}
