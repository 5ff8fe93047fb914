//! Any bits for measurements and inputs, in any order of calls: no panic, and everything handed out is a number.

use fsb_core::Tuning;
use fsb_core::readout::{Memory, ParameterRule};
use fsb_core::regression::{DragConfig, DragEstimator, Identify, Term};
use proptest::prelude::*;

#[derive(Clone, Debug)]
enum Call {
    Measure([Option<u32>; 2]),
    Apply([u32; 2]),
    Ramp([u32; 2], [u32; 2]),
    Reset,
}

fn bits() -> impl Strategy<Value = u32> {
    // Any pattern, and often a number that is accepted, small, at the limit or subnormal.
    prop_oneof![
        any::<u32>(),
        (-10.0..10.0_f32).prop_map(f32::to_bits),
        prop::sample::select(vec![1e5_f32, -1e5, 1e6, -1e6, 1e-40, -1e-40, 1e-20, 0.0, -0.0]).prop_map(f32::to_bits),
    ]
}

fn call() -> impl Strategy<Value = Call> {
    let pair = || [bits(), bits()];
    prop_oneof![
        20 => [prop::option::of(bits()), prop::option::of(bits())].prop_map(Call::Measure),
        20 => pair().prop_map(Call::Apply),
        8 => (pair(), pair()).prop_map(|(a, b)| Call::Ramp(a, b)),
        1 => Just(Call::Reset),
    ]
}

fn is_sound(estimator: &DragEstimator<2>) -> Result<(), TestCaseError> {
    if let Some(k) = estimator.parameter() {
        prop_assert!(k.value.is_finite() && k.value > 0.0 && k.variance.is_finite() && k.sd() >= 0.0, "{k:?}");
    }
    for terms in estimator.terms() {
        for term in [terms.drag, terms.disturbance] {
            if let Term::Known { value, sd } = term {
                prop_assert!(value.is_finite() && sd.is_finite() && sd >= 0.0, "{terms:?}");
            }
        }
    }
    for state in estimator.states().into_iter().flatten() {
        prop_assert!(state.position.is_finite() && state.velocity.is_finite(), "{state:?}");
    }
    for variance in estimator.residual_variance().into_iter().flatten() {
        prop_assert!(variance.is_finite() && variance >= 0.0, "residual variance {variance}");
    }
    for d in estimator.diagnostics() {
        let all = [d.z2, d.z0, d.zv, d.zu, d.residual, d.innovation];
        prop_assert!(all.iter().all(|x| x.is_finite()), "{d:?}");
    }
    Ok(())
}

fn endure(config: &DragConfig<2>, calls: &[Call]) -> Result<(), TestCaseError> {
    let mut estimator = DragEstimator::new(config).unwrap();
    for call in calls {
        match call {
            Call::Measure(y) => drop(estimator.measure(&y.map(|y| y.map(f32::from_bits)))),
            Call::Apply(f) => estimator.apply(&f.map(f32::from_bits)),
            Call::Ramp(from, to) => estimator.apply_ramp(&from.map(f32::from_bits), &to.map(f32::from_bits)),
            Call::Reset => estimator.reset(),
        }
        is_sound(&estimator)?;
    }
    Ok(())
}

fn config(period: f64, substeps: u32, tau: Option<f64>, nominal: Option<f64>, fast: bool) -> DragConfig<2> {
    let measured = period * f64::from(substeps);
    let rate = if fast { 1.0 } else { 0.05 } / measured;
    DragConfig {
        substeps,
        identifier: Tuning { lambda: 0.5 * rate, q: rate },
        observer: Tuning { lambda: rate, q: rate },
        identify: [Identify::BOTH, Identify { drag: true, disturbance: false }],
        memory: tau.map_or(Memory::Infinite, |rows| Memory::Fading { tau: rows * measured }),
        drift: [-9.81, 0.0],
        nominal,
        // Anything goes: the more is handed out, the more is checked.
        rule: ParameterRule { min: 1e-12, max: 1e12, max_relative_sd: 1e5 },
        excitation: 1e-9,
        drag_sd_limit: 1e9,
        disturbance_sd_limit: 1e9,
        disturbance_sd: tau.map(|_| if fast { 1e6 } else { 1e-12 }),
        position_limit: 1e6,
        input_limit: 1e6,
        ..DragConfig::new(period)
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    #[test]
    fn any_bits_in_any_order(
        calls in prop::collection::vec(call(), 1..200),
        period in prop::sample::select(vec![1e-6, 1e-3, 0.02, 10.0]),
        substeps in 1..4_u32,
        tau in prop::option::of(prop::sample::select(vec![50.0, 5000.0])),
        nominal in prop::option::of(0.1..10.0),
        fast in any::<bool>(),
    ) {
        endure(&config(period, substeps, tau, nominal, fast), &calls)?;
    }

    /// A flight with a burst of anything in it: whatever is handed out afterwards is a number.
    #[test]
    fn a_burst_in_flight(
        burst in prop::collection::vec(call(), 1..40),
        period in prop::sample::select(vec![1e-3, 0.02]),
    ) {
        let mut estimator = DragEstimator::new(&config(period, 1, None, Some(1.0), false)).unwrap();
        for n in 0..600_u32 {
            let t = f64::from(n) * period;
            let y = ((8.0 * t).sin() as f32, (5.0 * t).cos() as f32);
            let _ = estimator.measure(&[Some(y.0), Some(y.1)]);
            estimator.apply(&[9.81 - 64.0 * y.0, -25.0 * y.1]);
            if n == 300 {
                for call in &burst {
                    match call {
                        Call::Measure(y) => drop(estimator.measure(&y.map(|y| y.map(f32::from_bits)))),
                        Call::Apply(f) => estimator.apply(&f.map(f32::from_bits)),
                        Call::Ramp(from, to) => estimator.apply_ramp(&from.map(f32::from_bits), &to.map(f32::from_bits)),
                        Call::Reset => estimator.reset(),
                    }
                    is_sound(&estimator)?;
                }
            }
            is_sound(&estimator)?;
        }
    }
}

/// Every field of the configuration is checked, and named where it is wrong.
#[test]
fn configurations() {
    let good = DragConfig::<2>::new(0.01);
    assert!(DragEstimator::new(&good).is_ok());
    let wrong = [
        ("period", DragConfig { period: 0.0, ..good }),
        ("substeps", DragConfig { substeps: 0, ..good }),
        ("substeps", DragConfig { substeps: 70_000, ..good }),
        ("identifier.lambda", DragConfig { identifier: Tuning::from_lambda(200.0), ..good }),
        ("observer.q", DragConfig { observer: Tuning { lambda: 1.0, q: -1.0 }, ..good }),
        ("memory.tau", DragConfig { memory: Memory::Fading { tau: 0.01 }, ..good }),
        ("drift", DragConfig { drift: [0.0, f64::NAN], ..good }),
        ("nominal", DragConfig { nominal: Some(-1.0), ..good }),
        ("rule.min", DragConfig { rule: ParameterRule { min: 2.0, max: 1.0, max_relative_sd: 0.05 }, ..good }),
        ("excitation", DragConfig { excitation: 0.0, ..good }),
        ("drag_sd_limit", DragConfig { drag_sd_limit: f64::INFINITY, ..good }),
        ("drag_prior_sd", DragConfig { drag_prior_sd: f64::NAN, ..good }),
        ("drag_prior_sd", DragConfig { drag_prior_sd: -1e-9, ..good }),
        ("disturbance_prior_sd", DragConfig { disturbance_prior_sd: 1.1e6, ..good }),
        ("disturbance_sd_limit", DragConfig { disturbance_sd_limit: -0.1, ..good }),
        ("parameter_settle", DragConfig { parameter_settle: -1.0, ..good }),
        ("state_settle", DragConfig { state_settle: f64::NAN, ..good }),
        ("position_limit", DragConfig { position_limit: 1e7, ..good }),
        ("input_limit", DragConfig { input_limit: 0.0, ..good }),
    ];
    for (name, config) in wrong {
        assert_eq!(DragEstimator::new(&config).map(|_| ()).unwrap_err().parameter(), name);
    }
}
