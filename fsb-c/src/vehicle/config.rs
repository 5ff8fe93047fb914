//! The configuration of the vehicle.

use fsb_core::guard::GuardConfig;
use fsb_core::readout::{Memory, Readout};
use fsb_core::vehicle::{ChangeRule, Expected, GroupConfig, VehicleConfig};

use super::frame::Frame;
use super::names::c_name;
use crate::config::{FSB_READOUT_ABSOLUTE_RATIO, FSB_READOUT_LEAST_SQUARES, Refusal, fsb_tuning_t, known};
use crate::status::FSB_CONFIG_OUT_OF_RANGE;

/// What is known of a mass [kg] or a moment of inertia [kg m^2] beforehand; fsb_expected_about fills it in.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_expected_t {
    /// Predicted with until the parameter is identified. 1e-12..1e12. NaN: not known, and no state is handed out before.
    pub nominal: f64,
    /// The smallest that can be right. 1e-12..1e12. A smaller estimate is never used.
    pub min: f64,
    /// The largest that can be right; above the smallest, up to 1e12.
    pub max: f64,
}

/// What makes a measurement one that cannot be true. It is left out and counted then.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_guard_t {
    /// A step of the innovation of more than so many of its standard deviations is improbable. 3..1000.
    pub sigmas: f64,
    /// The largest acceleration that the model may not know of [m/s^2 or rad/s^2]: a load dropped, wind. 0..1e6.
    pub acceleration: f64,
    /// Steps up to this always pass [m or rad]: a few quanta of the sensor. 0..1e6.
    pub floor: f64,
    /// Gaps up to this are bridged by prediction [s]; after longer ones the state is stale and begins anew, masses and
    /// inertias being held. In whole measurements, 1 to 65534 of them.
    pub bridge: f64,
    /// So many improbable measurements in a row that agree with each other are a jump of the sensor. 2..65535.
    pub jump_after: u32,
    /// A measurement whose bits have been the same for more than so many samples is one of a frozen sensor; 0: never.
    /// Up to 65535.
    pub frozen_after: u32,
}

/// One of the two groups of axes: x, y, z, or the angles about the body's axes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_vehicle_group_t {
    /// Control periods from one measurement to the next, 1..65535.
    pub substeps: u32,
    /// Control periods by which a measurement is late: what is given at an update was true so many periods before.
    /// Up to FSB_VEHICLE_MAX_LATENCY; that of the translation not below that of the rotation.
    pub latency: u32,
    /// Measurements per step of the identifier, 1..65535. More where the measurement rate is high: cheaper.
    pub block: u32,
    /// FSB_READOUT_LEAST_SQUARES or FSB_READOUT_ABSOLUTE_RATIO.
    pub readout: u32,
    /// Tuning of the identifier; runs at period * substeps * block.
    pub identifier: fsb_tuning_t,
    /// Tuning of the observer; runs at period * substeps.
    pub observer: fsb_tuning_t,
    /// Standard deviation of a measurement [m or rad] where it is known beforehand, else NaN. 1e-12..1e6.
    pub noise_sd: f64,
    /// Standard deviation of the acceleration that is not accounted for [m/s^2 or rad/s^2], such as wind, where it is
    /// known beforehand, else NaN. 1e-12..1e6.
    pub disturbance_sd: f64,
    /// Time constant [s] with which the identifier forgets, at least one of its steps; INFINITY: never.
    pub memory_tau: f64,
    /// The largest relative standard deviation at which a parameter becomes valid. 1e-15..1e6.
    pub max_relative_sd: f64,
    /// The largest share of the filtered acceleration's mean square that the model may leave unexplained before a
    /// parameter is contradicted; above 0, up to 1. NaN: not asked.
    pub max_misfit: f64,
    /// No parameter is valid earlier than this after a reset [s]. 0 to 1e9 measurements.
    pub parameter_settle: f64,
    /// States are not valid earlier than this after the first measurement [s]. 0 to 1e9 measurements.
    pub state_settle: f64,
    /// What cannot be true.
    pub guard: fsb_guard_t,
    /// A position, or a body angle, of larger magnitude is rejected [m or rad]. Up to 1e6.
    pub measurement_limit: f64,
    /// A force or torque with a larger component is rejected [N or N m]. Up to 5e5; best what the actuators can do.
    pub input_limit: f64,
}

/// When a change of mass or inertia is taken as such, and identified anew.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_change_t {
    /// The smallest change to react to, relative: 0.15 is a good choice. 1e-3..1e3; 0: changes are not looked for.
    pub relative: f64,
    /// By how many of its standard deviations the change must show. 1..1e3.
    pub sigmas: f64,
    /// Time after a start or a change in which nothing is decided [s]. 0..1e6.
    pub hold_off: f64,
}

/// Configuration of an fsb_vehicle_t. Start from fsb_vehicle_config_default.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_vehicle_config_t {
    /// Control period [s]: the time from one update to the next. 1e-6..1e3.
    pub period: f64,
    /// FSB_FRAME_Z_UP or FSB_FRAME_Z_DOWN: the axes of everything that goes in and out.
    pub frame: u32,
    /// x, y, z, pooled into the mass.
    pub translation: fsb_vehicle_group_t,
    /// Angles about the body's x, y, z, each with its moment of inertia.
    pub rotation: fsb_vehicle_group_t,
    /// Gravity [m/s^2], downwards whatever the frame. 0..1e6.
    pub gravity: f64,
    /// Mass [kg].
    pub mass: fsb_expected_t,
    /// Moments of inertia about the body's x, y, z [kg m^2].
    pub inertia: [fsb_expected_t; 3],
    /// Time constant of force and torque behind what the actuators are told, first order [s]: from a twentieth of the
    /// period to 1e3, or 0 where they follow at once.
    pub actuator_lag: f64,
    /// When a change of load is taken as such.
    pub change: fsb_change_t,
}

impl fsb_vehicle_config_t {
    pub(super) fn new(period: f64) -> Self {
        let of = VehicleConfig::new(period);
        let ChangeRule { sigmas, hold_off, .. } = ChangeRule::default();
        Self {
            period: of.period,
            frame: Frame::ZUp.code(),
            translation: of.translation.into(),
            rotation: of.rotation.into(),
            gravity: of.gravity,
            mass: of.mass.into(),
            inertia: of.inertia.map(fsb_expected_t::from),
            actuator_lag: of.actuator_lag.unwrap_or(0.0),
            change: fsb_change_t { relative: of.change.map_or(0.0, |rule| rule.relative), sigmas, hold_off },
        }
    }

    pub(super) fn to_core(self) -> Result<(VehicleConfig, Frame), Refusal> {
        let refused = |at| (FSB_CONFIG_OUT_OF_RANGE, c_name(at));
        let frame = Frame::of(self.frame).ok_or_else(|| refused("frame"))?;
        let fsb_change_t { relative, sigmas, hold_off } = self.change;
        let config = VehicleConfig {
            period: self.period,
            translation: self.translation.to_core().ok_or_else(|| refused("translation.readout"))?,
            rotation: self.rotation.to_core().ok_or_else(|| refused("rotation.readout"))?,
            gravity: self.gravity,
            mass: self.mass.into(),
            inertia: self.inertia.map(Expected::from),
            actuator_lag: if self.actuator_lag == 0.0 { None } else { Some(self.actuator_lag) },
            change: if relative == 0.0 { None } else { Some(ChangeRule { relative, sigmas, hold_off }) },
        };
        Ok((config, frame))
    }
}

impl fsb_vehicle_group_t {
    /// `None` where the readout is none.
    fn to_core(self) -> Option<GroupConfig> {
        let fsb_guard_t { sigmas, acceleration, floor, bridge, jump_after, frozen_after } = self.guard;
        let tau = self.memory_tau;
        Some(GroupConfig {
            substeps: self.substeps,
            latency: self.latency,
            block: self.block,
            identifier: self.identifier.into(),
            observer: self.observer.into(),
            noise_sd: known(self.noise_sd),
            disturbance_sd: known(self.disturbance_sd),
            readout: match self.readout {
                FSB_READOUT_LEAST_SQUARES => Readout::LeastSquares,
                FSB_READOUT_ABSOLUTE_RATIO => Readout::AbsoluteRatio,
                _ => return None,
            },
            memory: if tau == f64::INFINITY { Memory::Infinite } else { Memory::Fading { tau } },
            max_relative_sd: self.max_relative_sd,
            max_misfit: known(self.max_misfit),
            parameter_settle: self.parameter_settle,
            state_settle: self.state_settle,
            guard: GuardConfig { sigmas, acceleration, floor, jump_after, bridge, frozen_after },
            measurement_limit: self.measurement_limit,
            input_limit: self.input_limit,
        })
    }
}

impl From<GroupConfig> for fsb_vehicle_group_t {
    fn from(of: GroupConfig) -> Self {
        let GuardConfig { sigmas, acceleration, floor, jump_after, bridge, frozen_after } = of.guard;
        Self {
            substeps: of.substeps,
            latency: of.latency,
            block: of.block,
            readout: match of.readout {
                Readout::AbsoluteRatio => FSB_READOUT_ABSOLUTE_RATIO,
                _ => FSB_READOUT_LEAST_SQUARES,
            },
            identifier: of.identifier.into(),
            observer: of.observer.into(),
            noise_sd: of.noise_sd.unwrap_or(f64::NAN),
            disturbance_sd: of.disturbance_sd.unwrap_or(f64::NAN),
            memory_tau: match of.memory {
                Memory::Fading { tau } => tau,
                _ => f64::INFINITY,
            },
            max_relative_sd: of.max_relative_sd,
            max_misfit: of.max_misfit.unwrap_or(f64::NAN),
            parameter_settle: of.parameter_settle,
            state_settle: of.state_settle,
            guard: fsb_guard_t { sigmas, acceleration, floor, bridge, jump_after, frozen_after },
            measurement_limit: of.measurement_limit,
            input_limit: of.input_limit,
        }
    }
}

impl From<Expected> for fsb_expected_t {
    fn from(Expected { nominal, min, max }: Expected) -> Self {
        Self { nominal: nominal.unwrap_or(f64::NAN), min, max }
    }
}

impl From<fsb_expected_t> for Expected {
    fn from(fsb_expected_t { nominal, min, max }: fsb_expected_t) -> Self {
        Self { nominal: known(nominal), min, max }
    }
}
