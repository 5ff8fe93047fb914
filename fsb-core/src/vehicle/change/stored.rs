//! What a snapshot holds of a detector.

use super::{Detector, Response};
use crate::snapshot::{Archive, Fingerprint, Stored, stored};

stored!(Response { phi, e, w });

impl Stored for Detector {
    fn pass(&mut self, archive: &mut dyn Archive) {
        self.responses.pass(archive);
        self.usual.pass(archive);
        self.statistics.pass(archive);
        self.instants.pass(archive);
        self.contradicted.pass(archive);
        self.measured.pass(archive);
        self.known.pass(archive);
        self.was_known.pass(archive);
        self.residuals.pass(archive);
        self.squares.pass(archive);
        self.doubt.pass(archive);
    }
}

impl Detector {
    /// Responses to inputs: far below this. The square of it is a number.
    const MOST: f32 = 1e15;

    /// What tells detectors apart.
    pub fn add_to(&self, hash: &mut Fingerprint) {
        let [gain, half] = [self.innovation_gain, self.doubt.half];
        for number in [self.relative, self.sigmas2, self.period2, gain, self.disturbance, half] {
            hash.add_number(number);
        }
        for count in [self.hold_off, self.enough] {
            hash.add(count);
        }
    }

    /// Of a state that was stored: nothing in it can overflow, squares and variances are none below zero.
    pub fn is_sound(&self) -> bool {
        let largest = Self::MOST * Self::MOST;
        let is_square = |x: f32| (0.0..=largest).contains(&x);
        self.responses.iter().flat_map(|response| [response.phi, response.e, response.w]).all(|x| x.abs() <= Self::MOST)
            && self.residuals.is_sound()
            && self.squares.are_sound(largest)
            && self.doubt.is_sound()
            && self.usual.iter().all(|&x| is_square(x))
            && self.statistics.iter().flat_map(|statistic| &statistic.sums).all(|sum| {
                sum.product.abs() <= largest
                    && is_square(sum.square)
                    && is_square(sum.variance)
                    && is_square(sum.disturbed)
            })
    }
}
