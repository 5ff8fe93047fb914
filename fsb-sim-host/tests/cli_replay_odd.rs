//! `fsb replay` as a process, on axis logs and with options that make little sense.

use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Output};

fn fsb(directory: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fsb")).current_dir(directory).arg("replay").args(args).output().unwrap()
}

fn replay(log: &str, args: &[&str]) -> (Output, String) {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("log.csv"), log).unwrap();
    let output = fsb(directory.path(), &[&["log.csv", "--json"], args].concat());
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    (output, stderr)
}

fn json(log: &str, args: &[&str]) -> Value {
    let (output, stderr) = replay(log, args);
    assert!(output.status.success(), "{stderr}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Ten seconds of y = sin 2t at 100 Hz; the mean acceleration of a step is the change of the velocity over it.
fn swing(position: &str, input: &str, seen: impl Fn(f64) -> Option<f64>) -> String {
    let mut log = format!("t,{position},{input}\n");
    for n in 0..1000 {
        let t = 0.01 * f64::from(n);
        let y = seen(t).map(|y| y.to_string()).unwrap_or_default();
        let force = 0.5 * ((2.0 * (t + 0.01)).cos() - (2.0 * t).cos()) * 2.0 / 0.01;
        writeln!(log, "{t},{y},{force}").unwrap();
    }
    log
}

fn sine(t: f64) -> Option<f64> {
    Some((2.0 * t).sin())
}

/// What the input does before its first row and after its last one is not known: those rows are left out, and a lag as long
/// as the log leaves nothing.
#[test]
fn a_lag_leaves_what_is_known() {
    let log = swing("x", "fx", sine);
    for (lag, samples) in [("0.005", 999), ("-0.005", 999), ("0.2", 980), ("-0.2", 980)] {
        assert_eq!(json(&log, &["--lag", lag])["samples"], samples, "{lag}");
    }
    for lag in ["9.99", "-9.99", "10"] {
        let (output, stderr) = replay(&log, &["--lag", lag]);
        assert!(stderr.contains("log.csv: with this --lag hardly a position is left"), "{stderr}");
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    }
}

/// An axis that turns has no drag to identify, and says so by the keys of the others.
#[test]
fn every_axis_answers_what_was_asked() {
    let json = json(&swing("roll", "taux", sine), &["--identify", "k,drag,disturbance"]);
    let roll = json["axes"]["roll"].as_object().unwrap();
    for key in ["drag", "drag_sd", "disturbance", "disturbance_sd"] {
        assert_eq!(roll.get(key), Some(&Value::Null), "{key}");
    }
    assert_eq!((&roll["drag_observable"], &roll["disturbance_observable"]), (&false.into(), &false.into()));
    assert_eq!((json.get("residual_rms"), &json["lag_s"]), (Some(&Value::Null), &0.0.into()));
    assert!((json["inertia"]["x"]["value"].as_f64().unwrap() - 0.5).abs() < 1e-3, "{json}");
}

/// A sensor that has stopped is told; a gap is not taken for a jump.
#[test]
fn a_sensor_that_stops_and_one_that_pauses() {
    let (_, stderr) = replay(&swing("x", "fx", |t| sine(t.min(6.0))), &[]);
    assert!(stderr.contains("does not change at all for 3.99 s from t = 6.00 s on"), "{stderr}");
    let (_, stderr) = replay(&swing("x", "fx", |t| sine(t).filter(|_| !(4.0..4.6).contains(&t))), &[]);
    assert!(stderr.contains("a gap of 0.61 s") && !stderr.contains("jump") && !stderr.contains("change"), "{stderr}");
}

/// Options for two files are not passed over in silence.
#[test]
fn options_of_two_files_are_refused_with_one() {
    let log = swing("x", "fx", sine);
    for args in [&["--normalised"][..], &["--column", "x=y"], &["--columns", "names.toml"]] {
        let (output, stderr) = replay(&log, args);
        assert!(stderr.contains("are for --motion and --input, not for log.csv"), "{stderr}");
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    }
}

/// A message says what is so: what a read-out must remember at least, and which inputs tell nothing.
#[test]
fn what_is_refused_or_not_valid_is_explained() {
    let log = swing("x", "fx", sine);
    for (args, least) in [(&[][..], "0.01"), (&["--identify", "k"], "0.05"), (&["--lambda", "0.02"], "0.1")] {
        let (output, stderr) = replay(&log, &[args, &["--fade", "0.009"]].concat());
        assert!(
            stderr.contains(&format!("--fade 0.009: must be at least one step of what is read out, {least} s")),
            "{stderr}"
        );
        assert_eq!(output.status.code(), Some(2));
        json(&log, &[args, &["--fade", least]].concat());
    }
    let (output, stderr) = replay(&log, &["--lambda", "1e-4"]);
    assert!(stderr.contains("too short for this λ") && output.status.success(), "{stderr}");
    let (_, stderr) = replay(&swing("x", "fx", |t| Some(2e6 + t)), &[]);
    assert!(stderr.contains("a position of at most 1e6 in magnitude"), "{stderr}");
    let (_, stderr) = replay(&log, &["--full-thrust", "1e300"]);
    assert!(stderr.contains("must be at most 1e6 N"), "{stderr}");
}
