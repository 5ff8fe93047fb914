use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::TwinIdentifier;
use crate::twin::Moments;

const LAMBDA: f64 = 2.0;
const Q: f64 = 1.0;
const SEED: u64 = 7;

/// Positions and forces that obey nothing at all: the two forms must agree on any input.
fn noise(samples: usize) -> Vec<(f64, f64)> {
    println!("seed {SEED}");
    let mut rng = Pcg64Mcg::seed_from_u64(SEED);
    (0..samples).map(|_| (rng.random_range(-1.0..1.0), rng.random_range(-5.0..5.0))).collect()
}

/// The chain without differences of y: the shift expanded, stage inputs b1 y, b2 y, b3 y, h = 1 - ρ^n and neighbours.
#[test]
fn equals_the_form_with_expanded_coefficients() {
    for period in [0.1, 0.02, 1e-3] {
        let (p, rho) = ((-LAMBDA * period).exp(), (-Q * period).exp());
        let (c, alpha) = (-(-LAMBDA * period).exp_m1(), -(-Q * period).exp_m1());
        let scale = 1.0 / (period * p).powi(2);
        let mut x = [0.0; 3];
        let mut twin = TwinIdentifier::new(LAMBDA, Q, period, 1);
        let samples = noise(2000);
        let (mut size, mut gap) = (0.0_f64, 0.0_f64);
        for (n, &(y, f)) in samples.iter().enumerate() {
            let h = |shift: f64| -(-Q * period * (n as f64 + shift)).exp_m1();
            let e = (-Q * period * n as f64).exp();
            let b1 = scale * c * c * h(1.0) * h(2.0);
            let b2 = -2.0 * scale * c * h(1.0) * ((1.0 - rho * rho) * e + c * h(0.0));
            let b3 = scale
                * (alpha * alpha * (1.0 + rho) / rho * e * ((1.0 + rho) * e - 1.0)
                    + 2.0 * c * (1.0 - rho * rho) / rho * h(0.0) * e
                    + c * c * h(-1.0) * h(0.0));
            let relative = y - samples[0].0;
            x[2] += c * (b3 * relative - x[2]);
            x[1] += c * (b2 * relative + x[2] - x[1]);
            x[0] += c * (b1 * relative + x[1] - x[0]);
            let moments = Moments::held(f, period);
            let out = twin.sample(y, moments.j1, moments.j2).unwrap();
            size = size.max(out.z2.abs());
            gap = gap.max((out.z2 - x[0]).abs());
        }
        assert!(gap < 1e-9 * size, "T = {period}: {gap:e} of {size:e}");
    }
}

/// S of blocks by sums that restart with each block, section by section:
/// S = M T V[-2] + P[-1] - P[-2] + τ (V[-1] - V[-2]) + s[0] - 2 s[-1] + s[-2], τ = (M-1) T/2.
#[test]
fn equals_the_form_with_restarted_sums() {
    let period = 1e-3;
    for block in [1, 2, 10, 40] {
        let length = period * block as f64;
        let (c, samples) = (-(-LAMBDA * length).exp_m1(), noise(100 * block));
        let mut twin = TwinIdentifier::new(LAMBDA, Q, period, block);
        // (P, V, s) of each block; f of a sample is held after it.
        let blocks: Vec<(f64, f64, f64)> = samples
            .chunks(block)
            .map(|chunk| {
                let (mut phi, mut psi, mut sum) = (0.0, 0.0, 0.0);
                for &(_, f) in chunk {
                    sum += phi;
                    phi += period * psi + f * period * period / 2.0;
                    psi += f * period;
                }
                (phi, psi, sum / block as f64)
            })
            .collect();
        let mut x = [0.0; 3];
        for (n, &(y, _)) in samples.iter().enumerate() {
            let f_before = if n > 0 { samples[n - 1].1 } else { 0.0 };
            let moments = Moments::held(f_before, period);
            let Some(out) = twin.sample(y, moments.j1, moments.j2) else { continue };
            let b = n / block;
            if b >= 2 {
                let (p2, v2, s2) = blocks[b - 2];
                let (p1, v1, s1) = blocks[b - 1];
                let s0 = blocks[b].2;
                let tau = (block - 1) as f64 * period / 2.0;
                let s = length * v2 + p1 - p2 + tau * (v1 - v2) + s0 - 2.0 * s1 + s2;
                let h = |n: f64| 1.0 - (-Q * length * n).exp();
                x[0] += c * (h(b as f64 - 1.0) * h(b as f64) * s / (length * length) - x[0]);
                x[1] += c * (x[0] - x[1]);
                x[2] += c * (x[1] - x[2]);
            }
            assert!((out.z0 - x[2]).abs() < 1e-12, "M = {block}, block {b}: {} against {}", out.z0, x[2]);
        }
    }
}

/// Any straight line y = a + v t gives ẑ2 = 0: the window removes the initial state.
#[test]
fn a_straight_line_leaves_no_trace() {
    for block in [1, 8] {
        let mut twin = TwinIdentifier::new(LAMBDA, Q, 0.01, block);
        for n in 0..4000 {
            let out = twin.sample(-40.0 + 3.25 * f64::from(n) * 0.01, 0.0, 0.0);
            assert!(out.is_none_or(|out| out.z2.abs() < 1e-10 && out.z0 == 0.0));
        }
    }
}
