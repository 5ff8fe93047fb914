use super::{PaperConfig, PaperEstimator, ParameterFrom};
use crate::plant::{Motion, Recording, RecordingConfig, record};

fn flight(period: f64, samples: usize, drift: f64, centre: f64) -> Recording {
    record(&RecordingConfig {
        period,
        samples,
        k: 2.0,
        drift,
        motion: Motion { centre, amplitude: 1.0, frequency: 1.5 },
        ..Default::default()
    })
}

/// Worst errors of k, ŷ, ŷ' from ε on, two axes (one with gravity).
fn worst(config: PaperConfig, seconds: f64) -> [f64; 3] {
    let samples = (seconds / config.period).round() as usize + 1;
    let drifts = [0.0, -9.81];
    let axes = [flight(config.period, samples, drifts[0], -2.0), flight(config.period, samples, drifts[1], 3.0)];
    let mut estimator = PaperEstimator::new(config, &drifts).unwrap();
    let mut worst = [0.0_f64; 3];
    for n in 0..samples {
        let y = axes.each_ref().map(|axis| axis.positions[n]);
        let f = axes.each_ref().map(|axis| if n > 0 { axis.forces[n - 1] } else { 0.0 });
        estimator.update(&y, &f);
        assert_eq!(estimator.k().is_some(), n as f64 * config.period >= config.epsilon_parameter - 1e-9);
        if let Some(k) = estimator.k() {
            worst[0] = worst[0].max((k / 2.0 - 1.0).abs());
        }
        for (i, axis) in axes.iter().enumerate() {
            let t = n as f64 * config.period;
            assert_eq!(estimator.position(i).is_some(), t >= config.epsilon_observer - 1e-9, "t = {t}");
            if let (Some(position), Some(velocity)) = (estimator.position(i), estimator.velocity(i)) {
                worst[1] = worst[1].max((position - axis.positions[n]).abs());
                worst[2] = worst[2].max((velocity - axis.velocities[n]).abs());
            }
        }
    }
    worst
}

/// With the right k0 what is left is the chord's error, of second order in the period.
#[test]
fn error_is_of_second_order_in_the_period() {
    for parameter_from in [ParameterFrom::FirstAxis, ParameterFrom::AllAxes] {
        let config = PaperConfig { k0: 2.0, period: 1e-2, parameter_from, ..Default::default() };
        let coarse = worst(config, 4.0);
        let fine = worst(PaperConfig { period: 1e-3, ..config }, 4.0);
        for (name, (coarse, fine)) in ["k", "ŷ", "ŷ'"].iter().zip(coarse.iter().zip(fine)) {
            let ratio = coarse / fine;
            assert!((50.0..200.0).contains(&ratio), "{parameter_from:?}, {name}: {coarse:e} / {fine:e}");
        }
        assert!(fine[0] < 6e-6 && fine[1] < 4e-6 && fine[2] < 2e-5, "{fine:?}");
    }
}

/// Splitting a period into sub-steps changes nothing that matters: the chord, not the integrator, is the error.
#[test]
fn substeps_agree() {
    let config = PaperConfig { k0: 2.0, period: 1e-3, ..Default::default() };
    let (one, four) = (worst(config, 2.0), worst(PaperConfig { substeps: 4, ..config }, 2.0));
    for (one, four) in one.iter().zip(four) {
        assert!((one / four - 1.0).abs() < 1e-2, "{one:e} against {four:e}");
    }
}

/// Each field out of range is refused by name.
#[test]
fn refuses_what_makes_no_sense() {
    let good = PaperConfig::default();
    let cases = [
        (PaperConfig { lambda: 0.0, ..good }, "lambda"),
        (PaperConfig { q: -1.0, ..good }, "q"),
        (PaperConfig { period: f64::NAN, ..good }, "period"),
        (PaperConfig { substeps: 0, ..good }, "substeps"),
        (PaperConfig { epsilon_observer: 0.0, ..good }, "epsilon_observer"),
        (PaperConfig { epsilon_parameter: f64::INFINITY, ..good }, "epsilon_parameter"),
    ];
    for (config, name) in cases {
        assert_eq!(PaperEstimator::new(config, &[0.0]).unwrap_err().name, name);
    }
    assert_eq!(PaperEstimator::new(good, &[]).unwrap_err().name, "axes");
}
