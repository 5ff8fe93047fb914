//! The frames of a motion capture receiver on a serial port: 0xA5, then x, y, z [m] and φ, θ, ψ [rad] as little-endian f32, then
//! the sum of these 24 bytes. A frame that was cut off, or lost a byte, is none.

const SYNC: u8 = 0xA5;

/// Puts bytes together.
#[derive(Default)]
pub struct Decoder {
    bytes: [u8; 24],
    /// Bytes so far, the sync byte included.
    count: usize,
}

impl Decoder {
    /// Takes a byte; returns the six numbers when it was the last of a frame.
    pub fn push(&mut self, byte: u8) -> Option<[f32; 6]> {
        if self.count == 0 {
            self.count = usize::from(byte == SYNC);
            return None;
        }
        if let Some(slot) = self.bytes.get_mut(self.count - 1) {
            *slot = byte;
            self.count += 1;
            return None;
        }
        self.count = 0;
        if self.bytes.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte)) != byte {
            return None;
        }
        let (words, _) = self.bytes.as_chunks::<4>();
        let mut numbers = [0.0; 6];
        for (number, word) in numbers.iter_mut().zip(words) {
            *number = f32::from_le_bytes(*word);
        }
        Some(numbers)
    }
}
