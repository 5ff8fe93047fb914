//! The random draws of one sensor.

use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

use crate::hexarotor::vector::{Vector, norm, scaled};

/// All draws of one sample, in parts of their sizes.
#[derive(Clone, Copy, Debug)]
pub struct Draws {
    /// Independent standard normals.
    pub noise: Vector,
    /// Uniform in [0, 1).
    pub sampling: f64,
    /// Uniform in [0, 1).
    pub latency: f64,
    /// Uniform in [0, 1); below the probability the sample is lost.
    pub dropout: f64,
    /// Uniform in [0, 1); below the probability the sample is an outlier.
    pub outlier: f64,
    /// Uniform on the unit sphere.
    pub direction: Vector,
}

/// A generator for each fault. Each draws for every sample, wanted or not: switching one fault on leaves the draws of all the
/// others as they were.
#[derive(Clone, Debug)]
pub struct Faults {
    noise: Pcg64,
    sampling: Pcg64,
    latency: Pcg64,
    dropout: Pcg64,
    outlier: Pcg64,
}

impl Faults {
    pub fn new(seed: u64) -> Self {
        let part = |number| Pcg64::seed_from_u64(mixed(seed, number));
        Self { noise: part(1), sampling: part(2), latency: part(3), dropout: part(4), outlier: part(5) }
    }

    pub fn draw(&mut self) -> Draws {
        Draws {
            noise: normals(&mut self.noise),
            sampling: self.sampling.random(),
            latency: self.latency.random(),
            dropout: self.dropout.random(),
            outlier: self.outlier.random(),
            direction: direction(&mut self.outlier),
        }
    }
}

/// SplitMix64 of (seed, number), so that neighbouring seeds and numbers have nothing in common.
fn mixed(seed: u64, number: u64) -> u64 {
    let step = |z: u64| {
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let golden = 0x9e37_79b9_7f4a_7c15_u64;
    step(step(seed.wrapping_add(golden)).wrapping_add(golden.wrapping_mul(number)))
}

fn normals(generator: &mut Pcg64) -> Vector {
    [(); 3].map(|()| generator.sample(StandardNormal))
}

fn direction(generator: &mut Pcg64) -> Vector {
    let normals = normals(generator);
    let length = norm(normals);
    // All three exactly zero does not happen in the life of a computer; then any direction will do.
    if length > 0.0 { scaled(1.0 / length, normals) } else { [1.0, 0.0, 0.0] }
}
