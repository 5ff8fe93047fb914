//! `snapshot` and `restore` of any state whose fields are known.

use super::SnapshotError;
use super::archive::{Length, Reader, Stored, Writer};
use super::frame::{CHECKSUM, HEADER, Identity};

/// A state that can be taken out and put back.
pub(crate) trait Whole: Stored + Clone {
    /// Kind of estimator, axes, parameters.
    const SHAPE: [u8; 3];
    /// Tells configurations apart.
    fn fingerprint(&self) -> u32;
    /// Whether this design can have come to this state.
    fn is_sound(&self) -> bool;
}

pub(crate) fn length<T: Whole>(of: &T) -> usize {
    HEADER + identity(of).length as usize + CHECKSUM
}

pub(crate) fn take<T: Whole>(of: &T, into: &mut [u8]) -> Result<usize, SnapshotError> {
    let identity = identity(of);
    let length = HEADER + identity.length as usize + CHECKSUM;
    let bytes = into.get_mut(..length).ok_or(SnapshotError::BufferTooShort)?;
    if let Some((_, state)) = bytes.split_at_mut_checked(HEADER) {
        // Passing a state on needs it mutable; writing does not change it.
        of.clone().pass(&mut Writer { words: state.chunks_exact_mut(4) });
    }
    identity.seal(bytes);
    Ok(length)
}

pub(crate) fn put<T: Whole>(into: &mut T, from: &[u8]) -> Result<(), SnapshotError> {
    let state = identity(into).open(from)?;
    let mut restored = into.clone();
    let mut reader = Reader { words: state.chunks_exact(4), sound: true };
    restored.pass(&mut reader);
    if !reader.sound || !restored.is_sound() {
        return Err(SnapshotError::OutOfBounds);
    }
    *into = restored;
    Ok(())
}

fn identity<T: Whole>(of: &T) -> Identity {
    let mut length = Length(0);
    of.clone().pass(&mut length);
    Identity { shape: T::SHAPE, length: length.0 as u32, fingerprint: of.fingerprint() }
}

/// The three calls, the same for every kind.
macro_rules! snapshots {
    () => {
        /// Bytes of a [`snapshot`](Self::snapshot).
        pub fn snapshot_length(&self) -> usize {
            $crate::snapshot::whole::length(self)
        }

        /// Writes the whole state to the begin of `into` and returns how many bytes that took. Not for the tick.
        ///
        /// # Errors
        /// [`SnapshotError::BufferTooShort`](crate::snapshot::SnapshotError::BufferTooShort).
        pub fn snapshot(&self, into: &mut [u8]) -> Result<usize, $crate::snapshot::SnapshotError> {
            $crate::snapshot::whole::take(self, into)
        }

        /// Takes the state of a [`snapshot`](Self::snapshot) of an estimator of the same kind and configuration. Not for
        /// the tick.
        ///
        /// # Errors
        /// [`SnapshotError`](crate::snapshot::SnapshotError); nothing has changed then.
        pub fn restore(&mut self, from: &[u8]) -> Result<(), $crate::snapshot::SnapshotError> {
            $crate::snapshot::whole::put(self, from)
        }
    };
}
pub(crate) use snapshots;

/// FNV-1a over words.
pub(crate) struct Fingerprint(u32);

impl Fingerprint {
    pub const fn new() -> Self {
        Self(0x811c_9dc5)
    }

    pub fn add(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    }

    pub fn add_number(&mut self, number: f32) {
        self.add(number.to_bits());
    }

    pub const fn value(&self) -> u32 {
        self.0
    }
}
