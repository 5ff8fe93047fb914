//! The faults as data.

use core::fmt;

/// Plain data; [`crate::Injector::new`] validates it. The default has no fault. Probabilities are per sample, 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaultConfig {
    /// Probability that the sample does not come.
    pub drop: f32,
    /// Probability that it is NaN or infinite.
    pub nan: f32,
    /// Probability that it is a spike.
    pub spike: f32,
    /// A spike is off by up to this, either way, in the signal's unit. Finite, not negative.
    pub spike_size: f32,
    /// Probability that one of its bits is flipped.
    pub bit_flip: f32,
    /// Probability that the sensor freezes.
    pub freeze: f32,
    /// Samples for which it stays frozen.
    pub freeze_length: u16,
    /// The sampling instant is off by up to this share of a sampling period, either way. 0 to 1.
    pub jitter: f32,
    /// Samples by which it comes late; at most the injector's capacity.
    pub delay: u16,
    /// Rounded to whole multiples of this, in the signal's unit; 0: not at all. Finite, not negative.
    pub quantum: f32,
}

/// A configuration was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FaultError {
    /// Not within 0..=1.
    NotAShare(&'static str),
    /// Not finite, or negative.
    NotASize(&'static str),
    /// A delay beyond the capacity of the injector.
    DelayTooLong,
}

impl FaultError {
    /// The parameter at fault.
    pub const fn parameter(self) -> &'static str {
        match self {
            Self::NotAShare(name) | Self::NotASize(name) => name,
            Self::DelayTooLong => "delay",
        }
    }
}

impl fmt::Display for FaultError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.parameter())?;
        out.write_str(match self {
            Self::NotAShare(_) => " must be from 0 to 1",
            Self::NotASize(_) => " must be finite and not negative",
            Self::DelayTooLong => " is longer than the injector's capacity",
        })
    }
}

impl core::error::Error for FaultError {}

impl FaultConfig {
    pub(crate) fn check(&self, capacity: usize) -> Result<(), FaultError> {
        let shares = [
            ("drop", self.drop),
            ("nan", self.nan),
            ("spike", self.spike),
            ("bit_flip", self.bit_flip),
            ("freeze", self.freeze),
            ("jitter", self.jitter),
        ];
        for (name, share) in shares {
            if !(0.0..=1.0).contains(&share) {
                return Err(FaultError::NotAShare(name));
            }
        }
        for (name, size) in [("spike_size", self.spike_size), ("quantum", self.quantum)] {
            if !(0.0..=f32::MAX).contains(&size) {
                return Err(FaultError::NotASize(name));
            }
        }
        if usize::from(self.delay) > capacity { Err(FaultError::DelayTooLong) } else { Ok(()) }
    }
}
