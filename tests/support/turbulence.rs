//! Accelerations that nobody told, all the time.

use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

/// First-order turbulence of standard deviation `sd` and correlation time `tau` (s), steady from the start.
#[derive(Clone, Copy, Debug)]
pub struct Turbulence<const N: usize> {
    acceleration: [f64; N],
    sd: f64,
    tau: f64,
}

impl<const N: usize> Turbulence<N> {
    /// As it is at first.
    pub fn new(sd: f64, tau: f64, rng: &mut impl Rng) -> Self {
        Self { acceleration: [(); N].map(|()| sd * normal(rng)), sd, tau }
    }

    /// What acts over the next `period` (s).
    pub fn over(&mut self, period: f64, rng: &mut impl Rng) -> [f64; N] {
        let keep = (-period / self.tau).exp();
        for a in &mut self.acceleration {
            *a = keep * *a + self.sd * (1.0 - keep * keep).sqrt() * normal(rng);
        }
        self.acceleration
    }
}

fn normal(rng: &mut impl Rng) -> f64 {
    StandardNormal.sample(rng)
}
