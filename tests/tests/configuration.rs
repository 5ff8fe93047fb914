//! Every value that cannot be right is refused, by the name of its parameter; every value at the edge of its range is taken.

use fsb_core::ConfigError::{
    self, InvertedRange, Negative, NonFinite, NonPositive, OutOfRange, TooFastForPeriod, TooSlowForPeriod, Zero,
};
use fsb_core::control::{TrackingConfig, TrackingController};
use fsb_core::readout::Memory;
use fsb_core::{Estimator, EstimatorConfig, EstimatorDesign, Tuning};

type Config = EstimatorConfig<2, 2>;
type Set = fn(&mut Config, f64);
type Case<'a> = (&'static str, Set, &'a [(f64, ConfigError)]);

fn base() -> Config {
    EstimatorConfig { block: 4, ..EstimatorConfig::new(1e-3) }
}

/// What a positive number must not be.
fn positive(name: &'static str) -> Vec<(f64, ConfigError)> {
    vec![
        (f64::NAN, NonFinite(name)),
        (f64::INFINITY, NonFinite(name)),
        (f64::NEG_INFINITY, NonFinite(name)),
        (0.0, NonPositive(name)),
        (-0.0, NonPositive(name)),
        (-1.0, NonPositive(name)),
    ]
}

/// The refusals of `positive`, and these.
fn positive_and(name: &'static str, more: &[(f64, ConfigError)]) -> Vec<(f64, ConfigError)> {
    [positive(name).as_slice(), more].concat()
}

fn refused(cases: &[Case<'_>]) {
    for (field, set, values) in cases {
        for &(value, expected) in *values {
            let mut config = base();
            set(&mut config, value);
            assert_eq!(EstimatorDesign::new(&config).err(), Some(expected), "{field} = {value}");
            assert_eq!(Estimator::new(&config).err(), Some(expected), "{field} = {value}");
            assert!(format!("{expected}").starts_with(expected.parameter()), "{expected}");
        }
    }
}

fn accepted(cases: &[(&str, Set, &[f64])]) {
    for (field, set, values) in cases {
        for &value in *values {
            let mut config = base();
            set(&mut config, value);
            assert_eq!(EstimatorDesign::new(&config).err(), None, "{field} = {value}");
        }
    }
}

#[test]
fn rates_and_periods() {
    let fast = |name| [(1e6, TooFastForPeriod(name)), (f64::MAX, TooFastForPeriod(name))];
    let slow = |name| [(1e-5, TooSlowForPeriod(name)), (f64::MIN_POSITIVE, TooSlowForPeriod(name))];
    let rate = |name| positive_and(name, &[fast(name), slow(name)].concat());
    refused(&[
        (
            "period",
            |c, x| c.period = x,
            &positive_and("period", &[(0.9e-6, OutOfRange("period")), (1.1e3, OutOfRange("period"))]),
        ),
        ("identifier.lambda", |c, x| c.identifier.lambda = x, &rate("identifier.lambda")),
        ("identifier.q", |c, x| c.identifier.q = x, &rate("identifier.q")),
        ("observer.lambda", |c, x| c.observer.lambda = x, &rate("observer.lambda")),
        ("observer.q", |c, x| c.observer.q = x, &rate("observer.q")),
        (
            "memory.tau",
            |c, x| c.memory = Memory::Fading { tau: x },
            &positive_and("memory.tau", &[(3.9e-3, OutOfRange("memory.tau"))]),
        ),
    ]);
    accepted(&[
        ("period", |c, x| (c.period, c.identifier.lambda, c.identifier.q) = (x, 0.1 / x, 0.1 / x), &[1e-4]),
        (
            "period, no blocks",
            |c, x| {
                (c.period, c.block, c.identifier, c.observer) =
                    (x, 1, Tuning::from_lambda(0.1 / x), Tuning::from_lambda(0.1 / x))
            },
            &[1e-6, 1e3],
        ),
        // By the period they run at: M T = 4 ms for the identifier, T = 1 ms for the observer.
        ("identifier.lambda", |c, x| c.identifier.lambda = x, &[2.6e-4, 249.0]),
        ("observer.lambda", |c, x| c.observer.lambda = x, &[1.1e-3, 999.0]),
        ("memory.tau", |c, x| c.memory = Memory::Fading { tau: x }, &[4e-3, 1e9]),
    ]);
}

/// The identifier's rates are judged by the block, the observer's by the measurement period.
#[test]
fn a_rate_is_judged_by_the_period_it_runs_at() {
    let with = |substeps, block, identifier, observer| {
        let mut config = EstimatorConfig::<1, 1> { substeps, block, ..EstimatorConfig::new(1e-3) };
        config.identifier.lambda = identifier;
        config.observer.lambda = observer;
        EstimatorDesign::new(&config).err()
    };
    assert_eq!(with(1, 1, 900.0, 900.0), None);
    assert_eq!(with(1, 10, 101.0, 900.0), Some(TooFastForPeriod("identifier.lambda")));
    assert_eq!(with(10, 1, 99.0, 101.0), Some(TooFastForPeriod("observer.lambda")));
    assert_eq!(with(10, 10, 9.9, 99.0), None);
}

#[test]
fn counts() {
    let check = |change: fn(&mut Config), expected| {
        let mut config = base();
        change(&mut config);
        assert_eq!(EstimatorDesign::new(&config).err(), expected, "{config:?}");
    };
    check(|c| c.substeps = 0, Some(Zero("substeps")));
    check(|c| c.substeps = 65_536, Some(OutOfRange("substeps")));
    check(|c| c.substeps = u32::MAX, Some(OutOfRange("substeps")));
    check(|c| c.block = 0, Some(Zero("block")));
    check(|c| c.block = 65_536, Some(OutOfRange("block")));
    check(|c| (c.block, c.turn) = (12, 12), Some(OutOfRange("turn")));
    // A round is a block, or eight measurements.
    check(|c| c.turn = 8, Some(OutOfRange("turn")));
    check(|c| c.turn = 7, None);
    check(|c| (c.period, c.substeps, c.block) = (1e-6, 65_535, 1), None);
    check(|c| c.turn = u32::MAX, Some(OutOfRange("turn")));
    // The products are periods, too.
    check(|c| (c.period, c.substeps) = (1.0, 1001), Some(OutOfRange("substeps")));
    check(|c| (c.period, c.substeps, c.block) = (1.0, 100, 11), Some(OutOfRange("block")));
}

#[test]
fn known_values_and_limits() {
    let limit = |name| positive_and(name, &[(1.1e6, OutOfRange(name)), (f64::MAX, OutOfRange(name))]);
    let settle = |name| {
        vec![
            (f64::NAN, NonFinite(name)),
            (f64::INFINITY, NonFinite(name)),
            (-1e-9, Negative(name)),
            (1.1e6, OutOfRange(name)),
            (f64::MAX, OutOfRange(name)),
        ]
    };
    let drift = [
        (f64::NAN, NonFinite("drift")),
        (f64::NEG_INFINITY, NonFinite("drift")),
        (1.1e6, OutOfRange("drift")),
        (-1.1e6, OutOfRange("drift")),
    ];
    let nominal = positive_and("nominal", &[(1e-16, OutOfRange("nominal")), (1.1e15, OutOfRange("nominal"))]);
    refused(&[
        ("drift", |c, x| c.drift[0] = x, &drift),
        ("drift", |c, x| c.drift[1] = x, &drift),
        ("nominal", |c, x| c.nominal[0] = Some(x), &nominal),
        ("nominal", |c, x| c.nominal[1] = Some(x), &nominal),
        (
            "noise_sd",
            |c, x| c.noise_sd = Some(x),
            &positive_and("noise_sd", &[(1e-13, OutOfRange("noise_sd")), (1.1e6, OutOfRange("noise_sd"))]),
        ),
        (
            "disturbance_sd",
            |c, x| c.disturbance_sd = Some(x),
            &positive_and(
                "disturbance_sd",
                &[(1e-13, OutOfRange("disturbance_sd")), (1.1e6, OutOfRange("disturbance_sd"))],
            ),
        ),
        (
            "max_misfit",
            |c, x| c.max_misfit = Some(x),
            &positive_and("max_misfit", &[(1.0 + 1e-6, OutOfRange("max_misfit"))]),
        ),
        ("parameter_settle", |c, x| c.parameter_settle = x, &settle("parameter_settle")),
        ("state_settle", |c, x| c.state_settle = x, &settle("state_settle")),
        ("position_limit", |c, x| c.position_limit = x, &limit("position_limit")),
        ("input_limit", |c, x| c.input_limit = x, &limit("input_limit")),
    ]);
    accepted(&[
        ("drift", |c, x| c.drift[1] = x, &[0.0, -9.81, 1e6, -1e6]),
        ("nominal", |c, x| c.nominal[1] = Some(x), &[1e-15, 1e15]),
        ("noise_sd", |c, x| c.noise_sd = Some(x), &[1e-12, 1e6]),
        ("disturbance_sd", |c, x| c.disturbance_sd = Some(x), &[1e-12, 1e6]),
        ("max_misfit", |c, x| c.max_misfit = Some(x), &[1e-9, 1.0]),
        ("parameter_settle", |c, x| c.parameter_settle = x, &[0.0, 1e-9, 1e6]),
        ("position_limit", |c, x| c.position_limit = x, &[1e-9, 1e6]),
    ]);
}

/// The range in which a parameter counts: by name, for every parameter.
#[test]
fn rules() {
    for index in [0, 1] {
        for (min, max, share, expected) in [
            (f64::NAN, 1.0, 0.1, Some(NonFinite("rule.min"))),
            (0.0, 1.0, 0.1, Some(NonPositive("rule.min"))),
            (-1.0, 1.0, 0.1, Some(NonPositive("rule.min"))),
            (0.1, f64::NAN, 0.1, Some(NonFinite("rule.max"))),
            (0.1, f64::INFINITY, 0.1, Some(NonFinite("rule.max"))),
            (1.0, 1.0, 0.1, Some(InvertedRange("rule.min"))),
            (1.0, 0.9, 0.1, Some(InvertedRange("rule.min"))),
            (1.0, -2.0, 0.1, Some(InvertedRange("rule.min"))),
            (0.1, 1.0, f64::NAN, Some(NonFinite("rule.max_relative_sd"))),
            (0.1, 1.0, 0.0, Some(NonPositive("rule.max_relative_sd"))),
            (0.1, 1.0, -0.1, Some(NonPositive("rule.max_relative_sd"))),
            (0.1, 1.0, 1.1e6, Some(OutOfRange("rule.max_relative_sd"))),
            (1e-15, 1e15, 1e6, None),
        ] {
            let mut config = base();
            config.rule[index].min = min;
            config.rule[index].max = max;
            config.rule[index].max_relative_sd = share;
            assert_eq!(EstimatorDesign::new(&config).err(), expected, "{min}, {max}, {share}");
        }
        for (min, max) in [(1e-16, 1.0), (1.0, 1e16), (1e300, f64::MAX)] {
            let mut config = base();
            (config.rule[index].min, config.rule[index].max) = (min, max);
            let error = EstimatorDesign::new(&config).err();
            assert!(matches!(error, Some(OutOfRange(name)) if name.starts_with("rule.m")), "{error:?}");
        }
    }
}

const TRACKING: TrackingConfig =
    TrackingConfig { kp: 6.0, kd: 5.0, drift: -9.81, parameter_min: 0.1, parameter_max: 10.0 };

#[test]
fn tracking_controller() {
    type Case = (&'static str, fn(&mut TrackingConfig, f64), Vec<(f64, ConfigError)>);
    let cases: [Case; 5] = [
        ("kp", |c, x| c.kp = x, positive("kp")),
        ("kd", |c, x| c.kd = x, positive("kd")),
        ("drift", |c, x| c.drift = x, vec![(f64::NAN, NonFinite("drift")), (f64::INFINITY, NonFinite("drift"))]),
        (
            "parameter_min",
            |c, x| c.parameter_min = x,
            positive_and(
                "parameter_min",
                &[(11.0, InvertedRange("parameter_min")), (1e-16, OutOfRange("parameter_min"))],
            ),
        ),
        (
            "parameter_max",
            |c, x| c.parameter_max = x,
            vec![
                (f64::NAN, NonFinite("parameter_max")),
                (f64::INFINITY, NonFinite("parameter_max")),
                (0.0, InvertedRange("parameter_min")),
                (-1.0, InvertedRange("parameter_min")),
                (1.1e15, OutOfRange("parameter_max")),
            ],
        ),
    ];
    assert!(TrackingController::new(&TRACKING).is_ok());
    for (field, set, values) in cases {
        for (value, expected) in values {
            let mut config = TRACKING;
            set(&mut config, value);
            assert_eq!(TrackingController::new(&config).err(), Some(expected), "{field} = {value}");
        }
    }
}

/// A gain or a drift that is no number in f32, or no gain any more, cannot be right either.
#[test]
fn tracking_gains_have_a_range() {
    for value in [1e39, f64::MAX, 1e-60] {
        assert!(TrackingController::new(&TrackingConfig { kp: value, ..TRACKING }).is_err(), "kp = {value}");
        assert!(TrackingController::new(&TrackingConfig { kd: value, ..TRACKING }).is_err(), "kd = {value}");
    }
    assert!(TrackingController::new(&TrackingConfig { drift: -1e39, ..TRACKING }).is_err());
}

/// "The name of the parameter, as it is written in the configuration": the field is called `rule`.
#[test]
fn rule_is_named_as_it_is_written() {
    let mut config = base();
    config.rule[1].min = f64::NAN;
    assert_eq!(EstimatorDesign::new(&config).err(), Some(NonFinite("rule.min")));
    config.rule[1].min = 1e-16;
    assert_eq!(EstimatorDesign::new(&config).err(), Some(OutOfRange("rule.min")));
}
