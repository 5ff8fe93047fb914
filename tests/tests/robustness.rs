//! Any bits for measurements and inputs, in any order of calls: no panic, and everything handed out is a number.

use fsb_core::readout::{Memory, ParameterRule, Readout};
use fsb_core::{Estimator, EstimatorConfig, Tuning};
use proptest::prelude::*;

#[derive(Clone, Debug)]
enum Call {
    Measure([Option<u32>; 2]),
    Apply([u32; 2]),
    Ramp([u32; 2], [u32; 2]),
    Reset,
    ResetIdentifier,
}

fn bits() -> impl Strategy<Value = u32> {
    // Any pattern, and often a number that is accepted, small, at the limit or subnormal.
    prop_oneof![
        any::<u32>(),
        (-10.0..10.0_f32).prop_map(f32::to_bits),
        prop::sample::select(vec![1e5_f32, -1e5, 1e-40, -1e-40, 1e-20, 0.0, -0.0]).prop_map(f32::to_bits),
    ]
}

fn call() -> impl Strategy<Value = Call> {
    let pair = || [bits(), bits()];
    prop_oneof![
        20 => [prop::option::of(bits()), prop::option::of(bits())].prop_map(Call::Measure),
        20 => pair().prop_map(Call::Apply),
        8 => (pair(), pair()).prop_map(|(a, b)| Call::Ramp(a, b)),
        1 => Just(Call::Reset),
        1 => Just(Call::ResetIdentifier),
    ]
}

/// What is asked of everything that is handed out.
type Check<const P: usize> = fn(&Estimator<2, P>) -> Result<(), TestCaseError>;

/// Parameters and states: what a controller flies on.
fn estimates_are_finite<const P: usize>(estimator: &Estimator<2, P>) -> Result<(), TestCaseError> {
    for parameter in estimator.parameters().into_iter().flatten() {
        prop_assert!(parameter.value.is_finite() && parameter.value > 0.0, "{parameter:?}");
        prop_assert!(parameter.variance.is_finite(), "{parameter:?}");
    }
    for state in estimator.states().into_iter().flatten() {
        prop_assert!(state.position.is_finite() && state.velocity.is_finite(), "{state:?}");
    }
    Ok(())
}

/// Variances and standard deviations.
fn spreads_are_numbers<const P: usize>(estimator: &Estimator<2, P>) -> Result<(), TestCaseError> {
    for parameter in estimator.parameters().into_iter().flatten() {
        prop_assert!(parameter.variance >= 0.0 && parameter.sd().is_finite(), "{parameter:?}");
    }
    for sd in estimator.state_sd().into_iter().flatten() {
        prop_assert!(
            sd.position >= 0.0 && sd.position.is_finite() && sd.velocity >= 0.0 && sd.velocity.is_finite(),
            "{sd:?}"
        );
    }
    Ok(())
}

fn endure<const P: usize>(
    config: &EstimatorConfig<2, P>,
    calls: &[Call],
    check: Check<P>,
) -> Result<(), TestCaseError> {
    let mut estimator = Estimator::new(config).unwrap();
    for call in calls {
        match call {
            Call::Measure(y) => drop(estimator.measure(&y.map(|y| y.map(f32::from_bits)))),
            Call::Apply(f) => estimator.apply(&f.map(f32::from_bits)),
            Call::Ramp(from, to) => estimator.apply_ramp(&from.map(f32::from_bits), &to.map(f32::from_bits)),
            Call::Reset => estimator.reset(),
            Call::ResetIdentifier => estimator.reset_identifier(),
        }
        check(&estimator)?;
    }
    Ok(())
}

/// A configuration of the kind that flies.
#[derive(Clone, Copy, Debug)]
struct Setting {
    substeps: u32,
    block: u32,
    period: f64,
    readout: Readout,
    memory: Memory,
    nominal: Option<f64>,
}

fn setting() -> impl Strategy<Value = Setting> {
    let memory = prop::sample::select(vec![Memory::Infinite, Memory::Fading { tau: 0.5 }]);
    let period = prop::sample::select(vec![1e-4, 1e-3, 0.02]);
    (1..4_u32, 1..5_u32, period, readout(), memory, prop::option::of(0.1..10.0_f64)).prop_map(
        |(substeps, block, period, readout, memory, nominal)| Setting {
            substeps,
            block,
            period,
            readout,
            memory,
            nominal,
        },
    )
}

fn readout() -> impl Strategy<Value = Readout> {
    prop::sample::select(vec![Readout::LeastSquares, Readout::AbsoluteRatio])
}

fn config<const P: usize>(setting: &Setting) -> EstimatorConfig<2, P> {
    let Setting { substeps, block, period, readout, memory, nominal } = *setting;
    EstimatorConfig { substeps, block, readout, memory, nominal: [nominal; P], ..EstimatorConfig::new(period) }
}

/// Both kinds of estimator: pooled and hardly choosy; apart, the noise known, one axis with a drift.
fn endure_both(setting: &Setting, calls: &[Call], checks: (Check<1>, Check<2>)) -> Result<(), TestCaseError> {
    let mut pooled = config::<1>(setting);
    pooled.rule[0].max_relative_sd = 1e3;
    endure(&pooled, calls, checks.0)?;
    endure(&EstimatorConfig { noise_sd: Some(0.01), drift: [0.0, -9.81], ..config::<2>(setting) }, calls, checks.1)
}

/// The ends of the range that a configuration may have.
fn extreme() -> impl Strategy<Value = EstimatorConfig<2, 2>> {
    let nominal = prop::sample::select(vec![1e-15, 1.0, 1e15]);
    let rate = prop::sample::select(vec![1.000_001e-6, 1e-3, 1.0]);
    let period = prop::sample::select(vec![1e-6, 1e-3, 1.0, 1e3]);
    let share = prop::sample::select(vec![1e-6, 1.0, 1e6]);
    (period, rate, prop::option::of(nominal), share, readout()).prop_map(|(period, rate, nominal, share, readout)| {
        // A period of 1e-6 or 1e3 s times its rate must not be rounded out of the range.
        let tuning = Tuning { lambda: 0.999_999_9 * rate / period, q: (0.5 * rate).max(1.000_001e-6) / period };
        EstimatorConfig {
            identifier: tuning,
            observer: tuning,
            nominal: [nominal, None],
            drift: [1e6, -1e6],
            position_limit: 1e6,
            input_limit: 1e6,
            readout,
            rule: [ParameterRule { min: 1e-15, max: 1e15, max_relative_sd: share }; 2],
            ..EstimatorConfig::new(period)
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, rng_seed: proptest::test_runner::RngSeed::Fixed(44), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bits_in_any_order(calls in prop::collection::vec(call(), 1..400), setting in setting()) {
        endure_both(&setting, &calls, (estimates_are_finite, estimates_are_finite))?;
    }

    #[test]
    fn any_bits_at_the_ends_of_the_range(calls in prop::collection::vec(call(), 1..300), config in extreme()) {
        endure(&config, &calls, estimates_are_finite)?;
    }

    #[test]
    fn spreads_of_any_bits(calls in prop::collection::vec(call(), 1..400), setting in setting()) {
        endure_both(&setting, &calls, (spreads_are_numbers, spreads_are_numbers))?;
    }

    #[test]
    fn spreads_at_the_ends_of_the_range(calls in prop::collection::vec(call(), 1..300), config in extreme()) {
        endure(&config, &calls, |e| {
            for sd in e.state_sd().into_iter().flatten() {
                prop_assert!(sd.position.is_finite() && sd.velocity.is_finite(), "{sd:?}");
            }
            Ok(())
        })?;
    }
}
