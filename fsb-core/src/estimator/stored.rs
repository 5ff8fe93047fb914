//! What a snapshot holds of an estimator, and what it must obey.

use super::Estimator;
use super::advance::LONG_AGO;
use super::axis::{Axis, Marks, Source};
use super::output::{Counters, Learning};
use super::shared::{Pace, Progress};
use crate::snapshot::{Archive, Fingerprint, Stored, Whole, snapshots, stored};

stored!(Counters { missed, rejected_measurements, rejected_inputs });
stored!(Progress { observer, identifier, substep, started, all_measured, pace, learning, counters });
stored!(Marks { bits });
stored!(Axis {
    observer,
    model,
    moments,
    block,
    origin,
    innovation_before,
    tolerance,
    cascade,
    cross,
    noise_sum,
    noise,
    settled_at,
    usable_at,
    missed,
    gap,
    source,
    measured,
    marks,
    present,
});

/// Not kept: the first measurement after it goes the general way, which leads to the same state, and finds out.
impl Stored for Pace {
    fn pass(&mut self, archive: &mut dyn Archive) {
        *self = Self::Careful;
        0_u32.pass(archive);
    }
}

impl Stored for Learning {
    fn pass(&mut self, archive: &mut dyn Archive) {
        let mut code = *self as u8;
        code.pass(archive);
        match code {
            0 => *self = Self::On,
            1 => *self = Self::Off,
            2 => *self = Self::Contact,
            _ => archive.refuse(),
        }
    }
}

impl Stored for Source {
    fn pass(&mut self, archive: &mut dyn Archive) {
        let mut code = *self as u8;
        code.pass(archive);
        match code {
            0 => *self = Self::Nothing,
            1 => *self = Self::Provisional,
            2 => *self = Self::Nominal,
            3 => *self = Self::Held,
            4 => *self = Self::Identified,
            _ => archive.refuse(),
        }
    }
}

impl<const N: usize, const P: usize> Stored for Estimator<N, P> {
    fn pass(&mut self, archive: &mut dyn Archive) {
        self.frame.progress.pass(archive);
        self.frame.axes.pass(archive);
        self.parameters.pass(archive);
    }
}

impl<const N: usize, const P: usize> Estimator<N, P> {
    snapshots!();
}

impl<const N: usize, const P: usize> Whole for Estimator<N, P> {
    const SHAPE: [u8; 3] = [0, N as u8, P as u8];

    /// Whether the state is one that this design can have come to.
    fn is_sound(&self) -> bool {
        let common = &self.frame.common;
        let progress = &self.frame.progress;
        let clocks = progress.substep <= common.substeps
            && progress.identifier.position < common.schedule.round
            && progress.observer.count <= LONG_AGO + 65_536
            && progress.observer.is_sound()
            && progress.identifier.is_sound();
        // Positions are predicted within the limit or lost; a velocity crosses the whole range in a few periods at most.
        let most = 4.0 * common.position_limit;
        clocks
            && self.parameters.iter().all(|parameter| parameter.is_sound())
            && self.frame.axes.iter().all(|axis| {
                axis.model.is_sound(axis.own.drift_t2, common.period2)
                    && axis.observer.is_within(most)
                    && axis.noise.is_sound()
                    && axis.origin.abs() <= most
                    && axis.moments.j1.abs() <= 2.0 * common.input_limit
                    && axis.moments.j2.abs() <= 2.0 * common.input_limit
            })
    }

    /// Tells configurations apart: of two that differ in what a state depends on, all but one in 2^32 differ in this.
    fn fingerprint(&self) -> u32 {
        let common = &self.frame.common;
        let mut hash = Fingerprint::new();
        for word in [common.substeps, common.block_length, common.schedule.turn, common.parameter_settle] {
            hash.add(word);
        }
        for word in [common.state_settle, common.readout as u32, common.covariance.steps, u32::from(common.wants_unit)]
        {
            hash.add(word);
        }
        for number in [common.period2, common.observer.c(), common.identifier.c, common.identifier.scale] {
            hash.add(number.to_bits());
        }
        for number in [common.disturbance, common.forgetting, common.position_limit, common.input_limit] {
            hash.add(number.to_bits());
        }
        for tuning in [common.observer_tuning.lambda, common.observer_tuning.q, common.measurement_period] {
            let bits = tuning.to_bits();
            hash.add(bits as u32);
            hash.add((bits >> 32) as u32);
        }
        for axis in &self.frame.axes {
            hash.add(axis.own.drift.to_bits());
        }
        for parameter in &self.parameters {
            hash.add(parameter.nominal.unwrap_or(0.0).to_bits());
        }
        hash.value()
    }
}
