//! What recorded flights say, where `FSB_FLIGHT_DATA` names a folder of them.

use std::path::PathBuf;

use anyhow::Result;
use serde_json::Value;

use super::measured::fsb;
use super::tables::number;

/// File, vehicle, mass on the scales in g.
const FLIGHTS: [(&str, &str, &str); 4] = [
    ("crazyflie_brushless_37.0g", "Crazyflie, brushless", "37.0"),
    ("crazyflie_brushed_34.7g", "Crazyflie, brushed", "34.7"),
    ("crazyflie_payload_44.4g", "Crazyflie, load on a cable", "44.4"),
    ("nanobench_lissajous_fast", "Crazyflie, thrust known to a factor", "not known"),
];

fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("FSB_FLIGHT_DATA").filter(|folder| !folder.is_empty());
    if folder.is_none() {
        println!("FSB_FLIGHT_DATA is not set: numbers of recorded flights are not checked");
    }
    folder.map(PathBuf::from)
}

/// What drag and a constant disturbance explain; `None` without recordings.
pub fn drag() -> Result<Option<String>> {
    let Some(folder) = folder() else { return Ok(None) };
    let mut table = String::from(
        "| flight | residual, k only (m/s²) | k and drag | k, drag, disturbance | mass (g) | drag along x, y (1/s) | velocity x, y with them (m/s) | without |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (file, vehicle, _) in FLIGHTS {
        let log = folder.join("flights").join(format!("{file}.csv"));
        let replayed = |what| fsb(&["replay", &log.to_string_lossy(), "--identify", what, "--json"]);
        let (k, drag, all) = (replayed("k")?, replayed("k,drag")?, replayed("k,drag,disturbance")?);
        let pair = |json: &Value, key: &str| -> String {
            let both = ["x", "y"].map(|axis| match json["axes"][axis][key].as_f64() {
                Some(value) => format!("{value:.3}"),
                None => "not observable".to_owned(),
            });
            both.join(", ")
        };
        table += &format!("| {vehicle} ");
        for json in [&k, &drag, &all] {
            table += &format!("| {:.4} ", number(&json["residual_rms"])?);
        }
        table += &format!(
            "| {:.2} | {} | {} | {} |\n",
            1e3 * number(&all["mass"]["value"])?,
            pair(&all, "drag"),
            pair(&all, "velocity_rms_error"),
            pair(&k, "velocity_rms_error"),
        );
    }
    Ok(Some(table))
}

/// Masses and velocity errors; `None` without recordings.
pub fn table() -> Result<Option<String>> {
    let Some(folder) = folder() else { return Ok(None) };
    let mut table = String::from(
        "| flight | weighed (g) | `mass` (g) | `sd` (g) | x, y, z velocity, rms difference (m/s) |\n|---|---|---|---|---|\n",
    );
    for (file, vehicle, weighed) in FLIGHTS {
        let log = folder.join("flights").join(format!("{file}.csv"));
        let json = fsb(&["replay", &log.to_string_lossy(), "--json"])?;
        let velocity = ["x", "y", "z"].map(|axis| number(&json["axes"][axis]["velocity_rms_error"]));
        let [x, y, z] = velocity;
        table += &format!(
            "| {vehicle} | {weighed} | {:.2} | {:.3} | {:.3}, {:.3}, {:.3} |\n",
            1e3 * number(&json["mass"]["value"])?,
            1e3 * number(&json["mass"]["sd"])?,
            x?,
            y?,
            z?,
        );
    }
    Ok(Some(table))
}
