//! The same in the band of the identifier.

use crate::estimator::IdentifierView;

#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    steps: f32,
    ee: f32,
    ez: f32,
    zz: f32,
}

#[derive(Clone, Copy, Debug, Default)]
struct Side {
    last: Option<f32>,
    left: f32,
    streak: u32,
    sums: Sums,
    explains: bool,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Contest {
    blocks: u32,
    learned: f32,
    sides: [Side; 3],
}

pub(super) struct Outcome {
    pub changed: bool,
    pub explains: [bool; 3],
}

impl Contest {
    pub fn reset(&mut self) {
        let left = self.sides.map(|s| s.left);
        *self = Self { learned: self.learned, ..Self::default() };
        for (s, l) in self.sides.iter_mut().zip(left) { s.left = l; }
    }

    pub fn observe(&mut self, view: &IdentifierView<3>, known: &[Option<f32>; 3], pooled: bool, relative: f32, sigmas2: f32, open: bool) -> Outcome {
        let mut outcome = Outcome { changed: false, explains: self.sides.map(|s| s.explains) };
        if view.blocks == self.blocks {
            return outcome;
        }
        self.blocks = view.blocks;
        let keep = 1.0 - view.c / 3.0;
        if self.learned < 80.0 / view.c { self.learned += 1.0; }
        for i in 0..(if pooled { 1 } else { 3 }) {
            let side = &mut self.sides[i];
            if known[i].is_some() { side.last = known[i]; }
            let Some(k) = side.last else { continue };
            let s = &mut side.sums;
            for sum in [&mut s.ee, &mut s.ez, &mut s.zz, &mut s.steps] { *sum *= keep; }
            let range = if pooled { 0..3 } else { i..i + 1 };
            let kappa = if s.zz > 0.0 { s.ez / s.zz } else { 0.0 };
            for axis in range {
                let noise = view.noise[axis];
                if noise <= 0.0 { continue; }
                let (z2, z0) = (view.z2[axis], view.z0[axis]);
                let w = 1.0 / noise;
                let e = z2 - k * z0;
                s.ee += e * e * w;
                s.ez += e * z0 * w;
                s.zz += z0 * z0 * w;
                s.steps += 1.0;
                let left = e - kappa * z0;
                let (left, most) = (left * left * w, 4.0 * side.left + 1.0);
                side.left += (if left < most { left } else { most } - side.left) / self.learned;
            }
            if s.steps < 1.0 { continue; }
            let explained = s.ez * s.ez / s.zz;
            let d: f32 = std::env::var("D").map_or(0.0, |d| d.parse().unwrap());
            let usual = 1.0 + d * d * view.weight * view.weight / view.noise[i];
            side.explains = s.ez.abs() > relative * k * s.zz
                && explained > sigmas2 * (3.0 / view.c) * usual
                && explained > s.ee - 1.5 * s.steps - explained;
            side.streak = if side.explains && open && known[i].is_some() { side.streak + 1 } else { 0 };
            if side.streak as f32 * view.c > 0.2 { outcome.changed = true; }
            outcome.explains[i] = side.explains;
        }
        outcome
    }
}
