//! Three axes with linear drag and a constant disturbance, flown by a PD-like law: the truth for the regression.

use fsb_core::regression::{DragConfig, DragEstimator, Term};
use rand::SeedableRng;
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;

/// y'' = k f - D y' + a, the input held over each step, moved in closed form.
#[derive(Clone, Copy, Debug)]
pub struct DragAxis {
    /// y (m).
    pub position: f64,
    /// y' [m/s].
    pub velocity: f64,
    /// k [1/kg].
    pub k: f64,
    /// D [1/s].
    pub drag: f64,
    /// Known drift and disturbance, c + d [m/s²].
    pub acceleration: f64,
}

impl DragAxis {
    /// Moves `dt` (s) ahead with the input held at `f` (N).
    pub fn step(&mut self, f: f64, dt: f64) {
        let a = self.k * f + self.acceleration;
        let x = self.drag * dt;
        // (1 - e^(-x))/x and (1 - that)/x, by series where the quotients would cancel.
        let (first, second) = if x.abs() < 1e-2 {
            let first = 1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0))));
            (first, 0.5 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0 * (1.0 - x / 7.0))))))
        } else {
            let first = -(-x).exp_m1() / x;
            (first, (1.0 - first) / x)
        };
        self.position += dt * first * self.velocity + dt * dt * second * a;
        self.velocity += dt * first * a - x * first * self.velocity;
    }
}

/// What to fly.
#[derive(Clone, Copy, Debug)]
pub struct DragFlight {
    /// Time between measurements (s), the input being held in between.
    pub period: f64,
    /// k [1/kg].
    pub k: f64,
    /// D of each axis [1/s].
    pub drag: [f64; 3],
    /// d of each axis [m/s²]; gravity acts on z besides.
    pub disturbance: [f64; 3],
    /// Amplitude of the reference on each axis (m).
    pub amplitude: [f64; 3],
    /// Standard deviation of the measurements (m).
    pub noise: f64,
    /// Standard deviation of a known, white part of the input [m/s²].
    pub flutter: f64,
}

/// Gravity on z [m/s²].
pub const DRIFT: [f64; 3] = [0.0, 0.0, -9.81];

/// One measurement instant of a flight.
#[derive(Clone, Copy, Debug)]
pub struct Instant {
    /// Time (s).
    pub t: f64,
    /// Measured positions (m).
    pub measured: [f32; 3],
    /// True velocities [m/s].
    pub velocity: [f64; 3],
    /// The forces held from now on (N), as the estimator is given them.
    pub force: [f32; 3],
}

/// The vehicle in flight. What it obeys may change from one instant to the next.
#[derive(Clone, Copy, Debug)]
pub struct Flyer {
    n: u64,
    axes: [DragAxis; 3],
}

const CENTRE: [f64; 3] = [1.0, -2.0, 3.0];

impl Flyer {
    /// At the centre of its motion, already moving unless the reference stands still.
    pub fn new(flight: &DragFlight) -> Self {
        let axes = [0, 1, 2].map(|i| DragAxis {
            position: CENTRE[i],
            velocity: [0.2, -0.1, 0.3][i] * flight.amplitude[i],
            k: 0.0,
            drag: 0.0,
            acceleration: 0.0,
        });
        Self { n: 0, axes }
    }

    /// The present instant, and on to the next one. The law flies on the truth: the noise is only measured.
    pub fn step(&mut self, flight: &DragFlight, rng: &mut Pcg64) -> Instant {
        self.step_in(flight, [0.0; 3], rng)
    }

    /// The same with accelerations [m/s²] beside the flight's until the next instant, which the law knows by their effect alone.
    pub fn step_in(&mut self, flight: &DragFlight, gusts: [f64; 3], rng: &mut Pcg64) -> Instant {
        let unit = Normal::new(0.0, 1.0).expect("a standard deviation");
        let t = self.n as f64 * flight.period;
        self.n += 1;
        for (i, axis) in self.axes.iter_mut().enumerate() {
            axis.k = flight.k;
            axis.drag = flight.drag[i];
            axis.acceleration = DRIFT[i] + flight.disturbance[i];
        }
        let instant = Instant {
            t,
            measured: self.axes.map(|a| (a.position + flight.noise * unit.sample(rng)) as f32),
            velocity: self.axes.map(|a| a.velocity),
            force: [0, 1, 2].map(|i| {
                let flutter = flight.flutter * unit.sample(rng) / flight.k;
                (flight.force(i, t, &self.axes[i]) + flutter) as f32
            }),
        };
        for ((axis, f), gust) in self.axes.iter_mut().zip(instant.force).zip(gusts) {
            axis.acceleration += gust;
            axis.step(f64::from(f), flight.period);
        }
        instant
    }
}

impl DragFlight {
    /// The instants of a flight of `seconds`.
    pub fn fly<'a>(&self, seconds: f64, rng: &'a mut Pcg64) -> impl Iterator<Item = Instant> + use<'a> {
        let (flight, mut flyer) = (*self, Flyer::new(self));
        (0..(seconds / flight.period) as usize).map(move |_| flyer.step(&flight, rng))
    }

    fn force(&self, i: usize, t: f64, axis: &DragAxis) -> f64 {
        let (w, a) = ([1.3, 1.7, 1.1][i], self.amplitude[i]);
        let (target, rate) = (
            CENTRE[i] + a * ((w * t).sin() + 0.4 * (2.3 * w * t).cos() - 0.4),
            a * w * ((w * t).cos() - 0.92 * (2.3 * w * t).sin()),
        );
        let wanted = 6.0 * (target - axis.position) + 5.0 * (rate - axis.velocity);
        (wanted - axis.acceleration + axis.drag * axis.velocity) / axis.k
    }
}

/// Lissajous-like motion, drag and trim on every axis, no noise.
pub const FLIGHT: DragFlight = DragFlight {
    period: 0.01,
    k: 1.0 / 1.3,
    drag: [0.35, 0.5, 0.2],
    disturbance: [0.3, -0.4, 0.25],
    amplitude: [0.8, 0.6, 0.5],
    noise: 0.0,
    flutter: 0.0,
};

/// On the default configuration, gravity known.
pub fn estimator(period: f64) -> DragEstimator<3> {
    DragEstimator::new(&DragConfig { drift: DRIFT, ..DragConfig::new(period) }).expect("a valid configuration")
}

/// One instant: measured, then applied.
pub fn feed(estimator: &mut DragEstimator<3>, instant: &Instant) {
    estimator.measure(&instant.measured.map(Some)).expect("in step");
    estimator.apply(&instant.force);
}

/// A flight from its begin.
pub fn fly(estimator: &mut DragEstimator<3>, flight: &DragFlight, seconds: f64, seed: u64) {
    fly_on(estimator, &mut Flyer::new(flight), flight, seconds, &mut Pcg64::seed_from_u64(seed));
}

/// The same flight going on.
pub fn fly_on(estimator: &mut DragEstimator<3>, flyer: &mut Flyer, flight: &DragFlight, seconds: f64, rng: &mut Pcg64) {
    for _ in 0..(seconds / flight.period) as usize {
        feed(estimator, &flyer.step(flight, rng));
    }
}

/// A term that must be known.
pub fn value(term: Term) -> f64 {
    f64::from(term.value().expect("known"))
}
