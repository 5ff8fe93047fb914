//! What differs from flight to flight: drawn from the flight's seed.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::error::Refused;
use super::scenario::Scenario;
use super::settings::EstimatorSettings;
use crate::hexarotor::ParameterError;

/// Ranges `[from, to]` from which a flight draws; one that is absent leaves the scenario as it is.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct RandomConfig {
    /// The true mass over the estimator's first guess; uniform in the logarithm.
    pub mass: Option<[f64; 2]>,
    /// Each true moment of inertia over its first guess, independently; uniform in the logarithm. The draw is repeated until
    /// each is at most the sum of the other two, as for every body.
    pub inertia: Option<[f64; 2]>,
    /// Initial roll, pitch and yaw [rad], each within plus or minus this.
    pub attitude: Option<f64>,
    /// Standard deviation of the position noise [m].
    pub position_noise: Option<[f64; 2]>,
    /// Standard deviation of the attitude noise [rad].
    pub attitude_noise: Option<[f64; 2]>,
    /// Latency of the position [s]. The attitude's is the scenario's, at most that of the position, or as `attitude_latency`
    /// says.
    pub position_latency: Option<[f64; 2]>,
    /// Latency of the attitude [s], at most that of the position.
    pub attitude_latency: Option<[f64; 2]>,
    /// Probability that a sample of either sensor is lost.
    pub dropout: Option<[f64; 2]>,
}

impl RandomConfig {
    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// `estimator` has the first guesses that mass and inertia are drawn around.
    pub(super) fn check(&self, estimator: &EstimatorSettings) -> Result<(), ParameterError> {
        const RATIO: (f64, f64, &str) = (1e-3, 1e3, "must be a range [from, to], in order, from 0.001 to 1000");
        const NOISE: (f64, f64, &str) = (0.0, 1e3, "must be a range [from, to], in order, from 0 to 1000");
        const TIME: (f64, f64, &str) = (0.0, 60.0, "must be a range [from, to], in order, from 0 to 60 s");
        const SHARE: (f64, f64, &str) = (0.0, 1.0, "must be a range [from, to], in order, from 0 to 1");
        let ranges = [
            ("mass", self.mass, RATIO),
            ("inertia", self.inertia, RATIO),
            ("position_noise", self.position_noise, NOISE),
            ("attitude_noise", self.attitude_noise, NOISE),
            ("position_latency", self.position_latency, TIME),
            ("attitude_latency", self.attitude_latency, TIME),
            ("dropout", self.dropout, SHARE),
        ];
        for (name, range, (least, most, needs)) in ranges {
            if let Some([from, to]) = range
                && !(least <= from && from <= to && to <= most)
            {
                return Err(ParameterError::new(name, [from, to], needs));
            }
        }
        if let (Some(range), None) = (self.mass, estimator.mass.nominal) {
            return Err(ParameterError::new("mass", range, "needs a first guess, estimator.mass.nominal"));
        }
        if let (Some(range), None) = (self.inertia, estimator.inertia.nominal) {
            return Err(ParameterError::new("inertia", range, "needs a first guess, estimator.inertia.nominal"));
        }
        match self.attitude {
            Some(most) if !(0.0..=1.5).contains(&most) => {
                Err(ParameterError::new("attitude", most, "must be from 0 to 1.5 rad"))
            }
            _ => Ok(()),
        }
    }
}

impl Scenario {
    /// The flight of `seed`: draws made, gusts seeded. The same seed gives the same flight on every machine.
    #[must_use]
    pub fn drawn(&self, seed: u64) -> Self {
        let mut flight = self.clone();
        flight.plant.wind.seed = self.plant.wind.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(seed);
        let mut draw = Draw(Pcg64::seed_from_u64(seed));
        let config = &self.random;
        if let (Some(range), Some(guess)) = (config.mass, self.estimator.mass.nominal) {
            flight.plant.mass = guess * draw.ratio(range);
        }
        if let (Some(range), Some(guess)) = (config.inertia, self.estimator.inertia.nominal) {
            // A range that holds no body at all is left after this many draws.
            for _ in 0..1000 {
                flight.plant.inertia = guess.map(|guess| guess * draw.ratio(range));
                let [x, y, z] = flight.plant.inertia;
                if x <= y + z && y <= x + z && z <= x + y {
                    break;
                }
            }
        }
        if let Some(most) = config.attitude {
            flight.plant.start.attitude = [(); 3].map(|()| draw.between([-most, most]));
        }
        let (position, attitude) = (&mut flight.sensors.position, &mut flight.sensors.attitude);
        for (range, to) in
            [(config.position_noise, &mut position.noise_sd), (config.attitude_noise, &mut attitude.noise_sd)]
        {
            if let Some(range) = range {
                *to = draw.between(range);
            }
        }
        if let Some(range) = config.position_latency {
            flight.position_is_late(draw.between(range));
        }
        if let Some([from, to]) = config.attitude_latency {
            let most = to.min(flight.sensors.position.latency);
            flight.sensors.attitude.latency = self.whole_ticks(draw.between([from.min(most), most]));
        }
        if let Some(range) = config.dropout {
            flight.sensors.position.dropout = draw.between(range);
            flight.sensors.attitude.dropout = draw.between(range);
        }
        flight
    }

    /// Checks the flights at both ends of what decides whether one can be flown at all.
    pub(super) fn check_draws(&self) -> Result<(), Refused> {
        let RandomConfig { mass, inertia, position_latency, attitude_latency, .. } = self.random;
        let check = |name, range: Option<[f64; 2]>, put: &dyn Fn(&mut Self, f64)| {
            let Some(range) = range else { return Ok(()) };
            range.into_iter().try_for_each(|end| {
                let mut flight = Self { random: RandomConfig::default(), ..self.clone() };
                put(&mut flight, end);
                flight.check().map_err(|refused| Refused::Drawn(name, range, end, Box::new(refused)))
            })
        };
        let EstimatorSettings { mass: guess, inertia: guesses, .. } = &self.estimator;
        check("mass", mass, &|flight, ratio| {
            flight.plant.mass = ratio * guess.nominal.unwrap_or(flight.plant.mass);
        })?;
        check("inertia", inertia, &|flight, ratio| {
            flight.plant.inertia = guesses.nominal.unwrap_or(flight.plant.inertia).map(|guess| ratio * guess);
        })?;
        check("position_latency", position_latency, &|flight, latency| flight.position_is_late(latency))?;
        check("attitude_latency", attitude_latency, &|flight, latency| {
            if let Some([_, latest]) = position_latency {
                flight.position_is_late(latest);
            }
            let latest = flight.sensors.position.latency;
            flight.sensors.attitude.latency = flight.whole_ticks(latency.min(latest));
        })
    }

    /// The attitude is at most as late as the position.
    fn position_is_late(&mut self, latency: f64) {
        self.sensors.position.latency = self.whole_ticks(latency);
        self.sensors.attitude.latency = self.sensors.attitude.latency.min(self.sensors.position.latency);
    }

    /// Down to whole control periods [s].
    fn whole_ticks(&self, time: f64) -> f64 {
        (time * self.rate + 1e-6).floor() / self.rate
    }
}

struct Draw(Pcg64);

impl Draw {
    fn between(&mut self, [from, to]: [f64; 2]) -> f64 {
        let share: f64 = self.0.random();
        from + share * (to - from)
    }

    fn ratio(&mut self, [from, to]: [f64; 2]) -> f64 {
        self.between([from.ln(), to.ln()]).exp()
    }
}
