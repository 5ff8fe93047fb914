//! Mean wind and first-order gusts.

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::config::WindConfig;
use super::vector::{Vector, by_components, sum};

/// The air's velocity, held over each tick. Sampled from the exact discrete form of the gust, w[n+1] = a w[n] +
/// √(1 - a²) ξ with a = e^(-T/T_g), starting from its stationary distribution: its statistics do not depend on the tick.
#[derive(Clone, Debug)]
pub struct Wind {
    config: WindConfig,
    generator: Pcg64,
    /// Gusts for a standard deviation of one.
    gust: Vector,
}

impl Wind {
    pub fn new(config: &WindConfig) -> Self {
        let mut wind = Self { config: *config, generator: Pcg64::seed_from_u64(config.seed), gust: [0.0; 3] };
        wind.gust = wind.normals();
        wind
    }

    /// Velocity of the air in the world frame [m/s].
    pub fn velocity(&self) -> Vector {
        sum(self.config.mean, by_components(self.config.gust_sd, self.gust))
    }

    /// Moves `dt` [s] ahead.
    pub fn advance(&mut self, dt: f64) {
        if self.config.gust_sd == [0.0; 3] {
            return;
        }
        let x = -dt / self.config.gust_time;
        let (kept, new) = (x.exp(), (-(2.0 * x).exp_m1()).sqrt());
        let normals = self.normals();
        self.gust = std::array::from_fn(|i| kept * self.gust[i] + new * normals[i]);
    }

    fn normals(&mut self) -> Vector {
        [(); 3].map(|()| StandardNormal.sample(&mut self.generator))
    }
}
