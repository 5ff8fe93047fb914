//! What came out, as one JSON object.

use super::feed::ParameterTrace;
use super::flight::ThrustUnit;
use super::recording::Recording;
use super::result::{AxisResult, ReplayResult};
use fsb_core::regression::{AxisTerms, Term};
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The JSON object of `fsb replay --json`. Values are those at the last sample; null where not valid.
#[derive(Clone, Debug, PartialEq)]
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
    /// In place of `mass`, where the input is a share of the full thrust.
    pub hover_thrust: Option<HoverSummary>,
    /// What the identification leaves of the accelerations, rms \[m/s²\]; there where the identification was asked for.
    pub residual_rms: Option<Option<f64>>,
    /// By how much the input acts later than its time stamps say \[s\]; there where it was asked for.
    pub lag_s: Option<f64>,
}

impl Serialize for Summary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("period_s", &self.period_s)?;
        map.serialize_entry("samples", &self.samples)?;
        map.serialize_entry("missed", &self.missed)?;
        match &self.hover_thrust {
            Some(hover) => map.serialize_entry("hover_thrust", hover)?,
            None => map.serialize_entry("mass", &self.mass)?,
        }
        map.serialize_entry("axes", &self.axes)?;
        map.serialize_entry("inertia", &self.inertia)?;
        if let Some(rms) = &self.residual_rms {
            map.serialize_entry("residual_rms", rms)?;
        }
        if let Some(lag) = &self.lag_s {
            map.serialize_entry("lag_s", lag)?;
        }
        map.end()
    }
}

/// g/k, the thrust that hovers, as a share of the full thrust.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct HoverSummary {
    /// g/k̂.
    pub value: Option<f64>,
    /// Its standard deviation as far as measurement noise causes it.
    pub sd: Option<f64>,
    /// Whether it may be used.
    pub valid: bool,
    /// The flight controller's own, the last one of the flight that it called valid; null where the log has none.
    pub px4: Option<f64>,
}

/// D and d of one axis.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct TermsSummary {
    /// D \[1/s\].
    pub drag: Option<f32>,
    /// Its standard deviation.
    pub drag_sd: Option<f32>,
    /// Whether it was asked for and the data tell.
    pub drag_observable: bool,
    /// d \[m/s²\].
    pub disturbance: Option<f32>,
    /// Its standard deviation.
    pub disturbance_sd: Option<f32>,
    /// Whether it was asked for and the data tell.
    pub disturbance_observable: bool,
    /// As `velocity_rms_error`, of what the observer handed out on the way, while k, D and d became known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity_rms_error_on_the_way: Option<f64>,
}

impl From<AxisTerms> for TermsSummary {
    fn from(terms: AxisTerms) -> Self {
        let split = |term: Term| match term {
            Term::Known { value, sd } => (Some(value), Some(sd), true),
            _ => (None, None, false),
        };
        let (drag, drag_sd, drag_observable) = split(terms.drag);
        let (disturbance, disturbance_sd, disturbance_observable) = split(terms.disturbance);
        Self {
            drag,
            drag_sd,
            drag_observable,
            disturbance,
            disturbance_sd,
            disturbance_observable,
            velocity_rms_error_on_the_way: None,
        }
    }
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
    /// Drag and disturbance, where their identification was asked for.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub terms: Option<TermsSummary>,
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
            terms: None,
        }
    }
}

impl From<&ReplayResult> for Summary {
    fn from(result: &ReplayResult) -> Self {
        let mut axes: Vec<(&'static str, AxisSummary)> =
            result.axes.iter().map(|a| (a.axis.name(), a.into())).collect();
        if let Some(identified) = &result.identified {
            let translational = axes.iter_mut().zip(&result.axes).filter(|(_, a)| a.axis.is_translation());
            for (i, ((_, axis), found)) in translational.enumerate() {
                let on_the_way = found.velocity_rms_error_on_the_way;
                let terms = TermsSummary::from(identified.last(i));
                axis.terms = Some(TermsSummary { velocity_rms_error_on_the_way: on_the_way, ..terms });
            }
        }
        Self {
            period_s: result.period,
            samples: result.samples,
            missed: result.missed,
            mass: result.mass.as_ref().map(Inverse::last_of),
            axes: Named(axes),
            inertia: Named(result.rotational().map(|a| (about(a), Inverse::last_of(&a.own))).collect()),
            hover_thrust: None,
            residual_rms: result.identified.as_ref().map(|identified| identified.residual_rms()),
            lag_s: None,
        }
    }
}

impl TermsSummary {
    /// Neither was identified.
    const NONE: Self = Self {
        drag: None,
        drag_sd: None,
        drag_observable: false,
        disturbance: None,
        disturbance_sd: None,
        disturbance_observable: false,
        velocity_rms_error_on_the_way: None,
    };
}

impl Summary {
    /// With the entries of an identification on every axis, rotational ones included, on which there is none but k's.
    #[must_use]
    pub fn as_asked(mut self) -> Self {
        for (_, axis) in &mut self.axes.0 {
            axis.terms.get_or_insert(TermsSummary::NONE);
        }
        self.residual_rms.get_or_insert(None);
        self
    }

    /// What `recording` gave under the gravity g \[m/s²\], its lag told where `tell_lag`.
    pub fn of(result: &ReplayResult, recording: &Recording, gravity: f64, tell_lag: bool) -> Self {
        let hover = |trace: &ParameterTrace| {
            let last = trace.last().map(|k| k.inverse_with_sd());
            HoverSummary {
                value: last.map(|(value, _)| gravity * f64::from(value)),
                sd: last.map(|(_, sd)| gravity * f64::from(sd)),
                valid: last.is_some(),
                px4: recording.px4_hover(),
            }
        };
        let normalised = recording.unit == ThrustUnit::Normalised;
        Self {
            hover_thrust: result.mass.as_ref().filter(|_| normalised).map(hover),
            lag_s: tell_lag.then_some(recording.lag),
            ..Self::from(result)
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
