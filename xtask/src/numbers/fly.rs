//! What simulated flights of the hexarotor come to.

use anyhow::Result;
use serde_json::Value;

use super::measured::fsb;
use super::tables::number;

/// The scenarios with one flight each, and what is set beside.
const SCENARIOS: [(&str, &[&str]); 12] = [
    ("aggressive", &[]),
    (
        "aggressive, 0.3°, 10 mm, 200 Hz",
        &["rate=200", "sensors.attitude.noise_sd=0.00524", "sensors.position.noise_sd=0.01"],
    ),
    ("spiral", &[]),
    ("hover", &[]),
    ("payload-pickup", &[]),
    ("payload-drop", &[]),
    ("wind", &[]),
    ("slow-position", &[]),
    ("latency", &[]),
    ("dropouts", &[]),
    ("outliers", &[]),
    ("bit-faults", &[]),
];

/// Parameters, tracking beside the yardstick, velocity.
pub fn scenarios() -> Result<String> {
    let mut table = String::from(
        "| scenario | mass, worst from 3 s (%) | inertias, worst from 3 s (%) | distance from the reference, rms (mm) | of the yardstick (mm) | largest height error (mm) | velocity, rms error (mm/s) |\n|---|---|---|---|---|---|---|\n",
    );
    for (name, settings) in SCENARIOS {
        let scenario = name.split(',').next().unwrap_or(name);
        let mut arguments = vec!["fly", "--scenario", scenario, "--json"];
        for setting in settings {
            arguments.extend(["--set", setting]);
        }
        let json = flown(&arguments)?;
        let (tracking, state) = (&json["tracking"], &json["state"]);
        table += &format!(
            "| {name} | {} | {} | {:.2} | {:.2} | {:.1} | {:.1} |\n",
            worst(&json, &["mass"]),
            worst(&json, &["ixx", "iyy", "izz"]),
            1e3 * number(&tracking["position_rms"])?,
            1e3 * number(&tracking["yardstick_position_rms"])?,
            1e3 * number(&tracking["height_error_max"])?,
            1e3 * number(&state["velocity_rms"])?,
        );
    }
    Ok(table)
}

/// The spread over many flights.
pub fn random() -> Result<String> {
    let json = flown(&["fly", "--scenario", "random", "--runs", "2000", "--json"])?;
    let mut table = format!(
        "| {} flights, {} diverged | 5 % | median | 95 % | smallest | largest |\n|---|---|---|---|---|---|\n",
        json["runs"], json["diverged"]
    );
    for (key, name) in [("mass", "mass (%)"), ("ixx", "I_x (%)"), ("iyy", "I_y (%)"), ("izz", "I_z (%)")] {
        let of = &json["distribution"][key];
        table += &format!("| error of the {name} ");
        for part in ["p05", "median", "p95", "min", "max"] {
            table += &format!("| {:.3} ", number(&of[part])?);
        }
        table += "|\n";
    }
    Ok(table)
}

/// Without a report.
fn flown(arguments: &[&str]) -> Result<Value> {
    let folder = std::env::temp_dir().join(format!("fsb-numbers-fly-{}", std::process::id()));
    let out = folder.to_string_lossy();
    let json = fsb(&[arguments, &["--out", &out]].concat());
    let _ = std::fs::remove_dir_all(&folder);
    json
}

/// The largest error from 3 s on where there is one, after a change of load only from 1 s after it.
fn worst(json: &Value, names: &[&str]) -> String {
    let changes: Vec<f64> = json["events"]
        .as_array()
        .into_iter()
        .flatten()
        .filter(|event| event["what"].as_str().is_some_and(|what| what.starts_with("payload")))
        .filter_map(|event| event["t"].as_f64())
        .collect();
    let mut worst: Option<f64> = None;
    for row in json["errors"].as_array().into_iter().flatten() {
        let Some(t) = row["t"].as_f64() else { continue };
        if t < 3.0 || changes.iter().any(|at| (*at..at + 1.0).contains(&t)) {
            continue;
        }
        for error in names.iter().filter_map(|name| row[*name].as_f64()) {
            worst = Some(worst.map_or(error.abs(), |worst: f64| worst.max(error.abs())));
        }
    }
    worst.map_or_else(|| "not excited".to_owned(), |worst| format!("{worst:.3}"))
}
