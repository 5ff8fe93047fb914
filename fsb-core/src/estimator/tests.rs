//! What cannot be reached from outside in a reasonable time.

use super::{Estimator, EstimatorConfig};
use crate::accumulator::Accumulator;
use crate::error::ConfigError;
use crate::guard::{GuardConfig, Guarded};
use crate::observer::Observer;
use crate::readout::{ParameterRule, ParameterStatus};

/// Position and velocity.
type Motion = (f64, f64);
const START: Motion = (0.3, 0.0);

/// A swing under a known force, k = 2, going on from where it is; returns the number of ticks with a valid state.
fn swing(estimator: &mut Estimator<1, 1>, (y, v): &mut Motion, from: u32, ticks: u32) -> u32 {
    let mut valid = 0;
    for tick in from..from + ticks {
        estimator.measure(&[Some(*y as f32)]).expect("in step");
        valid += u32::from(estimator.states()[0].is_some());
        let kick = if tick / 250 % 2 == 0 { 1.0 } else { -1.0 };
        let force = (kick - 2.0 * *y) as f32;
        estimator.apply(&[force]);
        let acceleration = 2.0 * f64::from(force);
        *y += *v * 1e-3 + acceleration * 5e-7;
        *v += acceleration * 1e-3;
    }
    valid
}

/// Counts do not run out: after 2^31 measurements everything goes on, and the identification can still begin anew.
#[test]
#[cfg_attr(miri, ignore = "minutes, and nothing that Miri does not see in the C interface's tests")]
fn counts_go_on() {
    for block in [1, 10, 40] {
        let config = EstimatorConfig { block, parameter_settle: 0.5, ..EstimatorConfig::new(1e-3) };
        let mut motion = START;
        let mut estimator = Estimator::<1, 1>::new(&config).expect("valid");
        swing(&mut estimator, &mut motion, 0, 3000);
        assert!(estimator.parameters()[0].is_some(), "block {block}");
        estimator.frame.progress.observer.count = super::advance::LONG_AGO - 500;
        assert_eq!(swing(&mut estimator, &mut motion, 3000, 2000), 2000, "block {block}: states all the way");
        assert!(estimator.frame.progress.observer.count < super::advance::LONG_AGO);
        estimator.reset_identifier();
        assert!(estimator.parameters()[0].is_none());
        swing(&mut estimator, &mut motion, 5000, 3000);
        let k = estimator.parameters()[0].expect("identified anew").value;
        assert!((k - 2.0).abs() < 1e-4, "block {block}: {k}");
    }
}

/// A memory changed from outside: told by the bare estimator's status, begun anew by the guarded one.
#[test]
#[cfg_attr(miri, ignore = "minutes, and nothing that Miri does not see in the C interface's tests")]
fn what_is_no_number_is_a_fault() {
    let config = EstimatorConfig::new(1e-3);
    let mut bare = Estimator::<1, 1>::new(&config).expect("valid");
    let mut motion = START;
    swing(&mut bare, &mut motion, 0, 3000);
    bare.frame.axes[0].cascade.x1 = Accumulator::new(f32::NAN);
    swing(&mut bare, &mut motion, 3000, 10);
    assert_eq!(bare.parameter_status(), [ParameterStatus::Faulted]);
    assert!(bare.parameters()[0].is_none());

    let mut guarded = Guarded::<1, 1>::new(&config, &GuardConfig::default()).expect("valid");
    let corrupt: [fn(&mut Estimator<1, 1>); 3] = [
        |e| e.frame.axes[0].cascade.x1 = Accumulator::new(f32::NAN),
        |e| e.frame.axes[0].observer = Observer::at(f32::NAN),
        |e| e.frame.axes[0].observer = Observer::at(1e30),
    ];
    let (mut y, mut v) = START;
    for tick in 0..12_000_u32 {
        if tick % 3000 == 2999 && tick < 9000 {
            guarded.corrupt(corrupt[(tick / 3000) as usize]);
        }
        guarded.measure(&[Some(y as f32)]).expect("in step");
        for state in guarded.states().into_iter().flatten() {
            assert!((f64::from(state.velocity) - v).abs() < 1e-2, "{tick}: {state:?} for {v}");
        }
        let force = (if tick / 250 % 2 == 0 { 1.0 } else { -1.0 } - 2.0 * y) as f32;
        guarded.apply(&[force]);
        y += v * 1e-3 + f64::from(force) * 1e-6;
        v += 2.0 * f64::from(force) * 1e-3;
    }
    assert_eq!(guarded.rejections().faults, 3);
    assert!((guarded.parameters()[0].expect("identified anew").value - 2.0).abs() < 1e-3);
}

/// Neither before it is configured nor after a configuration that was refused does an estimator take anything in or hand anything out.
#[test]
fn without_a_configuration_there_is_nothing() {
    let mut refused = Estimator::<1, 1>::new(&EstimatorConfig::new(1e-3)).expect("valid");
    assert_eq!(swing(&mut refused, &mut START.clone(), 0, 100), 0, "no parameter to predict with yet");
    let mut configuring = refused.configuring();
    configuring.shared(&EstimatorConfig::<1, 1> { position_limit: -1.0, ..EstimatorConfig::new(1e-3) }.shared());
    configuring.drift(0, 0.0);
    configuring.parameter(0, 2.0, &ParameterRule::DEFAULT);
    assert_eq!(configuring.finish(), Err(ConfigError::NonPositive("position_limit")));
    for mut estimator in [Estimator::<1, 1>::unconfigured(), refused] {
        for position in [0.0, 0.3, -0.0] {
            estimator.measure(&[Some(position)]).expect("in step");
            estimator.apply(&[1.0]);
            assert_eq!((estimator.states(), estimator.parameters()), ([None], [None]));
            assert!(!estimator.has_started());
        }
    }
}
