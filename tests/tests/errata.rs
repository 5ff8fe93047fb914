//! Each erratum of `docs/errata.md`: the printed version fails, the corrected one holds.

use fsb_sim_host::paper_form::bibo::{gamma11, gamma12, gamma22, max_b11, max_b21};
use fsb_sim_host::paper_form::{AdbObserver, Identifier, Observer, Step, Tuning, Window, rk4};

const TUNING: Tuning = Tuning { lambda: 2.0, q: 1.0 };
const K: f64 = 2.0;
const DT: f64 = 1e-3;

/// An analytic motion with y(0), y'(0) not zero, and the force that makes it: y'' = K f.
fn y(t: f64) -> f64 {
    3.0 - 1.5 * t + (2.0 * t).sin()
}

fn velocity(t: f64) -> f64 {
    -1.5 + 2.0 * (2.0 * t).cos()
}

fn force(t: f64) -> f64 {
    -4.0 * (2.0 * t).sin() / K
}

/// The coefficients of y in the second and third window function: (w2, w3), or (w̄2, w̄3).
type Pair = fn(&Window) -> (f64, f64);

const PRINTED: Pair = |w| (w.w2, w.w3);
const BARRED: Pair = |w| (w.w2_bar, w.w3_bar);

/// (53)-(54) with the given pair, at `t_end`.
fn observer(pair: Pair, t_end: f64) -> [f64; 2] {
    let lambda = TUNING.lambda;
    (0..(t_end / DT).round() as usize).fold([0.0; 2], |x, n| {
        let step = Step::new(TUNING, n as f64 * DT, DT);
        rk4(&x, DT, |i, x| {
            let w = &step.window[i];
            let (w2, w3) = pair(w);
            [-lambda * x[0] + x[1] - w2 * y(w.t), -lambda * x[1] - w3 * y(w.t) + K * w.w1 * force(w.t)]
        })
    })
}

/// Outputs (57), (59).
fn outputs(x: [f64; 2], t: f64) -> (f64, f64) {
    let c = Window::at(TUNING, t).output_matrix(TUNING).unwrap();
    (c[0][0] * x[0], c[1][0] * x[0] + c[1][1] * x[1])
}

/// (49)-(50), (53)-(54): w2, w3 are printed, w̄2, w̄3 are meant.
#[test]
fn observer_inputs_are_the_barred_functions() {
    for t in [0.5, 1.0, 4.0, 10.0] {
        let (position, rate) = outputs(observer(BARRED, t), t);
        assert!((position - y(t)).abs() < 1e-8 && (rate - velocity(t)).abs() < 1e-8, "corrected, t = {t}");
        let (position, rate) = outputs(observer(PRINTED, t), t);
        let off = (position - y(t)).hypot(rate - velocity(t));
        assert!(off > 1.0, "printed, t = {t}: {position}, {rate}");
    }
}

/// (52), (56): w1' = -λ w1 - w̄2 + x2. As printed, with w2 for w̄2 and with -x2, it fails; so does either slip alone.
#[test]
fn output_equation_has_plus_x2_and_the_barred_w2() {
    for t in [0.5_f64, 1.0, 4.0] {
        let w = Window::at(TUNING, t);
        let x2 = observer(BARRED, t)[1];
        // (58)
        let truth = 2.0 * TUNING.q * w.e * w.h * y(t) + w.h * w.h * velocity(t);
        let equation = |w2: f64, sign: f64| -TUNING.lambda * w.w1 * y(t) - w2 * y(t) + sign * x2;
        assert!((equation(w.w2_bar, 1.0) - truth).abs() < 1e-8, "corrected, t = {t}");
        for (w2, sign) in [(w.w2, -1.0), (w.w2_bar, -1.0), (w.w2, 1.0)] {
            assert!((equation(w2, sign) - truth).abs() > 0.05, "t = {t}, sign {sign}");
        }
    }
}

/// (45) needs w̃3 = w̄3 - k z0, as (46) has it: w1 + G w̄2 + G² w̃3 = 0.
#[test]
fn forty_five_needs_the_input() {
    let lambda = TUNING.lambda;
    let residual = |k: f64, t_end: f64| {
        // G w̄2, then G G (w̄3 - k z0)
        let x = (0..(t_end / DT).round() as usize).fold([0.0; 3], |x, n| {
            let step = Step::new(TUNING, n as f64 * DT, DT);
            rk4(&x, DT, |i, x| {
                let w = &step.window[i];
                let inner = w.w3_bar * y(w.t) - k * w.w1 * force(w.t);
                [-lambda * x[0] + w.w2_bar * y(w.t), -lambda * x[1] + x[2], -lambda * x[2] + inner]
            })
        });
        Window::at(TUNING, t_end).w1 * y(t_end) + x[0] + x[1]
    };
    for t in [1.0, 4.0] {
        assert!(residual(K, t).abs() < 1e-9, "corrected, t = {t}");
        assert!(residual(0.0, t).abs() > 0.02, "printed, t = {t}");
    }
}

/// (15)-(16): the known drift is dropped on the way. With gravity ẑ2 = k ẑ0 fails and ẑ2 - c ẑu = k ẑ0 holds.
#[test]
fn drift_belongs_in_the_identity() {
    let drift = -9.81;
    let mut identifier = Identifier::new(TUNING, drift);
    for n in 0..5000 {
        let step = Step::new(TUNING, f64::from(n) * DT, DT);
        identifier.step(&step, &step.sample(y), &step.sample(|t| force(t) - drift / K));
    }
    assert!((identifier.z2_without_drift() - K * identifier.z0()).abs() < 1e-10);
    assert!((identifier.z2() - K * identifier.z0()).abs() > 1.0);
}

/// (10) lacks a dot. A rigid body by (1), (5) near level under constant torques: I η'' = τ, while I η' = τ holds at no time but t = 1.
#[test]
fn ten_is_of_second_order() {
    let inertia = [0.03, 0.035, 0.055];
    let torque = [3e-4, -2e-4, 4e-4];
    // η and ω
    let derivative = |_: usize, x: &[f64; 6]| {
        let (sf, cf, st, ct) = (x[0].sin(), x[0].cos(), x[1].sin(), x[1].cos());
        let (p, q, r) = (x[3], x[4], x[5]);
        [
            p + (sf * st * q + cf * st * r) / ct,
            cf * q - sf * r,
            (sf * q + cf * r) / ct,
            (torque[0] - (inertia[2] - inertia[1]) * q * r) / inertia[0],
            (torque[1] - (inertia[0] - inertia[2]) * r * p) / inertia[1],
            (torque[2] - (inertia[1] - inertia[0]) * p * q) / inertia[2],
        ]
    };
    let mut states = vec![[0.0; 6]];
    for n in 0..3000 {
        let next = rk4(&states[n], DT, derivative);
        states.push(next);
    }
    for n in [200, 500, 2000] {
        for i in 0..3 {
            let (before, here, after) = (states[n - 1][i], states[n][i], states[n + 1][i]);
            let right = torque[i] / inertia[i];
            let second = (after - 2.0 * here + before) / (DT * DT);
            let first = (after - before) / (2.0 * DT);
            assert!((second / right - 1.0).abs() < 0.05, "corrected, sample {n}, angle {i}: {second} against {right}");
            assert!((first / right - 1.0).abs() > 0.4, "printed, sample {n}, angle {i}: {first} against {right}");
        }
    }
}

/// Largest |b11| and |b21| over a dense grid of u = e^(-qt).
fn largest(tuning: Tuning) -> (f64, f64) {
    (1..=100_000).fold((0.0, 0.0), |(b11, b21): (f64, f64), i| {
        let t = -(f64::from(i) / 1e5).ln() / tuning.q;
        let b = Window::at(tuning, t).input_matrix(K);
        (b11.max(b[0][0].abs()), b21.max(b[1][0].abs()))
    })
}

/// (62): no erratum. For q > 2λ/3 b21 has a maximum between its end values, which (62) does not consider, but it is never the
/// largest in size.
#[test]
fn sixty_two_stands() {
    let lambda = 2.0;
    for ratio in [0.1, 0.5, 0.6, 0.68, 0.8, 1.1, 2.0, 5.0, 20.0] {
        let q = ratio * lambda;
        let tuning = Tuning { lambda, q };
        assert!((largest(tuning).1 / max_b21(lambda, q) - 1.0).abs() < 1e-3, "q = {ratio} λ");
        assert_eq!(max_b21(lambda, q), (lambda * lambda).max(2.0 * q * q));
        if ratio > 2.0 / 3.0 {
            let u = ((lambda - q) / (lambda - 2.0 * q)).powi(2);
            let b21 = |u: f64| Window::at(tuning, -u.ln() / q).input_matrix(K)[1][0];
            assert!(b21(u) > b21(1.0) && b21(u) > -lambda * lambda, "the interior extremum, q = {ratio} λ");
        }
    }
}

/// (64): max|b11| = 2λ holds up to q = λ only; beyond it is 2q²/(2q - λ), 10.5 λ at q = 10 λ.
#[test]
fn sixty_four_uses_a_wrong_maximum() {
    let lambda = 2.0;
    for ratio in [0.1, 0.5, 1.0, 1.5, 3.0, 10.0, 20.0] {
        let q = ratio * lambda;
        let found = largest(Tuning { lambda, q }).0;
        assert!((found / max_b11(lambda, q) - 1.0).abs() < 1e-3, "corrected, q = {ratio} λ: {found}");
        let printed = 2.0 * lambda;
        assert_eq!(found > printed * 1.001, ratio > 1.0, "printed, q = {ratio} λ: {found}");
    }
    assert!((max_b11(lambda, 10.0 * lambda) / lambda - 200.0 / 19.0).abs() < 1e-12);
    assert!(gamma11(lambda, 10.0 * lambda) > (2.0 * lambda + 200.0 * lambda) / lambda);
}

/// (64) again: only the step of the proof fails. The exact worst case sup|x1|/sup|y|, the integral of the kernel's modulus,
/// stays below even the printed gain.
#[test]
fn sixty_four_is_true_as_an_inequality() {
    let lambda = 2.0;
    for ratio in [0.1, 0.5, 1.0, 1.2, 3.0, 10.0, 20.0] {
        let tuning = Tuning { lambda, q: ratio * lambda };
        let dt = 0.005 / (lambda * f64::max(1.0, ratio));
        let b: Vec<_> = (0..(8.0 / lambda / dt) as usize)
            .map(|n| Window::at(tuning, (n as f64 + 0.5) * dt).input_matrix(K))
            .collect();
        let worst = (1..=80).map(|part| b.len() * part / 80).map(|end| {
            let kernel = |(n, b): (usize, &[[f64; 2]; 2])| {
                let s = (end - n) as f64 * dt;
                (-lambda * s).exp() * (b[0][0] + s * b[1][0]).abs() * dt
            };
            b[..end].iter().enumerate().map(kernel).sum::<f64>()
        });
        let (worst, printed) = (worst.fold(0.0, f64::max), 2.0 + f64::max(1.0, 2.0 * ratio * ratio));
        assert!(worst < printed, "q = {ratio} λ: {worst} against {printed}");
        println!("q = {ratio} λ: worst case {worst:.2}, (64) as printed {printed:.2}");
    }
}

/// (44): its integrals grow with time without bound, k is what is left of them, without its sign, and nothing if nothing acts.
#[test]
fn integrals_of_the_read_out_are_unbounded() {
    let run = |k: f64, seconds: f64| {
        let mut identifier = Identifier::new(TUNING, 0.0);
        for n in 0..(seconds / 1e-2_f64).round() as usize {
            let step = Step::new(TUNING, n as f64 * 1e-2, 1e-2);
            identifier.step(&step, &step.sample(y), &step.sample(|t| force(t) * K / k));
        }
        identifier
    };
    let (once, twice, fourfold) = (run(K, 100.0), run(K, 200.0), run(K, 400.0));
    for read in [|i: &Identifier| i.integrals().0, |i: &Identifier| i.integrals().1] {
        let growth = (read(&twice) - read(&once), read(&fourfold) - read(&twice));
        assert!((growth.1 / growth.0 - 2.0).abs() < 0.02, "linear growth: {growth:?}");
    }
    assert!((fourfold.z2() / K - fourfold.z0()).abs() < 1e-6, "the states themselves stay exact");
    assert!((run(-K, 100.0).k().unwrap() - K).abs() < 1e-4, "the sign is lost");
    assert_eq!(Identifier::new(TUNING, 0.0).k(), None);
}

/// (63), (64), (68), (69) print k where |k| is meant: with k < 0 and y = 0 the printed bounds are negative.
#[test]
fn gains_need_the_modulus_of_k() {
    let (k, t_end) = (-3.0_f64, 10.0_f64);
    let (mut fsb, mut adb) = (Observer::new(TUNING, k, 0.0), AdbObserver::new(k, 0.0));
    for n in 0..(t_end / DT).round() as usize {
        let step = Step::new(TUNING, n as f64 * DT, DT);
        fsb.step(&step, &[0.0; 3], &[1.0; 3]);
        adb.step(n as f64 * DT, DT, &[0.0; 3], &[1.0; 3]);
    }
    let lambda = TUNING.lambda;
    // State, bound as printed, bound with the modulus.
    let cases = [
        (fsb.states()[1], k / lambda, gamma22(lambda, k)),
        (fsb.states()[0], k / (lambda * lambda), gamma12(lambda, k)),
        (adb.states()[0], k / 3.0 * t_end.powi(3), k.abs() / 3.0 * t_end.powi(3)),
        (adb.states()[1], k / 12.0 * t_end.powi(4), k.abs() / 12.0 * t_end.powi(4)),
    ];
    for (state, printed, corrected) in cases {
        assert!(state.abs() > printed && state.abs() <= corrected * (1.0 + 1e-9), "{state}, {printed}, {corrected}");
    }
}
