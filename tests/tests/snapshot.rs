//! Snapshots: what is restored goes on to the last bit; what is no snapshot of this estimator is refused.

use fsb_core::guard::{GuardConfig, Guarded};
use fsb_core::readout::Memory;
use fsb_core::snapshot::SnapshotError;
use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::{Motion, Recording, RecordingConfig, record};
use fsb_tests::seal::sealed;
use proptest::prelude::*;

const PERIOD: f64 = 1e-3;

fn flight() -> Recording {
    let motion = Motion { centre: 3.0, amplitude: 1.0, frequency: 1.3 };
    record(&RecordingConfig { period: PERIOD, samples: 6000, drift: 0.0, motion, ..Default::default() })
}

fn config(block: u32) -> EstimatorConfig<2, 2> {
    EstimatorConfig { block, noise_sd: Some(1e-4), nominal: [Some(1.0), None], ..EstimatorConfig::new(PERIOD) }
}

fn tick(estimator: &mut Estimator<2, 2>, flight: &Recording, n: usize) {
    let (y, f) = (flight.positions[n] as f32, flight.forces[n] as f32);
    // Every seventh sample of the second axis is missing.
    estimator.measure(&[Some(y), (n % 7 != 3 || n == 0).then_some(-y)]).unwrap();
    estimator.apply(&[f, -f]);
}

fn taken(estimator: &Estimator<2, 2>) -> Vec<u8> {
    let mut bytes = vec![0; estimator.snapshot_length()];
    assert_eq!(estimator.snapshot(&mut bytes), Ok(bytes.len()));
    bytes
}

/// From the first measurement on, whatever the tuning: rounding in the gains of the first few makes no state that is refused.
#[test]
fn the_first_measurements_of_any_tuning() {
    let flight = flight();
    for step in 1..400_u32 {
        let observer = fsb_core::Tuning { lambda: 0.25 * f64::from(step), q: 0.11 * f64::from(step) };
        let config = EstimatorConfig { observer, nominal: [Some(1.0); 2], ..EstimatorConfig::new(0.01) };
        let (mut original, mut restored) = (Estimator::new(&config).unwrap(), Estimator::new(&config).unwrap());
        for n in 0..8 {
            tick(&mut original, &flight, n);
            assert_eq!(restored.restore(&taken(&original)), Ok(()), "{observer:?}, {n}");
        }
    }
}

/// An input beyond its limit, which is rejected, is not what actuators are taken to have held, and makes no state that is refused.
#[test]
fn a_rejected_input_before_it() {
    let config = EstimatorConfig { input_limit: 10.0, ..config(1) };
    let guard = GuardConfig::default();
    let mut original = Guarded::new(&config, &guard).unwrap();
    for f in [1.0, 2.0, 1e3, -25.0, f32::INFINITY] {
        original.measure(&[Some(1.0), Some(-1.0)]).unwrap();
        original.apply(&[f, -f]);
        let mut bytes = vec![0; original.snapshot_length()];
        original.snapshot(&mut bytes).unwrap();
        let mut restored = Guarded::new(&config, &guard).unwrap();
        assert_eq!(restored.restore(&bytes), Ok(()), "{f}");
    }
    let rejected = original.counters().rejected_inputs;
    assert_eq!(rejected, 6);
    original.missed(5);
    assert_eq!(original.counters().rejected_inputs, rejected, "the last one that was taken is held");
}

/// At any moment, with blocks of any length: the restored estimator and the one it was taken from never part.
#[test]
fn what_is_restored_goes_on_to_the_last_bit() {
    let flight = flight();
    for block in [1, 4, 10, 40] {
        for moment in [0, 1, 2, 3, 17, 400, 1234, 4000] {
            let mut original = Estimator::new(&config(block)).unwrap();
            for n in 0..moment {
                tick(&mut original, &flight, n);
            }
            let mut restored = Estimator::new(&config(block)).unwrap();
            // Whatever it was doing before.
            for n in 0..123 {
                tick(&mut restored, &flight, n);
            }
            restored.restore(&taken(&original)).unwrap();
            for n in moment..moment + 1500 {
                assert_eq!(taken(&original), taken(&restored), "block {block}, {moment}, {n}");
                tick(&mut original, &flight, n);
                tick(&mut restored, &flight, n);
            }
            assert_eq!(original.parameters(), restored.parameters());
            assert_eq!(original.states(), restored.states());
        }
    }
}

/// The gates' memory too: a sensor that was about to be called frozen, or to have jumped, still is.
#[test]
fn what_is_restored_behind_the_gate_goes_on_to_the_last_bit() {
    let flight = flight();
    let guard = GuardConfig { frozen_after: 20, ..GuardConfig::default() };
    let taken = |guarded: &Guarded<2, 2>| {
        let mut bytes = vec![0; guarded.snapshot_length()];
        assert_eq!(guarded.snapshot(&mut bytes), Ok(bytes.len()));
        bytes
    };
    let tick = |guarded: &mut Guarded<2, 2>, n: usize| {
        let (y, f) = (flight.positions[n] as f32, flight.forces[n] as f32);
        let first = match n {
            1000..1030 => flight.positions[1000] as f32,
            2000.. => y + 7.0,
            _ if n % 50 == 49 => y + 3.0,
            _ => y,
        };
        let verdicts = guarded.measure(&[Some(first), (n % 7 != 3 || n == 0).then_some(-y)]).unwrap();
        guarded.apply(&[f, -f]);
        verdicts
    };
    for moment in [0, 1, 500, 1015, 1029, 2003, 2009, 2500] {
        let mut original = Guarded::new(&config(4), &guard).unwrap();
        for n in 0..moment {
            tick(&mut original, n);
        }
        let mut restored = Guarded::new(&config(4), &guard).unwrap();
        for n in 0..777 {
            tick(&mut restored, n);
        }
        restored.restore(&taken(&original)).unwrap();
        for n in moment..moment + 1500 {
            assert_eq!(taken(&original), taken(&restored), "{moment}, {n}");
            assert_eq!(tick(&mut original, n), tick(&mut restored, n), "{moment}, {n}");
        }
        assert_eq!(original.rejections(), restored.rejections());
        assert_eq!(original.parameters(), restored.parameters());
        // The bare estimator's is another kind, and another gate another configuration.
        let mut bare = Estimator::new(&config(4)).unwrap();
        assert_eq!(bare.restore(&taken(&original)), Err(SnapshotError::Shape));
        let other = GuardConfig { jump_after: 11, ..guard };
        let mut other = Guarded::<2, 2>::new(&config(4), &other).unwrap();
        assert_eq!(other.restore(&taken(&original)), Err(SnapshotError::Design));
    }
}

#[test]
fn others_are_refused() {
    let flight = flight();
    let mut estimator = Estimator::new(&config(10)).unwrap();
    for n in 0..2000 {
        tick(&mut estimator, &flight, n);
    }
    let good = taken(&estimator);
    let refused = |bytes: &[u8]| {
        let mut other = estimator;
        let refused = other.restore(bytes).unwrap_err();
        assert_eq!(taken(&other), good, "it must stay as it was");
        refused
    };
    assert_eq!(refused(&[]), SnapshotError::NotASnapshot);
    assert_eq!(refused(&good[..good.len() - 1]), SnapshotError::Shape);
    assert_eq!(refused(&[good.clone(), vec![0]].concat()), SnapshotError::Shape);
    let changed = |at: usize, to: u8| {
        let mut bytes = good.clone();
        bytes[at] = to;
        bytes
    };
    assert_eq!(refused(&changed(0, b'X')), SnapshotError::NotASnapshot);
    assert_eq!(refused(&changed(3, 9)), SnapshotError::Version(9));
    assert_eq!(refused(&changed(4, 3)), SnapshotError::Shape);
    // Of another configuration, in every respect that a state depends on.
    let base = config(10);
    let others = [
        config(11),
        EstimatorConfig { period: 2e-3, ..base },
        EstimatorConfig { observer: fsb_core::Tuning::from_lambda(11.0), ..base },
        EstimatorConfig { identifier: fsb_core::Tuning::from_lambda(2.1), ..base },
        EstimatorConfig { drift: [0.0, -9.81], ..base },
        EstimatorConfig { nominal: [Some(1.1), None], ..base },
        EstimatorConfig { position_limit: 10.0, ..base },
        EstimatorConfig { parameter_settle: 1.0, ..base },
    ];
    for other in others {
        let mut other = Estimator::new(&other).unwrap();
        assert_eq!(other.restore(&good), Err(SnapshotError::Design));
    }
    let mut buffer = vec![0; good.len() - 1];
    assert_eq!(estimator.snapshot(&mut buffer), Err(SnapshotError::BufferTooShort));
}

/// Any one bit: refused.
#[test]
fn a_flipped_bit_is_found() {
    let flight = flight();
    let mut estimator = Estimator::new(&config(10)).unwrap();
    for n in 0..500 {
        tick(&mut estimator, &flight, n);
    }
    let good = taken(&estimator);
    for bit in 0..8 * good.len() {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(estimator.restore(&bytes).is_err(), "bit {bit}");
    }
    assert_eq!(taken(&estimator), good);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, rng_seed: proptest::test_runner::RngSeed::Fixed(6), failure_persistence: None, ..ProptestConfig::default() })]

    /// A state made up, its checksum right: refused, or what follows is numbers and no panic.
    #[test]
    fn a_state_made_up_does_no_harm(words in prop::collection::vec((16_usize..600, any::<u32>()), 1..8), moment in 1_usize..1500) {
        let flight = flight();
        let mut estimator = Estimator::new(&config(4)).unwrap();
        for n in 0..moment {
            tick(&mut estimator, &flight, n);
        }
        let mut bytes = taken(&estimator);
        for (at, word) in words {
            let at = at / 4 * 4;
            if at + 8 <= bytes.len() {
                bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
            }
        }
        if estimator.restore(&sealed(bytes)).is_ok() {
            for n in moment..moment + 400 {
                tick(&mut estimator, &flight, n);
                for parameter in estimator.parameters().into_iter().flatten() {
                    prop_assert!(parameter.value.is_finite() && parameter.variance.is_finite(), "{parameter:?}");
                }
                for state in estimator.states().into_iter().flatten() {
                    prop_assert!(state.position.is_finite() && state.velocity.is_finite(), "{state:?}");
                }
            }
        }
    }
}

/// A sensor that stands still while the input changes: k is as good as zero and its variance next to infinite, and a snapshot is taken back
/// all the same.
#[test]
fn of_a_sensor_that_stands_still() {
    for step in 0..60_i16 {
        let noise = 1e-6 * 10_f64.powf(f64::from(step) / 10.0);
        let config = EstimatorConfig::<1, 1> {
            noise_sd: Some(noise),
            memory: Memory::Fading { tau: 3.0 },
            ..EstimatorConfig::new(0.01)
        };
        let mut estimator = Estimator::new(&config).unwrap();
        let mut restored = estimator;
        for n in 0..300_u16 {
            estimator.measure(&[Some(0.5)]).unwrap();
            let mut bytes = vec![0; estimator.snapshot_length()];
            estimator.snapshot(&mut bytes).unwrap();
            assert_eq!(restored.restore(&bytes), Ok(()), "noise {noise}, {n}");
            estimator.apply(&[(0.03 * f32::from(n)).sin()]);
        }
    }
}

/// Nor does an axis that was lost and is measured again, which takes no part in the identification, make a state that is refused.
#[test]
fn of_an_axis_that_was_lost() {
    for block in [1, 2, 5, 20] {
        let config = EstimatorConfig::<2, 2> {
            block,
            nominal: [Some(1.0); 2],
            position_limit: 100.0,
            ..EstimatorConfig::new(0.01)
        };
        let mut estimator = Estimator::new(&config).unwrap();
        let mut restored = estimator;
        for n in 0..8000_u16 {
            // It leaves at 10 m/s, is not seen for 25 s, and is back.
            let away = (500..3000).contains(&n);
            let y = if n < 500 { 0.1 * f32::from(n) } else { 1.0 };
            estimator.measure(&[Some(0.5), (!away).then_some(y)]).unwrap();
            if n % 50 == 0 {
                let mut bytes = vec![0; estimator.snapshot_length()];
                estimator.snapshot(&mut bytes).unwrap();
                assert_eq!(restored.restore(&bytes), Ok(()), "blocks of {block}, {n}");
            }
            estimator.apply(&[(0.03 * f32::from(n)).sin(), 0.1]);
        }
    }
}
