//! The pipeline: jitter, quantisation, spike, freeze, bit flip, NaN, drop, delay.

use crate::config::{FaultConfig, FaultError};
use crate::draws::Generator;
use heapless::Deque;

/// The faults of one scalar signal. `D`, at least 1, is the longest delay in samples.
#[derive(Clone, Debug)]
pub struct Injector<const D: usize> {
    config: FaultConfig,
    generator: Generator,
    /// The last true sample, for jitter.
    before: Option<f32>,
    /// What the sensor gives while it is frozen, and for how many samples still.
    frozen: Option<f32>,
    thaws_in: u16,
    underway: Deque<Option<f32>, D>,
}

impl<const D: usize> Injector<D> {
    /// Validates `config`.
    ///
    /// # Errors
    /// Names the first parameter that cannot be right.
    pub fn new(config: &FaultConfig, seed: u64) -> Result<Self, FaultError> {
        config.check(D)?;
        Ok(Self {
            config: *config,
            generator: Generator::new(seed),
            before: None,
            frozen: None,
            thaws_in: 0,
            underway: Deque::new(),
        })
    }

    /// One sample of the truth (`None`: there was none) to what arrives in its place.
    pub fn pass(&mut self, truth: Option<f32>) -> Option<f32> {
        let arriving = self.spoil(truth);
        if self.config.delay == 0 {
            return arriving;
        }
        let late = if self.underway.len() >= usize::from(self.config.delay) { self.underway.pop_front() } else { None };
        // There is room: the delay is at most the capacity.
        let _ = self.underway.push_back(arriving);
        late.flatten()
    }

    fn spoil(&mut self, truth: Option<f32>) -> Option<f32> {
        let config = &self.config;
        let draws = self.generator.draw();
        let mut y = truth?;
        let before = self.before.replace(y).unwrap_or(y);
        // On the straight line through the last two samples: off by half a T² of the acceleration at most.
        y += config.jitter * draws.jitter * (y - before);
        if config.quantum > 0.0 {
            y = rounded(y, config.quantum);
        }
        if draws.spike < config.spike {
            y += config.spike_size * draws.size;
        }
        if self.thaws_in > 0 {
            self.thaws_in -= 1;
            y = self.frozen.unwrap_or(y);
        } else if draws.freeze < config.freeze {
            self.frozen = Some(y);
            self.thaws_in = config.freeze_length;
        }
        if draws.bit_flip < config.bit_flip {
            y = f32::from_bits(y.to_bits() ^ (1 << (draws.which & 31)));
        }
        if draws.nan < config.nan {
            y = [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY][(draws.which >> 5) as usize & 3];
        }
        (draws.drop >= config.drop).then_some(y)
    }
}

/// To the nearest whole multiple of `quantum`; as it is where there are too many of them for f32 to count.
fn rounded(y: f32, quantum: f32) -> f32 {
    let count = y / quantum;
    if count.abs() < 8_388_608.0 {
        let half = if count < 0.0 { -0.5 } else { 0.5 };
        (count + half) as i32 as f32 * quantum
    } else {
        y
    }
}
