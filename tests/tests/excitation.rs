//! Without an input, or with next to none, nothing is said of the parameter, and nothing is spoilt.

use fsb_core::estimator::StateStatus;
use fsb_core::readout::{ParameterStatus, Readout};
use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::{Motion, RecordingConfig, record};
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

const PERIOD: f64 = 1e-3;

/// Zero input: the parameter is unexcited for ever, and without a nominal one no state is handed out.
#[test]
fn without_input_nothing_is_said() {
    let mut estimator =
        Estimator::<1, 1>::new(&EstimatorConfig { noise_sd: Some(1e-7), ..EstimatorConfig::new(PERIOD) }).unwrap();
    for n in 0..20_000 {
        // Drifts at 0.1 m/s.
        estimator.measure(&[Some((3.0 + 1e-4 * f64::from(n)) as f32)]).unwrap();
        assert_eq!(estimator.parameters(), [None]);
        assert_eq!(estimator.parameter_status(), [ParameterStatus::Unexcited]);
        assert_eq!(estimator.states(), [None], "at {n}");
        estimator.apply(&[0.0]);
    }
    assert_eq!(estimator.state_status(), [StateStatus::NoParameter]);
}

/// The paper's read-out on an axis that rests and is not pushed.
#[test]
fn without_input_the_absolute_ratio_says_nothing() {
    for moving in [0.0, 1e-4] {
        let mut estimator = Estimator::<1, 1>::new(&EstimatorConfig {
            readout: Readout::AbsoluteRatio,
            ..EstimatorConfig::new(PERIOD)
        })
        .unwrap();
        for n in 0..5000 {
            estimator.measure(&[Some((3.0 + moving * f64::from(n)) as f32)]).unwrap();
            assert_eq!(estimator.parameters(), [None], "moving {moving}, measurement {n}");
            estimator.apply(&[0.0]);
        }
        assert_eq!(estimator.parameter_status(), [ParameterStatus::Unexcited], "moving {moving}");
    }
}

/// When k̂ is valid [ms after take-off]: a vehicle that rests under the last digits of a controller that is switched off,
/// then flies from rest. Noise of 1 mm.
fn valid_after_dust(dust: f32) -> Option<usize> {
    let motion = Motion { centre: 3.0, amplitude: 1.0, frequency: 1.3 };
    let flight = record(&RecordingConfig { drift: 0.0, velocity: 0.0, motion, ..Default::default() });
    let mut estimator = Estimator::<1, 1>::new(&EstimatorConfig::new(PERIOD)).unwrap();
    let mut rng = Pcg64::seed_from_u64(1);
    let mut noisy = |y: f64| {
        let noise: f64 = rng.sample(StandardNormal);
        Some((y + 1e-3 * noise) as f32)
    };
    for n in 0..3000 {
        estimator.measure(&[noisy(flight.positions[0])]).unwrap();
        estimator.apply(&[if n % 2 == 0 { dust } else { dust / 2.0 }]);
    }
    for n in 0..20_000 {
        estimator.measure(&[noisy(flight.positions[n])]).unwrap();
        if estimator.parameters()[0].is_some() {
            return Some(n);
        }
        estimator.apply(&[flight.forces[n] as f32]);
    }
    None
}

/// What a weak input says of k is worth little, and is outweighed by what comes.
#[test]
fn dust_before_the_flight() {
    for dust in [0.0, 1e-3, 1e-6, 1e-8] {
        let valid = valid_after_dust(dust).expect("valid in 20 s");
        println!("{dust} N before the flight: valid {valid} ms after take-off");
        assert!(valid < 1000);
    }
}

#[test]
fn finest_dust_before_the_flight() {
    assert!(valid_after_dust(1e-13).is_some());
}
