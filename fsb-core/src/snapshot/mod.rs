//! The whole state of an estimator as plain bytes, and back: to log and replay, to start warm.
//!
//! ```text
//! "FSB" | version | kind | N | P | 0 | length of the state (u32) | fingerprint of the design (u32) | state | CRC-32 of all before
//! ```
//!
//! All numbers little-endian. A snapshot fits only an estimator of the same shape and the same configuration; every field is
//! checked before anything is taken, and an estimator that refuses a snapshot stays as it was. After
//! [`restore`](crate::Estimator::restore) every later call gives the same bits as on the estimator it was taken from.
//! [`Estimator`](crate::Estimator), [`Guarded`](crate::guard::Guarded) and
//! [`VehicleEstimator`](crate::vehicle::VehicleEstimator) have them; both calls need stack for a copy of the state.
//!
//! | file | what |
//! |---|---|
//! | `archive` | writing and reading the fields of a state in their order |
//! | `frame` | header and checksum |
//! | `fields` | which fields each state has |
//! | `whole` | `snapshot` and `restore` |

mod archive;
mod fields;
mod frame;
pub(crate) mod whole;

pub(crate) use archive::{Archive, MOST, Stored, stored};
pub(crate) use whole::{Fingerprint, Whole, snapshots};

use core::fmt;

/// A snapshot could not be taken, or was refused; nothing has changed then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SnapshotError {
    /// The buffer is shorter than [`snapshot_length`](crate::Estimator::snapshot_length).
    BufferTooShort,
    /// Not a snapshot of this project.
    NotASnapshot,
    /// Of another version.
    Version(u8),
    /// Of an estimator with other numbers of axes or parameters, or of another length.
    Shape,
    /// Of an estimator configured otherwise.
    Design,
    /// The checksum does not match.
    Corrupt,
    /// A field holds what no estimator can hold.
    OutOfBounds,
}

impl fmt::Display for SnapshotError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BufferTooShort => out.write_str("the buffer is too short for a snapshot"),
            Self::NotASnapshot => out.write_str("not a snapshot"),
            Self::Version(version) => write!(out, "a snapshot of version {version}"),
            Self::Shape => out.write_str("a snapshot of an estimator of another shape"),
            Self::Design => out.write_str("a snapshot of an estimator configured otherwise"),
            Self::Corrupt => out.write_str("a snapshot whose checksum does not match"),
            Self::OutOfBounds => out.write_str("a snapshot with a field out of bounds"),
        }
    }
}

impl core::error::Error for SnapshotError {}
