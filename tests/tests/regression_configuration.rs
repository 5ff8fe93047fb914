//! What a `DragConfig` may hold: every value at the ends of its range, and next to them by name; and its defaults.

use fsb_core::ConfigError::{
    self, InvertedRange, Negative, NonFinite, NonPositive, OutOfRange, TooFastForPeriod, TooSlowForPeriod, Zero,
};
use fsb_core::Tuning;
use fsb_core::readout::{Memory, ParameterRule};
use fsb_core::regression::{DragConfig, DragEstimator, Identify};

type Config = DragConfig<2>;
type Set = fn(&mut Config, f64);
/// How a value is set, what is refused and how, what is taken.
type Case<'a> = (Set, Vec<(f64, ConfigError)>, &'a [f64]);

fn outcome(change: impl Fn(&mut Config)) -> Option<ConfigError> {
    let mut config = Config::new(1e-3);
    change(&mut config);
    DragEstimator::new(&config).err()
}

#[test]
fn every_number() {
    let positive = |name| vec![(f64::NAN, NonFinite(name)), (0.0, NonPositive(name)), (-1.0, NonPositive(name))];
    let and = |name, more: &[(f64, ConfigError)]| [positive(name).as_slice(), more].concat();
    let rate = |name| and(name, &[(1001.0, TooFastForPeriod(name)), (0.9e-3, TooSlowForPeriod(name))]);
    let limit = |name| and(name, &[(1.1e6, OutOfRange(name))]);
    let settle = |name| vec![(f64::NAN, NonFinite(name)), (-1e-9, Negative(name)), (1.1e6, OutOfRange(name))];
    let cases: [Case<'_>; 17] = [
        (|c, x| c.identifier.lambda = x, rate("identifier.lambda"), &[1000.0, 1e-3]),
        (|c, x| c.identifier.q = x, rate("identifier.q"), &[1000.0, 1e-3]),
        (|c, x| c.observer.lambda = x, rate("observer.lambda"), &[1000.0, 1e-3]),
        (|c, x| c.observer.q = x, rate("observer.q"), &[1000.0, 1e-3]),
        (|c, x| c.drift[1] = x, vec![(f64::NAN, NonFinite("drift")), (-1.1e6, OutOfRange("drift"))], &[-1e6, 0.0, 1e6]),
        (
            |c, x| c.nominal = Some(x),
            and("nominal", &[(0.9e-15, OutOfRange("nominal")), (1.1e15, OutOfRange("nominal"))]),
            &[1e-15, 1e15],
        ),
        (|c, x| c.excitation = x, positive("excitation"), &[1e-9, 1e9]),
        (|c, x| c.drag_sd_limit = x, positive("drag_sd_limit"), &[1e-9, 1e9]),
        (|c, x| c.disturbance_sd_limit = x, positive("disturbance_sd_limit"), &[1e-9, 1e9]),
        (|c, x| c.drag_prior_sd = x, settle("drag_prior_sd"), &[0.0, 1e6]),
        (|c, x| c.disturbance_prior_sd = x, settle("disturbance_prior_sd"), &[0.0, 1e6]),
        (
            |c, x| c.disturbance_sd = Some(x),
            and("disturbance_sd", &[(0.9e-12, OutOfRange("disturbance_sd")), (1.1e6, OutOfRange("disturbance_sd"))]),
            &[1e-12, 1e6],
        ),
        (|c, x| c.parameter_settle = x, settle("parameter_settle"), &[0.0, 1e6]),
        (|c, x| c.state_settle = x, settle("state_settle"), &[0.0, 1e6]),
        (|c, x| c.position_limit = x, limit("position_limit"), &[1e-9, 1e6]),
        (|c, x| c.input_limit = x, limit("input_limit"), &[1e-9, 1e6]),
        // A row of the regression is 0.05 s here.
        (
            |c, x| c.memory = Memory::Fading { tau: x },
            and("memory.tau", &[(0.049, OutOfRange("memory.tau"))]),
            &[0.0501, 1e9],
        ),
    ];
    for (set, wrong, right) in cases {
        for (value, expected) in wrong {
            assert_eq!(outcome(|c| set(c, value)), Some(expected), "{value}");
        }
        for &value in right {
            assert_eq!(outcome(|c| set(c, value)), None, "{value}");
        }
    }
}

#[test]
fn periods_counts_and_rules() {
    assert_eq!(outcome(|c| c.period = 0.0), Some(NonPositive("period")));
    assert_eq!(outcome(|c| c.period = 0.9e-6), Some(OutOfRange("period")));
    assert_eq!(outcome(|c| c.substeps = 0), Some(Zero("substeps")));
    assert_eq!(outcome(|c| c.substeps = 65_536), Some(OutOfRange("substeps")));
    assert_eq!(outcome(|c| (c.period, c.substeps) = (1.0, 1001)), Some(OutOfRange("substeps")));
    assert_eq!(outcome(|c| c.rule.min = c.rule.max), Some(InvertedRange("rule.min")));
    assert_eq!(outcome(|c| c.rule.max_relative_sd = 0.0), Some(NonPositive("rule.max_relative_sd")));
}

#[test]
fn defaults() {
    let expected = Config {
        period: 1e-3,
        substeps: 1,
        identifier: Tuning { lambda: 2.0, q: 1.0 },
        observer: Tuning { lambda: 10.0, q: 5.0 },
        identify: [Identify { drag: true, disturbance: true }; 2],
        memory: Memory::Infinite,
        drift: [0.0; 2],
        nominal: None,
        rule: ParameterRule::DEFAULT,
        excitation: 0.03,
        drag_sd_limit: 0.25,
        disturbance_sd_limit: 0.2,
        drag_prior_sd: 0.25,
        disturbance_prior_sd: 0.2,
        disturbance_sd: None,
        parameter_settle: 0.0,
        state_settle: 0.0,
        position_limit: 1e5,
        input_limit: 1e5,
    };
    assert_eq!(Config::new(1e-3), expected);
}
