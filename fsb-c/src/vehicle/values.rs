//! What goes into the vehicle's estimator and comes out.

use fsb_core::estimator::StateStatus;
use fsb_core::readout::ParameterStatus;
use fsb_core::vehicle::{Attitude, Events, Identified, Measured, VehicleCounters, VehicleModel, VehicleState, Wrench};

use super::frame::Frame;
use crate::status::{FSB_UNKNOWN_VALUE, fsb_status_t};
use crate::values::{
    FSB_PARAMETER_UNKNOWN, FSB_STATE_NOMINAL, FSB_STATE_UNKNOWN, fsb_parameter_status_t, fsb_state_status_t,
    parameter_code, state_code,
};

/// No attitude has come.
pub const FSB_ATTITUDE_NONE: u32 = 0;
/// Body to world by rows: attitude[3 i + j] is the component of body axis j along world axis i.
pub const FSB_ATTITUDE_MATRIX: u32 = 1;
/// Body to world as a unit quaternion w, x, y, z in attitude[0..3]; q and -q are the same.
pub const FSB_ATTITUDE_QUATERNION: u32 = 2;

/// An attitude was none, or cannot be true, and was taken as missing.
pub const FSB_EVENT_ATTITUDE_REJECTED: u32 = 1;
/// The attitude has turned by more than could be followed: the rotation begins anew, the moments of inertia are held.
pub const FSB_EVENT_ATTITUDE_LOST: u32 = 2;
/// A position was not finite, beyond its limit or cannot be true, and was taken as missing.
pub const FSB_EVENT_POSITION_REJECTED: u32 = 4;
/// The origin of the positions has jumped: they were followed, and velocity and mass have not noticed.
pub const FSB_EVENT_POSITION_JUMPED: u32 = 8;
/// A position came between two measurement instants, and was not taken, but for the last one of jump_after in succession: the
/// instants begin anew with it.
pub const FSB_EVENT_POSITION_OUT_OF_STEP: u32 = 16;
/// A force or a torque was not finite or beyond its limit; the one before was taken in its place.
pub const FSB_EVENT_WRENCH_REJECTED: u32 = 32;
/// The mass has changed: it is identified anew, the old one held until then, unless it was contradicted.
pub const FSB_EVENT_MASS_CHANGED: u32 = 64;
/// A moment of inertia has changed: all three are identified anew, the old ones held until then, unless contradicted.
pub const FSB_EVENT_INERTIA_CHANGED: u32 = 128;
/// The velocity has changed at once by more than any input explains, as in a collision: it was followed, and the mass, where it
/// was known, is identified anew, the old one held until then.
pub const FSB_EVENT_TRANSLATION_PUSHED: u32 = 256;
/// The same for the rates and the moments of inertia.
pub const FSB_EVENT_ROTATION_PUSHED: u32 = 512;

/// What was measured and has arrived by now. Start from fsb_measured_none.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_measured_t {
    /// x, y, z in the world frame [m]; NaN, all three, where none has come.
    pub position: [f32; 3],
    /// FSB_ATTITUDE_NONE, FSB_ATTITUDE_MATRIX or FSB_ATTITUDE_QUATERNION: what `attitude` holds.
    pub attitude_kind: u32,
    /// Body to world, in that form.
    pub attitude: [f32; 9],
}

/// Force and torque on the body about its centre of mass, along the body's axes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_wrench_t {
    /// Force [N], gravity not included.
    pub force: [f32; 3],
    /// Torque [N m], the gyroscopic moment not included.
    pub torque: [f32; 3],
}

/// The state now. What may not be used is NaN; the two `..._status` say why.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_vehicle_state_t {
    /// World frame [m].
    pub position: [f32; 3],
    /// World frame [m/s].
    pub velocity: [f32; 3],
    /// Body to world by rows: attitude[3 i + j] is the component of body axis j along world axis i. While the rates are
    /// not known yet it is the attitude as measured, if that is of now.
    pub attitude: [f32; 9],
    /// About the body's axes [rad/s].
    pub rates: [f32; 3],
    /// Whether position and velocity may be used, and why not: usable is FSB_STATE_NOMINAL or more.
    pub translation_status: fsb_state_status_t,
    /// The same for the rates.
    pub rotation_status: fsb_state_status_t,
}

/// An identified mass [kg] or moment of inertia [kg m^2]. `value` and `variance` are NaN where `status` says that they may
/// not be used.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_identified_t {
    /// Mass or moment of inertia.
    pub value: f32,
    /// Its variance; the square root of it is the standard deviation. For a while after a change (`mass_changed`, `inertia_changed`) it has the
    /// distance from the value before in it: a torque or force that nobody told may have been taken for the change.
    pub variance: f32,
    /// Whether it may be used, and why not: usable is FSB_PARAMETER_VALID or more. Its k is 1/value: FSB_PARAMETER_BELOW is
    /// a mass that is too large.
    pub status: fsb_parameter_status_t,
}

/// What is predicted with, and what a controller may divide by: identified, else held, else nominal; else NaN.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_vehicle_model_t {
    /// Mass [kg].
    pub mass: f32,
    /// Moments of inertia [kg m^2].
    pub inertia: [f32; 3],
}

/// How often what happened since the initialisation; a reset does not clear them. They stop at the largest number.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fsb_vehicle_counters_t {
    /// FSB_EVENT_ATTITUDE_REJECTED
    pub rejected_attitudes: u32,
    /// FSB_EVENT_ATTITUDE_LOST
    pub lost_attitudes: u32,
    /// FSB_EVENT_POSITION_REJECTED
    pub rejected_positions: u32,
    /// FSB_EVENT_POSITION_JUMPED
    pub position_jumps: u32,
    /// FSB_EVENT_POSITION_OUT_OF_STEP
    pub positions_out_of_step: u32,
    /// FSB_EVENT_WRENCH_REJECTED
    pub rejected_wrenches: u32,
    /// FSB_EVENT_MASS_CHANGED
    pub mass_changes: u32,
    /// FSB_EVENT_INERTIA_CHANGED
    pub inertia_changes: u32,
    /// FSB_EVENT_TRANSLATION_PUSHED
    pub translation_pushes: u32,
    /// FSB_EVENT_ROTATION_PUSHED
    pub rotation_pushes: u32,
}

impl fsb_measured_t {
    pub(super) const NONE: Self =
        Self { position: [f32::NAN; 3], attitude_kind: FSB_ATTITUDE_NONE, attitude: [0.0; 9] };

    pub(super) fn to_core(self, frame: Frame) -> Result<Measured, fsb_status_t> {
        let [a, b, c, d, e, f, g, h, i] = self.attitude;
        Ok(Measured {
            position: if self.position.iter().all(|x| x.is_nan()) { None } else { Some(frame.vector(self.position)) },
            attitude: match self.attitude_kind {
                FSB_ATTITUDE_NONE => None,
                FSB_ATTITUDE_MATRIX => Some(Attitude::Matrix(frame.matrix([[a, b, c], [d, e, f], [g, h, i]]))),
                FSB_ATTITUDE_QUATERNION => Some(Attitude::Quaternion(frame.quaternion([a, b, c, d]))),
                _ => return Err(FSB_UNKNOWN_VALUE),
            },
        })
    }
}

impl fsb_wrench_t {
    pub(super) fn to_core(self, frame: Frame) -> Wrench {
        Wrench { force: frame.vector(self.force), torque: frame.vector(self.torque) }
    }
}

impl fsb_vehicle_state_t {
    pub(super) const INVALID: Self = Self {
        position: [f32::NAN; 3],
        velocity: [f32::NAN; 3],
        attitude: [f32::NAN; 9],
        rates: [f32::NAN; 3],
        translation_status: FSB_STATE_UNKNOWN,
        rotation_status: FSB_STATE_UNKNOWN,
    };

    pub(super) fn new(state: &VehicleState, [translation, rotation]: [[StateStatus; 3]; 2], frame: Frame) -> Self {
        let VehicleState { position, velocity, attitude, rates } = *state;
        let vector = |of: Option<[f32; 3]>| of.map_or([f32::NAN; 3], |of| frame.vector(of));
        Self {
            position: vector(position),
            velocity: vector(velocity),
            attitude: attitude.map_or([f32::NAN; 9], |rows| {
                let [[a, b, c], [d, e, f], [g, h, i]] = frame.matrix(rows);
                [a, b, c, d, e, f, g, h, i]
            }),
            rates: vector(rates),
            translation_status: least(translation, position.is_some() && velocity.is_some()),
            rotation_status: least(rotation, rates.is_some()),
        }
    }
}

/// The status of the three axes: usable only where all are, and there is a state.
fn least([x, y, z]: [StateStatus; 3], there: bool) -> fsb_state_status_t {
    let least = state_code(x).min(state_code(y)).min(state_code(z));
    if there || least < FSB_STATE_NOMINAL { least } else { FSB_STATE_UNKNOWN }
}

impl fsb_identified_t {
    pub(super) const INVALID: Self = Self { value: f32::NAN, variance: f32::NAN, status: FSB_PARAMETER_UNKNOWN };

    pub(super) fn new(status: ParameterStatus, identified: Option<Identified>) -> Self {
        let status = parameter_code(status);
        match identified {
            Some(Identified { value, variance }) => Self { value, variance, status },
            None => Self { status, ..Self::INVALID },
        }
    }
}

impl fsb_vehicle_model_t {
    pub(super) const INVALID: Self = Self { mass: f32::NAN, inertia: [f32::NAN; 3] };
}

impl From<VehicleModel> for fsb_vehicle_model_t {
    fn from(VehicleModel { mass, inertia }: VehicleModel) -> Self {
        Self { mass: mass.unwrap_or(f32::NAN), inertia: inertia.map(|inertia| inertia.unwrap_or(f32::NAN)) }
    }
}

impl fsb_vehicle_counters_t {
    pub(super) const NONE: Self = Self {
        rejected_attitudes: 0,
        lost_attitudes: 0,
        rejected_positions: 0,
        position_jumps: 0,
        positions_out_of_step: 0,
        rejected_wrenches: 0,
        mass_changes: 0,
        inertia_changes: 0,
        translation_pushes: 0,
        rotation_pushes: 0,
    };
}

impl From<VehicleCounters> for fsb_vehicle_counters_t {
    fn from(of: VehicleCounters) -> Self {
        Self {
            rejected_attitudes: of.rejected_attitudes,
            lost_attitudes: of.lost_attitudes,
            rejected_positions: of.rejected_positions,
            position_jumps: of.position_jumps,
            positions_out_of_step: of.positions_out_of_step,
            rejected_wrenches: of.rejected_wrenches,
            mass_changes: of.mass_changes,
            inertia_changes: of.inertia_changes,
            translation_pushes: of.translation_pushes,
            rotation_pushes: of.rotation_pushes,
        }
    }
}

/// The events as bits.
pub(super) fn bits(events: &Events) -> u32 {
    [
        (events.attitude_rejected, FSB_EVENT_ATTITUDE_REJECTED),
        (events.attitude_lost, FSB_EVENT_ATTITUDE_LOST),
        (events.position_rejected, FSB_EVENT_POSITION_REJECTED),
        (events.position_jumped, FSB_EVENT_POSITION_JUMPED),
        (events.position_out_of_step, FSB_EVENT_POSITION_OUT_OF_STEP),
        (events.wrench_rejected, FSB_EVENT_WRENCH_REJECTED),
        (events.mass_changed, FSB_EVENT_MASS_CHANGED),
        (events.inertia_changed, FSB_EVENT_INERTIA_CHANGED),
        (events.translation_pushed, FSB_EVENT_TRANSLATION_PUSHED),
        (events.rotation_pushed, FSB_EVENT_ROTATION_PUSHED),
    ]
    .iter()
    .fold(0, |bits, (happened, bit)| if *happened { bits | bit } else { bits })
}
