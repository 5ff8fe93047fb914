//! Beginning anew without losing what is known: a parameter that was valid stands in until the new one is.

use fsb_core::estimator::StateStatus;
use fsb_core::guard::{GuardConfig, Guarded};
use fsb_core::readout::{Parameter, ParameterStatus};
use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::HeldInputAxis;

const PERIOD: f64 = 0.01;

fn config() -> EstimatorConfig<1, 1> {
    // Tells a held parameter from the nominal one.
    EstimatorConfig { drift: [-9.81], nominal: [Some(0.3)], noise_sd: Some(1e-6), ..EstimatorConfig::new(PERIOD) }
}

/// An axis that swings about 1 m, exactly.
struct Craft {
    axis: HeldInputAxis,
    tick: u32,
}

impl Craft {
    fn new() -> Self {
        Self { axis: HeldInputAxis { position: 1.0, velocity: 0.0, k: 0.8, drift: -9.81 }, tick: 0 }
    }

    fn next(&mut self) -> (f32, f32) {
        let HeldInputAxis { position, velocity, .. } = self.axis;
        let to = 1.0 + (f64::from(self.tick) * 0.02).sin();
        let force = ((9.81 - 5.0 * velocity - 6.0 * (position - to)) / 0.8) as f32;
        self.axis.step(f64::from(force), PERIOD);
        self.tick += 1;
        (position as f32, force)
    }

    fn fly(&mut self, estimator: &mut Estimator<1, 1>, ticks: u32) {
        for _ in 0..ticks {
            let (y, force) = self.next();
            estimator.measure(&[Some(y)]).unwrap();
            estimator.apply(&[force]);
        }
    }
}

fn k(estimator: &Estimator<1, 1>) -> Option<f64> {
    estimator.parameters()[0].map(|k| f64::from(k.value))
}

/// The load changes and the estimator is told to begin anew, in one of three ways: hold, restart, or forget.
#[test]
fn a_parameter_stands_in() {
    type Way = fn(&mut Estimator<1, 1>);
    let ways: [(Way, bool, bool); 3] = [
        (Estimator::reinitialise_identifier, true, true),
        (Estimator::restart, true, false),
        (Estimator::reset_identifier, false, true),
    ];
    for (begin_anew, held, state_goes_on) in ways {
        let (mut craft, mut estimator) = (Craft::new(), Estimator::new(&config()).unwrap());
        craft.fly(&mut estimator, 500);
        let before = k(&estimator).expect("valid");
        assert!((before / 0.8 - 1.0).abs() < 1e-5);
        begin_anew(&mut estimator);
        craft.axis.k = 1.0;
        assert_eq!(k(&estimator), held.then_some(before));
        assert_eq!(estimator.states()[0].is_some(), state_goes_on);
        let mut stood_in = 0;
        for _ in 0..500 {
            craft.fly(&mut estimator, 1);
            match estimator.parameter_status()[0] {
                ParameterStatus::Held => {
                    assert!(held && k(&estimator) == Some(before));
                    // The first instants after a restart have no state.
                    let state = estimator.state_status()[0];
                    assert!(state == StateStatus::Held || stood_in < 2, "{state:?}");
                    stood_in += 1;
                }
                ParameterStatus::Valid => assert!(k(&estimator).is_some_and(|k| (k - 1.0).abs() < 0.05)),
                status => assert!(!held && k(&estimator).is_none(), "{status:?}"),
            }
        }
        assert_eq!(stood_in > 0, held);
        assert!(k(&estimator).is_some_and(|k| (k - 1.0).abs() < 1e-4), "{:?}", k(&estimator));
    }
}

/// Where nothing was valid nothing is held.
#[test]
fn nothing_is_held_where_nothing_was_known() {
    let mut estimator = Estimator::new(&config()).unwrap();
    Craft::new().fly(&mut estimator, 2);
    assert_eq!(k(&estimator), None);
    for begin_anew in [Estimator::restart, Estimator::reinitialise_identifier] {
        begin_anew(&mut estimator);
        assert_eq!(k(&estimator), None);
        assert_ne!(estimator.parameter_status()[0], ParameterStatus::Held);
    }
}

/// A gap too long to be bridged: k is held over it, the state is not.
#[test]
fn a_long_gap_keeps_the_parameter() {
    let mut craft = Craft::new();
    let mut guarded = Guarded::<1, 1>::new(&config(), &GuardConfig::default()).unwrap();
    for n in 0..1200 {
        let (y, force) = craft.next();
        let silent = (500..800).contains(&n);
        guarded.measure(&[(!silent).then_some(y)]).unwrap();
        if n >= 500 {
            assert!(k(&guarded).is_some_and(|k| (k / 0.8 - 1.0).abs() < 1e-3), "{n}");
        }
        if (710..800).contains(&n) {
            assert_eq!((guarded.states()[0], guarded.state_status()[0]), (None, StateStatus::Stale), "{n}");
            assert_eq!(guarded.parameter_status()[0], ParameterStatus::Held, "{n}");
        }
        guarded.apply(&[force]);
    }
    assert_eq!(guarded.parameter_status()[0], ParameterStatus::Valid);
}

/// m = 1/k with sd(k)/k².
#[test]
fn the_inverse_of_a_parameter() {
    let (inverse, sd) = Parameter { value: 0.8, variance: 0.0016 }.inverse_with_sd();
    assert!((inverse - 1.25).abs() < 1e-6 && (sd - 0.0625).abs() < 1e-6, "{inverse}, {sd}");
}
