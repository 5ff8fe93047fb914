//! The estimates sample by sample, as CSV.

use super::feed::ParameterTrace;
use super::log::AxisLog;
use super::result::ReplayResult;
use super::summary::about;
use std::fmt::Write as _;

/// `estimates.csv`: `t`; per axis `<axis>_hat` \[m or rad\] and `<axis>_rate_hat` \[m/s or rad/s\]; `mass_hat` and `mass_sd`
/// \[kg\] if a translational axis is present, or `hover_thrust_hat` and `hover_thrust_sd`, g/k̂ as a share of the full thrust, where
/// `hovering` gives the gravity g \[m/s²\]; `inertia_<x, y or z>_hat` and `_sd` \[kg m²\] of the rotational ones.
///
/// Empty where not valid. Each number has the fewest digits that give back the same f32; `t` \[s\] is rounded to 1e-9.
pub fn to_csv(result: &ReplayResult, log: &AxisLog, hovering: Option<f64>) -> String {
    let mut parameters: Vec<(String, &ParameterTrace, Option<f64>)> = Vec::new();
    let name = if hovering.is_some() { "hover_thrust" } else { "mass" };
    parameters.extend(result.mass.as_ref().map(|trace| (name.to_owned(), trace, hovering)));
    parameters.extend(result.rotational().map(|a| (format!("inertia_{}", about(a)), &a.own, None)));

    let mut out = String::from("t");
    for axis in &result.axes {
        let name = axis.axis.name();
        // Writing to a String cannot fail, here and below.
        let _ = write!(out, ",{name}_hat,{name}_rate_hat");
    }
    for (name, ..) in &parameters {
        let _ = write!(out, ",{name}_hat,{name}_sd");
    }
    out.push('\n');
    for n in 0..log.len() {
        let _ = write!(out, "{}", to_nanoseconds(log.time(n)));
        for axis in &result.axes {
            let state = axis.trace.state.get(n).copied().flatten();
            pair(&mut out, state.map(|s| (s.position, s.velocity)));
        }
        for (_, trace, factor) in &parameters {
            let value = trace.value.get(n).copied().flatten().map(|k| k.inverse_with_sd());
            let times = |x: f32| factor.map_or(x, |factor| (factor * f64::from(x)) as f32);
            pair(&mut out, value.map(|(value, sd)| (times(value), times(sd))));
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
