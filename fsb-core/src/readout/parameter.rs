//! k with its variance, and the rule by which it may be used.

use super::ratio::{Ratio, Readout};
use super::status::ParameterStatus;
use crate::accumulator::Accumulator;
use crate::checks::{Checks, Range, Rule, rule};
use crate::snapshot::{MOST, stored};

/// An identified parameter: k of (15), 1/m or 1/I.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Parameter {
    /// k̂, in 1/kg or 1/(kg m²), or with the input's unit in place of N or N m.
    pub value: f32,
    /// Variance of k̂.
    pub variance: f32,
}

impl Parameter {
    /// Standard deviation of k̂. Uses a square root: not for the tick.
    pub fn sd(&self) -> f32 {
        libm::sqrtf(self.variance)
    }

    /// m = 1/k, and its standard deviation sd(k)/k².
    pub fn inverse_with_sd(&self) -> (f32, f32) {
        let inverse = 1.0 / self.value;
        (inverse, self.sd() * inverse * inverse)
    }
}

/// When k̂ counts as valid. Plain data.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct ParameterRule {
    /// The smallest k that can be right; 1e-15..=1e15. A smaller k̂ is reported, never used.
    pub min: f64,
    /// The largest k that can be right; above the smallest, up to 1e15.
    pub max: f64,
    /// The largest sd(k̂)/k̂ at which k̂ becomes valid. It stays valid up to twice that (hysteresis).
    /// 1e-15..=1e6.
    pub max_relative_sd: f64,
}

impl ParameterRule {
    /// Any positive k that f32 handles well, known to 5 %.
    pub const DEFAULT: Self = Self { min: 1e-6, max: 1e9, max_relative_sd: 0.05 };
}

impl Default for ParameterRule {
    /// [`DEFAULT`](Self::DEFAULT).
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl ParameterRule {
    #[inline(never)]
    pub(crate) fn checked(&self, checks: &mut Checks) -> CheckedRule {
        const LIMITS: [Rule; 2] = [*rule!("rule.min", Range::PARAMETER), *rule!("rule.max", Range::PARAMETER)];
        const SHARE: Range = Range::positive(1e-15, 1e6);
        let (min, max) = checks.limits(&LIMITS, [self.min, self.max], false);
        let share = checks.number(rule!("rule.max_relative_sd", SHARE), self.max_relative_sd);
        let relative_variance = share * share;
        CheckedRule { min, max, relative_variance, limit_to_stay: HYSTERESIS * relative_variance }
    }
}

/// A [`ParameterRule`] that has been validated.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct CheckedRule {
    pub min: f32,
    pub max: f32,
    pub relative_variance: f32,
    /// The same for a parameter that is valid already.
    pub limit_to_stay: f32,
}

/// A coarse step of one of a parameter's axes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CoarseStep {
    /// What it adds to Σ ω ẑ0.
    pub added: f32,
    /// What noise alone adds to Σ ẑ2².
    pub noise: f32,
    /// ω
    pub weight: f32,
    /// What the square of the residual is beyond noise, as often as there are steps in one, times the steps that a disturbance lasts.
    pub disturbance: f32,
}

/// One parameter: its sums, pooled over the axes that share it, and what has been read out of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ParameterState {
    pub ratio: Ratio,
    /// The newest quotient and its variance; while it is held, the value from before.
    value: f32,
    variance: f32,
    /// What noise makes of the newest quotient's variance, and the square of what else it may be off by, relative to itself.
    of_noise: f32,
    doubt: f32,
    /// What measurement noise alone makes of its variance, without what the residuals have added to the level.
    of_measurement: f32,
    pub status: ParameterStatus,
    read: bool,
    credible: bool,
    /// The model leaves too much unexplained.
    contradicted: bool,
    /// All its axes have taken a coarse step since the variance was read.
    pub stale: bool,
    /// Axes that take part, and how many of them have taken the present coarse step.
    members: u8,
    stepped: u8,
    /// Σ ω ẑ0 over the coarse steps.
    information: Accumulator,
    /// Σ var ẑ2 of noise alone over the coarse steps.
    echo: Accumulator,
    /// The quotient's variance by disturbances: Σ (ω r)² over the square of the information, r² being what the residual's square is beyond
    /// noise, times the steps that a disturbance lasts.
    disturbance: f32,
    /// The newest quotient and its variance while the value from before is held.
    fresh: Parameter,
    /// Coarse steps to come in which what differs from the value held may be a disturbance.
    suspect: u8,
    pub nominal: Option<f32>,
    rule: CheckedRule,
}

impl ParameterState {
    /// What rounding leaves of k, however long it is looked at.
    const ROUNDING: f32 = 1e-7;

    /// A variance below this is none: it does not end among the subnormal numbers.
    const NOTHING: f32 = 1e-36;

    /// Some 2/λ.
    const SUSPECT: u8 = 25;

    /// No parameter yet.
    pub const BLANK: Self = {
        let rule = CheckedRule { min: 0.0, max: 0.0, relative_variance: 0.0, limit_to_stay: 0.0 };
        let nothing = Parameter { value: 0.0, variance: 0.0 };
        Self { variance: 0.0, of_noise: 0.0, of_measurement: 0.0, fresh: nothing, ..Self::start(0, None, rule) }
    };

    /// Nothing known, to be read out of so many axes: no quotient, and a variance above any limit.
    pub const fn start(members: u8, nominal: Option<f32>, rule: CheckedRule) -> Self {
        Self {
            ratio: Ratio::EMPTY,
            value: 0.0,
            variance: f32::MAX,
            of_noise: f32::MAX,
            doubt: 0.0,
            of_measurement: f32::MAX,
            status: ParameterStatus::Settling,
            read: false,
            credible: false,
            contradicted: false,
            stale: false,
            members,
            stepped: 0,
            information: Accumulator::ZERO,
            echo: Accumulator::ZERO,
            disturbance: 0.0,
            fresh: Parameter { value: 0.0, variance: f32::MAX },
            suspect: 0,
            nominal,
            rule,
        }
    }

    /// Adds a sample to the sums, whatever the read-out; returns whether it held any information.
    #[cold]
    #[inline(never)]
    pub fn add_generally(&mut self, z2: f32, z0: f32, readout: Readout, forgetting: f32) -> bool {
        self.ratio.add(readout, z2, z0, forgetting)
    }

    /// Forgets what is known.
    pub fn restart(&mut self, members: u8) {
        *self = Self::start(members, self.nominal, self.rule);
    }

    /// Begins anew, the value so far standing in until the new one is valid.
    pub fn hold(&mut self, members: u8) {
        let held = self.valid();
        self.restart(members);
        if let Some(Parameter { value, variance }) = held {
            self.status = ParameterStatus::Held;
            (self.value, self.variance) = (value, variance);
        }
    }

    /// What has told that the value held is no longer right may have been a disturbance, which goes on.
    pub fn suspect(&mut self) {
        self.suspect = Self::SUSPECT;
    }

    /// The value held, while what differs from it may be a disturbance. To be asked once a coarse step.
    pub fn suspected(&mut self) -> Option<f32> {
        if self.suspect == 0 {
            return None;
        }
        self.suspect -= 1;
        self.held_value()
    }

    /// Whether it is not known yet, and nothing speaks against what has been learned so far.
    pub fn is_being_learned(&self) -> bool {
        !matches!(self.status, ParameterStatus::Valid | ParameterStatus::Contradicted | ParameterStatus::Faulted)
    }

    /// Whether nothing has been learned yet.
    pub fn is_new(&self) -> bool {
        self.ratio.denominator() == 0.0
    }

    /// Begins a new window, to be read out of so many axes; what is known stays.
    pub fn reopen(&mut self, members: u8) {
        (self.members, self.stepped) = (members, 0);
    }

    #[inline(always)]
    fn is_held(&self) -> bool {
        self.status == ParameterStatus::Held
    }

    /// The value that stands in for one that is not valid.
    pub fn held_value(&self) -> Option<f32> {
        if self.is_held() { Some(self.value) } else { None }
    }

    /// One of its axes no longer takes part.
    pub fn leave(&mut self) {
        self.members = self.members.saturating_sub(1);
    }

    /// A coarse step of one of its axes.
    ///
    /// What acts and was not told, a gust or a push, is no position noise, which two differences have made small where the input
    /// is steady. It is an acceleration, which comes out of the three stages spread over many steps: what the squares of
    /// the residuals add up to, each weighed as it went into the quotient, counts so many times.
    pub fn step_coarsely(&mut self, step: &CoarseStep, forgetting: f32) {
        self.echo.add_folded(step.noise - forgetting * self.echo.value());
        self.information.add_folded(step.added - forgetting * self.information.value());
        if step.added > 0.0 {
            // Scaled down first: the sum by itself could be beyond f32.
            let per_information = 1.0 / self.information.value();
            let before = 1.0 - step.added * per_information;
            let weight = step.weight * per_information;
            let disturbance = before * before * self.disturbance + weight * weight * step.disturbance;
            self.disturbance = if disturbance < Self::NOTHING { 0.0 } else { known(disturbance) };
            // The quotient is handed out with this step in it before the variance is read.
            if step.disturbance > 0.0 {
                self.add_doubt(self.newest().value);
            }
        }
        self.skip_coarse_step();
    }

    /// A coarse step of one of its axes that says nothing: those that share the parameter do not wait for it.
    #[inline(always)]
    pub fn skip_coarse_step(&mut self) {
        self.stepped = self.stepped.saturating_add(1);
        if self.stepped >= self.members {
            self.stepped = 0;
            self.stale = true;
        }
    }

    /// The newest quotient, where it is in range and its standard deviation is below its value.
    pub fn credible(&self) -> Option<f32> {
        if self.credible { Some(self.newest().value) } else { None }
    }

    /// The newest quotient, where it is in range and noise leaves it known to four times what would make it valid.
    pub fn rough(&self) -> Option<Parameter> {
        let newest = self.newest();
        let limit = 16.0 * self.rule.relative_variance * (newest.value * newest.value);
        if self.credible && self.of_noise <= limit { Some(newest) } else { None }
    }

    /// The parameter, where it is valid or held.
    pub fn valid(&self) -> Option<Parameter> {
        // The two come last: one comparison.
        let usable = self.status as u8 >= ParameterStatus::Valid as u8;
        if usable { Some(self.newest_or_held()) } else { None }
    }

    /// The value, where it is valid.
    #[inline(always)]
    pub fn valid_value(&self) -> Option<f32> {
        match self.status {
            ParameterStatus::Valid => Some(self.value),
            _ => None,
        }
    }

    /// The variance of the quotient from that of its numerator, where that is known. `scale2` is the square of the
    /// identifier's scale.
    ///
    /// A controller that feeds the estimates back answers to measurement noise with an input that goes with it. Where hardly
    /// anything else moves, that pulls the quotient towards zero, by a share of about ½ Σ var ẑ2 / Σ (k ẑ0)² (observed: 38 %
    /// at 1.3 times the noise). The square of it counts as variance.
    pub fn read_variance(&mut self, numerator: Option<[f32; 2]>, scale2: f32) {
        self.stale = false;
        let information = self.information.value();
        if let Some([variance, measured]) = numerator
            && information > 0.0
        {
            let quotient = self.ratio.quotient();
            let pull = 0.5 * self.echo.value() / (quotient * information);
            let rounding = Self::ROUNDING * quotient;
            let (scale, least) = (scale2 / information, pull * pull + rounding * rounding);
            // Rounding can take a sum of next to nothing below zero; no quotient yet makes it infinite.
            let of = |variance: f32| {
                let variance = (variance / information) * scale + least;
                if variance >= 0.0 { known(variance) } else { f32::MAX }
            };
            (self.of_noise, self.of_measurement) = (of(variance), of(measured));
            self.add_doubt(quotient);
        }
    }

    /// Sets the square of what the quotient may be off by, relative to itself, for other reasons than noise: it counts as variance.
    pub fn set_doubt(&mut self, doubt: f32) {
        self.doubt = known(doubt);
        self.add_doubt(self.newest().value);
    }

    fn add_doubt(&mut self, quotient: f32) {
        let variance = self.of_noise + (self.disturbance + self.doubt * (quotient * quotient));
        *(if self.is_held() { &mut self.fresh.variance } else { &mut self.variance }) = known(variance);
    }

    /// Compares what the model leaves `unexplained` with the most it may; half of that ends a contradiction.
    pub fn compare(&mut self, unexplained: f32, most: f32) {
        let most = if self.contradicted { 0.5 * most } else { most };
        self.contradicted = unexplained > most;
        if self.contradicted && self.status == ParameterStatus::Valid {
            self.status = ParameterStatus::Contradicted;
        }
    }

    /// [`read`](Self::read) where the value from before is held, which it is until the new one is valid.
    #[inline(never)]
    fn read_beside_held(&mut self, settled: bool) {
        let held = self.newest_or_held();
        (self.value, self.variance) = (self.fresh.value, self.fresh.variance);
        self.status = ParameterStatus::Settling;
        self.read_newest(settled);
        if self.status != ParameterStatus::Valid {
            self.fresh = self.newest_or_held();
            (self.value, self.variance) = (held.value, held.variance);
            self.status = ParameterStatus::Held;
        }
    }

    fn newest_or_held(&self) -> Parameter {
        Parameter { value: self.value, variance: self.variance }
    }

    /// The newest quotient and its variance, whatever is handed out.
    fn newest(&self) -> Parameter {
        if self.is_held() { self.fresh } else { self.newest_or_held() }
    }

    /// The variance of the `quotient` by measurement noise, and what else it may be off by. Not by disturbances; nor by what the level of the noise
    /// has risen by because of them: they would hide behind it until it is forgotten, and be forgotten with it.
    pub fn undisturbed_variance(&self, quotient: f32) -> f32 {
        self.of_measurement + self.doubt * (quotient * quotient)
    }

    /// The newest quotient of a parameter that is not held; zero before there is any.
    #[inline(always)]
    pub const fn newest_value(&self) -> f32 {
        self.value
    }

    /// The quotient of a parameter that is valid and stays so. False where it has to be [`read`](Self::read) instead.
    #[inline(always)]
    pub fn read_on(&mut self) -> bool {
        let rule = &self.rule;
        self.ratio.fold();
        let value = self.ratio.numerator_total() / self.ratio.denominator_total();
        let limit = rule.limit_to_stay * (value * value);
        let stays =
            self.status == ParameterStatus::Valid && value >= rule.min && value <= rule.max && self.variance <= limit;
        if stays {
            self.value = value;
        }
        stays
    }

    /// Whether [`read`](Self::read) would find it valid, or no longer settling; also said where it takes a closer look to tell.
    #[inline(never)]
    pub fn may_be_valid(&self, settled: bool) -> bool {
        let (rule, value) = (&self.rule, self.ratio.quotient());
        let limit = rule.relative_variance * (value * value);
        let found = value >= rule.min && value <= rule.max && self.variance <= limit && !self.contradicted;
        let settles = settled && self.status == ParameterStatus::Settling;
        found || settles || self.status as u8 >= ParameterStatus::Valid as u8
    }

    /// The quotient from the sums as they are, and its status.
    pub fn read(&mut self, settled: bool) {
        if self.is_held() {
            self.read_beside_held(settled);
        } else {
            self.read_newest(settled);
        }
    }

    /// [`read`](Self::read) where nothing is held.
    fn read_newest(&mut self, settled: bool) {
        if self.ratio.denominator() > 0.0 && self.read_on() {
            return;
        }
        if self.ratio.denominator() > 0.0 {
            self.value = self.ratio.numerator() / self.ratio.denominator();
            self.read = true;
        }
        self.judge(settled);
    }

    #[inline(never)]
    fn judge(&mut self, settled: bool) {
        let rule = &self.rule;
        let value2 = self.value * self.value;
        let in_range = self.value >= rule.min && self.value <= rule.max;
        self.credible = self.read && in_range && !self.contradicted && self.of_noise <= value2;
        self.status = if !settled {
            ParameterStatus::Settling
        } else if !self.read {
            ParameterStatus::Unexcited
        } else if self.value.is_nan() {
            ParameterStatus::Faulted
        } else if self.contradicted {
            ParameterStatus::Contradicted
        } else if self.value > rule.max {
            ParameterStatus::AboveRange
        } else if !in_range {
            ParameterStatus::BelowRange
        } else if self.variance > rule.relative_variance * value2 {
            ParameterStatus::Uncertain
        } else {
            ParameterStatus::Valid
        };
    }
}

/// A variance beyond what a number of a state can be says that nothing is known, as does one that is no number.
fn known(variance: f32) -> f32 {
    if variance <= MOST { variance } else { f32::MAX }
}

/// Twice the standard deviation at which a parameter becomes valid is the one at which it no longer is.
const HYSTERESIS: f32 = 4.0;

stored!(ParameterState {
    ratio,
    value,
    variance,
    of_noise,
    doubt,
    of_measurement,
    status,
    read,
    credible,
    contradicted,
    stale,
    members,
    stepped,
    information,
    echo,
    disturbance,
    fresh,
    suspect,
});
stored!(Parameter { value, variance });

impl ParameterState {
    /// Whether what would be handed out can be.
    pub(crate) fn is_sound(&self) -> bool {
        let rule = &self.rule;
        let in_range = |k: Parameter| k.value >= rule.min && k.value <= rule.max;
        let variances =
            [self.variance, self.fresh.variance, self.of_noise, self.of_measurement, self.doubt, self.disturbance];
        variances.iter().all(|variance| *variance >= 0.0) && self.valid().is_none_or(in_range)
    }
}
