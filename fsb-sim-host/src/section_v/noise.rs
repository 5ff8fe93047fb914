//! The measurement noise: σ ξ(t), ξ from N(0, 1), independent on both axes and at every tick.

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// Position noise of both axes, one pair a tick. The same seed gives the same sequence on every machine.
#[derive(Clone, Debug)]
pub struct Noise {
    generator: Pcg64,
    sigma: f64,
}

impl Noise {
    /// Noise of standard deviation `sigma` [m] (0: none) from PCG XSL RR 128/64 seeded with `seed`.
    pub fn new(sigma: f64, seed: u64) -> Self {
        Self { generator: Pcg64::seed_from_u64(seed), sigma }
    }

    /// The next tick's noise [m] on x and y.
    pub fn next_pair(&mut self) -> [f64; 2] {
        [(); 2].map(|()| {
            let standard: f64 = StandardNormal.sample(&mut self.generator);
            self.sigma * standard
        })
    }
}

/// The seed of run `run` (from 0) of a series that begins with `seed`: `seed + run`, so any run can be repeated alone.
pub const fn seed_of_run(seed: u64, run: u64) -> u64 {
    seed.wrapping_add(run)
}
