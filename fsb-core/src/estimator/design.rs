//! A configuration validated and turned into constants.

use super::config::{EstimatorConfig, SharedConfig, or_nan};
use super::schedule::Schedule;
use crate::checks::{Checks, Fault, Range, rounded_up, rule};
use crate::error::{ConfigError, name};
use crate::identifier::{BlockDesign, IdentifierDesign};
use crate::moments::Substep;
use crate::observer::ObserverDesign;
use crate::readout::{CheckedRule, CovarianceDesign, NoiseLevel, ParameterRule, Readout, innovation_step_gain};
use crate::tuning::{Tuning, decayed};
use crate::wide::Wide;
use crate::window::WindowDesign;

/// The immutable part of an [`super::Estimator`]; one may serve several.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EstimatorDesign<const N: usize, const P: usize> {
    pub(super) common: Common,
    pub(super) axes: [AxisDesign; N],
    pub(super) parameters: [ParameterDesign; P],
}

/// What differs from axis to axis.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct AxisDesign {
    /// c
    pub drift: f32,
    /// c T²
    pub drift_t2: f32,
}

/// What differs from parameter to parameter.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct ParameterDesign {
    pub nominal: Option<f32>,
    pub rule: CheckedRule,
}

/// What does not depend on the number of axes.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Common {
    /// R
    pub substeps: u32,
    pub substep: Substep,
    /// 1/R
    pub substep_share: f32,
    /// M
    pub block_length: u32,
    pub schedule: Schedule,
    pub observer: ObserverDesign,
    /// The observer's window over `schedule.gains_every` samples.
    pub observer_stride: WindowDesign,
    pub identifier: IdentifierDesign,
    pub block: BlockDesign,
    pub covariance: CovarianceDesign,
    /// What turns the squared step of the innovation into the variance of a block's mean.
    pub innovation_to_mean: f32,
    pub readout: Readout,
    /// Least squares with infinite memory.
    pub plain: bool,
    /// 1 - μ over a block, for one of the axes that share a parameter: together they forget what τ says
    pub forgetting: f32,
    pub noise: NoiseLevel,
    /// Variance, behind the cascade, of what neither input nor drift is the cause of.
    pub disturbance: f32,
    /// An axis has a drift, or there is a disturbance: ẑu is needed.
    pub wants_unit: bool,
    /// T²
    pub period2: f32,
    /// The share that may stay unexplained; beyond 1 nothing is.
    pub max_misfit: f32,
    /// ε in measurements
    pub parameter_settle: u32,
    pub state_settle: u32,
    /// Measurements after which an observer that started late has forgotten its start
    pub late_settle: u32,
    pub position_limit: f32,
    pub input_limit: f32,
    /// As configured, for reports.
    pub observer_tuning: Tuning,
    pub measurement_period: f64,
}

impl<const N: usize, const P: usize> EstimatorDesign<N, P> {
    /// Validates `config`.
    ///
    /// # Errors
    /// Names the first parameter that cannot be right. Rates are judged by the period they run at: λ and q of the observer
    /// by the measurement period T, those of the identifier by M T; both products must be within 1e-6..=1.
    pub fn new(config: &EstimatorConfig<N, P>) -> Result<Self, ConfigError> {
        let mut checks = Checks::new();
        let mut common = Common::BLANK;
        common.fill(&config.shared(), Shape::of::<N, P>(), &mut checks);
        let axes = config.drift.map(|c| AxisDesign::new(c, &mut common, &mut checks));
        let mut rules = config.rule.iter();
        let parameters = config.nominal.map(|nominal| {
            let rule = rules.next().copied().unwrap_or_default();
            ParameterDesign::new(or_nan(nominal), &rule, &mut checks)
        });
        checks.outcome()?;
        Ok(Self { common, axes, parameters })
    }
}

impl AxisDesign {
    /// Under the known drift `drift` (m/s² or rad/s²); tells `common` of it.
    #[inline(never)]
    pub fn new(drift: f64, common: &mut Common, checks: &mut Checks) -> Self {
        let rounded = checks.signed(rule!("drift", Range::MAGNITUDE), drift);
        common.wants_unit |= rounded != 0.0;
        let period = Wide::new(common.measurement_period);
        Self { drift: rounded, drift_t2: (Wide::new(drift) * (period * period)).rounded() }
    }
}

impl ParameterDesign {
    /// `nominal` is NaN where it is not known.
    pub fn new(nominal: f64, rule: &ParameterRule, checks: &mut Checks) -> Self {
        let nominal = checks.if_known(rule!("nominal", Range::PARAMETER), nominal);
        Self { nominal, rule: rule.checked(checks) }
    }
}

/// The number of axes, and how many of them share a parameter.
#[derive(Clone, Copy)]
pub(super) struct Shape {
    axes: u8,
    pub sharing: u8,
}

impl Shape {
    /// N axes, P parameters.
    pub const fn of<const N: usize, const P: usize>() -> Self {
        const {
            assert!(
                N >= 1 && N <= 8 && (P == 1 || P == N),
                "at most 8 axes; P must be 1 (pooled) or N (one parameter per axis)"
            );
        }
        Self { axes: N as u8, sharing: if P == 1 { N as u8 } else { 1 } }
    }
}

impl Common {
    /// No measurement is within this limit.
    pub const NOTHING: f32 = -1.0;

    /// Nothing.
    pub const BLANK: Self = Self {
        substeps: 0,
        substep: Substep::BLANK,
        substep_share: 0.0,
        block_length: 0,
        schedule: Schedule {
            turn: 0,
            round: 0,
            weights_at: 0,
            gains_every: 0,
            gains_at: 0,
            reads_at: 0,
            events: 0,
            shared: 0,
            unhurried: false,
            staggered: false,
        },
        observer: ObserverDesign::BLANK,
        observer_stride: WindowDesign::BLANK,
        identifier: IdentifierDesign::BLANK,
        block: BlockDesign {
            length: 0.0,
            per_length: 0.0,
            per_length2: 0.0,
            centre: 0.0,
            span: 0.0,
            unit_s: 0.0,
            unit_past: 0.0,
        },
        covariance: CovarianceDesign::BLANK,
        innovation_to_mean: 0.0,
        readout: Readout::LeastSquares,
        plain: false,
        forgetting: 0.0,
        noise: NoiseLevel::UNKNOWN,
        disturbance: 0.0,
        wants_unit: false,
        period2: 0.0,
        max_misfit: 0.0,
        parameter_settle: 0,
        state_settle: 0,
        late_settle: 0,
        position_limit: Self::NOTHING,
        input_limit: 0.0,
        observer_tuning: Tuning { lambda: 0.0, q: 0.0 },
        measurement_period: 0.0,
    };

    /// Where `checks` find something wrong the constants are of no use; there is no panic, whatever the values.
    #[inline(never)]
    pub fn fill(&mut self, config: &SharedConfig, shape: Shape, checks: &mut Checks) {
        const NOISE: Range = Range::positive(1e-12, 1e6);
        let (axes, sharing) = (u32::from(shape.axes), u32::from(shape.sharing));
        // What is zero is noted down; from here on it need not be thought of.
        let (substeps, block) = (config.substeps.max(1), config.block.max(1));
        checks.number(rule!("period", Range::PERIOD), config.period);
        checks.count(const { name("substeps") }, config.substeps);
        checks.count(const { name("block") }, config.block);
        if config.turn >= block.max(8) {
            checks.note(const { name("turn") }, Fault::OutOfRange);
        }
        if config.readout > 1 {
            checks.note(const { name("readout") }, Fault::OutOfRange);
        }
        let period = Wide::new(config.period) * Wide::of(substeps);
        let step = period * Wide::of(block);
        checks.within(rule!("substeps", Range::PERIOD), period);
        checks.within(rule!("block", Range::PERIOD), step);
        config.identifier.checked(step, const { &[name("identifier.lambda"), name("identifier.q")] }, checks);
        config.observer.checked(period, const { &[name("observer.lambda"), name("observer.q")] }, checks);
        let tau = Wide::new(config.memory_tau);
        let fades = tau.bits() != f64::INFINITY.to_bits();
        let mut fading = Wide::ZERO;
        if fades {
            checks.within(rule!("memory.tau", Range::POSITIVE), tau);
            fading = step.over(tau);
            checks.within(rule!("memory.tau", Range::FADING), fading);
        }
        let block_length = block as f32;
        self.noise = match checks.if_known(rule!("noise_sd", NOISE), config.noise_sd) {
            Some(sd) => NoiseLevel::expected(sd * sd / block_length),
            None => NoiseLevel::UNKNOWN,
        };
        let disturbance = checks.if_known(rule!("disturbance_sd", NOISE), config.disturbance_sd).unwrap_or(0.0);
        // What of one that is correlated over 1/λ comes through the three stages: with the correlation of residuals 2 d²/(λT).
        self.disturbance = 0.375 * (disturbance * disturbance);
        self.wants_unit = disturbance > 0.0;
        let misfit = checks.if_known(rule!("max_misfit", Range::SHARE), config.max_misfit);
        self.max_misfit = misfit.unwrap_or(f32::INFINITY);
        self.position_limit = checks.number(rule!("position_limit", Range::LIMIT), config.position_limit);
        self.input_limit = checks.number(rule!("input_limit", Range::LIMIT), config.input_limit);
        self.parameter_settle = checks.samples(const { name("parameter_settle") }, config.parameter_settle, period);
        self.state_settle = checks.samples(const { name("state_settle") }, config.state_settle, period);

        self.substeps = substeps;
        self.substep = Substep::of(substeps);
        self.substep_share = 1.0 / substeps as f32;
        self.block_length = block;
        self.block = BlockDesign::new(block);
        let unit = Schedule::coarse_unit(block, period);
        self.covariance.fill(&config.identifier, step, fading, sharing, unit);
        self.schedule = Schedule::new(axes, block, config.turn, period, self.covariance.steps);
        self.observer = ObserverDesign::from_decay(&config.observer.decay(period));
        let stride = period * Wide::of(self.schedule.gains_every);
        self.observer_stride = WindowDesign::new(&config.observer.decay(stride));
        self.identifier = IdentifierDesign::from_decay(&config.identifier.decay(step));
        self.innovation_to_mean = 1.0 / (innovation_step_gain(self.observer.p()) * block_length);
        self.readout = if config.readout == 0 { Readout::LeastSquares } else { Readout::AbsoluteRatio };
        self.plain = config.readout == 0 && !fades;
        self.forgetting = decayed(fading.over(Wide::of(sharing))).rounded();
        self.period2 = (period * period).rounded();
        self.late_settle = rounded_up(Wide::new(8.0).over(Wide::new(config.observer.lambda) * period));
        self.observer_tuning = config.observer;
        self.measurement_period = period.get();
    }
    /// The power that noise has in the observer's band over that in the identifier's, where it wanders as white noise summed up: (λ/λ of
    /// the observer)², at most one. In the first `blocks` both bands are where the time since the start has them, at 4/t.
    pub fn wander_at_observer(&self, blocks: u32) -> f32 {
        let opening = 4.0 / (blocks as f32 + 1.0);
        let ratio = (self.identifier.c + opening) / (self.block.length * (1.0 - self.observer.p()) + opening);
        if ratio < 1.0 { ratio * ratio } else { 1.0 }
    }

    /// When the state is known of an axis of which nothing has come since the first measurement, `count` instants ago. The
    /// velocity taken for zero weighs 3 (count/n)² of itself at instant n, until the observer has forgotten it.
    pub fn settled_after(&self, count: u32) -> u32 {
        let outweighed = count.saturating_add(1).saturating_mul(10);
        outweighed.min(count.saturating_add(self.late_settle)).max(self.state_settle)
    }
}
