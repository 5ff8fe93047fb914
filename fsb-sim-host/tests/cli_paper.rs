//! `fsb`, `fsb paper`, `fsb efficiency` and `fsb soak` as processes.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn fsb(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fsb")).args(arguments).current_dir(directory).output().unwrap()
}

fn files(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        std::fs::read_dir(directory).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn keys(value: &Value) -> Vec<String> {
    let mut keys: Vec<_> = value.as_object().unwrap().keys().cloned().collect();
    keys.sort();
    keys
}

const REPORT: [&str; 9] =
    ["fig2.svg", "fig3.svg", "fig4.svg", "fig5.svg", "fig6.svg", "fig7.svg", "fig8.svg", "fig9.svg", "report.html"];

/// Without arguments: Section V with its defaults, the table, the report, and where it was written; then the spiral.
#[test]
fn no_arguments_reproduce_the_paper() {
    let root = tempfile::tempdir().unwrap();
    let output = fsb(root.path(), &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let out = text(&output.stdout);
    for part in ["Table 1", "100 runs", "f32 core", "paper form", "out/paper/report.html", "0.4133", "-14.3569"] {
        assert!(out.contains(part), "{part} is missing in\n{out}");
    }
    assert_eq!(files(&root.path().join("out/paper")), REPORT);
    assert_eq!(files(&root.path().join("out/fly-spiral")), ["report.html", "scene.svg"]);
    assert!(out.contains("out/fly-spiral/report.html") && out.contains("spiral: what is estimated"), "{out}");
    let page = std::fs::read_to_string(root.path().join("out/paper/report.html")).unwrap();
    for figure in 2..=9 {
        assert!(page.contains(&format!("Fig. {figure}.")), "Fig. {figure} is not in the report");
    }
    for foreign in ["src=", "<link", "<script", "@import", "url("] {
        assert!(!page.contains(foreign), "the report is not self-contained: {foreign}");
    }
}

#[test]
fn json_is_one_object_with_the_agreed_keys() {
    let root = tempfile::tempdir().unwrap();
    let output = fsb(root.path(), &["paper", "--rate", "500", "--runs", "4", "--seed", "9", "--out", "here", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let json: Value = serde_json::from_slice(&output.stdout).expect("stdout is one JSON value and nothing else");
    assert_eq!(keys(&json), ["core", "paper_form", "rate_hz", "runs", "table1"]);
    assert_eq!((&json["runs"], &json["rate_hz"]), (&Value::from(4), &Value::from(500.0)));
    let rows = json["table1"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|row| row["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["k", "x", "y", "x_rate", "y_rate"]);
    for row in rows {
        assert_eq!(keys(row), ["error_percent", "estimated", "name", "paper_error_percent", "true"]);
        let number = |name: &str| row[name].as_f64().unwrap();
        let error = 100.0 * ((number("estimated") - number("true")) / number("true")).abs();
        assert!((error - number("error_percent")).abs() < 1e-9 * error, "{row}");
    }
    assert_eq!((&rows[0]["true"], &rows[2]["paper_error_percent"]), (&Value::from(2.0), &Value::from(0.4133)));
    for form in ["core", "paper_form"] {
        let of = &json[form];
        assert_eq!(keys(of), ["k_error_mean", "k_error_sd", "position_rms", "velocity_rms"]);
        for key in keys(of) {
            assert!(of[&key].as_f64().is_some_and(|value| value.abs() < 1.0), "{form} {key}: {}", of[&key]);
        }
    }
    assert_eq!(files(root.path()), ["here"]);
    assert_eq!(files(&root.path().join("here")), REPORT);
}

/// Numbers that do not exist are null: one run has no spread, half a second no rms from 2 s on and no k.
#[test]
fn what_does_not_exist_is_null() {
    let root = tempfile::tempdir().unwrap();
    let output = fsb(root.path(), &["paper", "--rate", "500", "--runs", "1", "--duration", "0.5", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(json["core"]["k_error_sd"].is_null() && json["core"]["position_rms"].is_null(), "{json}");
    assert!(json["table1"][0]["estimated"].is_null() && json["table1"][1]["estimated"].is_f64(), "{json}");
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let root = tempfile::tempdir().unwrap();
    let run = |seed: &str, out: &str| {
        let arguments = ["paper", "--rate", "200", "--runs", "3", "--seed", seed, "--out", out, "--json"];
        let output = fsb(root.path(), &arguments);
        (output.stdout, std::fs::read(root.path().join(out).join("report.html")).unwrap())
    };
    let (first, again, other) = (run("5", "a"), run("5", "b"), run("6", "c"));
    assert!(first == again, "seed 5 twice");
    assert!(first.0 != other.0 && first.1 != other.1, "seed 6 is seed 5");
}

/// The start can be set, and the page says so.
#[test]
fn the_start_can_be_set() {
    let root = tempfile::tempdir().unwrap();
    let arguments =
        ["paper", "--rate", "200", "--runs", "1", "--sigma", "0", "--start-x", "-4", "--start-vy", "2.5", "--out", "o"];
    assert!(fsb(root.path(), &arguments).status.success());
    let page = std::fs::read_to_string(root.path().join("o/report.html")).unwrap();
    assert!(
        page.contains("(-4, 1) m, (0, 2.5) m/s") && page.contains("--start-x -4 --start-vy 2.5"),
        "not on the page"
    );
}

/// Exit status 2, the parameter named on stderr, nothing on stdout, nothing written.
#[test]
fn bad_parameters_are_named_and_nothing_is_written() {
    let cases: [(&[&str], &str); 22] = [
        (&["paper", "--rate", "0"], "--rate"),
        (&["paper", "--rate", "-100"], "--rate"),
        (&["paper", "--rate", "fast"], "--rate"),
        (&["paper", "--rate", "nan"], "--rate"),
        (&["paper", "--rate", "1e9"], "--rate"),
        (&["paper", "--sigma", "-0.5"], "--sigma"),
        (&["paper", "--sigma", "inf"], "--sigma"),
        (&["paper", "--seed", "-1"], "--seed"),
        (&["paper", "--runs", "0"], "--runs"),
        (&["paper", "--runs", "2.5"], "--runs"),
        (&["paper", "--duration", "0"], "--duration"),
        (&["paper", "--duration", "1e9"], "--duration"),
        (&["paper", "--lambda", "0"], "--lambda"),
        (&["paper", "--lambda", "20000"], "--lambda"),
        (&["paper", "--q", "-1"], "--q"),
        (&["paper", "--q", "1e-9"], "--q"),
        (&["paper", "--start-x", "nan"], "--start-x"),
        (&["efficiency", "--runs", "1"], "--runs"),
        (&["soak", "--rate", "1"], "--rate"),
        (&["soak", "--hours", "0.001"], "--hours"),
        (&["soak", "--faults", "--rate", "999"], "--rate"),
        (&["soak", "--faults", "--rate", "40000"], "--rate"),
    ];
    for (arguments, name) in cases {
        let root = tempfile::tempdir().unwrap();
        let output = fsb(root.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", text(&output.stderr));
        assert!(text(&output.stderr).contains(name), "{arguments:?}: {}", text(&output.stderr));
        assert!(output.stdout.is_empty(), "{arguments:?}: {}", text(&output.stdout));
        assert!(files(root.path()).is_empty(), "{arguments:?} wrote something");
    }
}

/// The first velocity, a difference of two noisy or faulty positions, is no signal without bounds, at any rate and seed.
#[test]
fn a_soak_holds_at_high_rates_and_after_a_bad_start() {
    let root = tempfile::tempdir().unwrap();
    for arguments in [&["--rate", "8000"][..], &["--faults", "--seed", "4"], &["--faults", "--rate", "5000"]] {
        let output = fsb(root.path(), &[&["soak", "--hours", "0.0167"][..], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output.stderr));
    }
}

/// A report that cannot be written: exit status 1, the path named, nothing on stdout.
#[test]
fn a_report_that_cannot_be_written_is_an_error() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("taken"), "kept").unwrap();
    let arguments = ["paper", "--rate", "200", "--runs", "1", "--duration", "1", "--out", "taken", "--json"];
    let output = fsb(root.path(), &arguments);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("taken") && output.stdout.is_empty());
    assert_eq!(std::fs::read_to_string(root.path().join("taken")).unwrap(), "kept");
}

/// `--help` of everything gives units, defaults and exit status; `--version` the version.
#[test]
fn help_and_version() {
    let root = tempfile::tempdir().unwrap();
    let help = |arguments: &[&str]| {
        let output = fsb(root.path(), arguments);
        assert!(output.status.success(), "{arguments:?}");
        text(&output.stdout)
    };
    let cases: [(&[&str], &[&str]); 4] = [
        (&["--help"], &["paper", "efficiency", "soak", "Exit status"]),
        (
            &["paper", "--help"],
            &["[Hz]", "[default: 10000]", "[1/s]", "half of λ", "[default: out/paper]", "Exit status"],
        ),
        (&["efficiency", "--help"], &["[Hz]", "[default: 4000]", "Cramér-Rao", "Exit status"]),
        (&["soak", "--help"], &["[h]", "[default: 1000]", "subnormal", "Exit status"]),
    ];
    for (arguments, parts) in cases {
        let help = help(arguments);
        for part in parts {
            assert!(help.contains(part), "{arguments:?}: {part} is missing in\n{help}");
        }
    }
    assert_eq!(help(&["--version"]).trim(), concat!("fsb ", env!("CARGO_PKG_VERSION")));
}

#[test]
fn efficiency_and_soak_give_json() {
    let root = tempfile::tempdir().unwrap();
    let json = |arguments: &[&str]| -> Value {
        let output = fsb(root.path(), arguments);
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let efficiency = json(&["efficiency", "--runs", "50", "--rate", "500", "--json"]);
    let times: Vec<_> = efficiency["times"].as_array().unwrap().iter().map(|row| row["t"].as_f64().unwrap()).collect();
    assert_eq!(times, [0.5, 1.0, 2.0, 5.0, 10.0]);
    let soak = json(&["soak", "--hours", "0.02", "--json"]);
    assert_eq!((&soak["ticks"], &soak["violations"]), (&Value::from(72_000), &Value::Array(Vec::new())));
    assert!(files(root.path()).is_empty());
}
