//! The estimates sample by sample, as CSV.

use super::feed::ParameterTrace;
use super::log::AxisLog;
use super::result::ReplayResult;
use super::summary::about;
use std::fmt::Write as _;

/// `estimates.csv`: `t`; per axis `<axis>_hat` \[m or rad\] and `<axis>_rate_hat` \[m/s or rad/s\]; `mass_hat` and `mass_sd`
/// \[kg\] if a translational axis is present; `inertia_<x, y or z>_hat` and `_sd` \[kg m²\] of the rotational ones.
///
/// Empty where not valid. Each number has the fewest digits that give back the same f32; `t` \[s\] is rounded to 1e-9.
pub fn to_csv(result: &ReplayResult, log: &AxisLog) -> String {
    let mut parameters: Vec<(String, &ParameterTrace)> = Vec::new();
    parameters.extend(result.mass.as_ref().map(|trace| ("mass".to_owned(), trace)));
    parameters.extend(result.rotational().map(|a| (format!("inertia_{}", about(a)), &a.own)));

    let mut out = String::from("t");
    for axis in &result.axes {
        let name = axis.axis.name();
        // Writing to a String cannot fail, here and below.
        let _ = write!(out, ",{name}_hat,{name}_rate_hat");
    }
    for (name, _) in &parameters {
        let _ = write!(out, ",{name}_hat,{name}_sd");
    }
    out.push('\n');
    for n in 0..log.len() {
        let _ = write!(out, "{}", to_nanoseconds(log.time(n)));
        for axis in &result.axes {
            let state = axis.trace.state.get(n).copied().flatten();
            pair(&mut out, state.map(|s| (s.position, s.velocity)));
        }
        for (_, trace) in &parameters {
            let value = trace.value.get(n).copied().flatten();
            pair(&mut out, value.map(|k| k.inverse_with_sd()));
        }
        out.push('\n');
    }
    out
}

fn pair(out: &mut String, values: Option<(f32, f32)>) {
    let _ = match values {
        Some((first, second)) => write!(out, ",{first},{second}"),
        None => write!(out, ",,"),
    };
}

/// 0.3, not 0.30000000000000004.
fn to_nanoseconds(t: f64) -> f64 {
    (t * 1e9).round() / 1e9
}
