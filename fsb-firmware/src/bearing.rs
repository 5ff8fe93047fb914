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
    /// Good ones in a row that end an outage, so far and needed.
    good: u32,
    quiet: u32,
    /// A bad one was told in this outage.
    told: bool,
}

impl Bearing {
    /// For as long as the rotation is bridged; the configuration has been validated.
    pub fn of(config: &LoopConfig) -> Self {
        let periods = |time: f64| libm::round(time / config.rotation.period) as u32;
        let (bridge, quiet) = (periods(config.rotation_guard.bridge), periods(1.0));
        Self { matrix: LEVEL, known: false, age: 0, bridge, good: 0, quiet, told: false }
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
        match attitude {
            Some(matrix) if trusted && is_rotation(matrix) => {
                self.matrix = *matrix;
                self.age = 0;
                if !self.known {
                    self.known = true;
                    events.push(tick, Event::AttitudeUsable);
                }
                if self.told {
                    self.good += 1;
                    self.told = self.good < self.quiet;
                }
            }
            other => self.age_by_a_tick(other.is_some(), tick, events),
        }
    }

    fn age_by_a_tick(&mut self, rejected: bool, tick: u32, events: &mut Events) {
        if rejected {
            self.good = 0;
            if !self.told {
                self.told = true;
                events.push(tick, Event::AttitudeRejected);
            }
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
