//! What came out, as one JSON object.

use super::feed::ParameterTrace;
use super::result::{AxisResult, ReplayResult};
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The JSON object of `fsb replay --json`. Values are those at the last sample; null where not valid.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Summary {
    /// Time step \[s\].
    pub period_s: f64,
    /// Rows of the log.
    pub samples: usize,
    /// Empty positions, over all axes.
    pub missed: usize,
    /// From x, y and z pooled \[kg\]; null where the log has no translational axis.
    pub mass: Option<Inverse>,
    /// Each axis by itself.
    pub axes: Named<AxisSummary>,
    /// Of the rotational axes present \[kg m²\], by the names x, y, z.
    pub inertia: Named<Inverse>,
}

/// 1/k̂ and its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Inverse {
    /// Mass \[kg\] or moment of inertia \[kg m²\].
    pub value: Option<f32>,
    /// Its standard deviation as far as measurement noise causes it.
    pub sd: Option<f32>,
    /// Whether it may be used.
    pub valid: bool,
}

/// k̂ from one axis alone.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct AxisSummary {
    /// k̂ \[1/kg or 1/(kg m²)\].
    pub k: Option<f32>,
    /// Its standard deviation.
    pub k_sd: Option<f32>,
    /// Whether it may be used.
    pub valid: bool,
    /// Root mean square of v̂ minus the reference \[m/s or rad/s\]; null without a reference.
    pub velocity_rms_error: Option<f64>,
}

/// A JSON object that keeps the order of its entries.
#[derive(Clone, Debug, PartialEq)]
pub struct Named<T>(pub Vec<(&'static str, T)>);

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, value) in &self.0 {
            map.serialize_entry(name, value)?;
        }
        map.end()
    }
}

impl<T> Named<T> {
    /// The entry of this name.
    pub fn get(&self, name: &str) -> Option<&T> {
        self.0.iter().find(|(n, _)| *n == name).map(|(_, value)| value)
    }
}

impl Inverse {
    /// 1/k̂ at the last sample of `trace`.
    pub fn last_of(trace: &ParameterTrace) -> Self {
        let last = trace.last().map(|k| k.inverse_with_sd());
        Self { value: last.map(|(value, _)| value), sd: last.map(|(_, sd)| sd), valid: last.is_some() }
    }
}

impl From<&AxisResult> for AxisSummary {
    fn from(axis: &AxisResult) -> Self {
        let last = axis.own.last();
        Self {
            k: last.map(|k| k.value),
            k_sd: last.map(|k| k.sd()),
            valid: last.is_some(),
            velocity_rms_error: axis.velocity_rms_error,
        }
    }
}

impl From<&ReplayResult> for Summary {
    fn from(result: &ReplayResult) -> Self {
        Self {
            period_s: result.period,
            samples: result.samples,
            missed: result.missed,
            mass: result.mass.as_ref().map(Inverse::last_of),
            axes: Named(result.axes.iter().map(|a| (a.axis.name(), a.into())).collect()),
            inertia: Named(result.rotational().map(|a| (about(a), Inverse::last_of(&a.own))).collect()),
        }
    }
}

/// The body axis that a rotational axis turns about.
pub(super) fn about(axis: &AxisResult) -> &'static str {
    match axis.axis.name() {
        "roll" => "x",
        "pitch" => "y",
        _ => "z",
    }
}
