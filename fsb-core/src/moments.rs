//! The two input moments over an interval of length T, section 2 of the design:
//!
//! J1 = ∫ f(τ) dτ,   J2 = ∫ (T - τ) f(τ) dτ,
//!
//! the velocity and the position that the input alone gives a unit mass at rest. They are all the estimator ever needs to
//! know of the input, and they are exact for an input held, linear, or held piecewise (control faster than measurement).

/// (J1, J2) over the interval so far. Units of the input times s and s².
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct InputMoments {
    /// J1 = ∫ f dτ: the unit response's velocity.
    pub j1: f32,
    /// J2 = ∫ (T - τ) f dτ: the unit response's position.
    pub j2: f32,
}

impl InputMoments {
    /// An interval of length zero.
    pub const ZERO: Self = Self { j1: 0.0, j2: 0.0 };

    /// Appends `dt` [s] of an input held at `f`: J2 += J1 dt + f dt²/2, J1 += f dt. `dt2_half` is dt²/2.
    #[inline(always)]
    pub fn hold(&mut self, f: f32, dt: f32, dt2_half: f32) {
        self.j2 += self.j1 * dt + f * dt2_half;
        self.j1 += f * dt;
    }

    /// Appends `dt` [s] of an input that goes linearly from `f0` to `f1`: J2 += J1 dt + dt²/6 (2 f0 + f1), J1 += dt/2 (f0 + f1).
    /// `dt2_half` is dt²/2.
    #[inline(always)]
    pub fn ramp(&mut self, f0: f32, f1: f32, dt: f32, dt2_half: f32) {
        self.j2 += self.j1 * dt + dt2_half * ((f0 + f0 + f1) * (1.0 / 3.0));
        self.j1 += dt * ((f0 + f1) * 0.5);
    }

    /// Appends an interval of `dt` [s] whose own moments are known.
    #[inline(always)]
    pub fn append(&mut self, later: InputMoments, dt: f32) {
        self.j2 += self.j1 * dt + later.j2;
        self.j1 += later.j1;
    }
}
