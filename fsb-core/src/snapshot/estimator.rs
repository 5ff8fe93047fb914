//! `snapshot` and `restore`.

use super::SnapshotError;
use super::archive::{Length, Reader, Stored, Writer};
use super::frame::{CHECKSUM, HEADER, Identity};
use crate::estimator::Estimator;

impl<const N: usize, const P: usize> Estimator<N, P> {
    /// Bytes of a [`snapshot`](Self::snapshot).
    pub fn snapshot_length(&self) -> usize {
        HEADER + self.identity().length as usize + CHECKSUM
    }

    /// Writes the whole state to the begin of `into` and returns how many bytes that took. Not for the tick.
    ///
    /// # Errors
    /// [`SnapshotError::BufferTooShort`].
    pub fn snapshot(&self, into: &mut [u8]) -> Result<usize, SnapshotError> {
        let identity = self.identity();
        let length = HEADER + identity.length as usize + CHECKSUM;
        let bytes = into.get_mut(..length).ok_or(SnapshotError::BufferTooShort)?;
        if let Some((_, state)) = bytes.split_at_mut_checked(HEADER) {
            // Passing a state on needs it mutable; writing does not change it.
            let mut copy = *self;
            copy.pass(&mut Writer { words: state.chunks_exact_mut(4) });
        }
        identity.seal(bytes);
        Ok(length)
    }

    /// Takes the state of a [`snapshot`](Self::snapshot) of an estimator of the same configuration. Not for the tick.
    ///
    /// # Errors
    /// [`SnapshotError`]; nothing has changed then.
    pub fn restore(&mut self, from: &[u8]) -> Result<(), SnapshotError> {
        let state = self.identity().open(from)?;
        let mut restored = *self;
        let mut reader = Reader { words: state.chunks_exact(4), sound: true };
        restored.pass(&mut reader);
        if !reader.sound || !restored.is_sound() {
            return Err(SnapshotError::OutOfBounds);
        }
        *self = restored;
        Ok(())
    }

    fn identity(&self) -> Identity {
        let mut length = Length(0);
        let mut copy = *self;
        copy.pass(&mut length);
        Identity { axes: N as u8, parameters: P as u8, length: length.0 as u32, fingerprint: self.fingerprint() }
    }
}
