//! The random draws of one sample.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// All of them are drawn for every sample.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draws {
    /// Uniform in 0..1; below the probability it happens.
    pub drop: f32,
    pub nan: f32,
    pub spike: f32,
    pub bit_flip: f32,
    pub freeze: f32,
    /// Uniform in -1..1.
    pub size: f32,
    pub jitter: f32,
    /// Which of the values that are none, and which bit.
    pub which: u32,
}

#[derive(Clone, Debug)]
pub(crate) struct Generator(Pcg32);

impl Generator {
    pub fn new(seed: u64) -> Self {
        Self(Pcg32::seed_from_u64(seed))
    }

    pub fn draw(&mut self) -> Draws {
        Draws {
            drop: self.share(),
            nan: self.share(),
            spike: self.share(),
            bit_flip: self.share(),
            freeze: self.share(),
            size: 2.0 * self.share() - 1.0,
            jitter: 2.0 * self.share() - 1.0,
            which: self.0.next_u32(),
        }
    }

    /// Uniform in 0..1, in steps of 2^-24.
    fn share(&mut self) -> f32 {
        (self.0.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0)
    }
}
