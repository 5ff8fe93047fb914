//! When a parameter may be used.

use super::super::{CoarseStep, ParameterRule, ParameterState, ParameterStatus, Readout};
use crate::checks::Checks;
use crate::snapshot::{Archive, Stored};

/// k from 0.5 to 2, valid from 5 % on.
fn rule(max_relative_sd: f64) -> ParameterState {
    let rule = ParameterRule { min: 0.5, max: 2.0, max_relative_sd };
    ParameterState::start(1, None, rule.checked(&mut Checks::new()))
}

/// Valid whatever it is.
fn open() -> ParameterState {
    let rule = ParameterRule { max_relative_sd: 1e6, ..ParameterRule::default() };
    ParameterState::start(1, None, rule.checked(&mut Checks::new()))
}

fn variance_of(state: &mut ParameterState) -> f32 {
    state.read(true);
    state.valid().expect("whatever it is").variance
}

/// Moves k to `k`, its variance to that of the standard deviation `relative_sd` k.
fn tell(state: &mut ParameterState, k: f32, relative_sd: f32) {
    // So much information that what was there before counts for nothing.
    let z0 = libm::sqrtf(1e4 * state.ratio.denominator().max(1e-4));
    state.ratio.add(Readout::LeastSquares, z0 * k, z0, 0.0);
    state.ratio.fold();
    state.step_coarsely(&CoarseStep { added: 1e4, ..CoarseStep::default() }, 1.0);
    let sd = relative_sd * k * 1e4;
    state.read_variance(Some([sd * sd; 2]), 1.0);
    state.read(true);
}

fn told(k: f32, relative_sd: f32) -> ParameterState {
    let mut state = rule(0.05);
    tell(&mut state, k, relative_sd);
    state
}

#[test]
fn each_status_has_its_reason() {
    for (k, relative_sd, status) in [
        (1.0, 0.045, ParameterStatus::Valid),
        (1.0, 0.055, ParameterStatus::Uncertain),
        (1.8, 0.045, ParameterStatus::Valid),
        (1.8, 0.055, ParameterStatus::Uncertain),
        (0.6, 0.055, ParameterStatus::Uncertain),
        (0.4, 0.01, ParameterStatus::BelowRange),
        (-1.0, 0.01, ParameterStatus::BelowRange),
        (2.1, 0.01, ParameterStatus::AboveRange),
        // The ends belong to the range.
        (0.5, 0.01, ParameterStatus::Valid),
        (2.0, 0.01, ParameterStatus::Valid),
    ] {
        let state = told(k, relative_sd);
        assert_eq!(state.status, status, "{k} to {relative_sd}");
        assert_eq!(state.valid().is_some(), status == ParameterStatus::Valid, "{k} to {relative_sd}");
        assert_eq!(state.valid_value().is_some(), status == ParameterStatus::Valid, "{k} to {relative_sd}");
    }
    let mut state = told(1.0, 0.01);
    state.read(false);
    assert_eq!(state.status, ParameterStatus::Valid, "a valid one does not settle again");
    let mut early = rule(0.05);
    early.read(false);
    assert_eq!(early.status, ParameterStatus::Settling);
    early.read(true);
    assert_eq!((early.status, early.credible(), early.rough()), (ParameterStatus::Unexcited, None, None));
    // A standard deviation of exactly what is asked for is enough.
    let mut exact = rule(0.5);
    exact.ratio.add(Readout::LeastSquares, 1.0, 1.0, 0.0);
    exact.step_coarsely(&CoarseStep { added: 1.0, ..CoarseStep::default() }, 0.0);
    exact.read_variance(Some([0.25; 2]), 1.0);
    exact.read(true);
    assert_eq!(exact.status, ParameterStatus::Valid);
}

/// Valid up to twice the standard deviation at which it becomes valid, and only within the range.
#[test]
fn a_valid_parameter_stays_so_with_hysteresis() {
    for k in [0.6, 1.0, 1.9] {
        let mut state = told(k, 0.045);
        let mut status = |k: f32, relative_sd: f32| {
            tell(&mut state, k, relative_sd);
            state.status
        };
        assert_eq!(status(k, 0.095), ParameterStatus::Valid, "{k}");
        assert_eq!(status(k, 0.105), ParameterStatus::Uncertain, "{k}");
        assert_eq!(status(k, 0.095), ParameterStatus::Uncertain, "{k}");
        assert_eq!(status(k, 0.045), ParameterStatus::Valid, "{k}");
        assert_eq!(status(2.1, 0.01), ParameterStatus::AboveRange, "{k}");
        assert_eq!(status(k, 0.045), ParameterStatus::Valid, "{k}");
        assert_eq!(status(0.4, 0.01), ParameterStatus::BelowRange, "{k}");
    }
}

/// Credible up to a standard deviation as large as k, rough up to four times what would make it valid; neither out of range.
#[test]
fn credible_and_rough() {
    for k in [0.6_f32, 1.0, 1.9] {
        let known = |relative_sd: f32| {
            let state = told(k, relative_sd);
            let close = |value: f32| assert!((value / k - 1.0).abs() < 1e-3, "{value}");
            state.credible().into_iter().chain(state.rough().map(|k| k.value)).for_each(close);
            (state.credible().is_some(), state.rough().is_some())
        };
        assert_eq!(known(0.19), (true, true), "{k}");
        assert_eq!(known(0.21), (true, false), "{k}");
        assert_eq!(known(0.97), (true, false), "{k}");
        assert_eq!(known(1.03), (false, false), "{k}");
    }
    for k in [0.4, 2.1] {
        let state = told(k, 0.01);
        assert_eq!((state.credible(), state.rough()), (None, None), "{k}");
    }
}

/// A contradiction begins where more than so much is unexplained and ends at half of that.
#[test]
fn a_contradiction_and_its_end() {
    let mut state = told(1.0, 0.01);
    let mut status = |unexplained: f32, most: f32| {
        state.compare(unexplained, most);
        let at_once = state.status;
        tell(&mut state, 1.0, 0.01);
        (at_once, state.status, state.credible().is_some())
    };
    let (valid, contradicted) = (ParameterStatus::Valid, ParameterStatus::Contradicted);
    assert_eq!(status(0.0, 0.0), (valid, valid, true), "nothing moves: nothing is unexplained");
    assert_eq!(status(0.9, 1.0), (valid, valid, true));
    assert_eq!(status(1.1, 1.0), (contradicted, contradicted, false));
    assert_eq!(status(0.6, 1.0), (contradicted, contradicted, false));
    assert_eq!(status(0.4, 1.0), (contradicted, valid, true));
    assert_eq!(status(0.6, 1.0), (valid, valid, true));
    // One that is not valid keeps its own reason until it is read.
    let mut unknown = told(1.0, 0.2);
    unknown.compare(1.1, 1.0);
    assert_eq!(unknown.status, ParameterStatus::Uncertain);
}

/// σ² var a / (Σ ω ẑ0)², what noise pulls the quotient towards zero by, and rounding, 1e-7 of k.
#[test]
fn the_variance_is_the_sum_of_its_causes() {
    for (k, variance, echo) in
        [(2.0_f32, 9.0_f32, 0.0_f32), (2.0, 9.0, 8.0), (2.0, 0.0, 8.0), (0.5, 0.0, 0.0), (100.0, 0.0, 0.0)]
    {
        let (z0, scale2) = (5.0_f32, 3.0);
        let mut state = open();
        state.ratio.add(Readout::LeastSquares, k * z0, z0, 0.0);
        state.step_coarsely(&CoarseStep { added: z0 * z0, noise: echo, ..CoarseStep::default() }, 0.0);
        state.read_variance(Some([variance; 2]), scale2);
        let information = f64::from(z0 * z0);
        let pull = 0.5 * f64::from(echo) / (f64::from(k) * information);
        let rounding = 1e-7 * f64::from(k);
        let expected =
            f64::from(variance) * f64::from(scale2) / (information * information) + pull * pull + rounding * rounding;
        let read = f64::from(variance_of(&mut state));
        assert!((read / expected - 1.0).abs() < 1e-5, "{k}, {variance}, {echo}: {read:e} for {expected:e}");
    }
}

/// Of disturbances Σ (ω r)²/(Σ ω ẑ0)² counts, so many times as one of them lasts, in the proportion of what is remembered: a memory that fades
/// fades in both.
#[test]
fn disturbances_count_as_they_went_in() {
    const CORRELATION: f64 = 7.0;
    for forgetting in [0.0_f32, 0.01] {
        let mut state = open();
        let (mut squares, mut information) = (0.0_f64, 0.0_f64);
        let kept = 1.0 - f64::from(forgetting);
        for n in 0..300_u16 {
            let z0 = 3.0 + libm::sinf(0.1 * f32::from(n));
            let beyond = if n % 50 == 20 { 0.4 } else { 0.0 };
            state.ratio.add(Readout::LeastSquares, 2.0 * z0, z0, forgetting);
            let step = CoarseStep { added: z0 * z0, weight: z0, disturbance: CORRELATION as f32 * beyond, noise: 0.0 };
            state.step_coarsely(&step, forgetting);
            squares = kept * kept * squares + f64::from(z0 * z0 * beyond);
            information = kept * information + f64::from(z0 * z0);
        }
        state.read_variance(Some([0.0; 2]), 1.0);
        let expected = CORRELATION * squares / (information * information);
        let read = f64::from(variance_of(&mut state));
        assert!((read / expected - 1.0).abs() < 1e-4, "{forgetting}: {read:e} for {expected:e}");
    }
}

/// What noise adds fades as the information does: both end at 1/φ of what a step adds.
#[test]
fn the_sums_of_coarse_steps_fade() {
    let (k, forgetting) = (2.0_f32, 0.1_f32);
    let mut state = open();
    state.ratio.add(Readout::LeastSquares, k, 1.0, 0.0);
    for _ in 0..400 {
        state.step_coarsely(&CoarseStep { added: 3.0, noise: 0.5, ..CoarseStep::default() }, forgetting);
    }
    state.read_variance(Some([0.0; 2]), 1.0);
    // Σ ω ẑ0 = 30, Σ var ẑ2 = 5: the pull is ½ 5/(2 · 30).
    let expected = 1.0_f32 / 24.0;
    let variance = variance_of(&mut state);
    assert!((libm::sqrtf(variance) / expected - 1.0).abs() < 1e-4, "{variance}");
}

/// The variance is due when all axes that take part have taken the step.
#[test]
fn every_member_counts() {
    let rule = ParameterRule::default().checked(&mut Checks::new());
    let mut state = ParameterState::start(3, None, rule);
    let due = |state: &mut ParameterState| {
        state.step_coarsely(&CoarseStep { added: 1.0, ..CoarseStep::default() }, 0.0);
        core::mem::replace(&mut state.stale, false)
    };
    assert_eq!([(); 6].map(|()| due(&mut state)), [false, false, true, false, false, true]);
    state.leave();
    assert_eq!([(); 4].map(|()| due(&mut state)), [false, true, false, true]);
}

/// What is held is neither credible nor rough by itself: those are of the new quotient.
#[test]
fn held_beside_the_new_one() {
    let mut state = told(1.0, 0.01);
    state.hold(1);
    assert_eq!((state.status, state.held_value()), (ParameterStatus::Held, state.valid().map(|k| k.value)));
    assert_eq!((state.credible(), state.rough()), (None, None));
    tell(&mut state, 1.5, 0.1);
    assert!(state.held_value().is_some_and(|k| (k - 1.0).abs() < 1e-3));
    assert!(state.credible().is_some_and(|k| (k - 1.5).abs() < 1e-3) && state.rough().is_some());
    tell(&mut state, 1.5, 0.04);
    assert_eq!(state.status, ParameterStatus::Valid);
    assert!(state.valid_value().is_some_and(|k| (k - 1.5).abs() < 1e-3) && state.held_value().is_none());
}

/// Puts one number in the place of another.
struct Replace {
    from: f32,
    to: f32,
    found: u32,
}

impl Archive for Replace {
    fn word(&mut self, bits: &mut u32) {
        if *bits == self.from.to_bits() {
            *bits = self.to.to_bits();
            self.found += 1;
        }
    }

    fn refuse(&mut self) {}
}

/// A state that would hand out a k out of its range, or a variance below zero, is none.
#[test]
fn what_cannot_be_restored() {
    let sound = |state: &ParameterState, from: f32, to: f32| {
        let (mut state, mut replace) = (*state, Replace { from, to, found: 0 });
        state.pass(&mut replace);
        assert!(replace.found > 0, "{from} is not there");
        state.is_sound()
    };
    let mut state = told(1.3, 0.01);
    let known = state.valid().expect("known");
    assert!(state.is_sound());
    for held in [false, true] {
        if held {
            state.hold(1);
        }
        assert!(sound(&state, known.value, 1.9) && sound(&state, known.value, 0.5) && sound(&state, known.value, 2.0));
        assert!(
            !sound(&state, known.value, 2.1) && !sound(&state, known.value, 0.4) && !sound(&state, known.value, -1.3)
        );
        assert!(sound(&state, known.variance, 0.0) && !sound(&state, known.variance, -1e-9));
        // The newest one's, while there is none.
        assert!(sound(&state, f32::MAX, 1.0) && !sound(&state, f32::MAX, -1.0));
    }
    // Out of range, and said to be so: that is sound.
    assert!(told(2.1, 0.01).is_sound() && told(0.4, 0.01).is_sound());
}
