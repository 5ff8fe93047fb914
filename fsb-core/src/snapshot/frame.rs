//! Header and checksum around a state.

use super::SnapshotError;

pub(super) const HEADER: usize = 16;
pub(super) const CHECKSUM: usize = 4;
const VERSION: u8 = 1;

/// What a snapshot must be of.
#[derive(Clone, Copy)]
pub(super) struct Identity {
    /// Kind of estimator, axes, parameters.
    pub shape: [u8; 3],
    pub length: u32,
    pub fingerprint: u32,
}

impl Identity {
    fn header(self) -> [u8; HEADER] {
        let ([a, b, c, d], [e, f, g, h]) = (self.length.to_le_bytes(), self.fingerprint.to_le_bytes());
        let [kind, axes, parameters] = self.shape;
        [b'F', b'S', b'B', VERSION, kind, axes, parameters, 0, a, b, c, d, e, f, g, h]
    }

    /// Writes header and checksum around the state in `bytes`, whose length is right.
    pub fn seal(self, bytes: &mut [u8]) {
        for (byte, from) in bytes.iter_mut().zip(self.header()) {
            *byte = from;
        }
        let end = bytes.len().saturating_sub(CHECKSUM);
        if let Some((sealed, place)) = bytes.split_at_mut_checked(end) {
            for (byte, from) in place.iter_mut().zip(crc32(sealed).to_le_bytes()) {
                *byte = from;
            }
        }
    }

    /// The state in a snapshot that is of this identity and whole.
    pub fn open(self, bytes: &[u8]) -> Result<&[u8], SnapshotError> {
        let (header, rest) = bytes.split_at_checked(HEADER).ok_or(SnapshotError::NotASnapshot)?;
        let [magic @ .., _, _] = self.header();
        let same = |from: usize, to: usize| header.get(from..to) == magic.get(from..to);
        if header.get(..3) != Some(b"FSB") {
            return Err(SnapshotError::NotASnapshot);
        }
        match header.get(3) {
            Some(&VERSION) => {}
            version => return Err(SnapshotError::Version(version.copied().unwrap_or(0))),
        }
        if !same(4, 12) || bytes.len() != HEADER + self.length as usize + CHECKSUM {
            return Err(SnapshotError::Shape);
        }
        if header != self.header() {
            return Err(SnapshotError::Design);
        }
        let (state, checksum) = rest.split_at_checked(self.length as usize).ok_or(SnapshotError::Shape)?;
        let sealed = bytes.get(..HEADER + self.length as usize).unwrap_or_default();
        if checksum != crc32(sealed).to_le_bytes() {
            return Err(SnapshotError::Corrupt);
        }
        Ok(state)
    }
}

/// CRC-32 (IEEE 802.3, reflected), bit by bit: snapshots are rare and tables are large.
pub(super) fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for byte in bytes {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xedb8_8320 & 0_u32.wrapping_sub(crc & 1));
        }
    }
    !crc
}

#[cfg(test)]
mod tests {
    #[test]
    fn checksum_is_the_usual_one() {
        assert_eq!(super::crc32(b"123456789"), 0xcbf4_3926);
    }
}
