//! What the actuators really do: first order behind what they are told (τ F' = F_told - F), or at once.
//!
//! Over a control period dt, s from 0 to 1, with the command held: F(s) = A + B e^(-x s), x = dt/τ, A the command and B what
//! was missing at the start. Everything that is needed of it are four numbers, computed once:
//! e^(-x), and E_n = ∫ s^n e^(-x s) ds over 0..1 for n = 0, 1, 2.

use super::measured::Wrench;
use crate::attitude::rotation::{self, Matrix};
use crate::error::{ConfigError, positive};
use crate::moments::InputMoments;

/// Constants of the lag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Actuators {
    lags: bool,
    /// e^(-x)
    decay: f32,
    /// E_0
    e0: f32,
    /// E_1
    e1: f32,
    /// E_0 - E_1
    e01: f32,
    /// E_1 - E_2
    e12: f32,
}

/// One control period: A + B e^(-x s).
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    told: Wrench,
    rest: Wrench,
}

impl Actuators {
    pub fn new(time_constant: Option<f64>, period: f64) -> Result<Self, ConfigError> {
        let Some(time_constant) = time_constant else {
            return Ok(Self { lags: false, decay: 0.0, e0: 0.0, e1: 0.0, e01: 0.0, e12: 0.0 });
        };
        let x = period / positive("actuator_lag", time_constant)?;
        if x > 20.0 || time_constant > 1e3 {
            return Err(ConfigError::OutOfRange("actuator_lag"));
        }
        let [e0, e1, e2] = [0, 1, 2].map(|power| moment(power, x));
        Ok(Self {
            lags: true,
            decay: libm::exp(-x) as f32,
            e0: e0 as f32,
            e1: e1 as f32,
            e01: (e0 - e1) as f32,
            e12: (e1 - e2) as f32,
        })
    }

    /// e^(-dt/T_a): one for each lag.
    pub const fn decay(&self) -> f32 {
        self.decay
    }

    /// The course over a period at whose start they did `now` (unknown: what they were told), and what they do at its end.
    pub fn follow(&self, told: &Wrench, now: Option<Wrench>) -> (Course, Wrench) {
        if !self.lags {
            return (Course { told: *told, rest: Wrench::default() }, *told);
        }
        let now = now.unwrap_or(*told);
        let rest = combined(&now, told, |now, told| now - told);
        let then = combined(told, &rest, |told, rest| told + self.decay * rest);
        (Course { told: *told, rest }, then)
    }

    /// Moments of the torque over the period.
    pub fn torque(&self, course: &Course) -> [InputMoments; 3] {
        let mut moments = course.told.torque.map(|a| InputMoments { j1: a, j2: 0.5 * a });
        if self.lags {
            for (moment, b) in moments.iter_mut().zip(course.rest.torque) {
                moment.j1 += self.e0 * b;
                moment.j2 += self.e01 * b;
            }
        }
        moments
    }

    /// Moments over the period of the force along the world's axes, (R0 + (R1 - R0) s) F(s): R0 and R1 are the attitudes
    /// at its two ends. Cost: 45 operations, 50 more with a lag.
    pub fn force(&self, course: &Course, from: &Matrix, to: &Matrix) -> [InputMoments; 3] {
        let mut moments = [InputMoments::ZERO; 3];
        let ends = rotation::apply(from, &course.told.force).into_iter().zip(rotation::apply(to, &course.told.force));
        for (moment, (f0, f1)) in moments.iter_mut().zip(ends) {
            *moment = InputMoments { j1: 0.5 * (f0 + f1), j2: (f0 + f0 + f1) * (1.0 / 6.0) };
        }
        if self.lags {
            let rest = &course.rest.force;
            let ends = rotation::apply(from, rest).into_iter().zip(rotation::apply(to, rest));
            for (moment, (f0, f1)) in moments.iter_mut().zip(ends) {
                let turned = f1 - f0;
                moment.j1 += self.e0 * f0 + self.e1 * turned;
                moment.j2 += self.e01 * f0 + self.e12 * turned;
            }
        }
        moments
    }
}

fn combined(a: &Wrench, b: &Wrench, f: impl Fn(f32, f32) -> f32) -> Wrench {
    let each = |[ax, ay, az]: [f32; 3], [bx, by, bz]: [f32; 3]| [f(ax, bx), f(ay, by), f(az, bz)];
    Wrench { force: each(a.force, b.force), torque: each(a.torque, b.torque) }
}

/// ∫ s^n e^(-x s) ds over 0..1, x up to 20.
fn moment(power: i32, x: f64) -> f64 {
    // e^(-x) Σ x^k/((n+1)(n+2)...(n+1+k)): positive terms only.
    let n = f64::from(power);
    let (mut term, mut sum) = (1.0 / (n + 1.0), 0.0);
    for k in 1..120 {
        sum += term;
        term *= x / (n + 1.0 + f64::from(k));
    }
    libm::exp(-x) * sum
}
