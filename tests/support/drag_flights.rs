//! Flights with drag at random, and how far off is what is handed out of them.

use fsb_core::regression::{DragEstimator, Term};
use rand::RngExt;
use rand_pcg::Pcg64;

use crate::drag_flight::{DragFlight, Instant};

/// What is drawn: k of 0.2 to 30 1/kg, drag up to 1/2 1/s and disturbances up to 0.4 m/s² of each axis, amplitudes of up to 1.5, 1.5 and 1 m.
#[derive(Clone, Copy, Debug)]
pub struct Draw {
    /// One of these times between measurements (s).
    pub periods: [f64; 3],
    /// The share of axes that do not swing.
    pub still: f64,
    /// The decimal logarithm of the least standard deviation of the measurements (m), which goes up to 1 cm.
    pub noise: f64,
}

impl Draw {
    /// The next one.
    pub fn flight(&self, rng: &mut Pcg64) -> DragFlight {
        let mut uniform = |low: f64, high: f64| rng.random_range(low..high);
        let period = self.periods[uniform(0.0, 3.0) as usize];
        let mut amplitude = [1.5, 1.5, 1.0].map(|most| uniform(0.1 * most, most));
        amplitude.iter_mut().for_each(|a| *a = if uniform(0.0, 1.0) < self.still { 0.0 } else { *a });
        DragFlight {
            period,
            k: uniform(0.2, 30.0),
            drag: [(); 3].map(|()| uniform(0.0, 0.5)),
            disturbance: [(); 3].map(|()| uniform(-0.4, 0.4)),
            amplitude,
            noise: 10.0_f64.powf(uniform(self.noise, -2.0)),
            flutter: 0.0,
        }
    }
}

/// The largest errors of a flight.
#[derive(Clone, Copy, Debug, Default)]
pub struct Off {
    /// Of k, in its standard deviations.
    pub k: f64,
    /// Of a term, in its own.
    pub term: f64,
    /// States that were not handed out after [`Off::SETTLED`].
    pub stateless: u32,
    squares: [f64; 3],
    count: f64,
}

impl Off {
    /// Velocities count from then on (s).
    pub const SETTLED: f64 = 10.0;

    /// Compares with the truth. A velocity that is not handed out counts as off by 1 m/s.
    pub fn look(&mut self, estimator: &DragEstimator<3>, flight: &DragFlight, instant: &Instant) {
        if let Some(known) = estimator.parameter() {
            self.k = self.k.max((f64::from(known.value) - flight.k).abs() / f64::from(known.sd()));
        }
        for (i, terms) in estimator.terms().into_iter().enumerate() {
            for (told, truth) in [(terms.drag, flight.drag[i]), (terms.disturbance, flight.disturbance[i])] {
                if let Term::Known { value, sd } = told {
                    self.term = self.term.max((f64::from(value) - truth).abs() / f64::from(sd));
                }
            }
        }
        if instant.t > Self::SETTLED {
            self.count += 1.0;
            for ((sum, state), truth) in self.squares.iter_mut().zip(estimator.states()).zip(instant.velocity) {
                self.stateless += u32::from(state.is_none());
                *sum += state.map_or(1.0, |state| (f64::from(state.velocity) - truth).powi(2));
            }
        }
    }

    /// How far off the velocities of the worst axis are from 10 s on (rms), in what noise makes of them at the observer's default λ = 10
    /// where nothing is missing.
    pub fn velocity(&self, flight: &DragFlight) -> f64 {
        // var v = 2 (1-p)³/(1+p)³ σ²/T².
        let p = (-10.0 * flight.period).exp();
        let noise = flight.noise / flight.period * (2.0 * ((1.0 - p) / (1.0 + p)).powi(3)).sqrt();
        self.squares.iter().map(|sum| (sum / self.count).sqrt() / noise).fold(0.0, f64::max)
    }
}
