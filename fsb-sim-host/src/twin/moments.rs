//! The input moments over an interval of length T: J1 = ∫ f dτ, J2 = ∫ (T - τ) f dτ.

/// (J1, J2), what the input alone gives to the velocity and the position of a unit mass at rest. Units of f times s and s².
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// J1 [N s].
    pub j1: f64,
    /// J2 [N s²].
    pub j2: f64,
}

impl Moments {
    /// `f` [N] held for `period` [s].
    pub const fn held(f: f64, period: f64) -> Self {
        Self { j1: f * period, j2: f * period * period / 2.0 }
    }

    /// A force going linearly from `from` to `to` [N] in `period` [s].
    pub const fn linear(from: f64, to: f64, period: f64) -> Self {
        Self { j1: period * (from + to) / 2.0, j2: period * period * (2.0 * from + to) / 6.0 }
    }

    /// Sub-steps of equal length that fill `period` [s], each with its force [N] held: the definition, term by term.
    pub fn held_in_parts(forces: &[f64], period: f64) -> Self {
        let dt = period / forces.len() as f64;
        forces.iter().enumerate().fold(Self::default(), |sum, (i, f)| {
            let after = period - (i + 1) as f64 * dt;
            Self { j1: sum.j1 + f * dt, j2: sum.j2 + f * (dt * dt / 2.0 + after * dt) }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Moments;
    use crate::plant::HeldInputAxis;

    /// The moments are what a unit mass at rest does.
    #[test]
    fn parts_move_a_unit_mass() {
        let forces = [3.0, -1.0, 0.5, 7.0];
        let mut mass = HeldInputAxis { position: 0.0, velocity: 0.0, k: 1.0, drift: 0.0 };
        for f in forces {
            mass.step(f, 0.05);
        }
        let moments = Moments::held_in_parts(&forces, 0.2);
        assert!((moments.j1 - mass.velocity).abs() < 1e-15 && (moments.j2 - mass.position).abs() < 1e-15);
        let whole = Moments::held_in_parts(&[4.0; 10], 0.2);
        let held = Moments::held(4.0, 0.2);
        assert!((whole.j1 - held.j1).abs() < 1e-15 && (whole.j2 - held.j2).abs() < 1e-15);
    }

    /// f = 1 + 2τ over 0.5 s: J1 = 0.75, J2 = 0.5/2·0.5 + 2·0.5³/6.
    #[test]
    fn linear_force() {
        let moments = Moments::linear(1.0, 2.0, 0.5);
        assert!((moments.j1 - 0.75).abs() < 1e-15);
        assert!((moments.j2 - (0.125 + 2.0 * 0.125 / 6.0)).abs() < 1e-15);
    }
}
