//! What recorded flights say, where `FSB_FLIGHT_DATA` names a folder of them.

use std::path::PathBuf;

use anyhow::Result;

use super::measured::fsb;
use super::tables::number;

/// File, vehicle, mass on the scales in g.
const FLIGHTS: [(&str, &str, &str); 4] = [
    ("crazyflie_brushless_37.0g", "Crazyflie, brushless", "37.0"),
    ("crazyflie_brushed_34.7g", "Crazyflie, brushed", "34.7"),
    ("crazyflie_payload_44.4g", "Crazyflie, load on a cable", "44.4"),
    ("nanobench_lissajous_fast", "Crazyflie, thrust known to a factor", "not known"),
];

/// Masses and velocity errors; `None` without recordings.
pub fn table() -> Result<Option<String>> {
    let Some(folder) = std::env::var_os("FSB_FLIGHT_DATA").filter(|folder| !folder.is_empty()) else {
        println!("FSB_FLIGHT_DATA is not set: numbers of recorded flights are not checked");
        return Ok(None);
    };
    let mut table = String::from(
        "| flight | weighed (g) | `mass` (g) | `sd` (g) | x, y, z velocity, rms difference (m/s) |\n|---|---|---|---|---|\n",
    );
    for (file, vehicle, weighed) in FLIGHTS {
        let log = PathBuf::from(&folder).join("flights").join(format!("{file}.csv"));
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
