//! The paths: three functions of time with their first two derivatives.

use serde::{Deserialize, Serialize};

use crate::hexarotor::ParameterError;
use crate::hexarotor::error::{check, check_each};
use crate::section_v::trajectory;

/// Three numbers and their derivatives at one time: a position, or (roll, pitch, yaw).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// [m] or [rad]
    pub value: [f64; 3],
    /// [m/s] or [rad/s]
    pub rate: [f64; 3],
    /// [m/s²] or [rad/s²]
    pub acceleration: [f64; 3],
}

/// x_d(t), world frame, z up.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum PositionPath {
    /// One place.
    Hover {
        /// Where [m]; 0.
        #[serde(default)]
        at: [f64; 3],
    },
    /// The spiral of Section V in the plane, rising as its radius grows: x = c + s (a sin φ, a cos φ), a = 9 - 8 e^(-0.2 τ),
    /// φ = (2 - e^(-τ)) τ, z = c_z + rise (1 - e^(-0.2 τ))², all at τ = pace · t.
    Spiral {
        /// c, the axis of the spiral and its lowest height [m]; 0.
        #[serde(default)]
        centre: [f64; 3],
        /// s; 1. Accelerations grow with it.
        #[serde(default = "one")]
        scale: f64,
        /// How fast time runs on the path; 1. Accelerations grow with its square.
        #[serde(default = "one")]
        pace: f64,
        /// How far it rises [m]; 0.
        #[serde(default)]
        rise: f64,
    },
    /// A sinusoid on each axis, see [`Sinusoids`].
    Sinusoids(Sinusoids),
}

/// η_d(t) = (roll, pitch, yaw).
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum AttitudePath {
    /// One attitude.
    Still {
        /// (roll, pitch, yaw) [rad]; 0.
        #[serde(default)]
        at: [f64; 3],
    },
    /// A sinusoid on each angle, see [`Sinusoids`].
    Sinusoids(Sinusoids),
}

impl Default for AttitudePath {
    fn default() -> Self {
        Self::Still { at: [0.0; 3] }
    }
}

/// c + r(t) A sin(ω t + φ) on each axis, r = (1 - e^(-t/ramp))²: with a ramp it starts at rest in c.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Sinusoids {
    /// c [m] or [rad]; 0.
    #[serde(default)]
    pub centre: [f64; 3],
    /// A [m] or [rad].
    pub amplitude: [f64; 3],
    /// ω [rad/s].
    pub frequency: [f64; 3],
    /// φ [rad]; 0.
    #[serde(default)]
    pub phase: [f64; 3],
    /// Time constant of the start [s]; 0, at once.
    #[serde(default)]
    pub ramp: f64,
}

fn one() -> f64 {
    1.0
}

fn still(value: [f64; 3]) -> Point {
    Point { value, ..Point::default() }
}

impl PositionPath {
    /// At `t` [s].
    pub fn at(&self, t: f64) -> Point {
        match self {
            Self::Hover { at } => still(*at),
            Self::Spiral { centre, scale, pace, rise } => spiral(*centre, *scale, *pace, *rise, t),
            Self::Sinusoids(path) => path.at(t),
        }
    }

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        match self {
            Self::Hover { at } => check_each("at", *at, -1e4..=1e4, "must each be of magnitude up to 10000 m"),
            Self::Spiral { centre, scale, pace, rise } => {
                check_each("centre", *centre, -1e4..=1e4, "must each be of magnitude up to 10000 m")?;
                check("scale", *scale, 0.0..=1e3, "must be from 0 to 1000")?;
                check("pace", *pace, 0.0..=1e3, "must be from 0 to 1000")?;
                check("rise", *rise, -1e3..=1e3, "must be of magnitude up to 1000 m")
            }
            Self::Sinusoids(path) => path.check(),
        }
    }
}

impl AttitudePath {
    /// At `t` [s].
    pub fn at(&self, t: f64) -> Point {
        match self {
            Self::Still { at } => still(*at),
            Self::Sinusoids(path) => path.at(t),
        }
    }

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        match self {
            Self::Still { at } => check_each("at", *at, -10.0..=10.0, "must each be of magnitude up to 10 rad"),
            Self::Sinusoids(path) => path.check(),
        }
    }
}

impl Sinusoids {
    fn at(&self, t: f64) -> Point {
        let [r, dr, ddr] = self.opening(t);
        let mut point = still(self.centre);
        for i in 0..3 {
            let (a, w) = (self.amplitude[i], self.frequency[i]);
            let (sin, cos) = (w * t + self.phase[i]).sin_cos();
            point.value[i] += a * r * sin;
            point.rate[i] = a * (dr * sin + r * w * cos);
            point.acceleration[i] = a * (ddr * sin + 2.0 * dr * w * cos - r * w * w * sin);
        }
        point
    }

    /// r, r', r''.
    fn opening(&self, t: f64) -> [f64; 3] {
        if self.ramp == 0.0 {
            return [1.0, 0.0, 0.0];
        }
        let left = (-t / self.ramp).exp();
        let (open, speed) = (1.0 - left, left / self.ramp);
        [open * open, 2.0 * open * speed, 2.0 * speed * (speed - open / self.ramp)]
    }

    fn check(&self) -> Result<(), ParameterError> {
        check_each("centre", self.centre, -1e4..=1e4, "must each be of magnitude up to 10000")?;
        check_each("amplitude", self.amplitude, -1e3..=1e3, "must each be of magnitude up to 1000")?;
        check_each("frequency", self.frequency, -1e3..=1e3, "must each be of magnitude up to 1000 rad/s")?;
        check_each("phase", self.phase, -1e3..=1e3, "must each be of magnitude up to 1000 rad")?;
        check("ramp", self.ramp, 0.0..=1e3, "must be from 0 to 1000 s")
    }
}

fn spiral(centre: [f64; 3], scale: f64, pace: f64, rise: f64, t: f64) -> Point {
    let [x, y] = trajectory::reference(pace * t);
    let slow = (-0.2 * pace * t).exp();
    let (open, speed) = (1.0 - slow, 0.2 * pace * slow);
    Point {
        value: [centre[0] + scale * x.position, centre[1] + scale * y.position, centre[2] + rise * open * open],
        rate: [scale * pace * x.velocity, scale * pace * y.velocity, 2.0 * rise * open * speed],
        acceleration: [
            scale * pace * pace * x.acceleration,
            scale * pace * pace * y.acceleration,
            2.0 * rise * speed * (speed - 0.2 * pace * open),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rates and accelerations are those of the values, by central differences.
    #[test]
    fn derivatives_belong_to_the_values() {
        let sinusoids = Sinusoids {
            centre: [0.1, 0.2, -0.3],
            amplitude: [0.4, -0.3, 0.8],
            frequency: [2.0, 3.1, 1.3],
            phase: [0.0, 1.0, -0.4],
            ramp: 0.5,
        };
        let at_once = Sinusoids { ramp: 0.0, ..sinusoids };
        let spiral = PositionPath::Spiral { centre: [1.0, 2.0, 3.0], scale: 0.3, pace: 0.7, rise: 2.0 };
        let paths: [&dyn Fn(f64) -> Point; 3] = [&|t| sinusoids.at(t), &|t| at_once.at(t), &|t| spiral.at(t)];
        let h = 1e-4;
        for (number, path) in paths.iter().enumerate() {
            for t in [0.2, 1.0, 3.7, 12.0] {
                let [before, here, after] = [path(t - h), path(t), path(t + h)];
                for i in 0..3 {
                    let rate = (after.value[i] - before.value[i]) / (2.0 * h);
                    let acceleration = (after.value[i] - 2.0 * here.value[i] + before.value[i]) / (h * h);
                    assert!((here.rate[i] - rate).abs() < 1e-6, "path {number}, axis {i}, t = {t}");
                    assert!((here.acceleration[i] - acceleration).abs() < 1e-5, "path {number}, axis {i}, t = {t}");
                }
            }
        }
    }

    /// At full size and pace the plane of the spiral is the paper's.
    #[test]
    fn the_spiral_is_that_of_the_paper() {
        let path = PositionPath::Spiral { centre: [0.0; 3], scale: 1.0, pace: 1.0, rise: 0.0 };
        let t: f64 = 4.0;
        let (a, phase) = (9.0 - 8.0 * (-0.8_f64).exp(), (2.0 - (-t).exp()) * t);
        let [x, y, z] = path.at(t).value;
        assert!((x - a * phase.sin()).abs() < 1e-12 && (y - a * phase.cos()).abs() < 1e-12 && z == 0.0);
    }

    #[test]
    fn a_ramp_starts_at_rest() {
        let path = Sinusoids { centre: [0.5; 3], amplitude: [1.0; 3], frequency: [3.0; 3], phase: [1.0; 3], ramp: 0.4 };
        let start = path.at(0.0);
        assert_eq!((start.value, start.rate), ([0.5; 3], [0.0; 3]));
    }
}
