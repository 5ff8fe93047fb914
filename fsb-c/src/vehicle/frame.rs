//! The axes of what goes in and out. The core's are z up, and x forward, y left, z up on the body.

/// World with z up (ENU, or any other: x and y as you like), body x forward, y left, z up. The default.
pub const FSB_FRAME_Z_UP: u32 = 0;
/// World with z down (NED), body x forward, y right, z down (FRD): PX4 and ArduPilot.
pub const FSB_FRAME_Z_DOWN: u32 = 1;

/// One of the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Frame {
    ZUp,
    ZDown,
}

impl Frame {
    pub const fn of(code: u32) -> Option<Self> {
        match code {
            FSB_FRAME_Z_UP => Some(Self::ZUp),
            FSB_FRAME_Z_DOWN => Some(Self::ZDown),
            _ => None,
        }
    }

    pub const fn code(self) -> u32 {
        match self {
            Self::ZUp => FSB_FRAME_Z_UP,
            Self::ZDown => FSB_FRAME_Z_DOWN,
        }
    }

    /// Between this frame and the core's, either way: half a turn about x.
    pub fn vector(self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        match self {
            Self::ZUp => [x, y, z],
            Self::ZDown => [x, -y, -z],
        }
    }

    /// The same for R, of which both frames change.
    pub fn matrix(self, [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]: [[f32; 3]; 3]) -> [[f32; 3]; 3] {
        match self {
            Self::ZUp => [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]],
            Self::ZDown => [[xx, -xy, -xz], [-yx, yy, yz], [-zx, zy, zz]],
        }
    }

    /// The same for the quaternion of R.
    pub fn quaternion(self, [w, x, y, z]: [f32; 4]) -> [f32; 4] {
        match self {
            Self::ZUp => [w, x, y, z],
            Self::ZDown => [w, x, -y, -z],
        }
    }
}
