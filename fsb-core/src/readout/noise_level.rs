//! The variance σ² of the measurement noise of one axis, learned from the data in two bands.
//!
//! * From sample to sample: the observer's innovations. Two that follow each other differ by the noise filtered by
//!   (1 - z⁻¹)³/(1 - p z⁻¹)², of a known variance near 2 σ². Many independent values in a short time; what a wrong k or an
//!   unknown disturbance adds to both cancels.
//! * In the band of the identifier: the residual ẑ2 - k ẑ0 has the variance σ² P₁₁. Few independent values, but it sees
//!   what the model lacks (drag, wind, a swinging load), which the first does not.
//!
//! The larger one counts. Beside them the filtered acceleration itself is averaged, in the same measure: what part of it
//! the model leaves unexplained tells whether the model holds at all. Each is a mean over the past,
//! at first of all values, later over the last 256, or as many as the read-out remembers.
//!
//! k remembers longer than that: a gust that has passed, or noise that was, is in its sums for as long as they last, and what came while
//! nothing moved is not. So both are averaged a second time over all that is remembered, each value weighing as much as the information
//! ω ẑ0 that came with it, and where that is larger it counts: the level at which k was learned.
//!
//! What stands in for measurements that are missing is off by more than they would have been, and by the same for a whole gap:
//! the share of them of late says by how much more the noise counts.

use crate::snapshot::stored;

/// Two running means of σ².
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NoiseLevel {
    fine: f32,
    slow: f32,
    /// The means of both over all that the read-out remembers, weighed as it went in.
    whole: [f32; 2],
    /// What they weigh together: Σ ω ẑ0 of this axis.
    weight: f32,
    /// Means of the residual and of what there is to explain, over a shorter past.
    residual: f32,
    signal: f32,
    values: u16,
    /// The mean square of late, of the noise's kind, that stands for the errors of what stood in for missing measurements.
    gaps: f32,
    /// The share of the measurements of late that were missing, in 65536ths.
    absent: u16,
}

impl NoiseLevel {
    /// Values before which the level is not trusted.
    const ENOUGH: u16 = 8;
    /// The memory of the misfit, in values: about 2.5/λ.
    const RECENT: u16 = 32;
    /// A residual of so many times the variance of the measurement noise may still be noise.
    pub(crate) const EXPLAINED: f32 = 25.0;
    /// The mean of as many residuals may be so many times the variance of a disturbance, which lasts for some of them.
    const EXPECTED: f32 = 9.0;

    /// Where most measurements are missing, the level learned from those that came after gaps tells of the predictions as well.
    const STRETCH: f32 = 3.0;
    /// No more than so many times the variance of the measurement noise, as a number to reckon with.
    const MOST: f32 = 1e8;
    /// A value that weighs less than this share of all moves their mean by less than it is rounded to.
    const SLIGHT: f32 = 1.0 / 16_777_216.0;
    /// A mean over more than 1/`LEAST` values of the same weight would move by less than f32 has digits for.
    const LEAST: f32 = 1.0 / 1_048_576.0;
    /// A mean square below this is none; well above the subnormal numbers.
    const NOTHING: f32 = 1e-30;
    /// Added to means at every value: of nothing but zeros they end here, and not among the subnormal numbers.
    const ABOVE_SUBNORMAL: f32 = 1e-36;

    /// Nothing seen yet.
    pub(crate) const UNKNOWN: Self = Self {
        fine: 0.0,
        slow: 0.0,
        whole: [0.0; 2],
        weight: 0.0,
        residual: 0.0,
        signal: 0.0,
        values: 0,
        gaps: 0.0,
        absent: 0,
    };

    /// The memory of the level of the moment, for a read-out that forgets by e^(-`fading`) from value to value.
    pub(crate) fn memory(fading: f32) -> u16 {
        // Infinite where nothing is forgotten.
        (1.0 / fading).clamp(16.0, 256.0) as u32 as u16
    }

    /// A level known beforehand; it counts as much as the least number of values that is trusted.
    pub(crate) const fn expected(variance: f32) -> Self {
        Self { fine: variance, slow: variance, whole: [variance; 2], values: Self::ENOUGH, ..Self::UNKNOWN }
    }

    /// Adds one value of each: `fine` from the innovations, `slow` from the residual, `signal` from ẑ2. `weight` is the ω ẑ0, positive,
    /// that went into the sums with them. `remembers`: how many values the level of the moment is a mean of, and by what share their part in the
    /// variance of k̂ fades from value to value.
    pub(crate) fn add(&mut self, fine: f32, slow: f32, signal: f32, weight: f32, remembers: (u16, f32)) {
        let (memory, forgetting) = remembers;
        if self.values < memory {
            self.values += 1;
        }
        let gain = 1.0 / f32::from(self.values);
        self.fine += gain * (fine - self.fine) + Self::ABOVE_SUBNORMAL;
        self.slow += gain * (slow - self.slow) + Self::ABOVE_SUBNORMAL;
        let faded = if forgetting > Self::LEAST { forgetting } else { Self::LEAST } * self.weight;
        self.weight += weight - faded + Self::ABOVE_SUBNORMAL;
        if weight > Self::SLIGHT * self.weight {
            // At first a few values carry most of the weight, and are no level: these means move no faster than those of late.
            let share = weight / self.weight;
            let gain = if share < gain { share } else { gain };
            let [whole_fine, whole_slow] = &mut self.whole;
            *whole_fine += gain * (fine - *whole_fine) + Self::ABOVE_SUBNORMAL;
            *whole_slow += gain * (slow - *whole_slow) + Self::ABOVE_SUBNORMAL;
        }
        let gain = 1.0 / f32::from(if self.values < Self::RECENT { self.values } else { Self::RECENT });
        self.residual += gain * (slow - self.residual) + Self::ABOVE_SUBNORMAL;
        self.signal += gain * (signal - self.signal) + Self::ABOVE_SUBNORMAL;
    }

    /// A measurement was missing; `gain` is the share that one measurement has in the memory.
    pub(crate) fn miss(&mut self, gain: f32) {
        let here = f32::from(u16::MAX - self.absent);
        self.absent = self.absent.saturating_add((gain * here) as u16).saturating_add(1);
    }

    /// After a gap of `missing` measurements the first one is `off` from what was expected: what stood in for those that are missing
    /// was off by about half of that, and all of it the same way, as it goes on to be for so many measurements, the gap or `lasting`. Each counts as so
    /// many times its square. `gain` is the share that one measurement has in the memory.
    pub(crate) fn come_back(&mut self, missing: f32, lasting: f32, off: f32, gain: f32) {
        self.gaps += gain * (0.25 * (missing * lasting) * (off * off));
    }

    /// A new window: what stood in for measurements before is not in it.
    pub(crate) fn forget_gaps(&mut self) {
        (self.gaps, self.absent) = (0.0, 0);
    }

    /// How many times the amplitude of the noise counts: at least one over the share that came, three times at most, and what the
    /// predictions were found to be off by. What is remembered of the gaps fades by `fading`, of what was missing by `came` of that.
    #[inline(never)]
    pub(crate) fn stretch(&mut self, fading: f32, came: f32) -> f32 {
        let absent = f32::from(self.absent);
        let here = 1.0 - absent * (1.0 / 65_536.0);
        let least = if here > 1.0 / Self::STRETCH { 1.0 / (here * here) } else { Self::STRETCH * Self::STRETCH };
        let found = 1.0 + self.gaps / self.fine;
        self.absent = (absent - fading * came * absent) as u16;
        self.gaps -= fading * self.gaps;
        if self.gaps < Self::NOTHING {
            self.gaps = 0.0;
        }
        let times = if found > least { found } else { least };
        root(if times < Self::MOST { times } else { Self::MOST })
    }

    /// Whether there have been gaps of late.
    #[inline(always)]
    pub(crate) fn has_gaps(&self) -> bool {
        self.absent > 0 || self.gaps > 0.0
    }

    /// σ², in the square of the position's unit, of the means that the identifier works on.
    pub fn variance(&self) -> f32 {
        let (fine, [_, whole]) = (self.measured(), self.whole);
        let slow = if self.slow > whole { self.slow } else { whole };
        if slow > fine { slow } else { fine }
    }

    /// The same of measurement noise alone, as it shows from sample to sample.
    pub(crate) fn measured(&self) -> f32 {
        let [whole, _] = self.whole;
        if self.fine > whole { self.fine } else { whole }
    }

    /// Both: from sample to sample, and in the band of the identifier.
    pub const fn variances(&self) -> [f32; 2] {
        [self.fine, self.slow]
    }

    /// What the model leaves unexplained, beyond what measurement noise of this level and the `disturbance` that is expected can
    /// explain, and what there is to explain: all in the square of the position's unit.
    pub(crate) fn misfit(&self, disturbance: f32) -> (f32, f32) {
        let noise = Self::EXPLAINED * self.fine + Self::EXPECTED * disturbance;
        (if self.residual > noise { self.residual } else { 0.0 }, self.signal)
    }

    /// σ² where only that `share` counts of what is seen in the band of the identifier, or is `expected` there.
    pub(crate) fn variance_beside(&self, share: f32, expected: f32) -> f32 {
        let slow = share * if self.slow > expected { self.slow } else { expected };
        if slow > self.fine { slow } else { self.fine }
    }

    /// Whether it can be what values were added to.
    pub(crate) fn is_sound(&self) -> bool {
        self.weight >= 0.0
    }

    /// Whether enough values have been seen.
    pub const fn is_known(&self) -> bool {
        self.values >= Self::ENOUGH
    }

    /// σ² as it shows from sample to sample: measurement noise alone.
    pub const fn measurement_variance(&self) -> f32 {
        self.fine
    }
}

/// √x for x of 1 and more, at most 0.1 % too large: halving the exponent is right to 4 %, and Newton's step makes of that half its square.
fn root(x: f32) -> f32 {
    let about = f32::from_bits((x.to_bits() >> 1) + 0x1fbd_1df5);
    0.5 * (about + x / about)
}

/// Variance of the difference of two innovations that follow each other over that of the noise, for an observer with
/// p = e^(-λT): the sum of squares of the impulse response of (1 - z⁻¹)³/(1 - p z⁻¹)². It is 4 (5 - p²)/(1 + p)³.
pub(crate) fn innovation_step_gain(p: f32) -> f32 {
    let q = 1.0 + p;
    4.0 * (5.0 - p * p) / (q * q * q)
}

stored!(NoiseLevel { fine, slow, whole, weight, residual, signal, values, gaps, absent });
