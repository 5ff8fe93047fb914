//! The covariance recursion against what it sums up: the cascade's answer to each single noisy sample.

use super::super::{CovarianceDesign, NoiseCross, NoiseShape};
use crate::identifier::{Cascade, Coefficients, IdentifierDesign};
use crate::tuning::Tuning;
use crate::wide::Wide;
use crate::window::Window;

const STEPS: usize = 120;
const PERIOD: f64 = 0.01;

/// A weight that goes up and down.
fn weight(n: usize) -> f32 {
    1.0 + libm::sinf(0.2 * n as f32)
}

/// var ẑ2 = Σ_j h_j², h_j the answer to the sample j alone; var a = Σ_j (Σ_n μ^(N-n) ω_n h_j[n])², fading or not.
#[test]
fn it_is_the_sum_over_single_samples() {
    for (tuning, fading) in [
        (Tuning { lambda: 10.0, q: 5.0 }, 0.0),
        (Tuning { lambda: 10.0, q: 30.0 }, 0.0),
        (Tuning { lambda: 6.0, q: 2.0 }, 0.05),
    ] {
        let mut design = CovarianceDesign::BLANK;
        design.fill(&tuning, Wide::new(PERIOD), Wide::new(fading), 1, 1);
        assert_eq!(design.steps, 1, "every step counts at this rate");
        let identifier = IdentifierDesign::at_scale(&tuning.decay(Wide::new(PERIOD)), Wide::ONE);
        let mut answers = [Cascade::default(); STEPS];
        let mut sums = [0.0_f64; STEPS];
        let (mut shape, mut cross, mut variance) = (NoiseShape::START, NoiseCross::default(), 0.0_f64);
        let mut window = Window::START;
        let remembered = libm::exp(-fading);
        for n in 0..STEPS {
            let at = Coefficients::at(&window, &identifier);
            let mut expected = 0.0;
            for (sample, (answer, sum)) in answers.iter_mut().zip(&mut sums).enumerate() {
                answer.step_folded(if sample == n { 1.0 } else { 0.0 }, 0.0, &identifier, &at);
                let h = f64::from(answer.z2());
                expected += h * h;
                *sum = remembered * *sum + f64::from(weight(n)) * h;
            }
            shape.step(&window, &design);
            let added = cross.step(weight(n), &shape, &design);
            variance += f64::from(added) - f64::from(design.noise_forgetting) * variance;
            identifier.step(&mut window);
            let summed: f64 = sums.iter().map(|sum| sum * sum).sum();
            if n >= 5 {
                let got = f64::from(shape.variance());
                assert!((got / expected - 1.0).abs() < 1e-4, "{tuning:?}, {n}: var {got:e} for {expected:e}");
                assert!((variance / summed - 1.0).abs() < 1e-3, "{tuning:?}, {n}: var a {variance:e} for {summed:e}");
            }
        }
    }
}
