//! `fsb exactness` as a process.

use serde_json::Value;
use std::process::{Command, Output};

fn fsb(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fsb")).arg("exactness").args(arguments).output().unwrap()
}

/// The limits are those of the requirement, and every way of sampling keeps them.
#[test]
fn every_case_is_within_the_limits() {
    let output = fsb(&["--json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let cases = json["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 13);
    for case in cases {
        for (name, limit) in [
            ("k", 5e-6),
            ("k_late", 1e-6),
            ("position", 5e-7),
            ("velocity", 2e-6),
            ("position_known_k", 5e-7),
            ("velocity_known_k", 2e-6),
        ] {
            let (max, rms) = (case[name]["max"].as_f64().unwrap(), case[name]["rms"].as_f64().unwrap());
            // Rounding leaves something, or nothing was flown.
            assert!(0.0 < rms && rms <= max && max <= limit, "{name} in {case}");
        }
    }
    let has = |rate: f64, control: f64, block: u64, axes: u64| {
        cases.iter().any(|case| {
            case["measurement_hz"] == rate
                && case["control_hz"] == control
                && case["block"] == block
                && case["axes"] == axes
        })
    };
    assert!(has(50.0, 50.0, 1, 1) && has(1e3, 1e3, 1, 1) && has(8e3, 8e3, 1, 1));
    assert!(has(1e3, 1e4, 1, 1) && has(8e3, 8e3, 40, 1) && has(1e3, 1e3, 10, 3));
}

#[test]
fn the_table_names_units_and_limits() {
    let output = fsb(&[]);
    let out = String::from_utf8(output.stdout).unwrap();
    for part in ["measured [Hz]", "position [m]", "velocity [m/s]", "limit", "5×10⁻⁷", "2×10⁻⁶"] {
        assert!(out.contains(part), "{part} is missing in\n{out}");
    }
}

#[test]
fn help_and_wrong_arguments() {
    assert!(String::from_utf8(fsb(&["--help"]).stdout).unwrap().contains("exact plants"));
    assert_eq!(fsb(&["--jsn"]).status.code(), Some(2));
}
