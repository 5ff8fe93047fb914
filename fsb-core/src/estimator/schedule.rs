//! Which measurement does what, so that no tick carries everything.
//!
//! Within a round of measurements (a block; sixteen where blocks are single samples) every axis has its turn, one sample
//! after the other, and the identifier's weights and the observer's gains have theirs, where there is room at a sample at
//! which no block ends. An estimator with another `turn` has all of that so many measurements later: two estimators of N axes
//! with turns 0 and N + 1 never end a block in the same tick where a round is at least 2 (N + 1) measurements.

use crate::wide::Wide;

/// Measurements within a round.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Schedule {
    /// Measurements by which this estimator's turns come later.
    pub turn: u32,
    /// Measurements to a round.
    pub round: u32,
    /// At which measurement of a block the identifier's weights for it are computed.
    pub weights_at: u8,
    /// The observer's gains are renewed every so many measurements, once they change slowly. Any gains leave the estimate
    /// exact; these are within a few per cent of the best ones.
    pub gains_every: u32,
    /// At which measurement of a round the gains are renewed, or where blocks are shorter than there are axes, after which
    /// axis's turn; unused where a round is longer than `gains_every`.
    pub gains_at: u8,
    /// At which measurement of a block the variances that are due are read, others of them with the weights; [`NEVER`](Self::NEVER) where there is no room for
    /// that: they are read at the turn of an axis. Where blocks are single samples, the same for a parameter of several axes.
    pub reads_at: u8,
    /// A bit for each measurement of a round (modulo 32) in which somebody has a turn.
    pub events: u32,
    /// The same for what the axes share: weights, gains, variances.
    pub shared: u32,
    /// There is time enough: the gains are renewed at every measurement, and with blocks of one every axis is served.
    pub unhurried: bool,
    /// Blocks of one: whether the axes take their coarse steps one after the other.
    pub staggered: bool,
}

impl Schedule {
    /// No measurement of a block.
    pub const NEVER: u8 = u8::MAX;

    /// Measurements to a round where blocks are single samples. At the first one and at the middle one the gains have their turn.
    /// After the first one the axes take their coarse steps one after the other, after the middle one they are served. That leaves
    /// gaps for another estimator of as many axes.
    const SINGLES: u32 = 16;

    /// At this period and above there is time enough.
    const UNHURRIED: f64 = 5e-3;

    fn is_unhurried(period: Wide) -> bool {
        period.bits() >= Self::UNHURRIED.to_bits()
    }

    /// What the coarse steps are a multiple of, where they are longer than that.
    pub fn coarse_unit(block: u32, period: Wide) -> u32 {
        if block == 1 && !Self::is_unhurried(period) { Self::SINGLES } else { 1 }
    }

    pub fn new(axes: u32, block: u32, turn: u32, period: Wide, coarse_steps: u32) -> Self {
        let round = if block == 1 { Self::SINGLES } else { block };
        let gains_every = if block == 1 {
            round / 2
        } else if round <= 16 {
            round
        } else {
            16
        };
        let unhurried = Self::is_unhurried(period);
        let (weights_at, gains_at) = match block {
            1 => (0, 0),
            // Where the last axis begins its block nobody completes one, and the gains come after the last one of the axes that
            // have a turn then. A block is never zero; the compiler need not know.
            _ if block <= axes => {
                let shared_at = (axes - 1).min(block - 1);
                (shared_at, shared_at + (axes - 1) / block.max(1) * block)
            }
            // Where there is room: when neither these axes nor those of another estimator have a turn.
            _ => {
                let after = if turn == 0 { 2 * axes } else { (2 * axes + 2).saturating_sub(turn) };
                let shared_at = after.max(axes - 1).min(block - 1);
                (shared_at, shared_at)
            }
        };
        // The measurement at which the last axis begins and nobody completes, or the next one: that of another estimator with this
        // many axes is elsewhere. Before the weights, which count the blocks since the coarse step.
        let reads_at = match block {
            1 => gains_every,
            _ if block < 2 * (axes + 1) || weights_at < axes => u32::from(Self::NEVER),
            _ if turn == 0 => axes - 1,
            _ => axes.min(weights_at - 1),
        };
        let read = if reads_at < 16 { 1 << reads_at } else { 0 };
        let shared = if round > gains_every { u32::MAX } else { 1 << weights_at | 1 << gains_at | read };
        let events = if round > 16 || unhurried {
            u32::MAX
        } else if block == 1 {
            let half = (1 << (axes + 1)) - 1;
            half | half << gains_every
        } else {
            // Those who begin a block come first; what they complete, they complete one measurement earlier.
            let begin = (1 << axes) - 1;
            (begin | 1 << (round - 1) | shared) & ((1 << round) - 1)
        };
        let staggered = block == 1 && coarse_steps > axes;
        // None of them is larger than 18.
        let (weights_at, gains_at, reads_at) = (weights_at as u8, gains_at as u8, reads_at as u8);
        Self { turn, round, weights_at, gains_every, gains_at, reads_at, events, shared, unhurried, staggered }
    }
}
