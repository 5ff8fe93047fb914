//! What is proposed.

use super::identifier::{Excitation, Spread};
use super::{Sensor, observer, opening};
use fsb_core::Tuning;

/// What the velocity is to be like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wish {
    /// Standard deviation of the velocity \[m/s\].
    VelocityNoise(f64),
    /// For what the model does not know \[Hz\].
    Bandwidth(f64),
    /// For what the model does not know \[s\].
    Delay(f64),
    /// λ of the observer itself \[1/s\].
    Lambda(f64),
}

/// A wish that cannot be met.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TuneError {
    /// Beyond what any λ that the core accepts gives.
    #[error("{option} {value}: with this sensor {low:.3e} to {high:.3e} {unit} can be had")]
    OutOfReach {
        /// The command-line option.
        option: &'static str,
        /// Its value.
        value: f64,
        /// The least that can be had.
        low: f64,
        /// The most.
        high: f64,
        /// Of all three.
        unit: &'static str,
    },
    /// Nothing that tells k.
    #[error("--acceleration 0 with --gravity 0: an input that does nothing tells nothing of k")]
    NoExcitation,
}

/// λ, q and ε, and what they give.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// The sensor that it is for.
    pub sensor: Sensor,
    /// What the input does.
    pub excitation: Excitation,
    /// The observer's tuning.
    pub observer: Tuning,
    /// ε of the state \[s\]: the velocity is within twice its steady noise.
    pub state_settle: f64,
    /// Standard deviation of the velocity \[m/s\].
    pub velocity_sd: f64,
    /// Standard deviation of the position \[m\].
    pub position_sd: f64,
    /// For what the model does not know \[Hz\].
    pub bandwidth: f64,
    /// For what the model does not know \[s\].
    pub delay: f64,
    /// The identifier's tuning.
    pub identifier: Tuning,
    /// What two standard deviations of k are to be at ε, as a share of k.
    pub k_within: f64,
    /// ε of the parameter \[s\]; `None` where k is not that good within [`LONGEST`].
    pub parameter_settle: Option<f64>,
}

/// A k that takes longer \[s\] is not waited for.
pub const LONGEST: f64 = 120.0;
/// λ of the identifier that are tried \[1/s\].
const LAMBDAS: [f64; 9] = [0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0];
/// A λ is as good as another one if k takes at most so much longer with it, as a factor or in seconds.
const AS_GOOD: (f64, f64) = (1.25, 0.5);
/// The core learns the noise level in about this over λ, and hands out no k before.
const LEARNING: f64 = 0.75;
/// λ of the identifier where nothing speaks for another one \[1/s\]: the core's default.
const DEFAULT_IDENTIFIER: f64 = 2.0;

/// λ, q and ε for a wish, `k_within` being what two standard deviations of k are to be as a share of k.
///
/// q is half of λ in both, the paper's choice: the window then opens about as fast as the filter fills. Of the identifier's
/// λ the one nearest to the default of 2 is taken with which k is as good about as soon as with any.
///
/// # Errors
/// [`TuneError`]
pub fn propose(sensor: Sensor, wish: Wish, excitation: Excitation, k_within: f64) -> Result<Proposal, TuneError> {
    if excitation.gravity == 0.0 && excitation.acceleration == 0.0 {
        return Err(TuneError::NoExcitation);
    }
    let (slowest, fastest) = sensor.lambdas();
    let lambda = match wish {
        Wish::VelocityNoise(sd) => observer::lambda_for_velocity_sd(&sensor, sd),
        Wish::Bandwidth(hz) => observer::lambda_for_bandwidth(&sensor, hz),
        Wish::Delay(delay) => observer::lambda_for_delay(&sensor, delay),
        Wish::Lambda(lambda) => lambda,
    };
    // Rounding must not refuse an end of the range.
    if !(slowest * (1.0 - 1e-9)..=fastest * (1.0 + 1e-9)).contains(&lambda) {
        let at = |of: fn(&Sensor, f64) -> f64| (of(&sensor, slowest), of(&sensor, fastest));
        let (option, value, (a, b), unit) = match wish {
            Wish::VelocityNoise(sd) => ("--velocity-noise", sd, at(observer::velocity_sd), "m/s"),
            Wish::Bandwidth(hz) => ("--bandwidth", hz, at(observer::bandwidth), "Hz"),
            Wish::Delay(delay) => ("--delay", delay, at(observer::delay), "s"),
            Wish::Lambda(lambda) => ("--observer-lambda", lambda, (slowest, fastest), "1/s"),
        };
        return Err(TuneError::OutOfReach { option, value, low: a.min(b), high: a.max(b), unit });
    }
    let observer = Tuning::from_lambda(lambda.clamp(slowest, fastest));
    let time = |lambda: f64| {
        let reached = Spread::new(sensor, Tuning::from_lambda(lambda), excitation).time_to(k_within, LONGEST)?;
        Some(reached.max(LEARNING / lambda))
    };
    let tried: Vec<(f64, f64)> = LAMBDAS
        .iter()
        .filter(|&&lambda| (slowest..=fastest).contains(&(lambda / 2.0)) && lambda <= fastest)
        .filter_map(|&lambda| time(lambda).map(|t| (lambda, t)))
        .collect();
    let soonest = tried.iter().map(|&(_, t)| t).fold(f64::INFINITY, f64::min);
    let soon_enough = (AS_GOOD.0 * soonest).max(soonest + AS_GOOD.1);
    let away = |lambda: f64| (lambda / DEFAULT_IDENTIFIER).ln().abs();
    let as_good = tried.iter().filter(|&&(_, t)| t <= soon_enough);
    let best = as_good.min_by(|a, b| away(a.0).total_cmp(&away(b.0))).copied();
    let identifier = best.map_or(DEFAULT_IDENTIFIER.min(fastest), |(lambda, _)| lambda);
    Ok(Proposal {
        sensor,
        excitation,
        observer,
        state_settle: opening::settled(&sensor, observer),
        velocity_sd: observer::velocity_sd(&sensor, observer.lambda),
        position_sd: observer::position_sd(&sensor, observer.lambda),
        bandwidth: observer::bandwidth(&sensor, observer.lambda),
        delay: observer::delay(&sensor, observer.lambda),
        identifier: Tuning::from_lambda(identifier),
        k_within,
        parameter_settle: best.map(|(_, t)| t),
    })
}

impl Proposal {
    /// sd(k)/k at these times \[s\], rising, with the λ of the identifier or another one.
    #[must_use]
    pub fn spread(&self, identifier: Tuning, times: &[f64]) -> Vec<(f64, f64)> {
        let mut spread = Spread::new(self.sensor, identifier, self.excitation);
        let mut found = Vec::with_capacity(times.len());
        let mut last = spread.step();
        for &time in times {
            while last.0 < time - self.sensor.period / 2.0 {
                last = spread.step();
            }
            found.push((time, last.1));
        }
        found
    }
}
