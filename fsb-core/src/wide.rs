//! Double precision for constants: [`Wide`], an f64 that a processor without double precision keeps in its integer registers.
//!
//! There every operation on an f64 is a call of a routine that takes and returns integer registers, while the compiler keeps
//! f64 in the registers of the single-precision unit, and moves them to and fro at every call: half of the code of a formula
//! is moves. In this form it is not. The values are those of f64, to the last bit. For the configuration, not for the tick.

use core::ops::{Add, Mul, Sub};

/// An f64 by its bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wide(u64);

impl Wide {
    pub const ZERO: Self = Self::new(0.0);
    pub const ONE: Self = Self::new(1.0);

    pub const fn new(value: f64) -> Self {
        Self(value.to_bits())
    }

    /// A count.
    #[inline(never)]
    pub fn of(count: u32) -> Self {
        Self::new(f64::from(count))
    }

    pub const fn get(self) -> f64 {
        f64::from_bits(self.0)
    }

    /// The bits: of positive numbers, and of the infinite one, the larger one has the larger bits.
    pub const fn bits(self) -> u64 {
        self.0
    }

    /// Whether it is no number.
    pub const fn is_nan(self) -> bool {
        self.magnitude().0 > f64::INFINITY.to_bits()
    }

    /// Whether it is neither infinite nor no number.
    pub const fn is_finite(self) -> bool {
        self.magnitude().0 < f64::INFINITY.to_bits()
    }

    /// Whether it has a minus sign.
    pub const fn is_negative(self) -> bool {
        self.0 & SIGN != 0
    }

    /// Without its sign.
    pub const fn magnitude(self) -> Self {
        Self(self.0 & !SIGN)
    }

    /// To the nearest f32.
    #[inline(never)]
    pub fn rounded(self) -> f32 {
        self.get() as f32
    }

    /// The nearest f32, again in f64.
    #[inline(never)]
    pub fn as_rounded(self) -> Self {
        Self::new(f64::from(self.rounded()))
    }

    #[inline(never)]
    pub fn over(self, other: Self) -> Self {
        Self::new(self.get() / other.get())
    }
}

const SIGN: u64 = 1 << 63;

impl Mul for Wide {
    type Output = Self;

    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        Self::new(self.get() * other.get())
    }
}

impl Add for Wide {
    type Output = Self;

    #[inline(never)]
    fn add(self, other: Self) -> Self {
        Self::new(self.get() + other.get())
    }
}

impl Sub for Wide {
    type Output = Self;

    #[inline(never)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.get() - other.get())
    }
}
