//! `fsb fly` as a process.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn fsb(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fsb")).arg("fly").args(arguments).current_dir(directory).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn json(output: &Output) -> Value {
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("stdout is one JSON value and nothing else")
}

fn keys(value: &Value) -> Vec<String> {
    let mut keys: Vec<_> = value.as_object().unwrap().keys().cloned().collect();
    keys.sort();
    keys
}

const SHORT: [&str; 4] = ["--set", "duration=7", "--out", "here"];

#[test]
fn json_has_the_agreed_keys() {
    let root = tempfile::tempdir().unwrap();
    let output = fsb(root.path(), &[&["--scenario", "aggressive", "--seed", "3", "--json"][..], &SHORT[..]].concat());
    let json = json(&output);
    let wanted =
        ["scenario", "seed", "runs", "diverged", "parameters", "errors", "tracking", "events", "real_time_factor"];
    for key in wanted {
        assert!(!json[key].is_null(), "{key} is missing");
    }
    assert_eq!((&json["scenario"], &json["seed"]), (&Value::from("aggressive"), &Value::from(3)));
    assert_eq!((&json["runs"], &json["diverged"]), (&Value::from(1), &Value::from(0)));
    for (name, real) in [("mass", 2.5), ("ixx", 0.03), ("iyy", 0.035), ("izz", 0.055)] {
        let of = &json["parameters"][name];
        assert_eq!(keys(of), ["estimated", "sd", "true", "valid"]);
        assert_eq!((of["true"].as_f64(), of["valid"].as_bool()), (Some(real), Some(true)));
        assert!((of["estimated"].as_f64().unwrap() / real - 1.0).abs() < 0.002, "{name}: {of}");
        assert!(of["sd"].as_f64().unwrap() > 0.0);
    }
    let errors = json["errors"].as_array().unwrap();
    assert_eq!(errors.len(), 71, "every 0.1 s from 0 to 7 s");
    for (i, error) in errors.iter().enumerate() {
        assert_eq!(keys(error), ["ixx", "iyy", "izz", "mass", "t"]);
        assert!((error["t"].as_f64().unwrap() - 0.1 * i as f64).abs() < 1e-9);
    }
    assert!(errors[0]["mass"].is_null() && errors[70]["mass"].as_f64().unwrap().abs() < 0.05);
    let of = &json["tracking"];
    for key in ["position_rms", "attitude_rms", "yardstick_position_rms", "yardstick_attitude_rms"] {
        assert!(of[key].as_f64().is_some_and(|value| 0.0 < value && value < 0.1), "{key}: {of}");
    }
    let events = json["events"].as_array().unwrap();
    assert!(
        events.iter().any(|event| event["what"] == "mass valid" && event["t"].as_f64().unwrap() < 1.0),
        "{events:?}"
    );
    assert!(json["small_angle"].as_array().unwrap().len() == 71);
    // Six rotors of 16 N, tilted by 0.96 rad, push upwards by the cosine of it.
    let attainable = &json["vehicle"]["attainable"];
    let most = attainable["vertical_force"][1].as_f64().unwrap();
    assert!((most - 6.0 * 16.0 * 0.96_f64.cos()).abs() < 1e-9, "{attainable}");
    assert!((attainable["thrust_to_weight"].as_f64().unwrap() - most / (2.5 * 9.81)).abs() < 1e-9);
    assert!(json["vehicle"]["condition"].as_f64().unwrap() > 1.0);
    assert!(json["real_time_factor"].as_f64().unwrap() > 1.0);
}

#[test]
fn many_flights_add_their_distribution() {
    let root = tempfile::tempdir().unwrap();
    let output = fsb(root.path(), &[&["--scenario", "random", "--runs", "5", "--json"][..], &SHORT[..]].concat());
    let json = json(&output);
    assert_eq!(json["runs"], Value::from(5));
    for name in ["mass", "ixx", "iyy", "izz", "position_rms"] {
        let of = &json["distribution"][name];
        assert_eq!(of["flights"], Value::from(5), "{name}");
        let at = |key: &str| of[key].as_f64().unwrap();
        assert!(at("min") <= at("p05") && at("p05") <= at("median") && at("median") <= at("p95"), "{of}");
    }
    assert_eq!(json["distribution"]["diverged_seeds"], Value::Array(Vec::new()));
}

#[test]
fn the_report_is_one_page_without_foreign_parts() {
    let root = tempfile::tempdir().unwrap();
    let output = fsb(root.path(), &["--scenario", "random", "--runs", "3", "--set", "duration=7"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let out = text(&output.stdout);
    for part in [
        "What the vehicle can do",
        "condition number",
        "what is estimated",
        "± 2 sd",
        "yardstick",
        "Events",
        "3 flights",
        "out/fly-random/report.html",
    ] {
        assert!(out.contains(part), "{part} is missing in\n{out}");
    }
    let page = std::fs::read_to_string(root.path().join("out/fly-random/report.html")).unwrap();
    for figure in [
        "Vehicle and path",
        "from above",
        "from the side",
        "from the front",
        "Parameters",
        "Velocities",
        "Thrusts",
        "Distribution",
    ] {
        assert!(page.contains(figure), "{figure} is not in the report");
    }
    for foreign in ["src=", "<link", "@import", "url("] {
        assert!(!page.contains(foreign), "the report is not self-contained: {foreign}");
    }
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..roxmltree::ParsingOptions::default() };
    roxmltree::Document::parse_with_options(&page, options).expect("the page is well-formed XML");
}

#[test]
fn the_same_seed_gives_the_same_report() {
    let root = tempfile::tempdir().unwrap();
    let page = |seed: &str, out: &str| {
        fsb(root.path(), &["--scenario", "hover", "--seed", seed, "--out", out, "--set", "duration=2"]);
        std::fs::read(root.path().join(out).join("report.html")).unwrap()
    };
    let (first, again, other) = (page("5", "a"), page("5", "b"), page("6", "c"));
    assert!(first == again, "seed 5 twice");
    assert!(first != other, "seed 6 is seed 5");
}

#[test]
fn the_list_names_every_scenario() {
    let root = tempfile::tempdir().unwrap();
    let listed = text(&fsb(root.path(), &["--list"]).stdout);
    let json = json(&fsb(root.path(), &["--list", "--json"]));
    let names: Vec<&str> = json["scenarios"].as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    for name in [
        "spiral",
        "aggressive",
        "hover",
        "payload-pickup",
        "payload-drop",
        "wind",
        "slow-position",
        "latency",
        "dropouts",
        "outliers",
        "random",
    ] {
        assert!(names.contains(&name) && listed.contains(name), "{name}");
    }
    assert_eq!(std::fs::read_dir(root.path()).unwrap().count(), 0, "a list writes nothing");
}

/// A file of one's own, and one entry of it overridden.
#[test]
fn a_file_is_flown() {
    let root = tempfile::tempdir().unwrap();
    let built_in = include_str!("../scenarios/hover.toml").replace("name = \"hover\"", "name = \"mine/../x\"");
    std::fs::write(root.path().join("mine.toml"), built_in).unwrap();
    let output =
        fsb(root.path(), &["--scenario", "mine.toml", "--set", "plant.mass=3.1", "--set", "duration=3", "--json"]);
    let json = json(&output);
    assert_eq!(json["parameters"]["mass"]["true"], Value::from(3.1));
    assert!(root.path().join("out/fly-mine----x/report.html").is_file(), "the name stays inside the folder");
}

/// Exit status 2, what is wrong on stderr, nothing on stdout, nothing written.
#[test]
fn bad_input_is_named_and_nothing_is_written() {
    let root = tempfile::tempdir().unwrap();
    for (arguments, part) in [
        (&["--scenario", "nowhere"][..], "neither a built-in"),
        (&["--set", "plant.mas=1"], "unknown field `mas`"),
        (&["--set", "plant.mass=-1"], "plant.mass = -1.0"),
        (&["--set", "plant.mass"], "KEY=VALUE"),
        (&["--set", "estimator.translation.lambda=1e5"], "estimator.translation.lambda"),
        (&["--set", "sensors.position.latency=5"], "latency"),
        (&["--runs", "0"], "0"),
        (&["--sed", "1"], "--sed"),
    ] {
        let output = fsb(root.path(), arguments);
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {complaint}");
        assert!(complaint.contains(part) && output.stdout.is_empty(), "{arguments:?}: {complaint}");
    }
    assert_eq!(std::fs::read_dir(root.path()).unwrap().count(), 0);
}

/// A vehicle that cannot carry its weight falls: exit status 1, and the flight is told and drawn.
#[test]
fn a_diverged_flight_is_told() {
    let root = tempfile::tempdir().unwrap();
    let output = fsb(root.path(), &["--scenario", "hover", "--set", "plant.mass=9", "--json"]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["diverged"], Value::from(1));
    assert!(json["events"].as_array().unwrap().iter().any(|event| event["what"] == "diverged"), "{json}");
    assert!(root.path().join("out/fly-hover/report.html").is_file());
}

/// A rate that has no tick every 0.1 s: each entry is from the tick nearest to its time, and none is lost over the flight.
#[test]
fn errors_keep_their_pace_at_any_rate() {
    let root = tempfile::tempdir().unwrap();
    for (rate, duration) in [("125", 30.0), ("333", 12.0)] {
        let set = [format!("rate={rate}"), format!("duration={duration}")];
        let output = fsb(root.path(), &["--scenario", "aggressive", "--json", "--set", &set[0], "--set", &set[1]]);
        let errors = json(&output)["errors"].as_array().unwrap().clone();
        assert_eq!(errors.len(), (10.0 * duration) as usize + 1, "{rate} Hz");
        let half = 0.5 / rate.parse::<f64>().unwrap() + 1e-9;
        for (i, error) in errors.iter().enumerate() {
            assert!((error["t"].as_f64().unwrap() - 0.1 * i as f64).abs() <= half, "{rate} Hz: {error}");
        }
    }
}

/// What is judged from 6 s on is null, not zero, in a flight that ends before.
#[test]
fn a_short_flight_has_no_tracking() {
    let root = tempfile::tempdir().unwrap();
    let json = json(&fsb(root.path(), &["--scenario", "hover", "--set", "duration=5", "--json"]));
    for part in ["tracking", "state"] {
        let of = json[part].as_object().unwrap();
        assert!(of.len() >= 3 && of.values().all(Value::is_null), "{of:?}");
    }
}

/// Before the flights are flown, and nothing is on stdout.
#[test]
fn a_directory_that_cannot_be_made_is_named() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("file"), "").unwrap();
    let output = fsb(root.path(), &["--scenario", "hover", "--set", "duration=1", "--json", "--out", "file/out"]);
    let complaint = text(&output.stderr);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0), "{complaint}");
    assert_eq!(complaint, "error: cannot write file/out: not a directory\n");
}
