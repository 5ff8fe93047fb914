//! What is of no consequence to a single estimate, and is promised all the same.

use super::{Cascade, Coefficients, IdentifierDesign};
use crate::tuning::Tuning;
use crate::window::Window;

/// After a swing a position that stays and no input: every stage ends at a normal number or at zero, and spends no step among
/// the subnormal ones, on which some processors are slow.
#[test]
fn stages_left_without_input_stay_normal() {
    let design = IdentifierDesign::new(Tuning { lambda: 50.0, q: 50.0 }, 1e-3).expect("valid");
    let (mut at_once, mut in_two, mut window) = (Cascade::default(), Cascade::default(), Window::START);
    for n in 0..10_000_u32 {
        let at = Coefficients::at(&window, &design);
        design.step(&mut window);
        let (y, s) = if n < 1000 { (libm::sinf(0.01 * n as f32), 1.0) } else { (0.0, 0.0) };
        at_once.step_folded(y, s, &design, &at);
        in_two.step(y, s, &design, &at);
        if n % 8 == 7 {
            at_once.keep_normal();
            in_two.fold();
        }
        for cascade in [at_once, in_two] {
            let Cascade { x1, x2, x3, x4, x5, x6 } = cascade;
            let stages = [x1, x2, x3, x4, x5, x6].map(|stage| stage.value());
            assert!(stages.iter().all(|x| !x.is_subnormal()), "{n}: {stages:?}");
        }
    }
}

/// Of the 512 scales the one that costs the constants of the weights, (39)-(41), least.
#[test]
fn the_scale_that_rounds_least() {
    for (lambda, q, period) in [(2.0, 1.0, 1e-3), (3.0, 5.0, 0.02), (10.0, 5.0, 1.25e-4), (0.7, 0.35, 0.01)] {
        let tuning = Tuning { lambda, q };
        let design = IdentifierDesign::new(tuning, period).expect("valid");
        let rounded = |x: f64| f64::from(-libm::expm1(-x) as f32);
        let (c, alpha) = (rounded(lambda * period), rounded(q * period));
        let (p, rho) = (1.0 - c, 1.0 - alpha);
        let base = 1.0 / (period * period * p * p);
        let constants = [
            base * c * c,
            base * 2.0 * c * (1.0 - rho * rho),
            base * alpha * alpha * (1.0 + rho) / rho,
            base * 2.0 * c * (1.0 - rho * rho) / rho,
        ];
        let loss = |scale: f64| {
            let losses = constants.map(|x| (f64::from((scale * x) as f32) / (scale * x) - 1.0).abs());
            losses.into_iter().fold(0.0, f64::max)
        };
        let chosen = loss(f64::from(design.scale));
        let smallest = 1_048_576.0_f64;
        assert!((smallest..2.0 * smallest).contains(&f64::from(design.scale)), "{}", design.scale);
        for choice in 0..512 {
            let scale = smallest + f64::from(choice) * 2048.0;
            assert!(chosen <= loss(scale) + 1e-12, "{tuning:?}: {} costs {chosen:e}, {scale} less", design.scale);
        }
    }
}
