//! A noise-free recording of one axis that follows a sine under a PD-like law.

use super::HeldInputAxis;

const DAMPING: f64 = 5.0;
const STIFFNESS: f64 = 6.0;

/// The reference motion: y_d(t) = centre + amplitude sin(frequency t).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// [m]
    pub centre: f64,
    /// [m]
    pub amplitude: f64,
    /// [rad/s]
    pub frequency: f64,
}

/// What to record. The default is a vertical axis at 1 kHz, 20 s, 3 m away from the origin, starting off its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordingConfig {
    /// Time between samples, and the time the force is held [s]. Below 0.3 s the law is stable.
    pub period: f64,
    /// How many samples.
    pub samples: usize,
    /// k of y'' = k f + c; not zero.
    pub k: f64,
    /// c [m/s²].
    pub drift: f64,
    /// y(0) [m].
    pub position: f64,
    /// y'(0) [m/s].
    pub velocity: f64,
    /// What the axis follows.
    pub motion: Motion,
    /// Round each force to f32 before it acts, so that an f32 estimator and an f64 one can be given the very same input.
    pub force_in_f32: bool,
}

impl Default for RecordingConfig {
    fn default() -> Self {
        Self {
            period: 1e-3,
            samples: 20_000,
            k: 1.0 / 1.3,
            drift: -9.81,
            position: 3.0,
            velocity: -1.5,
            motion: Motion { centre: 3.0, amplitude: 1.0, frequency: 1.0 },
            force_in_f32: true,
        }
    }
}

/// Samples at t = n T and the force held over [n T, (n+1) T).
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// T [s].
    pub period: f64,
    /// y(n T) [m].
    pub positions: Vec<f64>,
    /// y'(n T) [m/s].
    pub velocities: Vec<f64>,
    /// f over [n T, (n+1) T) [N]. The force of the last sample acts after the recording's end.
    pub forces: Vec<f64>,
}

/// Flies the axis and records it: k f = -c - 5 (y' - y_d') - 6 (y - y_d).
pub fn record(config: &RecordingConfig) -> Recording {
    let mut axis =
        HeldInputAxis { position: config.position, velocity: config.velocity, k: config.k, drift: config.drift };
    let Motion { centre, amplitude, frequency } = config.motion;
    let room = || Vec::with_capacity(config.samples);
    let mut recording = Recording { period: config.period, positions: room(), velocities: room(), forces: room() };
    for n in 0..config.samples {
        let phase = frequency * n as f64 * config.period;
        let rate_error = axis.velocity - amplitude * frequency * phase.cos();
        let error = axis.position - centre - amplitude * phase.sin();
        let mut force = (-config.drift - DAMPING * rate_error - STIFFNESS * error) / config.k;
        if config.force_in_f32 {
            force = f64::from(force as f32);
        }
        recording.positions.push(axis.position);
        recording.velocities.push(axis.velocity);
        recording.forces.push(force);
        axis.step(force, config.period);
    }
    recording
}

#[cfg(test)]
mod tests {
    use super::{RecordingConfig, record};

    /// The samples obey y[n] - 2 y[n-1] + y[n-2] = k T²/2 (f[n-1] + f[n-2]) + c T².
    #[test]
    fn obeys_the_difference_equation() {
        let config = RecordingConfig { period: 0.02, samples: 1000, ..Default::default() };
        let r = record(&config);
        for n in 2..config.samples {
            let left = r.positions[n] - 2.0 * r.positions[n - 1] + r.positions[n - 2];
            let t2 = config.period * config.period;
            let right = config.k * t2 / 2.0 * (r.forces[n - 1] + r.forces[n - 2]) + config.drift * t2;
            assert!((left - right).abs() < 4e-15, "sample {n}: {left} against {right}");
        }
    }

    /// The motion settles near its reference and stays excited: metres of travel about 3 m.
    #[test]
    fn follows_its_reference() {
        let r = record(&RecordingConfig::default());
        let late = &r.positions[10_000..];
        let (low, high) = late.iter().fold((f64::MAX, f64::MIN), |(l, h), &y| (l.min(y), h.max(y)));
        assert!(low > 1.0 && low < 2.5 && high > 3.5 && high < 5.0, "{low} .. {high}");
        assert!(r.forces.iter().all(|&f| f == f64::from(f as f32)));
    }
}
