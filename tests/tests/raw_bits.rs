//! Raw bit patterns, more than a million measurement instants a run: no panic, and whatever is handed out is a number within
//! bounds. Each call is decoded from words that proptest draws and shrinks.

use std::cell::Cell;

use fsb_core::estimator::Learning;
use fsb_core::guard::{GuardConfig, Guarded};
use fsb_core::moments::InputMoments;
use fsb_core::readout::{Memory, ParameterRule, Readout};
use fsb_core::regression::{DragConfig, DragEstimator, Identify, Term};
use fsb_core::vehicle::{Attitude, ChangeRule, Expected, Group, Measured, VehicleConfig, VehicleEstimator, Wrench};
use fsb_core::{Estimator, EstimatorConfig};
use fsb_tests::words::Words;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};

/// `cases` cases of 2000 words in the mean; `one` takes them all and counts measurement instants, of which there must be
/// `least` in the end.
fn endure(seed: u64, cases: u32, least: u64, one: impl Fn(&mut Words<'_>, &Cell<u64>) -> Option<()>) {
    println!("seed {seed}");
    let seen = Cell::new(0);
    let config = Config { cases, rng_seed: RngSeed::Fixed(seed), failure_persistence: None, ..Config::default() };
    let words = prop::collection::vec(any::<u32>(), 1..4000);
    let outcome = TestRunner::new(config).run(&words, |words| {
        one(&mut Words(&words), &seen);
        Ok(())
    });
    outcome.unwrap();
    println!("{} measurement instants", seen.get());
    assert!(seen.get() >= least, "only {} measurement instants", seen.get());
}

/// A state, or its way in a measurement period, lies within so many times the limit of positions and what the strongest input
/// moves in a period.
const REACH: f64 = 8.0;

/// What is handed out is a number, k positive and in its range, and a state no farther away than measurements and inputs within
/// their limits can take it.
fn judge<const N: usize, const P: usize>(estimator: &Estimator<N, P>, config: &EstimatorConfig<N, P>) {
    for (parameter, rule) in estimator.parameters().iter().zip(&config.rule) {
        let Some(k) = parameter else { continue };
        let range = rule.min as f32..=rule.max as f32;
        assert!(range.contains(&k.value) && k.variance.is_finite() && k.variance >= 0.0, "{k:?}");
    }
    let period = config.period * f64::from(config.substeps);
    let strongest = config.rule.iter().map(|rule| rule.max).fold(0.0, f64::max) * config.input_limit + 9.81;
    let most = REACH * (config.position_limit + strongest * period * period);
    for state in estimator.states().into_iter().flatten() {
        let (position, travelled) = (f64::from(state.position), f64::from(state.velocity) * period);
        assert!(position.abs() <= most && travelled.abs() <= most, "{state:?}, {most:e}, {config:?}");
    }
    for d in estimator.diagnostics() {
        assert!([d.z2, d.z0, d.zu, d.innovation].iter().all(|x| x.is_finite()), "{d:?}");
    }
}

fn configuration<const N: usize, const P: usize>(words: &mut Words<'_>) -> Option<EstimatorConfig<N, P>> {
    let bits = words.word()?;
    let choose = |from: u32, of: u32| bits >> from & (of - 1);
    let mut config = EstimatorConfig::new([1e-4, 1e-3, 4e-3, 0.005][choose(0, 4) as usize]);
    config.substeps = 1 + choose(2, 4);
    config.block = [1, 2, 5, 10][choose(4, 4) as usize];
    config.readout = [Readout::LeastSquares, Readout::AbsoluteRatio][choose(6, 2) as usize];
    config.memory = [Memory::Infinite, Memory::Fading { tau: 0.5 }][choose(7, 2) as usize];
    config.nominal = [(choose(8, 2) == 0).then_some(0.7); P];
    config.noise_sd = (choose(9, 2) == 0).then_some(1e-3);
    config.drift = [if choose(10, 2) == 0 { 0.0 } else { -9.81 }; N];
    if choose(11, 2) == 1 {
        (config.position_limit, config.input_limit) = (1e6, 1e6);
        config.rule = [ParameterRule { min: 1e-15, max: 1e15, max_relative_sd: 1e3 }; P];
    } else {
        (config.position_limit, config.input_limit) = (100.0, 30.0);
        config.rule = [ParameterRule { min: 0.05, max: 20.0, max_relative_sd: 1e3 }; P];
    }
    config.disturbance_sd = (choose(13, 2) == 0).then_some(0.1);
    config.max_misfit = (choose(12, 2) == 0).then_some(0.02);
    Some(config)
}

/// Any calls, on an estimator bare and on one behind the gate.
fn calls<const N: usize, const P: usize>(words: &mut Words<'_>, seen: &Cell<u64>) -> Option<()> {
    let config = configuration::<N, P>(words)?;
    let frozen_after = words.word()? & 7;
    let guard = GuardConfig { frozen_after, bridge: 0.5, ..GuardConfig::default() };
    let (mut bare, mut guarded) = (Estimator::new(&config).unwrap(), Guarded::new(&config, &guard).unwrap());
    loop {
        let call = words.word()?;
        match call & 127 {
            0..64 => {
                let given = words.numbers::<N>()?;
                // As a loop would: inputs up to the next measurement.
                while !bare.is_due() {
                    bare.apply(&given);
                    guarded.apply(&given);
                }
                let shown = given.map(|y| (call >> 8 & 15 != 0).then_some(y));
                bare.measure(&shown).unwrap();
                let _ = guarded.measure(&shown);
                seen.set(seen.get() + 1);
            }
            64..100 => {
                let input = words.numbers::<N>()?;
                bare.apply(&input);
                guarded.apply(&input);
            }
            100..108 => {
                let (from, to) = (words.numbers::<N>()?, words.numbers::<N>()?);
                bare.apply_ramp(&from, &to);
                guarded.apply_ramp(&from, &to);
            }
            108..116 => {
                let (j1, j2) = (words.numbers::<N>()?, words.numbers::<N>()?);
                let moments = std::array::from_fn(|i| InputMoments { j1: j1[i], j2: j2[i] });
                bare.apply_moments(&moments);
                guarded.apply_moments(&moments);
            }
            116..120 => guarded.missed(call >> 8 & 63),
            120..123 => {
                let learning = [Learning::On, Learning::Off, Learning::Contact][(call >> 8) as usize % 3];
                bare.set_learning(learning);
                guarded.set_learning(learning);
            }
            123 => {
                bare.reinitialise_identifier();
                guarded.reinitialise_identifier();
            }
            124 => {
                bare.reset_identifier();
                guarded.reset_identifier();
            }
            125 => {
                bare.restart();
                guarded.restart();
            }
            126 => bare.translate(&words.numbers()?),
            _ => {
                bare.reset();
                guarded.reset();
            }
        }
        judge(&bare, &config);
        judge(&guarded, &config);
        for state in guarded.states().into_iter().flatten() {
            assert!(state.position.is_finite() && state.velocity.is_finite(), "{state:?}");
        }
    }
}

/// Two estimators each see half a million instants, in each of two shapes.
#[test]
fn estimators_bare_and_behind_the_gate() {
    endure(61, 1500, 250_000, calls::<2, 1>);
    endure(62, 1500, 250_000, calls::<2, 2>);
}

#[test]
fn one_axis() {
    endure(63, 1500, 400_000, calls::<1, 1>);
}

#[test]
fn drag() {
    endure(64, 2400, 250_000, |words, seen| {
        let bits = words.word()?;
        let period = [1e-4, 1e-3, 0.02, 1.0][bits as usize & 3];
        let memory = if bits & 4 == 0 { Memory::Infinite } else { Memory::Fading { tau: 500.0 * period } };
        let config = DragConfig {
            memory,
            identifier: fsb_core::Tuning::from_lambda(0.05 / period),
            observer: fsb_core::Tuning::from_lambda(0.1 / period),
            identify: [Identify::BOTH, Identify { drag: true, disturbance: false }],
            nominal: (bits & 8 == 0).then_some(1.0),
            ..DragConfig::<2>::new(period)
        };
        let mut estimator = DragEstimator::new(&config).unwrap();
        loop {
            let call = words.word()?;
            match call & 127 {
                0..64 => {
                    let given = words.numbers::<2>()?.map(|y| (call >> 8 & 15 != 0).then_some(y));
                    seen.set(seen.get() + u64::from(estimator.measure(&given).is_ok()));
                }
                64..120 => estimator.apply(&words.numbers()?),
                120..127 => estimator.apply_ramp(&words.numbers()?, &words.numbers()?),
                _ => estimator.reset(),
            }
            let parameter = estimator.parameter();
            assert!(
                parameter.is_none_or(|k| k.value.is_finite() && k.value > 0.0 && k.variance >= 0.0),
                "{parameter:?}"
            );
            for terms in estimator.terms() {
                for term in [terms.drag, terms.disturbance] {
                    let Term::Known { value, sd } = term else { continue };
                    assert!(value.is_finite() && sd.is_finite() && sd >= 0.0, "{terms:?}");
                }
            }
            for state in estimator.states().into_iter().flatten() {
                assert!(state.position.is_finite() && state.velocity.is_finite(), "{state:?}");
            }
        }
    });
}

#[test]
fn vehicle() {
    endure(65, 1200, 100_000, |words, seen| {
        let bits = words.word()?;
        let mut config = VehicleConfig::new([1e-3, 4e-3, 0.01, 0.02][bits as usize & 3]);
        if bits & 4 == 0 {
            config.mass = Expected::about(1.5);
            config.inertia = [0.01, 0.01, 0.02].map(Expected::about);
        }
        config.translation.latency = bits >> 3 & 3;
        config.translation.substeps = 1 + (bits >> 5 & 3);
        config.actuator_lag = (bits >> 7 & 1 == 0).then_some(0.05);
        config.change = (bits >> 8 & 1 == 0).then(ChangeRule::default);
        let mut vehicle = VehicleEstimator::<4>::new(&config).unwrap();
        loop {
            let call = words.word()?;
            match call & 255 {
                0..2 => vehicle.reset(),
                2..4 => vehicle.reinitialise(Group::Translation),
                4..6 => vehicle.reinitialise(Group::Rotation),
                _ => {
                    let position = if call >> 8 & 3 == 0 { None } else { Some(words.numbers()?) };
                    let attitude = match call >> 10 & 3 {
                        0 => None,
                        1 => Some(Attitude::Matrix([words.numbers()?, words.numbers()?, words.numbers()?])),
                        2 => Some(Attitude::Quaternion(words.numbers()?)),
                        // One that is an attitude.
                        _ => {
                            let half = (call >> 12) as f32 / 1_048_576.0;
                            Some(Attitude::Quaternion([(1.0 - half * half).sqrt(), 0.0, half, 0.0]))
                        }
                    };
                    let wrench = Wrench { force: words.numbers()?, torque: words.numbers()? };
                    vehicle.update(&Measured { position, attitude }, &wrench);
                    seen.set(seen.get() + 1);
                }
            }
            let state = vehicle.state();
            let vectors = [state.position, state.velocity, state.rates];
            assert!(vectors.iter().flatten().flatten().all(|x| x.is_finite()), "{state:?}");
            assert!(state.attitude.iter().flatten().flatten().all(|x| x.is_finite()), "{state:?}");
            let (mass, inertia) = (vehicle.mass(), vehicle.inertia());
            for of in inertia.iter().chain([&mass]).flatten() {
                assert!(of.value.is_finite() && of.value > 0.0 && of.variance >= 0.0, "{of:?}");
            }
        }
    });
}
