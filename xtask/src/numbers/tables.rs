//! Results as Markdown.

use anyhow::{Context, Result};
use serde_json::Value;

/// A number, or what stands there instead as an error.
pub fn number(value: &Value) -> Result<f64> {
    value.as_f64().with_context(|| format!("{value} is no number"))
}

/// The entries of a list.
pub fn rows(value: &Value) -> Result<&[Value]> {
    value.as_array().map(Vec::as_slice).with_context(|| format!("{value} is no list"))
}

/// Table 1 of the paper.
pub fn table1(paper: &Value) -> Result<String> {
    let mut table = String::from(
        "| at 10 s | true | `fsb` | error of `fsb` (%) | error in the paper (%) |\n|---|---|---|---|---|\n",
    );
    let names = [
        ("k", "k (1/kg)"),
        ("x", "x (m)"),
        ("y", "y (m)"),
        ("x_rate", "velocity along x (m/s)"),
        ("y_rate", "velocity along y (m/s)"),
    ];
    for row in rows(&paper["table1"])? {
        let name = names.iter().find(|(key, _)| row["name"] == *key).context("an unknown row of Table 1")?.1;
        table += &format!(
            "| {name} | {:.4} | {:.4} | {:.3} | {:.3} |\n",
            number(&row["true"])?,
            number(&row["estimated"])?,
            number(&row["error_percent"])?,
            number(&row["paper_error_percent"])?,
        );
    }
    Ok(table)
}

/// The loops of the core and of the paper's form.
pub fn closed_loop(paper: &Value) -> Result<String> {
    let mut table = format!(
        "| {} flights, {} Hz | k at 10 s: sd of error (1/kg) | mean error (1/kg) | position rms, 2-10 s (m) | velocity rms (m/s) |\n|---|---|---|---|---|\n",
        paper["runs"],
        number(&paper["rate_hz"])?,
    );
    for (key, name) in [("core", "the f32 core"), ("paper_form", "the paper's equations, f64")] {
        let of = &paper[key];
        table += &format!(
            "| {name} | {:.5} | {:.5} | {:.4} | {:.4} |\n",
            number(&of["k_error_sd"])?,
            number(&of["k_error_mean"])?,
            number(&of["position_rms"])?,
            number(&of["velocity_rms"])?,
        );
    }
    Ok(table)
}

/// The spread of k against the best possible one.
pub fn efficiency(json: &Value) -> Result<String> {
    let mut table = format!(
        "| {} runs, {} Hz, {} m noise | sd of k (1/kg) | Cramér-Rao bound (1/kg) | ratio | 2 reported sd hold the truth (%) |\n|---|---|---|---|---|\n",
        json["runs"],
        number(&json["rate_hz"])?,
        number(&json["sigma"])?,
    );
    for row in rows(&json["times"])? {
        table += &format!(
            "| {} s | {:.2e} | {:.2e} | {:.2} | {:.1} |\n",
            number(&row["t"])?,
            number(&row["k_error_sd"])?,
            number(&row["cramer_rao_sd"])?,
            number(&row["ratio"])?,
            100.0 * number(&row["coverage"])?,
        );
    }
    Ok(table)
}

/// A choice of the cases: each rate, control faster than measurement, block means, three axes.
pub fn in_short(case: &Value) -> bool {
    let plain = case["measurement_hz"] == case["control_hz"] && case["axes"] == 1 && case["block"] == 1;
    let fast = case["control_hz"] == 10_000.0;
    let blocks = case["block"] == 40 && case["axes"] == 1;
    plain || fast || blocks || (case["block"] == 10 && case["axes"] == 3)
}

/// Errors that rounding leaves, of the cases that are `wanted`: largest / rms.
pub fn exactness(json: &Value, wanted: &dyn Fn(&Value) -> bool) -> Result<String> {
    let mut table = String::from(
        "| measured, control (Hz) | block | axes | k from 0.1 s | k from 1 s | position (m) | velocity (m/s) | velocity, k known (m/s) |\n|---|---|---|---|---|---|---|---|\n",
    );
    for case in rows(&json["cases"])?.iter().filter(|case| wanted(case)) {
        table += &format!(
            "| {}, {} | {} | {} ",
            number(&case["measurement_hz"])?,
            number(&case["control_hz"])?,
            case["block"],
            case["axes"],
        );
        for name in ["k", "k_late", "position", "velocity", "velocity_known_k"] {
            table += &format!("| {:.1e} / {:.1e} ", number(&case[name]["max"])?, number(&case[name]["rms"])?);
        }
        table += "|\n";
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn numbers_in_their_places() {
        let paper = json!({ "runs": 100, "rate_hz": 1e4, "table1": [
            { "name": "k", "true": 2.0, "estimated": 1.5, "error_percent": 25.0, "paper_error_percent": 0.0319 } ],
            "core": { "k_error_sd": 1e-3, "k_error_mean": -2e-4, "position_rms": 0.01, "velocity_rms": 0.02 },
            "paper_form": { "k_error_sd": 1.0, "k_error_mean": 2.0, "position_rms": 3.0, "velocity_rms": 4.0 } });
        assert!(table1(&paper).unwrap().ends_with("| k (1/kg) | 2.0000 | 1.5000 | 25.000 | 0.032 |\n"));
        let text = closed_loop(&paper).unwrap();
        assert!(text.starts_with("| 100 flights, 10000 Hz |"));
        assert!(text.contains("| the f32 core | 0.00100 | -0.00020 | 0.0100 | 0.0200 |\n"));
    }

    #[test]
    fn a_missing_number_is_an_error() {
        assert!(number(&Value::Null).is_err());
        assert!(table1(&json!({})).is_err());
        assert!(exactness(&json!({ "cases": [{ "measurement_hz": 50.0 }] }), &|_| true).is_err());
    }
}
