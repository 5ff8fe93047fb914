//! Bad input and faults, from `fsb faults --json`, as Markdown.

use anyhow::{Context, Result};
use serde_json::Value;

use super::tables::{number, rows};

/// One bad value, bare and behind the gate. Values with the same outcome share a row.
pub fn recovery(values: &Value) -> Result<String> {
    let mut groups: Vec<(String, Vec<&str>)> = Vec::new();
    for row in rows(values)? {
        let name = row["value"].as_str().context("a value without a name")?;
        let outcome = format!("{} | {}", outcome(&row["guarded"])?, outcome(&row["bare"])?);
        match groups.iter_mut().find(|(of, _)| *of == outcome) {
            Some((_, names)) => names.push(name),
            None => groups.push((outcome, vec![name])),
        }
    }
    let mut table = String::from(
        "| value | `Guarded`: used | v off (m/s) | k off | back after (ticks) | `Estimator`: used | v off (m/s) | k off | back after (ticks) |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (outcome, names) in groups {
        table += &format!("| {} | {outcome} |\n", names.join(", "));
    }
    Ok(table)
}

fn outcome(of: &Value) -> Result<String> {
    let used = if of["used"].as_bool().context("used or not?")? { "yes" } else { "no" };
    let ticks = of["ticks"].as_u64().map_or(String::from("not in 2000"), |ticks| ticks.to_string());
    let k = of["k"].as_f64().map_or(String::from("withdrawn"), |k| format!("{k:.1e}"));
    Ok(format!("{used} | {:.1e} | {k} | {ticks}", number(&of["velocity"])?))
}

/// A second of each kind of fault.
pub fn bursts(bursts: &Value) -> Result<String> {
    let mut table = String::from(
        "| fault | for a second | not used (%) | v off meanwhile (m/s) | N (ticks) | v off from then on (m/s) | E (m/s) | k off |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for of in rows(bursts)? {
        let text = |key: &str| of[key].as_str().with_context(|| format!("a burst without {key}"));
        table += &format!(
            "| {} | {} | {:.0} | {:.1e} | {} | {:.1e} | {} | {:.0e} |\n",
            text("name")?,
            text("what")?,
            100.0 * number(&of["unused"])?,
            number(&of["velocity_during"])?,
            of["ticks"],
            number(&of["velocity_after"])?,
            of["limit"],
            number(&of["k"])?,
        );
    }
    Ok(table)
}

/// Sampling instants that jitter: one row a share, one column a rate and noise.
pub fn jitter(effects: &Value) -> Result<String> {
    let effects = rows(effects)?;
    let first = effects.first().context("no jitter at all")?;
    let mut header = String::from("| ± % of a period |");
    let mut line = String::from("\n|---|");
    for of in effects.iter().filter(|of| of["percent"] == first["percent"]) {
        let (rate, noise) = (number(&of["rate_hz"])?, 1e3 * number(&of["noise"])?);
        header += &format!(" {rate:.0} Hz, {noise:.0} mm: v off, rms (m/s) | worst | k off |");
        line += "---|---|---|";
    }
    let mut table = header + &line + "\n";
    for share in effects.iter().filter(|of| of["rate_hz"] == first["rate_hz"] && of["noise"] == first["noise"]) {
        table += &format!("| {} |", number(&share["percent"])?);
        for of in effects.iter().filter(|of| of["percent"] == share["percent"]) {
            let [rms, worst, k] = ["velocity_rms", "velocity_worst", "k"].map(|key| number(&of[key]));
            table += &format!(" {:.1e} | {:.1e} | {:.0e} |", rms?, worst?, k?);
        }
        table += "\n";
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_same_outcome_shares_a_row() {
        let none = json!({ "used": false, "velocity": 1e-3, "k": 2e-6, "ticks": 7 });
        let never = json!({ "used": true, "velocity": 2.0, "k": 0.5, "ticks": null });
        let table = recovery(&json!([
            { "value": "NaN", "guarded": none, "bare": none },
            { "value": "9e4", "guarded": none, "bare": never },
            { "value": "inf", "guarded": none, "bare": none },
        ]));
        let table = table.unwrap();
        assert!(table.contains("| NaN, inf | no | 1.0e-3 | 2.0e-6 | 7 | no | 1.0e-3 | 2.0e-6 | 7 |\n"), "{table}");
        assert!(
            table.ends_with("| 9e4 | no | 1.0e-3 | 2.0e-6 | 7 | yes | 2.0e0 | 5.0e-1 | not in 2000 |\n"),
            "{table}"
        );
        assert!(recovery(&json!([{ "value": "NaN" }])).is_err());
    }

    #[test]
    fn a_column_a_rate() {
        let of = |percent: f64, rate: f64| json!({ "percent": percent, "rate_hz": rate, "noise": 1e-3, "velocity_rms": 0.5, "velocity_worst": 1.0, "k": 1e-6 });
        let table = jitter(&json!([of(1.0, 100.0), of(5.0, 100.0), of(1.0, 1e3), of(5.0, 1e3)])).unwrap();
        assert!(table.starts_with("| ± % of a period | 100 Hz, 1 mm: v off"));
        assert!(table.ends_with("| 5 | 5.0e-1 | 1.0e0 | 1e-6 | 5.0e-1 | 1.0e0 | 1e-6 |\n"), "{table}");
    }
}
