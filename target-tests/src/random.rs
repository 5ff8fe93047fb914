//! Noise, the same bits on every machine.

/// Marsaglia's xorshift.
#[derive(Clone, Copy, Debug)]
pub struct Random(u32);

impl Random {
    /// The one seed.
    pub const START: Self = Self(0x9E37_79B9);

    /// Uniform in [-1, 1).
    pub fn uniform(&mut self) -> f64 {
        f64::from(self.word() as i32) * (1.0 / 2_147_483_648.0)
    }

    /// Any bits but all zero.
    pub fn word(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }
}
