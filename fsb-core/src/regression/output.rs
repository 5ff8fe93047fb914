//! What a [`super::DragEstimator`] hands out.

/// One identified term of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Term {
    /// The configuration does not ask for it; it counts as zero.
    #[default]
    NotAsked,
    /// The data do not tell, or k̂ is not valid; it counts as zero, within what the configuration says it may be.
    NotObservable,
    /// Told from k and from the other terms.
    Known {
        /// D in 1/s or d in m/s².
        value: f32,
        /// Its standard deviation, in which that of k̂ is included.
        sd: f32,
    },
}

impl Term {
    /// The value, where it is known.
    pub const fn value(self) -> Option<f32> {
        match self {
            Self::Known { value, .. } => Some(value),
            _ => None,
        }
    }
}

/// What has been identified on an axis besides k: y'' = k f - D y' + c + d.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AxisTerms {
    /// D (1/s); positive where it brakes.
    pub drag: Term,
    /// d (m/s²), beyond the known drift c.
    pub disturbance: Term,
}

/// The regression's inner signals in physical units: for logs and tests, not for control.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DragDiagnostics {
    /// ẑ2 with the known drift removed: windowed, filtered acceleration (m/s²).
    pub z2: f32,
    /// ẑ0: windowed, filtered input (N).
    pub z0: f32,
    /// ẑv: windowed, filtered velocity (m/s).
    pub zv: f32,
    /// ẑu: windowed, filtered one.
    pub zu: f32,
    /// ẑ2 - k ẑ0 + D ẑv - d ẑu with what is used at present (m/s²); zero while k̂ is not credible.
    pub residual: f32,
    /// The observer's innovation y - ŷ⁻ at the last measurement (m).
    pub innovation: f32,
}
