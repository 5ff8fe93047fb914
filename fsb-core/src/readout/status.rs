//! What became of a parameter.

use core::fmt;

/// Whether k̂ may be used, and why not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ParameterStatus {
    /// Less than the configured time has passed since the last reset.
    #[default]
    Settling,
    /// The input has been zero: nothing can be said.
    Unexcited,
    /// The standard deviation is above the configured share of k̂.
    Uncertain,
    /// k̂ is outside the configured range.
    OutOfRange,
    /// Usable.
    Valid,
    /// Identified anew since a re-initialisation, and not valid yet: the value from before it stands in.
    Held,
}

impl fmt::Display for ParameterStatus {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Settling => "settling",
            Self::Unexcited => "unexcited",
            Self::Uncertain => "uncertain",
            Self::OutOfRange => "out of range",
            Self::Valid => "valid",
            Self::Held => "held",
        })
    }
}
