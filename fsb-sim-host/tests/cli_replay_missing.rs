//! `fsb replay` as a process: what is missing, and what stands between the fields, is the same for an axis log and for two files.

use serde_json::Value;
use std::process::{Command, Output};

/// Ten seconds at 100 Hz of a mass of 1 kg that swings, z = sin 2t, as the rows of t, z and the mean force of the step; `cells`
/// makes the last two what they are written as.
fn rows(cells: impl Fn(usize, f64, f64) -> (String, String)) -> Vec<[String; 3]> {
    let row = |n: usize| {
        let t = 0.01 * n as f64;
        let force = 9.81 + 2.0 * ((2.0 * (t + 0.01)).cos() - (2.0 * t).cos()) / 0.01;
        let (z, force) = cells(n, (2.0 * t).sin(), force);
        [t.to_string(), z, force]
    };
    (0..1000).map(row).collect()
}

fn run(files: &[(&str, String)], args: &[&str]) -> Output {
    let directory = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(directory.path().join(name), text).unwrap();
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_fsb"));
    command.current_dir(directory.path()).args(["replay", "--json"]).args(args).output().unwrap()
}

/// The same flight both ways: an axis log, and motion and input.
fn both(rows: &[[String; 3]], layout: impl Fn(String) -> String) -> [Output; 2] {
    let table = |header: &str, row: &dyn Fn(&[String; 3]) -> String| {
        layout(format!("{header}\n{}", rows.iter().map(|cells| row(cells) + "\n").collect::<String>()))
    };
    let log = table("t,z,fz", &|[t, z, force]| format!("{t},{z},{force}"));
    let motion = table("t,x,y,z,qw,qx,qy,qz", &|[t, z, _]| format!("{t},0,0,{z},1,0,0,0"));
    let input = table("t,thrust_N", &|[t, _, force]| format!("{t},{force}"));
    let pair = [("motion.csv", motion), ("input.csv", input)];
    [run(&[("log.csv", log)], &["log.csv"]), run(&pair, &["--motion", "motion.csv", "--input", "input.csv"])]
}

fn mass(output: &Output) -> (f64, u64) {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    (json["mass"]["value"].as_f64().unwrap(), json["missed"].as_u64().unwrap())
}

fn plain(_: usize, z: f64, force: f64) -> (String, String) {
    (z.to_string(), force.to_string())
}

/// Many tools write what was not measured as `nan`, some leave the cell empty.
#[test]
fn a_measurement_that_is_no_number_was_missed() {
    let gap = |missing: &'static str| {
        let cells = move |n: usize, z: f64, force: f64| {
            let lost = n % 10 == 7 || (300..320).contains(&n);
            (if lost { missing.to_owned() } else { z.to_string() }, force.to_string())
        };
        both(&rows(cells), |text| text)
    };
    let empty = gap("");
    for missing in ["nan", "NaN", "-nan"] {
        for (found, expected) in gap(missing).iter().zip(&empty) {
            assert_eq!(found.stdout, expected.stdout, "{missing}");
            assert!((mass(found).0 - 1.0).abs() < 1e-4);
        }
    }
    assert_eq!(mass(&empty[0]).1, 118, "a tenth, and 20 more of which two are in the tenth");
}

/// What the motors did then is not known: nothing is guessed in silence.
#[test]
fn an_input_that_is_no_number_is_refused() {
    let cells = |n: usize, z: f64, force: f64| (z.to_string(), if n == 500 { "nan".into() } else { force.to_string() });
    for (output, place) in
        both(&rows(cells), |text| text).iter().zip(["log.csv:502: column fz", "input.csv:502: column thrust_N"])
    {
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains(&format!("error: {place}: found `nan`, expected a finite number")), "{stderr}");
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    }
}

/// An axis log has one input a row; in a file of set-points an empty cell is one at which nothing new was set.
#[test]
fn an_empty_input() {
    let cells =
        |n: usize, z: f64, force: f64| (z.to_string(), if n == 500 { String::new() } else { force.to_string() });
    let [log, pair] = both(&rows(cells), |text| text);
    let stderr = String::from_utf8_lossy(&log.stderr);
    assert!(stderr.contains("log.csv:502: column fz: found an empty cell, expected a number"), "{stderr}");
    assert_eq!(log.status.code(), Some(2));
    assert!((mass(&pair).0 - 1.0).abs() < 1e-3);
}

#[test]
fn semicolons_and_tabs_separate_too() {
    let expected = both(&rows(plain), |text| text);
    for separator in [";", "\t", " ; "] {
        for (found, expected) in both(&rows(plain), |text| text.replace(',', separator)).iter().zip(&expected) {
            assert_eq!(found.stdout, expected.stdout, "{separator:?}: {}", String::from_utf8_lossy(&found.stderr));
        }
    }
    let decimal = both(&rows(plain), |text| text.replace(',', ";").replace('.', ","));
    for output in &decimal {
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains("expected a number with a decimal point"), "{stderr}");
        assert_eq!(output.status.code(), Some(2));
    }
}

/// A flight of hours is not replayed first and lost then.
#[test]
fn a_folder_that_cannot_be_is_told_before_the_work() {
    let rows: String = rows(plain).iter().map(|cells| cells.join(",") + "\n").collect();
    let files = [("log.csv", format!("t,z,fz\n{rows}")), ("file", String::new())];
    let output = run(&files, &["log.csv", "--out", "file/out"]);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(stderr, "error: cannot write file/out: not a directory\n");
    assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0));
}
