//! What the vehicle's estimator hands out.

/// An identified mass (kg) or moment of inertia (kg m²).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Identified {
    /// 1/k̂.
    pub value: f32,
    /// Its variance, var(k̂)/k̂⁴, and what a change leaves open ([`super::ChangeRule`]).
    pub variance: f32,
}

impl Identified {
    /// Standard deviation. Uses a square root: not for the tick.
    pub fn sd(&self) -> f32 {
        libm::sqrtf(self.variance)
    }
}

/// The state now, as far as it may be used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VehicleState {
    /// x, y, z in the world frame (m).
    pub position: Option<[f32; 3]>,
    /// Velocity in the world frame (m/s).
    pub velocity: Option<[f32; 3]>,
    /// R, body to world, by rows. Where the rates are not known yet it is the attitude as measured, if that is of now.
    pub attitude: Option<[[f32; 3]; 3]>,
    /// ω about the body's axes (rad/s).
    pub rates: Option<[f32; 3]>,
}

/// What is predicted with: identified, else held, else nominal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VehicleModel {
    /// m (kg).
    pub mass: Option<f32>,
    /// I_x, I_y, I_z (kg m²).
    pub inertia: [Option<f32>; 3],
}

/// The two groups of axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Group {
    /// x, y, z: the mass.
    Translation,
    /// The angles about the body's axes: the moments of inertia.
    Rotation,
}

/// What happened in an update.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Events {
    /// An attitude was none, or cannot be true, and was taken as missing.
    pub attitude_rejected: bool,
    /// The attitude had turned by more than could be followed: the rotation's state begins anew, the moments of inertia are
    /// held.
    pub attitude_lost: bool,
    /// A position was not finite, beyond its limit or cannot be true, and was taken as missing.
    pub position_rejected: bool,
    /// The origin of the positions has jumped: they were followed, and velocity and mass have not noticed.
    pub position_jumped: bool,
    /// The velocity has changed at once by more than any input explains, as in a collision: it was followed, and the mass, where
    /// it was known, is identified anew, the old one held until then.
    pub translation_pushed: bool,
    /// The same for the rates and the moments of inertia.
    pub rotation_pushed: bool,
    /// A position came between two measurement instants, and was not taken, but for the last one of `jump_after` in succession: the
    /// instants begin anew with it.
    pub position_out_of_step: bool,
    /// A force or a torque was not finite or beyond its limit; the one before was taken in its place.
    pub wrench_rejected: bool,
    /// The mass has changed: it is identified anew, the old one held until then, unless it was contradicted.
    pub mass_changed: bool,
    /// A moment of inertia has changed: all three are identified anew, the old ones held until then, unless contradicted.
    pub inertia_changed: bool,
}

impl Events {
    /// Whether anything happened.
    pub fn any(&self) -> bool {
        *self != Self::default()
    }
}

/// Events since construction. They only rise, and stop at the largest number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct VehicleCounters {
    /// Attitudes that were none, or could not be true.
    pub rejected_attitudes: u32,
    /// Times the attitude could not be followed.
    pub lost_attitudes: u32,
    /// Positions that were not finite, beyond their limit or could not be true.
    pub rejected_positions: u32,
    /// Jumps of the origin of positions.
    pub position_jumps: u32,
    /// Changes of the velocity that no input explains.
    pub translation_pushes: u32,
    /// Changes of the rates that no input explains.
    pub rotation_pushes: u32,
    /// Positions between two measurement instants.
    pub positions_out_of_step: u32,
    /// Wrenches of which the force or the torque was replaced.
    pub rejected_wrenches: u32,
    /// Changes of the mass.
    pub mass_changes: u32,
    /// Changes of the moments of inertia.
    pub inertia_changes: u32,
}

impl VehicleCounters {
    /// Counts what happened in an update.
    pub(super) fn count(&mut self, events: &Events) {
        for (counter, happened) in [
            (&mut self.rejected_attitudes, events.attitude_rejected),
            (&mut self.lost_attitudes, events.attitude_lost),
            (&mut self.rejected_positions, events.position_rejected),
            (&mut self.position_jumps, events.position_jumped),
            (&mut self.translation_pushes, events.translation_pushed),
            (&mut self.rotation_pushes, events.rotation_pushed),
            (&mut self.positions_out_of_step, events.position_out_of_step),
            (&mut self.rejected_wrenches, events.wrench_rejected),
            (&mut self.mass_changes, events.mass_changed),
            (&mut self.inertia_changes, events.inertia_changed),
        ] {
            *counter = counter.saturating_add(u32::from(happened));
        }
    }
}
