//! Long flights through the f32 identifier and observer beside the f64 twin.

use fsb_sim_host::soak::faulty::soak_with_faults;
use fsb_sim_host::soak::{SoakConfig, soak};

fn fly(hours: f64) {
    let config = SoakConfig { hours, rate: 1000.0, seed: 1 };
    let report = soak(&config, || ()).unwrap();
    println!("{config:?}: {report:#?}");
    assert_eq!(report.ticks, config.ticks());
    assert!(report.words > 500 * (hours * 3600.0) as u64, "the state was not looked at");
    assert!((report.k_twin - 0.8).abs() < 1e-4, "the twin itself is off");
    assert_eq!(report.violations(), Vec::<String>::new());
}

/// Half an hour: three rounds of flight, hover and a silent sensor.
#[test]
fn half_an_hour() {
    fly(0.5);
}

/// A day; half a minute in a release build: `cargo test --release -p fsb-tests --test soak -- --ignored`.
#[test]
#[ignore = "a day of flight takes a minute"]
fn a_day() {
    fly(24.0);
}

/// The same through the gate, with faults in every signal.
fn fly_with_faults(hours: f64, seed: u64) {
    let config = SoakConfig { hours, rate: 1000.0, seed };
    let report = soak_with_faults(&config, || ()).unwrap();
    println!("{config:?}: {report:#?}");
    assert_eq!(report.ticks, config.ticks());
    assert!(report.words > 500 * (hours * 3600.0) as u64, "the state was not looked at");
    assert!((report.k_twin - 0.8).abs() < 1e-4, "the twin itself is off");
    let away = report.rejections;
    let kinds =
        [away.missing, away.non_finite, away.beyond_limit, away.improbable, away.frozen, report.rejected_inputs];
    assert!(kinds.iter().all(|&count| count > 10), "faults are missing: {kinds:?}");
    assert_eq!(report.violations(), Vec::<String>::new());
}

#[test]
fn a_quarter_of_an_hour_with_faults() {
    for seed in [1, 2, 3] {
        fly_with_faults(0.25, seed);
    }
}

/// A day: `cargo test --release -p fsb-tests --test soak -- --ignored`.
#[test]
#[ignore = "a day of flight takes minutes"]
fn a_day_with_faults() {
    fly_with_faults(24.0, 1);
}
