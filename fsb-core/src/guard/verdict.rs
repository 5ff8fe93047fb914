//! What became of a measurement.

use core::fmt;

/// What became of a measurement of one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Verdict {
    /// It was used.
    Taken,
    /// There was none.
    #[default]
    Missing,
    /// NaN or infinite.
    NonFinite,
    /// Beyond the physical limit.
    BeyondLimit,
    /// It cannot have come there from the last one.
    Improbable,
    /// The same bits for longer than a sensor that lives gives them.
    Frozen,
    /// The sensor's origin has jumped by so much (m or rad): positions are moved by it, and the measurement was used.
    Jumped(f32),
    /// The velocity has changed at once, by so much (m/s or rad/s), which no input explains: a collision, or an input that was
    /// not what acted. The state is put where the measurement is, and the measurement was used.
    Pushed(f32),
}

impl Verdict {
    /// Whether the measurement was used.
    pub const fn is_used(self) -> bool {
        matches!(self, Self::Taken | Self::Jumped(_) | Self::Pushed(_))
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Taken => out.write_str("taken"),
            Self::Missing => out.write_str("missing"),
            Self::NonFinite => out.write_str("not finite"),
            Self::BeyondLimit => out.write_str("beyond the limit"),
            Self::Improbable => out.write_str("improbable"),
            Self::Frozen => out.write_str("frozen"),
            Self::Jumped(by) => write!(out, "jumped by {by}"),
            Self::Pushed(by) => write!(out, "pushed by {by}"),
        }
    }
}

/// Measurements that were not used, by reason, over all axes, and faults of the state. They only rise, and stop at the largest number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rejections {
    /// Did not come.
    pub missing: u32,
    /// NaN or infinite.
    pub non_finite: u32,
    /// Beyond the physical limit.
    pub beyond_limit: u32,
    /// Failed the gate.
    pub improbable: u32,
    /// Repeated for too long.
    pub frozen: u32,
    /// Jumps of a sensor's origin.
    pub jumps: u32,
    /// Changes of the velocity that no input explains.
    pub pushes: u32,
    /// Starts anew because the state held what is no number or out of all bounds: a memory changed from outside.
    pub faults: u32,
}

impl Rejections {
    pub(super) fn count_fault(&mut self) {
        self.faults = self.faults.saturating_add(1);
    }

    pub(super) fn count(&mut self, verdict: Verdict) {
        let counter = match verdict {
            Verdict::Taken => return,
            Verdict::Missing => &mut self.missing,
            Verdict::NonFinite => &mut self.non_finite,
            Verdict::BeyondLimit => &mut self.beyond_limit,
            Verdict::Improbable => &mut self.improbable,
            Verdict::Frozen => &mut self.frozen,
            Verdict::Jumped(_) => &mut self.jumps,
            Verdict::Pushed(_) => &mut self.pushes,
        };
        *counter = counter.saturating_add(1);
    }
}
