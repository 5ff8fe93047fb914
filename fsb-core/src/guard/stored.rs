//! What a snapshot holds of a guarded estimator.

use super::gate::Gate;
use super::guarded::Guarded;
use super::verdict::{Rejections, Verdict};
use crate::snapshot::{Archive, Fingerprint, Stored, Whole, snapshots, stored};

stored!(Gate { level, values, gap, blind, run, held, innovation, course, last });
stored!(Rejections { missing, non_finite, beyond_limit, improbable, frozen, jumps, pushes, faults });

impl Stored for Verdict {
    fn pass(&mut self, archive: &mut dyn Archive) {
        let (mut code, mut size) = match *self {
            Self::Missing => (0_u8, 0.0),
            Self::Taken => (1, 0.0),
            Self::NonFinite => (2, 0.0),
            Self::BeyondLimit => (3, 0.0),
            Self::Improbable => (4, 0.0),
            Self::Frozen => (5, 0.0),
            Self::Jumped(by) => (6, by),
            Self::Pushed(by) => (7, by),
        };
        code.pass(archive);
        size.pass(archive);
        match code {
            0 => *self = Self::Missing,
            1 => *self = Self::Taken,
            2 => *self = Self::NonFinite,
            3 => *self = Self::BeyondLimit,
            4 => *self = Self::Improbable,
            5 => *self = Self::Frozen,
            6 => *self = Self::Jumped(size),
            7 => *self = Self::Pushed(size),
            _ => archive.refuse(),
        }
    }
}

impl<const N: usize, const P: usize> Stored for Guarded<N, P> {
    fn pass(&mut self, archive: &mut dyn Archive) {
        self.estimator.pass(archive);
        self.gates.pass(archive);
        self.verdicts.pass(archive);
        self.rejections.pass(archive);
        self.interrupted.pass(archive);
        self.instants.pass(archive);
        self.last.pass(archive);
    }
}

impl<const N: usize, const P: usize> Guarded<N, P> {
    snapshots!();
}

impl<const N: usize, const P: usize> Whole for Guarded<N, P> {
    const SHAPE: [u8; 3] = [1, N as u8, P as u8];

    fn fingerprint(&self) -> u32 {
        let mut hash = Fingerprint::new();
        hash.add(self.estimator.fingerprint());
        let design = &self.design;
        for number in [design.sigmas2, design.step, design.fall, design.lambda_t, design.decay] {
            hash.add_number(number);
        }
        for count in [design.jump_after, design.frozen_after, design.bridge] {
            hash.add(u32::from(count));
        }
        hash.value()
    }

    fn is_sound(&self) -> bool {
        let most = 2.0 * self.estimator.input_limit();
        self.estimator.is_sound()
            && self.gates.iter().all(Gate::is_sound)
            && self.last.iter().all(|input| input.j1.abs() <= most && input.j2.abs() <= most)
    }
}
