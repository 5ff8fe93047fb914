//! The attitude that turns forces, and for how long it may.

use crate::attitude::is_rotation;
use crate::config::LoopConfig;
use crate::events::{Event, Events};
use crate::sample::Attitude;

/// Level: what is assumed where nothing is known.
const LEVEL: Attitude = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The last good attitude, and its age.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing {
    matrix: Attitude,
    known: bool,
    /// Control periods since a good one, or since the start; saturates.
    age: u32,
    /// Those that the last good one may be used for.
    bridge: u32,
    /// Control periods without a bad one that end an outage, and since the last one; saturates.
    quiet: u32,
    good: u32,
}

impl Bearing {
    /// For as long as the rotation is bridged; the configuration has been validated.
    pub fn of(config: &LoopConfig) -> Self {
        let periods = |time: f64| libm::round(time / config.rotation.period) as u32;
        let (bridge, quiet) = (periods(config.rotation_guard.bridge), periods(1.0));
        Self { matrix: LEVEL, known: false, age: 0, bridge, quiet, good: u32::MAX }
    }

    /// Where forces point now.
    pub const fn matrix(&self) -> &Attitude {
        &self.matrix
    }

    /// Whether forces can be pointed.
    pub const fn is_known(&self) -> bool {
        self.known
    }

    /// A tick with a sample's attitude or without one; `trusted` where the angles that came with it were.
    pub fn update(&mut self, attitude: Option<&Attitude>, trusted: bool, tick: u32, events: &mut Events) {
        self.good = self.good.saturating_add(1);
        match attitude {
            Some(matrix) if trusted && is_rotation(matrix) => {
                self.matrix = *matrix;
                self.age = 0;
                if !self.known {
                    self.known = true;
                    events.push(tick, Event::AttitudeUsable);
                }
            }
            other => self.age_by_a_tick(other.is_some(), tick, events),
        }
    }

    fn age_by_a_tick(&mut self, rejected: bool, tick: u32, events: &mut Events) {
        if rejected {
            if self.good > self.quiet {
                events.push(tick, Event::AttitudeRejected);
            }
            self.good = 0;
        }
        if self.age <= self.bridge {
            self.age += 1;
            if self.age > self.bridge {
                self.known = false;
                self.matrix = LEVEL;
                events.push(tick, Event::AttitudeLost);
            }
        }
    }
}
