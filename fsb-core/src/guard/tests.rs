//! The gate of one axis by itself: each bound from both sides.

use super::config::{GuardConfig, GuardDesign};
use super::gate::Gate;
use super::verdict::Verdict;
use crate::tuning::Tuning;

const LIMIT: f32 = 100.0;

/// λ T = 0.1, T = 0.01 s: a T/(eλ) is a/2718 s², 2a T/λ is a/500 s², a T²/2 is a/20000 s².
fn design(sigmas: f64, acceleration: f64, floor: f64) -> GuardDesign {
    let config = GuardConfig { sigmas, acceleration, floor, jump_after: 3, ..GuardConfig::default() };
    GuardDesign::new(&config, Tuning::from_lambda(10.0), 0.01).expect("valid")
}

/// Whether a measurement `away` from what is expected passes; the gate is left as it was.
fn passes(gate: &Gate, away: f32, design: &GuardDesign) -> bool {
    match { *gate }.judge(1.0 + away, Some(1.0), LIMIT, true, design) {
        Verdict::Taken => true,
        Verdict::Improbable => false,
        other => panic!("{away}: {other}"),
    }
}

/// It passes up to `bound` to either side.
fn bounded(gate: &Gate, bound: f32, design: &GuardDesign) {
    for side in [-1.0, 1.0] {
        assert!(passes(gate, 0.98 * side * bound, design), "{gate:?}: within {bound}");
        assert!(!passes(gate, 1.02 * side * bound, design), "{gate:?}: beyond {bound}");
    }
}

#[test]
fn the_limit_itself_is_possible() {
    let (mut gate, design) = (Gate::default(), design(8.0, 0.0, 0.0));
    for (y, verdict) in [
        (LIMIT, Verdict::Taken),
        (-LIMIT, Verdict::Taken),
        (101.0, Verdict::BeyondLimit),
        (-1e30, Verdict::BeyondLimit),
    ] {
        assert_eq!(gate.judge(y, None, LIMIT, true, &design), verdict, "{y}");
    }
}

/// s standard deviations of the innovation's steps; a gap widens them by 1 + λT for each sample.
#[test]
fn noise_is_let_pass() {
    let sd = 0.02_f32;
    for sigmas in [4.0_f32, 8.0] {
        let design = design(f64::from(sigmas), 0.0, 0.0);
        let mut gate = Gate::expecting(Some(sd * sd));
        for gap in 0..20_u8 {
            bounded(&gate, sigmas * sd * (1.0 + 0.1 * f32::from(gap)), &design);
            gate.miss();
        }
    }
}

/// floor + a T/(eλ), 2a T/λ for a gap's samples and a T²/2 for the square of them.
#[test]
fn unknown_accelerations_are_let_pass() {
    for (acceleration, floor) in [(0.0, 0.05), (30.0, 0.0), (30.0, 0.01)] {
        let design = design(8.0, acceleration, floor);
        let mut gate = Gate::expecting(Some(1e-16));
        for missed in 0..20_u8 {
            let (a, n) = (acceleration as f32, f32::from(missed));
            let gap = 2.0 * a * 1e-3 * n + 0.5 * a * 1e-4 * n * n;
            bounded(&gate, floor as f32 + a * (0.001 / core::f32::consts::E) + gap, &design);
            gate.miss();
        }
    }
}

/// An innovation on its way back may have changed by 3λT of itself, or be back where it is expected.
#[test]
fn a_large_innovation_decays() {
    let design = design(8.0, 0.0, 0.01);
    let mut gate = Gate::expecting(Some(1e-16));
    gate.follow(1.0, &design);
    let bound = 0.01 + 0.3;
    assert!(passes(&gate, 1.0 - 0.98 * bound, &design) && passes(&gate, 1.0 + 0.98 * bound, &design));
    assert!(!passes(&gate, 1.0 - 1.02 * bound, &design) && !passes(&gate, 1.0 + 1.02 * bound, &design));
    // Around zero it is the distance to the expected that counts.
    assert!(passes(&gate, 0.98 * bound, &design) && passes(&gate, -0.98 * bound, &design));
    assert!(!passes(&gate, 1.02 * bound, &design) && !passes(&gate, -1.02 * bound, &design));
}

/// Three that agree within the floor are a jump; one that does not begins the count anew.
#[test]
fn only_what_agrees_is_a_jump() {
    let design = design(8.0, 0.0, 0.1);
    let verdicts = |aways: [f32; 4]| {
        let mut gate = Gate::expecting(Some(1e-16));
        aways.map(|away| gate.judge(1.0 + away, Some(1.0), LIMIT, true, &design))
    };
    let no = Verdict::Improbable;
    let [first, second, third, _] = verdicts([5.0, 5.09, 5.0, 5.0]);
    assert_eq!((first, second), (no, no));
    assert!(matches!(third, Verdict::Jumped(by) if (by - 5.0).abs() < 1e-5), "{third}");
    let [_, second, third, fourth] = verdicts([3.0, 5.0, 5.05, 5.0]);
    assert_eq!((second, third), (no, no));
    assert!(matches!(fourth, Verdict::Jumped(_)), "{fourth}");
    assert_eq!(verdicts([5.0, 5.12, 5.0, 5.12]), [no; 4], "steps above the floor");
}

/// What the gate says to measurements so far from what is expected, T apart; there is none where that is NaN.
fn verdicts<const M: usize>(gate: &mut Gate, aways: [f32; M], design: &GuardDesign) -> [Verdict; M] {
    aways.map(|away| {
        if away.is_nan() {
            gate.miss();
            return Verdict::Missing;
        }
        gate.judge(1.0 + away, Some(1.0), LIMIT, true, design)
    })
}

/// Four on a straight line are a push, its rate over T the change of the velocity, also where one in between is missing; one that
/// is off the line begins another with the one before.
#[test]
fn what_goes_straight_is_a_push() {
    let design = design(8.0, 0.0, 0.1);
    let pushed = |verdict: Verdict, by: f32| matches!(verdict, Verdict::Pushed(found) if (found - by).abs() < 1e-3);
    let no = Verdict::Improbable;
    let fresh = || Gate::expecting(Some(1e-16));
    let [first, second, third, fourth] = verdicts(&mut fresh(), [1.0, 1.2, 1.4, 1.6], &design);
    assert!([first, second, third] == [no; 3] && pushed(fourth, 20.0), "{fourth}");
    let [.., last] = verdicts(&mut fresh(), [-1.0, f32::NAN, -1.4, -1.6, f32::NAN, f32::NAN, -2.2], &design);
    assert!(pushed(last, -20.0), "{last}");
    let [first @ .., last] = verdicts(&mut fresh(), [1.0, 1.2, 1.4, 6.0, 5.8, 5.6, 5.4], &design);
    assert!(first == [no; 6] && pushed(last, -20.0), "{first:?} {last}");
    // A measurement that is used ends it.
    let [.., last] = verdicts(&mut fresh(), [1.0, 1.2, 1.4, 0.0, 1.6, 1.8, 2.0], &design);
    assert_eq!(last, no);
}

/// Off the line by no more than noise and the floor, and what an unknown acceleration bends it by; led away by more than these.
#[test]
fn how_straight_a_push_is() {
    let no = Verdict::Improbable;
    for (acceleration, floor, sd) in [(0.0, 0.1, 0.0), (30.0, 0.1, 0.0), (0.0, 0.05, 0.02_f32)] {
        let design = GuardDesign { jump_after: 4, ..design(8.0, acceleration, floor) };
        let (a, noise) = (acceleration as f32, 8.0 * sd);
        let known = floor as f32 + a * (0.001 / core::f32::consts::E);
        // One ahead of a line over two; over all three intervals.
        let bend = libm::sqrtf(noise * noise + (known + 0.5 * a * 1e-4 * 3.0) * (known + 0.5 * a * 1e-4 * 3.0));
        let far = libm::sqrtf(noise * noise + (known + 0.5 * a * 1e-4 * 9.0) * (known + 0.5 * a * 1e-4 * 9.0));
        for side in [-1.0, 1.0] {
            for (share, is_push) in [(0.98, true), (1.02, false)] {
                let mut gate = Gate::expecting(Some(sd * sd + 1e-16));
                let [.., last] = verdicts(&mut gate, [5.0, 6.0, 7.0, 8.0 + side * share * bend], &design);
                assert_eq!(matches!(last, Verdict::Pushed(_)), is_push, "{side} {share}: {last}");
            }
            // A third of the way at each step; where it does not lead away it is a jump.
            for (share, is_push) in [(0.98, false), (1.02, true)] {
                let mut gate = Gate::expecting(Some(sd * sd + 1e-16));
                let step = side * share * far / 3.0;
                let found = verdicts(&mut gate, [5.0, 5.0 + step, 5.0 + 2.0 * step, 5.0 + 3.0 * step], &design);
                assert_eq!(matches!(found[3], Verdict::Pushed(_)), is_push, "{side} {share}: {found:?}");
                assert!(found[..3] == [no; 3] && found[3].is_used(), "{found:?}");
            }
        }
    }
}

/// A gap so long that it is no longer counted: no time passes, and nothing is a push.
#[test]
fn no_push_without_time() {
    let design = design(8.0, 0.0, 0.1);
    for gap in [u16::MAX, u16::MAX - 1, u16::MAX - 2] {
        let mut gate = Gate { gap, ..Gate::expecting(Some(1e-16)) };
        for n in 0..20_u8 {
            // Four within a gap that is counted, at most.
            let verdict = gate.judge(20.0 + f32::from(n), Some(1.0), LIMIT, true, &design);
            assert!(!matches!(verdict, Verdict::Pushed(by) if !by.is_finite()), "{n}: {verdict}");
            assert!(gap == u16::MAX - 2 || verdict == Verdict::Improbable, "{n}: {verdict}");
        }
    }
}

/// In a gap the observer's innovation is taken over only where it is large: the state was put elsewhere.
#[test]
fn the_innovation_of_a_gap() {
    let design = design(8.0, 0.0, 0.1);
    let mut gate = Gate::expecting(Some(1e-16));
    gate.follow(0.05, &design);
    assert_eq!(gate.innovation, 0.05);
    gate.miss();
    gate.follow(0.02, &design);
    assert_eq!(gate.innovation, 0.05, "small: it decays by itself");
    for innovation in [0.2, -0.3] {
        gate.follow(innovation, &design);
        assert_eq!(gate.innovation, innovation);
    }
}

/// What was learned of the noise, the age of the last measurement and what came last outlive a restart, and nothing else does.
#[test]
fn a_restart() {
    let design = design(8.0, 0.0, 0.1);
    let mut gate = Gate::expecting(Some(4e-4));
    gate.follow(0.05, &design);
    gate.judge(7.0, Some(1.0), LIMIT, true, &design);
    gate.miss();
    let before = gate;
    assert!(before.run == 1 && before.gap == 2 && before.course.last == 6.0 && before.last != 0);
    gate.restart();
    assert_eq!((gate.level, gate.values, gate.gap()), (before.level, before.values, 2));
    assert_eq!((gate.last, gate.held.repeated), (before.last, before.held.repeated));
    assert_eq!((gate.run, gate.innovation, gate.course.count), (0, 0.0, 0));
}

/// A sensor that has frozen is not alive because somebody starts anew: it takes two that differ, as ever.
#[test]
fn a_frozen_sensor_outlives_a_restart() {
    let design = GuardDesign { frozen_after: 3, ..design(8.0, 0.0, 0.1) };
    let mut gate = Gate::expecting(Some(4e-4));
    let judge = |gate: &mut Gate, y| gate.judge(y, None, LIMIT, false, &design);
    let first: [_; 6] = core::array::from_fn(|_| judge(&mut gate, 1.0));
    assert_eq!(
        first,
        [Verdict::Taken, Verdict::Taken, Verdict::Taken, Verdict::Taken, Verdict::Frozen, Verdict::Frozen]
    );
    for anew in [false, true] {
        if anew {
            gate = Gate::expecting(None).of_sensor(&gate);
        } else {
            gate.restart();
        }
        assert_eq!([1.0, 1.0].map(|y| judge(&mut gate, y)), [Verdict::Frozen; 2]);
    }
    assert_eq!([2.0, 2.1].map(|y| judge(&mut gate, y)), [Verdict::Frozen, Verdict::Taken]);
}

#[test]
fn a_level_is_no_less_than_zero() {
    let sound = |level: f32| Gate { level, ..Gate::default() }.is_sound();
    assert!(sound(0.0) && sound(1e-24) && sound(1.0));
    assert!(!sound(-1e-24) && !sound(-1.0) && !sound(f32::NAN));
}

/// A gate that lets everything pass, so that it learns from it.
fn learning(level: f32, values: u16, step: f32) -> Gate {
    let design = design(8.0, 0.0, 1e6);
    let mut gate = Gate { level, values, ..Gate::default() };
    assert_eq!(gate.judge(step, Some(0.0), LIMIT, true, &design), Verdict::Taken);
    gate
}

/// A mean of the first values, then of the last 128; one value counts for at most four times the level, one below a 64th of it
/// as one in 32 at least.
#[test]
fn how_the_level_is_learned() {
    let close = |gate: Gate, level: f32| assert!((gate.level / level - 1.0).abs() < 1e-5, "{gate:?}: not {level}");
    // Before there are eight, the mean of all.
    close(learning(0.0, 0, 3.0), 9.0);
    close(learning(9.0, 1, 5.0), 17.0);
    close(learning(1.0, 7, 5.0), 4.0);
    // From then on no more than four times the level.
    close(learning(1.0, 8, 5.0), 1.0 + 3.0 / 9.0);
    close(learning(1.0, 8, 1.5), 1.0 + 1.25 / 9.0);
    close(learning(1.0, 127, 2.0), 1.0 + 3.0 / 128.0);
    close(learning(1.0, 128, 2.0), 1.0 + 3.0 / 128.0);
    // Small ones, just above a 64th of the level and just below.
    for level in [1.0_f32, 0.01] {
        for (share, memory) in [(1.0 / 60.0, 128.0), (1.0 / 68.0, 32.0), (0.0, 32.0)] {
            let gate = learning(level, 128, libm::sqrtf(level * share));
            close(gate, level * (1.0 - (1.0 - share) / memory));
        }
    }
    // There is no haste where there are no more than 32 values.
    close(learning(1.0, 19, 0.0), 0.95);
    assert_eq!(learning(1.0, 128, 0.0).values, 128);
}

/// A sensor without any noise: the level stays a normal number.
#[test]
fn the_level_of_no_noise() {
    let design = design(8.0, 0.0, 1e6);
    let mut gate = Gate::expecting(Some(1.0));
    for _ in 0..5000 {
        gate.judge(1.0, Some(1.0), LIMIT, true, &design);
        assert!(gate.level >= 0.99e-24);
    }
    assert!(gate.level < 1.01e-24);
}

/// Normal noise of variance one, by the rules above, ends at 0.66.
#[test]
fn the_level_of_normal_noise() {
    let design = design(8.0, 0.0, 1e6);
    let (mut gate, mut seed, mut sum) = (Gate::default(), 1_u32, 0.0_f64);
    let mut uniform = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (f64::from(seed >> 8) + 0.5) / f64::from(1_u32 << 24)
    };
    let values = if cfg!(miri) { 5_000 } else { 200_000 };
    for n in 0..values + 1000 {
        let normal = libm::sqrt(-2.0 * libm::log(uniform())) * libm::cos(core::f64::consts::TAU * uniform());
        gate.judge(normal as f32, Some(0.0), LIMIT, true, &design);
        if n >= 1000 {
            sum += f64::from(gate.level);
        }
    }
    let mean = sum / f64::from(values);
    assert!((mean / 0.66 - 1.0).abs() < 0.05, "{mean}");
}
