//! Which times are uniform, and the period read from them.

use super::*;
use proptest::prelude::*;

fn refused(times: &[&str]) -> String {
    read(&with_times(times)).expect_err("these times must be refused").to_string()
}

#[test]
fn time_must_increase() {
    let message = refused(&["0", "0.1", "0.1", "0.2"]);
    assert!(message.starts_with("a.csv:4: column t: found 0.1 s after 0.1 s"), "{message}");
    let message = refused(&["0", "0.1", "0.05", "0.2"]);
    assert!(message.starts_with("a.csv:4: column t: found 0.05 s after 0.1 s"), "{message}");
}

#[test]
fn a_lost_row_is_found_where_it_is() {
    for (times, line) in [
        (["0", "0.01", "0.02", "0.04", "0.05"], 5),
        (["0", "0.02", "0.03", "0.04", "0.05"], 3),
        (["0", "0.01", "0.02", "0.03", "0.05"], 6),
        (["0", "1", "2", "4", "5"], 5),
    ] {
        let message = refused(&times);
        assert!(message.starts_with(&format!("a.csv:{line}: column t: found a step of ")), "{message}");
    }
    for times in [["0", "1", "3", "4"], ["0", "1", "2", "4"], ["0", "2", "3", "4"]] {
        assert!(refused(&times).contains("uniform"));
    }
    let message = refused(&["0", "0.01", "0.02", "0.04", "0.05"]);
    assert!(message.contains("step of 0.02 s, expected 0.01 s"), "{message}");
}

#[test]
fn a_step_may_be_off_by_a_hundredth() {
    let jittered =
        |seconds: f64| with_times((0..100).map(|n| if n == 50 { 0.5 + seconds } else { 0.01 * f64::from(n) }));
    assert!(read(&jittered(0.000_09)).is_ok());
    let message = read(&jittered(0.000_2)).unwrap_err().to_string();
    assert!(message.starts_with("a.csv:52: ") || message.starts_with("a.csv:53: "), "{message}");
}

#[test]
fn a_drifting_clock_is_not_uniform() {
    // Each step within 0.5 % of the mean, but 0.125 s from the grid in the middle.
    let drifting = with_times((0..10_000).map(|n| {
        let n = f64::from(n);
        0.00995 * n + 0.0001 * n * n / 20_000.0
    }));
    assert!(read(&drifting).unwrap_err().to_string().contains("uniform"));
}

#[test]
fn coarse_digits_are_no_jitter() {
    // 400 Hz in whole milliseconds; 1024 Hz with the six significant digits of %g, 0.1 ms past 10 s.
    let log = read(&with_times((0..4000).map(|n| format!("{:.3}", 0.0025 * f64::from(n))))).unwrap();
    assert!((log.period / 0.0025 - 1.0).abs() < 1e-4, "{}", log.period);
    let log = read(&with_times((0..20_000).map(|n| {
        let time = 0.0003 + f64::from(n) / 1024.0;
        let decimals = (5 - time.log10().floor() as i32).max(0) as usize;
        format!("{time:.decimals$}")
    })))
    .unwrap();
    assert!((log.period * 1024.0 - 1.0).abs() < 1e-5, "{}", log.period);
}

#[test]
fn a_step_below_f32_is_refused() {
    let message = refused(&["0", "1e-40", "2e-40", "3e-40"]);
    assert!(message.starts_with("a.csv:5: column t: found a time step of 1e-40 s"), "{message}");
}

proptest! {
    #![proptest_config(seeded(44))]

    /// A uniform clock, written with any number of digits that leaves the rounding below a fifth of the step, passes; with
    /// a row lost anywhere inside it does not. Its period is right to what the digits of its ends tell.
    #[test]
    fn uniform_passes_and_a_lost_row_does_not(
        rate in prop::sample::select(vec![50.0, 100.0, 240.0, 400.0, 500.0, 1000.0, 8000.0_f64]),
        decimals in 3..10_usize,
        count in 12..400_u32,
        start in -50.0..1000.0_f64,
        lost in 0.0..1.0_f64,
    ) {
        let half_unit = 0.5 * 10_f64.powi(-(decimals as i32));
        prop_assume!(half_unit * rate <= 0.2);
        let mut times: Vec<String> =
            (0..count).map(|n| format!("{:.decimals$}", start + f64::from(n) / rate)).collect();
        let log = read(&with_times(&times));
        prop_assert!(log.is_ok(), "{}", log.unwrap_err());
        let error = (log.unwrap().period - 1.0 / rate).abs();
        prop_assert!(error <= 2.0 * half_unit / f64::from(count - 1) + 1e-11 / rate + 1e-12, "{error}");

        times.remove(1 + (lost * f64::from(count - 2)) as usize);
        prop_assert!(read(&with_times(&times)).is_err());
    }
}
