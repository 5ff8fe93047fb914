//! The identifier in sampled time, (30)-(41), from its definition: the difference equation
//!
//! y[n] - 2 y[n-1] + y[n-2] = k S[n] + c T²
//!
//! divided by T², multiplied by the window g[n-1], and filtered by three stages x ← x + c1 (u - x), c1 = 1 - e^(-λT).
//! Normalised to unit gain: ẑ2 is an acceleration [m/s²], ẑ0 a force [N].
//!
//! On block means the same holds with T the block's length, y the mean over the block's samples, and S the second difference
//! of the block means of the unit response, simulated from rest over the three blocks. A block of 1 is no averaging.

use std::collections::VecDeque;

use super::TwinWindow;

/// What a finished block gives: ẑ2 = k ẑ0 + c ẑu.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockOutput {
    /// ẑ2 [m/s²].
    pub z2: f64,
    /// ẑ0 [N].
    pub z0: f64,
    /// ẑu [1]: the window, filtered the same way.
    pub zu: f64,
}

impl BlockOutput {
    /// ẑ2 - c ẑu [m/s²] for the known drift `c`, which equals k ẑ0.
    pub const fn z2_without_drift(&self, c: f64) -> f64 {
        self.z2 - c * self.zu
    }
}

/// Three low-pass stages of unit gain.
#[derive(Clone, Copy, Debug, Default)]
struct Cascade([f64; 3]);

impl Cascade {
    fn step(&mut self, u: f64, c1: f64) -> f64 {
        let mut input = u;
        for x in &mut self.0 {
            *x += c1 * (input - *x);
            input = *x;
        }
        input
    }
}

/// One axis. Needs every sample: a missing one has no place in the difference equation.
#[derive(Clone, Debug)]
pub struct TwinIdentifier {
    period: f64,
    block: usize,
    window: TwinWindow,
    c1: f64,
    origin: Option<f64>,
    in_block: usize,
    sum: f64,
    blocks: i64,
    /// Means of the block before the last and of the last.
    means: [f64; 2],
    /// (J1, J2) of the intervals inside the last three blocks and between them, oldest first.
    moments: VecDeque<(f64, f64)>,
    y_chain: Cascade,
    f_chain: Cascade,
    unit_chain: Cascade,
}

impl TwinIdentifier {
    /// λ, q [1/s] and the sample period [s], all positive; `block` samples to a block, at least 1 (0 counts as 1).
    pub fn new(lambda: f64, q: f64, period: f64, block: usize) -> Self {
        let block = block.max(1);
        let length = period * block as f64;
        Self {
            period,
            block,
            window: TwinWindow::new(q, length),
            c1: -(-lambda * length).exp_m1(),
            origin: None,
            in_block: 0,
            sum: 0.0,
            blocks: 0,
            means: [0.0; 2],
            moments: VecDeque::with_capacity(3 * block),
            y_chain: Cascade::default(),
            f_chain: Cascade::default(),
            unit_chain: Cascade::default(),
        }
    }

    /// Takes the sample `y` [m] and the moments [`super::Moments`] over the interval that ended with it (ignored with the
    /// first sample). Gives an output with the last sample of each block; it is zero for the first two blocks.
    pub fn sample(&mut self, y: f64, j1: f64, j2: f64) -> Option<BlockOutput> {
        if self.origin.is_some() {
            if self.moments.len() == 3 * self.block - 1 {
                self.moments.pop_front();
            }
            self.moments.push_back((j1, j2));
        }
        self.sum += y - *self.origin.get_or_insert(y);
        self.in_block += 1;
        (self.in_block == self.block).then(|| self.finish_block())
    }

    fn finish_block(&mut self) -> BlockOutput {
        let mean = self.sum / self.block as f64;
        // (y[n] - y[n-1]) - (y[n-1] - y[n-2]): the differences are small, and exact or nearly so.
        let second_difference = (mean - self.means[1]) - (self.means[1] - self.means[0]);
        let per_length2 = 1.0 / (self.period * self.block as f64).powi(2);
        let g = self.window.g(self.blocks - 1);
        let (mut u, mut s) = (0.0, 0.0);
        if self.blocks >= 2 {
            u = g * second_difference * per_length2;
            s = g * self.response_difference() * per_length2;
        }
        self.means = [self.means[1], mean];
        (self.sum, self.in_block) = (0.0, 0);
        self.blocks += 1;
        BlockOutput {
            z2: self.y_chain.step(u, self.c1),
            z0: self.f_chain.step(s, self.c1),
            zu: self.unit_chain.step(g, self.c1),
        }
    }

    /// S: the second difference of the block means of a unit mass that rests at the first sample of the three blocks.
    fn response_difference(&self) -> f64 {
        let (mut position, mut velocity) = (0.0, 0.0);
        let mut sums = [0.0; 3];
        for (i, &(j1, j2)) in self.moments.iter().enumerate() {
            position += self.period * velocity + j2;
            velocity += j1;
            sums[(i + 1) / self.block] += position;
        }
        (sums[2] - 2.0 * sums[1] + sums[0]) / self.block as f64
    }
}

#[cfg(test)]
mod tests;
