//! The six axes and the names of their columns.

/// One degree of freedom of the vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Axis {
    /// Along x, world frame \[m\].
    X,
    /// Along y, world frame \[m\].
    Y,
    /// Along z, world frame, up \[m\].
    Z,
    /// About x \[rad\].
    Roll,
    /// About y \[rad\].
    Pitch,
    /// About z \[rad\].
    Yaw,
}

impl Axis {
    /// Every axis.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::Roll, Self::Pitch, Self::Yaw];

    /// The name of the axis and of its position column.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.names().0
    }

    /// The name of its input column.
    #[must_use]
    pub const fn input_name(self) -> &'static str {
        self.names().1
    }

    /// The name of its velocity column.
    #[must_use]
    pub const fn reference_name(self) -> &'static str {
        self.names().2
    }

    /// Whether it moves by a force (parameter: 1/mass) and not by a torque (1/inertia).
    #[must_use]
    pub const fn is_translation(self) -> bool {
        matches!(self, Self::X | Self::Y | Self::Z)
    }

    const fn names(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::X => ("x", "fx", "vx_ref"),
            Self::Y => ("y", "fy", "vy_ref"),
            Self::Z => ("z", "fz", "vz_ref"),
            Self::Roll => ("roll", "taux", "vroll_ref"),
            Self::Pitch => ("pitch", "tauy", "vpitch_ref"),
            Self::Yaw => ("yaw", "tauz", "vyaw_ref"),
        }
    }
}
