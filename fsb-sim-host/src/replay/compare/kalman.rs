//! A Kalman filter with two states, position and velocity, that knows the input: what one would use in place of the observer.
//!
//! x' = v, v' = k f + c + w, w white with spectral density s \[m²/s³\]; y = x + noise of variance R. Over a step T the process noise has the
//! covariance s \[T³/3, T²/2; T²/2, T\]. R is that of the log; s is the one under which the log's own innovations are most
//! likely, so the filter is as well tuned to this very flight as it can be without looking at the reference.

use crate::replay::log::{AxisColumn, AxisLog};

/// A filter for one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kalman {
    /// k of the input.
    pub k: f64,
    /// c \[m/s²\].
    pub drift: f64,
    /// R \[m²\].
    pub noise_variance: f64,
    /// s \[m²/s³\].
    pub process: f64,
}

/// Position, velocity and covariance.
#[derive(Clone, Copy)]
struct State {
    y: f64,
    v: f64,
    yy: f64,
    yv: f64,
    vv: f64,
}

/// Velocities per sample, and the log-likelihood of the innovations.
#[derive(Clone, Debug, PartialEq)]
pub struct Filtered {
    /// \[m/s\]; `None` before the second measurement.
    pub velocity: Vec<Option<f64>>,
    /// Up to a constant.
    pub likelihood: f64,
}

/// Variance of the first velocity \[m²/s²\]: nothing is known of it.
const UNKNOWN: f64 = 1e4;

impl Kalman {
    /// Filters an axis.
    #[must_use]
    pub fn filter(&self, log: &AxisLog, axis: &AxisColumn) -> Filtered {
        let t = log.period;
        let mut state: Option<State> = None;
        let mut found = Filtered { velocity: Vec::with_capacity(axis.position.len()), likelihood: 0.0 };
        let mut measurements = 0;
        for (n, measured) in axis.position.iter().enumerate() {
            if let (Some(x), Some(before)) = (&mut state, n.checked_sub(1)) {
                let input = axis.moments(before, t);
                x.y += t * x.v + self.k * input.j2 + self.drift * t * t / 2.0;
                x.v += self.k * input.j1 + self.drift * t;
                x.yy += t * (2.0 * x.yv + t * x.vv) + self.process * t * t * t / 3.0;
                x.yv += t * x.vv + self.process * t * t / 2.0;
                x.vv += self.process * t;
            }
            if let Some(y) = *measured {
                measurements += 1;
                match &mut state {
                    Some(x) => {
                        let (innovation, variance) = (y - x.y, x.yy + self.noise_variance);
                        if measurements > 2 {
                            found.likelihood -= 0.5 * (variance.ln() + innovation * innovation / variance);
                        }
                        let (gain_y, gain_v) = (x.yy / variance, x.yv / variance);
                        x.y += gain_y * innovation;
                        x.v += gain_v * innovation;
                        x.vv -= gain_v * x.yv;
                        x.yv *= 1.0 - gain_y;
                        x.yy *= 1.0 - gain_y;
                    }
                    None => state = Some(State { y, v: 0.0, yy: self.noise_variance, yv: 0.0, vv: UNKNOWN }),
                }
            }
            found.velocity.push(state.filter(|_| measurements >= 2).map(|x| x.v));
        }
        found
    }

    /// The filter with the process noise under which the innovations of `axis` are most likely, within 1e-8..=1e4 m²/s³.
    #[must_use]
    pub fn tuned(self, log: &AxisLog, axis: &AxisColumn) -> Self {
        let with = |exponent: f64| Self { process: 10f64.powf(exponent), ..self };
        let likelihood = |exponent: f64| with(exponent).filter(log, axis).likelihood;
        let coarse = (-16..=8).map(|half| 0.5 * f64::from(half)).map(|exponent| (exponent, likelihood(exponent)));
        let best = coarse.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0.0, |(exponent, _)| exponent);
        let fine = (-5..=5).map(|tenth| best + 0.1 * f64::from(tenth)).map(|exponent| (exponent, likelihood(exponent)));
        with(fine.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(best, |(exponent, _)| exponent))
    }
}
