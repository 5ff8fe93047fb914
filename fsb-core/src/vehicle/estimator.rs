//! The update, once per control period.

use super::actuators::{Actuators, Course};
use super::change::Detector;
use super::config::{GroupConfig, VehicleConfig};
use super::delay::Delay;
use super::design;
use super::gyroscopic::{self, Gyroscopic};
use super::measured::{Attitude, Measured, Wrench};
use super::output::{Events, VehicleCounters};
use super::replaced::Replaced;
use super::retroactive::Retroactive;
use super::triple::{difference, each, positions, rates, within};
use crate::attitude::{AttitudeError, BodyAngles};
use crate::error::ConfigError;
use crate::estimator::Learning;
use crate::guard::{Guarded, Verdict};
use crate::moments::{InputMoments, Substep};
use crate::readout::{ParameterStatus, Readout};

/// Mass, moments of inertia and state of a vehicle whose position and attitude are measured.
///
/// `D` is the largest latency (control periods) that can be configured, at least 1; it costs 48 bytes each.
///
/// The rotation is estimated as of the newest attitude, the translation as of the newest position; both live in the past by
/// the latency of their measurement. Force and torque of the time since then wait, and [`state`](Self::state) takes them into
/// account. An attitude that is missing, or measured less often than forces are given, is predicted for turning the force into
/// the world frame.
///
/// What is not exact: within a control period the force turns along the chord between the attitudes at its ends, which leaves
/// out (|ω| dt)²/12 of it, and the gyroscopic moment is held at its value in the middle. Actuators that lag are taken to have
/// settled at what they are told in the first period.
///
/// Non-finite policy: what is not finite, beyond its limit or cannot be true ([`crate::guard`]) is rejected, counted and told in
/// [`Events`]; a measurement is then missing, a force or torque is replaced by the one before. From three in
/// succession on nothing is learned until they have acted: what is known stays. No allocation, no panic, no transcendental. Cost of an update: two
/// estimators of three axes, and about 350 operations beside them (50 more with a lag, 290 with a rule for changes), of them 90
/// for the attitude, 45 for turning the force and 200 for the gyroscopic moment; it does not depend on the latency.
#[derive(Clone, Debug)]
pub struct VehicleEstimator<const D: usize> {
    pub(super) translation: Guarded<3, 1>,
    pub(super) rotation: Guarded<3, 3>,
    pub(super) angles: BodyAngles,
    pub(super) actuators: Actuators,
    /// What they do at the rotation's time; unknown before the first period.
    pub(super) actual: Option<Wrench>,
    /// What the actuators were told since the rotation's time.
    pub(super) wrenches: Delay<Wrench, D>,
    /// Moments of the world-frame force between the translation's time and the rotation's.
    pub(super) forces: Delay<[InputMoments; 3], D>,
    /// dt
    pub(super) period: f32,
    /// T of the attitudes.
    pub(super) rotation_period: f32,
    /// The attitude was measured in the last update.
    pub(super) attitude_measured: bool,
    pub(super) position_limit: f32,
    pub(super) force_limit: f32,
    pub(super) torque_limit: f32,
    /// A body angle of larger magnitude is moved back by that (rad). What comes of it is exact, as it is within twice that.
    pub(super) far: f32,
    pub(super) last: Wrench,
    /// Forces and torques that were rejected.
    pub(super) replaced: [Replaced; 2],
    /// Attitudes in succession that were too far away to be followed, and how many make a start anew.
    pub(super) too_far: u32,
    pub(super) enough: u32,
    /// Attitudes and positions in succession that came between two measurement instants, none at one, and how many positions make a start anew.
    pub(super) early: [u32; 2],
    pub(super) enough_positions: u32,
    /// Control periods in which the rates recover from what was predicted in contact: 4/λ.
    pub(super) recovery: u32,
    /// Where the sums are those of least squares.
    pub(super) retroactive: Option<Retroactive>,
    pub(super) translation_change: Option<Detector>,
    pub(super) rotation_change: Option<Detector>,
    pub(super) begun: bool,
    pub(super) counters: VehicleCounters,
}

impl<const D: usize> VehicleEstimator<D> {
    /// Validates `config` and starts empty.
    ///
    /// # Errors
    /// Names the first parameter that cannot be right, as it is written in [`VehicleConfig`].
    pub fn new(config: &VehicleConfig) -> Result<Self, ConfigError> {
        let translation =
            Guarded::new(&design::translation(config)?, &config.translation.guard).map_err(design::of_translation)?;
        let rotation = Guarded::new(&design::rotation(config)?, &config.rotation.guard).map_err(design::of_rotation)?;
        let (late, latest) = (config.rotation.latency, config.translation.latency);
        if latest as usize > D || latest < late {
            let too_late = late as usize > D && latest as usize <= D;
            return Err(ConfigError::OutOfRange(if too_late { "rotation.latency" } else { "translation.latency" }));
        }
        Ok(Self {
            translation,
            rotation,
            angles: BodyAngles::default(),
            actuators: Actuators::new(config.actuator_lag, config.period)?,
            actual: None,
            wrenches: Delay::new(late),
            forces: Delay::new(latest - late),
            period: config.period as f32,
            rotation_period: (config.period * f64::from(config.rotation.substeps)) as f32,
            attitude_measured: false,
            position_limit: config.translation.measurement_limit as f32,
            force_limit: config.translation.input_limit as f32,
            torque_limit: config.rotation.input_limit as f32,
            far: libm::fmin(64.0, 0.5 * config.rotation.measurement_limit) as f32,
            last: Wrench::default(),
            replaced: Default::default(),
            too_far: 0,
            enough: config.rotation.guard.jump_after,
            early: [0; 2],
            recovery: libm::fmin(4.0 / (config.rotation.observer.lambda * config.period), 1e9) as u32,
            enough_positions: config.translation.guard.jump_after,
            retroactive: match config.rotation.readout {
                Readout::LeastSquares => Some(Retroactive::new(Substep::new(config.rotation.substeps)?)),
                Readout::AbsoluteRatio => None,
            },
            translation_change: detector(config, &config.translation, true)?,
            rotation_change: detector(config, &config.rotation, false)?,
            begun: false,
            counters: VehicleCounters::default(),
        })
    }

    /// One control period has ended: what was `measured`, and the wrench `applied` by the actuators, or told to them where they
    /// lag, over the period that ends now. At the very first call, which ends none, `applied` does not matter.
    pub fn update(&mut self, measured: &Measured, applied: &Wrench) -> Events {
        let mut events = Events::default();
        let mut from = self.angles.attitude();
        let mut course = None;
        if self.begun {
            let wrench = self.checked(applied, &mut events);
            course = self.wrenches.through(wrench).map(|wrench| self.advance_rotation(&wrench));
        }
        self.begun = true;
        // Before, the attitude is one from before the first call.
        if self.wrenches.is_full() {
            self.take_attitude(measured.attitude.as_ref(), &mut events);
        }
        let to = self.angles.attitude();
        if events.attitude_lost {
            from = to;
        }
        if let (Some(course), Some(from), Some(to)) = (course, from, to) {
            let force = self.actuators.force(&course, &from, &to);
            if let Some(force) = self.forces.through(force) {
                self.translation.apply_moments(&force);
            }
        }
        if to.is_some() && self.forces.is_full() {
            self.take_position(measured.position, &mut events);
        }
        self.counters.count(&events);
        events
    }

    /// Over a control period with torque and gyroscopic moment.
    fn advance_rotation(&mut self, wrench: &Wrench) -> Course {
        let (course, then) = self.actuators.follow(wrench, self.actual);
        self.actual = Some(then);
        let mut torque = self.actuators.torque(&course);
        if let (Some(rates), Some(k)) = (rates(&self.rotation.states()), self.reciprocals()) {
            let Gyroscopic { products, differences } = Gyroscopic::add(&mut torque, &rates, &k, 0.5 * self.period);
            if let Some(retroactive) = &mut self.retroactive {
                retroactive.hold(&products, &differences);
            }
        } else if let (Some(rates), Some(retroactive)) = (self.rotation.velocities(), &mut self.retroactive) {
            // Nothing to predict with yet: it comes in later, all of it.
            retroactive.hold(&gyroscopic::products(&rates), &[0.0; 3]);
        }
        self.rotation.apply_moments(&torque);
        course
    }

    fn take_attitude(&mut self, attitude: Option<&Attitude>, events: &mut Events) {
        let before = self.angles;
        let taken = attitude.map(|attitude| self.angles.turn_to(&attitude.matrix()));
        let mut angles = None;
        match taken {
            Some(Ok(turned)) => {
                angles = Some(turned);
                self.too_far = 0;
            }
            Some(Err(AttitudeError::TurnTooLarge)) => {
                self.too_far = self.too_far.saturating_add(1);
                if self.too_far >= self.enough || positions(&self.rotation.states()).is_none() {
                    events.attitude_lost = true;
                    self.too_far = 0;
                    self.rotation.restart();
                    self.begin_rotation();
                    angles = Some(self.angles.angles());
                } else {
                    // An outlier, unless it stays there.
                    events.attitude_rejected = true;
                    self.angles = before;
                }
            }
            Some(Err(_)) => events.attitude_rejected = true,
            None => {}
        }
        if angles.is_some() && self.attitude_is_early() {
            self.rotation.restart();
            self.begin_rotation();
        }
        if self.rotation.is_due() {
            self.pass_over_torques();
            // In step, as it is due.
            let verdicts = self.rotation.measure(&each(angles)).unwrap_or_default();
            if angles.is_some() && !verdicts.iter().all(|verdict| verdict.is_used()) {
                events.attitude_rejected = true;
                angles = None;
                self.angles = before;
            }
            events.rotation_pushed = is_pushed(&verdicts);
            if events.rotation_pushed
                && let Some(detector) = &mut self.rotation_change
            {
                detector.restart();
            }
            if events.rotation_pushed || events.attitude_lost {
                // The force of late was turned the wrong way.
                self.translation.reopen_window();
            }
            self.look_back();
            events.inertia_changed = self.inertia_has_changed();
        }
        self.attitude_measured = angles.is_some();
        if angles.is_none()
            && let Some(predicted) = positions(&self.rotation.states())
        {
            self.angles.turn_by(&difference(&predicted, &self.angles.angles()));
        }
        self.unwind();
    }

    /// The gyroscopic moment so far, with what is now known of the moments of inertia.
    #[inline(never)]
    fn look_back(&mut self) {
        let Some(retroactive) = &mut self.retroactive else { return };
        let view = self.rotation.innovation_view();
        if view.measured
            && self.rotation.parameter_status() != [ParameterStatus::Valid; 3]
            && let Some(rates) = self.rotation.velocities()
        {
            retroactive.correct(&view, &rates, self.rotation_period);
        }
        retroactive.sample(&view);
        if !retroactive.is_behind(self.rotation.identifier_blocks()) || self.rotation.learning() != Learning::On {
            return;
        }
        let guesses = self.rotation.prediction_parameters();
        // A value held may be the one of before a change.
        let mut k = self.rotation.parameters();
        let newest = self.rotation.rough_parameters().into_iter().zip(self.rotation.parameter_status());
        for (k, (rough, status)) in k.iter_mut().zip(newest) {
            if status != ParameterStatus::Valid {
                *k = rough;
            }
        }
        if let Some(shifts) = retroactive.step(&self.rotation.identifier_view(), &k, &guesses) {
            for (axis, shift) in shifts.iter().enumerate() {
                self.rotation.shift_input(axis, shift);
            }
        }
    }

    fn take_position(&mut self, position: Option<[f32; 3]>, events: &mut Events) {
        // Where one coordinate is nonsense the others are not to be trusted.
        let sound = position.filter(|position| within(position, self.position_limit));
        events.position_rejected = position.is_some() && sound.is_none();
        if sound.is_some() && self.position_is_early(events) {
            self.translation.restart();
            if let Some(detector) = &mut self.translation_change {
                detector.restart();
            }
        }
        if self.translation.is_due() {
            self.pass_over_forces();
            // In step, as it is due.
            let verdicts = self.translation.measure(&each(sound)).unwrap_or_default();
            if sound.is_some() {
                events.position_rejected = verdicts.iter().any(|verdict| !verdict.is_used());
                events.position_jumped = verdicts.iter().any(|verdict| matches!(verdict, Verdict::Jumped(_)));
                events.translation_pushed = is_pushed(&verdicts);
            }
            if events.translation_pushed
                && let Some(detector) = &mut self.translation_change
            {
                detector.restart();
            }
            events.mass_changed = self.mass_has_changed();
        }
    }

    /// Force and torque, each within its limit or else the one before.
    fn checked(&mut self, applied: &Wrench, events: &mut Events) -> Wrench {
        let sound = [within(&applied.force, self.force_limit), within(&applied.torque, self.torque_limit)];
        let [force, torque] = sound;
        if force {
            self.last.force = applied.force;
        }
        if torque {
            self.last.torque = applied.torque;
        }
        events.wrench_rejected = sound != [true; 2];
        let late = self.late();
        for ((replaced, sound), late) in self.replaced.iter_mut().zip(sound).zip(late) {
            replaced.count(!sound, late);
        }
        self.last
    }
}

fn is_pushed(verdicts: &[Verdict; 3]) -> bool {
    verdicts.iter().any(|verdict| matches!(verdict, Verdict::Pushed(_)))
}

/// The detector of a group, where one is configured.
fn detector(config: &VehicleConfig, group: &GroupConfig, pooled: bool) -> Result<Option<Detector>, ConfigError> {
    let period = config.period * f64::from(group.substeps);
    let disturbance_sd = group.disturbance_sd.unwrap_or(0.0);
    let step = group.identifier.lambda * period * f64::from(group.block);
    let new = |rule| Detector::new(rule, group.observer.lambda, period, step, disturbance_sd, pooled);
    config.change.as_ref().map(new).transpose()
}
