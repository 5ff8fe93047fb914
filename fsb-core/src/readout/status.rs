//! What became of a parameter.

use crate::snapshot::{Archive, Stored};
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
    /// k̂ is below the configured range.
    BelowRange,
    /// k̂ is above the configured range.
    AboveRange,
    /// The model does not explain the motion: in contact with the ground, a motor that does not obey, a wrong input.
    Contradicted,
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
            Self::BelowRange => "below its range",
            Self::AboveRange => "above its range",
            Self::Contradicted => "contradicted by the motion",
            Self::Valid => "valid",
            Self::Held => "held",
        })
    }
}

impl Stored for ParameterStatus {
    fn pass(&mut self, archive: &mut dyn Archive) {
        let mut code = *self as u8;
        code.pass(archive);
        match code {
            0 => *self = Self::Settling,
            1 => *self = Self::Unexcited,
            2 => *self = Self::Uncertain,
            3 => *self = Self::BelowRange,
            4 => *self = Self::AboveRange,
            5 => *self = Self::Contradicted,
            6 => *self = Self::Valid,
            7 => *self = Self::Held,
            _ => archive.refuse(),
        }
    }
}
