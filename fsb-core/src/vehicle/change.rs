//! Has a parameter changed?
//!
//! With k off by Δk the observer's innovation is r = T² Δk φ, where φ obeys the observer's own recursion (design, section 6),
//!
//! φ = e + w + j2,   e ← m1 φ,   w ← w + j1 - T l2 φ,   where nothing was measured e ← φ,   w ← w + j1,
//!
//! whatever the input and the gains. In the steady state it is the input through the two stages (1-p)²/(1-p z⁻¹)² over
//! (1-p)². So at every instant κ = Σ r φ/(T² Σ φ²), over the axes that share k, is Δk and what noise makes of it:
//! var κ = Σ φ² var r/(T² Σ φ²)², var r being σ² times (6 + 2p)/(1+p)³, the power of (1-z⁻¹)²/(1-p z⁻¹)². An acceleration across φ, by
//! wind or drag, leaves nothing in κ; one along it does, as Δk of its size does.
//!
//! The sums go over the axes at an instant, which tells a large change at once, and over the last 10/λ as well, which finds it
//! in noise: r has little power where φ has most, so that its var κ, taken as that of white noise, is on the safe side.
//!
//! An acceleration that is expected to be there without any change, of standard deviation d, adds what it makes of r, T² d/(T l2),
//! to the noise; over the last 10/λ as what is correlated over 2/λ. So does what r² has been beyond noise for long, which may be gusts, or
//! noise that wanders: in either a rule that knew of white noise alone would find one change after another.
//!
//! What the innovations hide the identifier's residuals may show ([`super::residual`]).
//!
//! A change is one by more than `relative` and by more than `sigmas`, several instants in succession, and never where the input
//! is small beside what it has been: there an unknown moment would be taken for a change of inertia. After a long gap all of it
//! begins anew, as after a start.

mod stored;

use super::config::ChangeRule;
use super::doubt::Doubt;
use super::long_mean::LongMeans;
use super::residual::Residuals;
use super::statistic::{Limits, Statistic, Terms};
use crate::error::{ConfigError, finite, positive};
use crate::estimator::{IdentifierView, InnovationView};

/// φ and what it comes from, one axis.
#[derive(Clone, Copy, Debug, Default)]
struct Response {
    phi: f32,
    e: f32,
    w: f32,
}

/// For three axes, with one parameter or one each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Detector {
    pub relative: f32,
    sigmas2: f32,
    /// T²
    period2: f32,
    /// var r over σ²
    innovation_gain: f32,
    /// T² d
    disturbance: f32,
    /// Instants after a start in which nothing is decided.
    hold_off: u32,
    /// Instants in succession that make a change.
    enough: u32,
    pooled: bool,
    responses: [Response; 3],
    /// Mean of φ² since the start, of each parameter.
    usual: [f32; 3],
    /// At the instant, and over the last ones.
    statistics: [Statistic; 2],
    instants: u32,
    /// Instants in succession at which a parameter was contradicted.
    contradicted: u32,
    /// The last instant was measured.
    measured: bool,
    /// Parameters that were known then.
    known: [bool; 3],
    /// At any time of this identification.
    was_known: [bool; 3],
    residuals: Residuals,
    /// r² of each axis.
    squares: LongMeans,
    /// The share of one instant in them.
    share: f32,
    pub doubt: Doubt,
}

impl Detector {
    /// r² of so many times what the noise is taken to make of it may be that of noise.
    const NOISE: f32 = 1.5;
    /// φ² below this share of its mean says nothing.
    const LEAST: f32 = 0.1;
    /// φ² that has grown to so many times its mean, nothing being measured, is what a gap makes of it.
    const GAP: f32 = 100.0;

    /// `period` is that of the measurements (s), λ (1/s) the observer's, `step` the identifier's λ times its period, and the standard
    /// deviation that of the disturbance (m/s² or rad/s²); all have been checked.
    pub fn new(
        rule: &ChangeRule,
        lambda: f64,
        period: f64,
        step: f64,
        disturbance_sd: f64,
        pooled: bool,
    ) -> Result<Self, ConfigError> {
        let hold_off = finite("change.hold_off", rule.hold_off)?;
        if hold_off < 0.0 {
            return Err(ConfigError::Negative("change.hold_off"));
        }
        for (name, value, range) in [
            ("change.relative", positive("change.relative", rule.relative)?, 1e-3..=1e3),
            ("change.sigmas", positive("change.sigmas", rule.sigmas)?, 1.0..=1e3),
            ("change.hold_off", hold_off, 0.0..=1e6),
        ] {
            if !range.contains(&value) {
                return Err(ConfigError::OutOfRange(name));
            }
        }
        // While the observer forgets its start.
        let hold_off = libm::fmax(hold_off, 4.0 / lambda);
        let p = libm::exp(-lambda * period);
        let count = |seconds: f64| libm::fmin(libm::ceil(seconds / period), 4e9) as u32;
        let (relative, sigmas2) = (rule.relative as f32, (rule.sigmas * rule.sigmas) as f32);
        Ok(Self {
            relative,
            sigmas2,
            period2: (period * period) as f32,
            innovation_gain: ((6.0 + 2.0 * p) / ((1.0 + p) * (1.0 + p) * (1.0 + p))) as f32,
            disturbance: (period * period * disturbance_sd) as f32,
            hold_off: count(hold_off),
            enough: count(0.2 / lambda).max(5),
            pooled,
            responses: [Response::default(); 3],
            usual: [0.0; 3],
            statistics: [
                Statistic::new(0.0, 1.0),
                Statistic::new(libm::exp(-0.1 * lambda * period), 1.0 + 2.0 / (lambda * period)),
            ],
            instants: 0,
            contradicted: 0,
            measured: false,
            known: [false; 3],
            was_known: [false; 3],
            residuals: Residuals::new(relative, sigmas2, step, pooled),
            squares: LongMeans::default(),
            // Over 100/λ, and no more than what f32 can add up.
            share: libm::fmax(0.01 * lambda * period, 1e-6) as f32,
            doubt: Doubt::new(count(libm::fmax(rule.hold_off, Doubt::HALF))),
        })
    }

    /// The identification has begun anew.
    pub fn reset(&mut self) {
        self.usual = [0.0; 3];
        for statistic in &mut self.statistics {
            statistic.reset();
        }
        self.residuals.reset();
        (self.instants, self.contradicted, self.was_known) = (0, 0, [false; 3]);
    }

    /// The observer has begun anew.
    pub fn restart(&mut self) {
        self.reset();
        self.responses = [Response::default(); 3];
        self.measured = false;
    }

    /// After a measurement instant; `known` is k of each axis, where it is identified, and `contradicted` tells whether the motion
    /// contradicts it, which counts for one that was known. Whether a parameter has changed: with noise it may be contradicted before the innovations have shown
    /// what k is now, and would be for as long as there is more in its sums of before than of since. Cost: about 160 operations.
    pub fn observe(&mut self, view: &InnovationView<3>, known: &[Option<f32>; 3], contradicted: &[bool; 3]) -> bool {
        for (response, input) in self.responses.iter_mut().zip(&view.moments) {
            response.phi = response.e + response.w + input.j2;
            let correction = if view.measured { view.t_l2 * response.phi } else { 0.0 };
            response.e = if view.measured { view.m1 * response.phi } else { response.phi };
            response.w += input.j1 - correction;
        }
        // The first one after a gap has another variance.
        let (sound, gap) = (view.measured && self.measured, !view.measured && !self.measured);
        self.measured = view.measured;
        if !sound {
            if gap && self.has_outgrown(view) {
                self.restart();
            }
            return false;
        }
        self.instants = self.instants.saturating_add(1);
        self.forget_guesses(known);
        if self.instants > self.hold_off {
            self.squares.add_squares(&view.innovations, self.share);
        }
        self.doubt.go_on(known);
        let terms = self.terms(view);
        let share = 1.0 / self.instants as f32;
        for (usual, term) in self.usual.iter_mut().zip(&terms) {
            *usual += (term.square - *usual) * share;
        }
        let limits = Limits {
            relative: self.relative * self.period2,
            sigmas2: self.sigmas2,
            least: self.usual.map(|usual| Self::LEAST * usual),
            open: self.instants > self.hold_off,
        };
        let [now, late] = &mut self.statistics;
        let streak = now.add(&terms, known, &limits).max(late.add(&terms, known, &limits));
        let contradicted =
            contradicted.iter().zip(&self.was_known).any(|(contradicted, known)| *contradicted && *known);
        self.contradicted = if contradicted && limits.open { self.contradicted.saturating_add(1) } else { 0 };
        streak >= self.enough || self.contradicted >= self.enough
    }

    /// Whether the identifier, which has come to so many blocks, has gone far enough to be [looked at](Self::observe_residuals) again.
    pub fn is_behind(&self, blocks: u32) -> bool {
        self.residuals.are_behind(blocks)
    }

    /// After a step of the identifier, as [`observe`](Self::observe): whether a parameter has changed. `learned` is k of each axis, where it is
    /// identified, even if it has become too uncertain since it was known.
    pub fn observe_residuals(&mut self, view: &IdentifierView<3>, mut learned: [Option<f32>; 3]) -> bool {
        for (k, _) in learned.iter_mut().zip(&self.was_known).filter(|(_, was_known)| !**was_known) {
            *k = None;
        }
        self.residuals.observe(view, &learned) && self.instants > self.hold_off
    }

    /// What a parameter that has just become known left in the innovations while another value was predicted with, its own and by
    /// the gyroscopic moment the others', tells nothing of a change of it.
    fn forget_guesses(&mut self, known: &[Option<f32>; 3]) {
        let known = known.map(|k| k.is_some());
        if known.iter().zip(&self.known).any(|(now, before)| *now && !before) {
            for statistic in &mut self.statistics {
                statistic.reset();
            }
        }
        for (was, now) in self.was_known.iter_mut().zip(known) {
            *was |= now;
        }
        self.known = known;
    }

    /// Whether a gap, of some 3/λ, has let φ grow so far that its mean would be one of the gap from then on, and what comes
    /// after it small beside it. The observer's start is forgotten by the time something is decided again.
    fn has_outgrown(&self, view: &InnovationView<3>) -> bool {
        let mut usual = self.usual.iter();
        if self.pooled {
            let square: f32 = self.responses.iter().map(|response| response.phi * response.phi).sum();
            return usual.next().is_some_and(|usual| square > Self::GAP * usual);
        }
        let noises = self.responses.iter().zip(&view.noise_variances);
        noises
            .zip(usual)
            .any(|((response, noise), usual)| noise.is_some() && response.phi * response.phi > Self::GAP * usual)
    }

    /// Of each parameter, the first one where all axes share it.
    fn terms(&self, view: &InnovationView<3>) -> [Terms; 3] {
        let mut terms = [Terms::default(); 3];
        let of_disturbance = if view.t_l2 > 0.0 { self.disturbance / view.t_l2 } else { 0.0 };
        let of_axes =
            self.responses.iter().zip(&view.innovations).zip(&view.noise_variances).zip(self.squares.values());
        for (axis, (((response, r), noise), usual)) in of_axes.enumerate() {
            if let Some(noise) = noise
                && let Some(term) = terms.get_mut(if self.pooled { 0 } else { axis })
            {
                let square = response.phi * response.phi;
                term.product += r * response.phi;
                term.square += square;
                let of_noise = noise * self.innovation_gain;
                term.variance += square * of_noise;
                let (expected, usual) = (of_disturbance * of_disturbance, usual - Self::NOISE * of_noise);
                term.disturbed += square * if usual > expected { usual } else { expected };
            }
        }
        terms
    }
}
