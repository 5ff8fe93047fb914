//! `fsb replay` as a process, on logs of the exact plant.

#[path = "cli_replay/flight.rs"]
mod flight;

use flight::{Flight, GRAVITY, INERTIA, MASS, Motion};
use fsb_sim_host::replay::{AxisLog, ReplayOptions, run};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

fn fsb(directory: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fsb")).current_dir(directory).arg("replay").args(args).output().unwrap()
}

fn with_log(log: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("log.csv"), log).unwrap();
    directory
}

/// Replays `log` and returns the JSON: the whole of stdout, so that anything else there is an error.
fn json(log: &str, args: &[&str]) -> Value {
    let directory = with_log(log);
    let output = fsb(directory.path(), &[&["log.csv", "--json"], args].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn keys(value: &Value) -> BTreeSet<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

fn assert_near(value: &Value, truth: f64, relative: f64) {
    let value = value.as_f64().unwrap();
    assert!((value / truth - 1.0).abs() <= relative, "{value} is not {truth}");
}

#[test]
fn mass_velocity_and_keys() {
    let json = json(&Flight::in_space(200.0, 4.0).csv(|_, _| false), &[]);
    assert_eq!(keys(&json), BTreeSet::from(["period_s", "samples", "missed", "mass", "axes", "inertia"]));
    assert_eq!((&json["period_s"], &json["samples"], &json["missed"]), (&0.005.into(), &800.into(), &0.into()));
    assert_eq!(keys(&json["mass"]), BTreeSet::from(["value", "sd", "valid"]));
    assert_near(&json["mass"]["value"], MASS, 1e-5);
    assert_eq!(json["mass"]["valid"], true);
    assert!(json["mass"]["sd"].as_f64().unwrap() < 1e-5 * MASS);
    assert_eq!(keys(&json["axes"]), BTreeSet::from(["x", "y", "z"]));
    for axis in ["x", "y", "z"] {
        let axis = &json["axes"][axis];
        assert_eq!(keys(axis), BTreeSet::from(["k", "k_sd", "valid", "velocity_rms_error"]));
        assert_near(&axis["k"], 1.0 / MASS, 1e-5);
        assert!(axis["velocity_rms_error"].as_f64().unwrap() < 2e-5);
    }
    assert_eq!(json["inertia"], serde_json::json!({}));
}

#[test]
fn every_subset_of_axes() {
    for axes in [&["z"][..], &["x"], &["y", "z"], &["x", "y"]] {
        let json = json(&Flight::in_space(100.0, 4.0).only(axes).csv(|_, _| false), &[]);
        assert_near(&json["mass"]["value"], MASS, 1e-5);
        assert_eq!(keys(&json["axes"]), axes.iter().copied().collect());
    }
}

#[test]
fn inertia_of_the_rotational_axes_present() {
    let flight = || Flight::turning(500.0, 4.0);
    let all = json(&flight().csv(|_, _| false), &[]);
    assert_eq!(all["mass"], Value::Null);
    assert_eq!(keys(&all["inertia"]), BTreeSet::from(["x", "y", "z"]));
    for (axis, truth) in ["x", "y", "z"].into_iter().zip(INERTIA) {
        assert_near(&all["inertia"][axis]["value"], truth, 1e-5);
        assert_eq!(keys(&all["inertia"][axis]), BTreeSet::from(["value", "sd", "valid"]));
    }
    assert_near(&all["axes"]["pitch"]["k"], 1.0 / INERTIA[1], 1e-5);
    let pitch = json(&flight().only(&["pitch"]).csv(|_, _| false), &[]);
    assert_eq!(keys(&pitch["inertia"]), BTreeSet::from(["y"]));
    assert_near(&pitch["inertia"]["y"]["value"], INERTIA[1], 1e-5);

    let mut both = Flight::in_space(500.0, 4.0);
    both.motions.append(&mut flight().only(&["roll", "yaw"]).motions);
    let both = json(&both.csv(|_, _| false), &[]);
    assert_near(&both["mass"]["value"], MASS, 1e-5);
    assert_near(&both["inertia"]["x"]["value"], INERTIA[0], 1e-5);
    assert_near(&both["inertia"]["z"]["value"], INERTIA[2], 1e-5);
    assert_eq!(keys(&both["inertia"]), BTreeSet::from(["x", "z"]));
}

#[test]
fn missed_samples_are_counted_and_cost_nothing() {
    // Every seventh of x from 0.5 s on, a fifth of a second of z, and y from the fourth row on.
    let missing = |row: usize, axis: &str| match axis {
        "x" => row >= 50 && row % 7 == 3,
        "y" => row < 3,
        _ => (300..320).contains(&row),
    };
    let flight = Flight::in_space(100.0, 4.0);
    let expected: usize = (0..flight.samples).map(|n| ["x", "y", "z"].iter().filter(|a| missing(n, a)).count()).sum();
    let some_missed = json(&flight.csv(missing), &[]);
    assert_eq!(some_missed["missed"], expected);
    assert_near(&some_missed["mass"]["value"], MASS, 1e-5);
    for axis in ["x", "y", "z"] {
        assert!(some_missed["axes"][axis]["velocity_rms_error"].as_f64().unwrap() < 1e-5, "{axis}");
    }
    // Before k is known, what stands in for a missed sample is no better than a constant velocity; its trace fades.
    let from_the_start = json(&flight.csv(|row, _| row % 7 == 3), &[]);
    assert_near(&from_the_start["mass"]["value"], MASS, 1e-5);
}

#[test]
fn no_reference_no_error() {
    let log = Flight::in_space(100.0, 2.0).csv(|_, _| false).replacen("vy_ref", "other", 1);
    let json = json(&log, &[]);
    assert_eq!(json["axes"]["y"]["velocity_rms_error"], Value::Null);
    assert!(json["axes"]["x"]["velocity_rms_error"].is_f64());
}

#[test]
fn options_reach_the_core() {
    let mut on_the_moon = Flight::in_space(100.0, 4.0).only(&["z"]);
    on_the_moon.motions[0].drift = -1.62;
    let log = on_the_moon.csv(|_, _| false);
    assert_near(&json(&log, &["--gravity", "1.62"])["mass"]["value"], MASS, 1e-5);
    assert!((json(&log, &[])["mass"]["value"].as_f64().unwrap() / MASS - 1.0).abs() > 0.1);

    let log = Flight::in_space(8000.0, 1.0).csv(|_, _| false);
    assert_near(&json(&log, &["--readout", "abs"])["mass"]["value"], MASS, 1e-5);
    assert_near(&json(&log, &["--lambda", "4", "--observer-lambda", "20"])["mass"]["value"], MASS, 1e-5);

    // The standard deviation depends on λ and q.
    let log = Flight::in_space(100.0, 2.0).csv(|_, _| false);
    let four = json(&log, &["--lambda", "4"]);
    assert_eq!(four, json(&log, &["--lambda", "4", "--q", "2"]));
    assert_ne!(four, json(&log, &["--lambda", "4", "--q", "1"]));
    assert_eq!(json(&log, &[]), json(&log, &["--lambda=2", "--q=1", "--observer-lambda=10", "--observer-q=5"]));
}

#[test]
fn fading_memory_follows_a_change() {
    let dropped =
        Motion { k: |t| if t < 4.0 { 1.0 } else { 2.0 }, ..Flight::in_space(100.0, 1.0).motions.swap_remove(2) };
    let log = Flight { period: 0.01, samples: 1200, motions: vec![dropped] }.csv(|_, _| false);
    // What remembers both masses is contradicted by the motion, and withdrawn.
    assert_eq!(json(&log, &[])["mass"]["value"], Value::Null);
    let fading = json(&log, &["--fade", "0.5"])["mass"]["value"].as_f64().unwrap();
    assert!((fading - 0.5).abs() < 0.005, "{fading}");
}

#[test]
fn what_never_becomes_valid_is_told_and_not_given() {
    let mut resting = Flight::in_space(100.0, 2.0).only(&["x"]);
    resting.motions[0].force = |_| 0.0;
    let directory = with_log(&resting.csv(|_, _| false));
    let output = fsb(directory.path(), &["log.csv", "--json", "--out", "out"]);
    assert!(output.status.success());
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["mass"], serde_json::json!({ "value": null, "sd": null, "valid": false }));
    assert_eq!(json["axes"]["x"]["k"], Value::Null);
    assert_eq!(json["axes"]["x"]["valid"], false);
    assert_eq!(json["axes"]["x"]["velocity_rms_error"], Value::Null);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(told.contains("mass is not valid: unexcited"), "{told}");
    let estimates = std::fs::read_to_string(directory.path().join("out/estimates.csv")).unwrap();
    assert!(estimates.lines().skip(1).all(|line| line.ends_with(",,,,")), "nothing is handed out");
    let table = fsb(directory.path(), &["log.csv"]);
    assert!(String::from_utf8_lossy(&table.stdout).contains("unexcited"));
}

#[test]
fn the_table_shows_the_mass() {
    let directory = with_log(&Flight::in_space(100.0, 2.0).csv(|_, _| false));
    let output = fsb(directory.path(), &["log.csv"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("1.3000") && text.contains("x, y, z") && text.contains("z alone"), "{text}");
}

#[test]
fn estimates_are_those_of_the_core_to_the_last_bit() {
    let mut flight = Flight::in_space(100.0, 2.0);
    flight.motions.append(&mut Flight::turning(100.0, 2.0).only(&["pitch"]).motions);
    let text = flight.csv(|row, axis| axis == "x" && row % 9 == 5);
    let directory = with_log(&text);
    let output = fsb(directory.path(), &["log.csv", "--out", "new/out"]);
    assert!(output.status.success());
    let out = directory.path().join("new/out");
    for name in ["mass.svg", "inertia.svg", "positions.svg", "velocities.svg", "innovations.svg"] {
        assert!(std::fs::read_to_string(out.join(name)).unwrap().contains("</svg>"), "{name}");
    }
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("fsb replay log.csv --lambda 2 --q 1") && page.matches("</svg>").count() == 5);

    let log = AxisLog::from_reader("log.csv", text.as_bytes()).unwrap();
    let result = run(&ReplayOptions::default(), &log).unwrap();
    let estimates = std::fs::read_to_string(out.join("estimates.csv")).unwrap();
    let mut lines = estimates.lines();
    let header = "t,x_hat,x_rate_hat,y_hat,y_rate_hat,z_hat,z_rate_hat,pitch_hat,pitch_rate_hat,mass_hat,mass_sd,\
                  inertia_y_hat,inertia_y_sd";
    assert_eq!(lines.next(), Some(header));
    let rows: Vec<Vec<Option<f32>>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().ok()).collect()).collect();
    assert_eq!(rows.len(), 200);
    for (n, row) in rows.iter().enumerate() {
        assert_eq!(row[0], Some((n as f64 * 0.01) as f32));
        for (i, axis) in result.axes.iter().enumerate() {
            let state = axis.trace.state[n];
            assert_eq!(row[1 + 2 * i], state.map(|s| s.position), "row {n}");
            assert_eq!(row[2 + 2 * i], state.map(|s| s.velocity), "row {n}");
        }
        let parameters = [result.mass.as_ref().unwrap().value[n], result.axes[3].own.value[n]];
        for (i, k) in parameters.into_iter().enumerate() {
            assert_eq!(row[9 + 2 * i], k.map(|k| k.inverse_with_sd().0), "row {n}");
            assert_eq!(row[10 + 2 * i], k.map(|k| k.inverse_with_sd().1), "row {n}");
        }
    }
    assert!(rows[0][1..].iter().all(Option::is_none), "nothing is known at the first sample");
    assert!(rows[199].iter().all(Option::is_some));
}

#[test]
fn bad_input_is_named_and_writes_nothing() {
    let good = Flight::in_space(100.0, 1.0).csv(|_, _| false);
    let line = |number: usize| good.lines().nth(number - 1).unwrap();
    let z = line(5).split(',').nth(7).unwrap();
    let not_a_number = good.replace(line(5), &line(5).replace(z, "high"));
    let row_lost = good.replace(&format!("{}\n", line(50)), "");
    let never_together = Flight::in_space(100.0, 1.0).csv(|row, axis| axis == "xyz".get(row % 3..=row % 3).unwrap());
    let cases: [(&str, &[&str], &[&str]); 19] = [
        (&good, &["--lambda", "0"], &["--lambda 0", "positive"]),
        (&good, &["--lambda", "-1"], &["--lambda -1", "positive"]),
        (&good, &["--lambda", "nan"], &["--lambda NaN", "finite"]),
        (&good, &["--lambda", "fast"], &["--lambda", "fast"]),
        (&good, &["--lambda", "101"], &["--lambda 101", "too large", "0.01 s"]),
        (&good, &["--lambda", "1e-9"], &["--lambda", "too small"]),
        (&good, &["--q", "0"], &["--q 0", "positive"]),
        (&good, &["--q", "150"], &["--q 150", "too large"]),
        (&good, &["--observer-lambda", "-2"], &["--observer-lambda -2", "positive"]),
        (&good, &["--observer-lambda", "300"], &["--observer-lambda 300", "too large"]),
        (&good, &["--observer-q", "0"], &["--observer-q 0", "positive"]),
        (&good, &["--gravity", "inf"], &["--gravity inf", "finite"]),
        (&good, &["--readout", "median"], &["--readout", "median"]),
        (&good, &["--fade", "0"], &["--fade 0", "positive"]),
        (&good, &["--fade", "0.001"], &["--fade 0.001", "0.01 s"]),
        (&not_a_number, &[], &["log.csv:5", "column z", "high"]),
        (&row_lost, &[], &["log.csv:50", "column t"]),
        ("t,x,fy\n0,1,2\n1,1,2\n2,1,2\n3,1,2\n", &[], &["log.csv:1", "no usable axis"]),
        (&never_together, &[], &["log.csv", "x, y, z"]),
    ];
    for (log, args, expected) in cases {
        let directory = with_log(log);
        let output = fsb(directory.path(), &[&["log.csv", "--json", "--out", "out"], args].concat());
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{args:?}: {told}");
        for part in expected {
            assert!(told.contains(part), "{args:?}: no `{part}` in: {told}");
        }
        assert!(output.stdout.is_empty(), "{args:?}");
        assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1, "{args:?}: something was written");
    }
}

#[test]
fn gravity_is_judged_without_a_vertical_axis() {
    let directory = with_log(&Flight::turning(100.0, 1.0).csv(|_, _| false));
    let output = fsb(directory.path(), &["log.csv", "--gravity", "nan"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--gravity"));
}

#[test]
fn a_file_that_is_not_there() {
    let directory = tempfile::tempdir().unwrap();
    let output = fsb(directory.path(), &["nowhere.csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("nowhere.csv"));
}

#[test]
fn a_directory_that_cannot_be_made_is_named() {
    let directory = with_log(&Flight::in_space(100.0, 1.0).csv(|_, _| false));
    let output = fsb(directory.path(), &["log.csv", "--json", "--out", "log.csv/out"]);
    assert!(!output.status.success() && output.stdout.is_empty());
    assert!(String::from_utf8_lossy(&output.stderr).contains("log.csv/out"));
}

#[test]
fn help_states_the_defaults() {
    let directory = tempfile::tempdir().unwrap();
    let output = fsb(directory.path(), &["--help"]);
    let text = String::from_utf8(output.stdout).unwrap();
    for part in ["[default: 2]", "[default: λ/2]", "[default: 10]", &format!("[default: {GRAVITY}]"), "exit status 0"]
    {
        assert!(text.contains(part), "{part}");
    }
}
