//! The flight of `fly.c`, on `fsb_core` itself: prints the same lines. `cargo xtask c` compares them.

use fsb_core::control::{Reference, TrackingConfig, TrackingController};
use fsb_core::estimator::StateStatus;
use fsb_core::readout::{ParameterRule, ParameterStatus};
use fsb_core::{Estimator, EstimatorConfig, Tuning};

const TICKS: usize = 10_000;
const PERIOD: f64 = 0.001;
const NOMINAL: [f64; 6] = [1.0, 1.0, 1.0, 0.02, 0.02, 0.04];
const TRUTH: [f64; 6] = [1.6, 1.6, 1.6, 0.03, 0.035, 0.055];
const DRIFT: [f64; 6] = [0.0, 0.0, -9.81, 0.0, 0.0, 0.0];
const AMPLITUDE: [f64; 6] = [1.0, 0.8, 0.5, 0.2, 0.15, 0.3];
const NOISE: [f64; 6] = [0.005, 0.005, 0.005, 0.001, 0.001, 0.001];
const TURN_C: [f64; 2] = [0.9999988750002109, 0.999995500003375];
const TURN_S: [f64; 2] = [0.0014999994375000632, 0.002999995500002025];
const RATE: [f64; 2] = [1.5, 3.0];

/// What C gives for a value that is not handed out.
const MISSING: u32 = 0x7fc0_0000;

struct Digest(u64);

impl Digest {
    fn add(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x100_0000_01b3);
    }
}

/// Uniform in -1..1.
fn uniform(state: &mut u32) -> f64 {
    *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    f64::from(*state as i32) / 2_147_483_648.0
}

/// The codes of fsb.h.
fn state_code(status: StateStatus) -> u32 {
    match status {
        StateStatus::NotMeasured => 1,
        StateStatus::Settling => 2,
        StateStatus::NoParameter => 3,
        StateStatus::Nominal => 8,
        StateStatus::Identified => 9,
        _ => 0,
    }
}

fn parameter_code(status: ParameterStatus) -> u32 {
    match status {
        ParameterStatus::Settling => 1,
        ParameterStatus::Unexcited => 2,
        ParameterStatus::Uncertain => 3,
        ParameterStatus::BelowRange => 4,
        ParameterStatus::AboveRange => 5,
        ParameterStatus::Contradicted => 6,
        ParameterStatus::Valid => 8,
        _ => 0,
    }
}

fn three<T: Copy>(six: &[T; 6], from: usize) -> [T; 3] {
    [six[from], six[from + 1], six[from + 2]]
}

fn some(values: [f32; 3]) -> [Option<f32>; 3] {
    values.map(|y| (!y.is_nan()).then_some(y))
}

fn estimators() -> (Estimator<3, 1>, Estimator<3, 3>) {
    let rule = ParameterRule { max_relative_sd: 0.02, ..ParameterRule::default() };
    let mut slow = EstimatorConfig::<3, 1>::new(PERIOD);
    (slow.substeps, slow.block) = (4, 5);
    slow.drift = three(&DRIFT, 0);
    slow.nominal = [Some(1.0 / NOMINAL[0])];
    slow.rule = [rule];
    let mut fast = EstimatorConfig::<3, 3>::new(PERIOD);
    fast.block = 10;
    fast.observer = Tuning::from_lambda(40.0);
    fast.nominal = three(&NOMINAL, 3).map(|i| Some(1.0 / i));
    fast.rule = [rule; 3];
    (Estimator::new(&slow).expect("valid"), Estimator::new(&fast).expect("valid"))
}

fn main() {
    let (mut translation, mut rotation) = estimators();
    let controllers: [TrackingController; 6] = std::array::from_fn(|i| {
        let (kp, kd) = if i < 3 { (4.0, 4.0) } else { (25.0, 10.0) };
        TrackingController::new(&TrackingConfig { kp, kd, drift: DRIFT[i], parameter_min: 1e-6, parameter_max: 1e9 })
            .expect("valid")
    });
    let (mut y, mut v) = ([0.0f64; 6], [0.0f64; 6]);
    let (mut c, mut s) = ([1.0f64; 2], [0.0f64; 2]);
    let mut input = [0.0, 0.0, 9.81f64 as f32, 0.0, 0.0, 0.0];
    let mut worst = 0.0f64;
    let mut seed = 12345;
    let mut hash = Digest(0xcbf2_9ce4_8422_2325);

    for tick in 0..TICKS {
        let mut measured = [0.0f32; 6];
        for i in 0..6 {
            measured[i] = (y[i] + NOISE[i] * uniform(&mut seed)) as f32;
        }
        match tick {
            2000 => measured[1] = f32::NAN,
            3000 => measured[2] = 1e9,
            _ => {}
        }
        if tick % 4 == 0 {
            translation.measure(&some(three(&measured, 0))).expect("in step");
        }
        rotation.measure(&some(three(&measured, 3))).expect("in step");
        let (moved, turned) = (translation.states(), rotation.states());
        let states = [moved[0], moved[1], moved[2], turned[0], turned[1], turned[2]];
        let (a, b) = (translation.state_status(), rotation.state_status());
        let codes = [a[0], a[1], a[2], b[0], b[1], b[2]].map(state_code);
        let (pooled, each) = (translation.parameters(), rotation.parameters());
        let parameters = [pooled[0], each[0], each[1], each[2]];
        let (a, b) = (translation.parameter_status(), rotation.parameter_status());
        let parameter_codes = [a[0], b[0], b[1], b[2]].map(parameter_code);

        for i in 0..6 {
            let k = parameters[if i < 3 { 0 } else { i - 2 }].map_or((1.0 / NOMINAL[i]) as f32, |found| found.value);
            let p = i % 2;
            let reference = Reference {
                position: (AMPLITUDE[i] * s[p]) as f32,
                velocity: (AMPLITUDE[i] * RATE[p] * c[p]) as f32,
                acceleration: (-AMPLITUDE[i] * RATE[p] * RATE[p] * s[p]) as f32,
            };
            if let Some(wanted) = states[i].and_then(|state| controllers[i].input(&reference, &state, k).ok()) {
                input[i] = wanted;
            }
            let error = (y[i] - f64::from(reference.position)).abs() / AMPLITUDE[i];
            if tick > 7000 && error > worst {
                worst = error;
            }
        }
        let mut given = input;
        if tick == 4000 {
            given[4] = f32::INFINITY;
        }
        translation.apply(&three(&given, 0));
        rotation.apply(&three(&given, 3));

        let shown: [[u32; 3]; 6] = std::array::from_fn(|i| {
            let [position, velocity] =
                states[i].map_or([MISSING; 2], |state| [state.position.to_bits(), state.velocity.to_bits()]);
            [position, velocity, input[i].to_bits()]
        });
        for (&[position, velocity, force], code) in shown.iter().zip(codes) {
            hash.add(position.wrapping_add(code));
            hash.add(velocity);
            hash.add(force);
        }
        let k = parameters.map(|found| found.map_or([MISSING; 2], |p| [p.value.to_bits(), p.variance.to_bits()]));
        for ([value, variance], code) in k.into_iter().zip(parameter_codes) {
            hash.add(value.wrapping_add(code));
            hash.add(variance);
        }
        if tick % 1000 == 999 {
            print!("{tick:5}");
            for [position, velocity, force] in shown {
                print!(" {position:08x} {velocity:08x} {force:08x}");
            }
            for ([value, _], code) in k.into_iter().zip(parameter_codes) {
                print!(" {value:08x} {code}");
            }
            println!(" {:016x}", hash.0);
        }

        for i in 0..6 {
            let a = f64::from(input[i]) / TRUTH[i] + DRIFT[i];
            y[i] += PERIOD * v[i] + 0.5 * PERIOD * PERIOD * a;
            v[i] += PERIOD * a;
        }
        for p in 0..2 {
            let next = c[p] * TURN_C[p] - s[p] * TURN_S[p];
            s[p] = s[p] * TURN_C[p] + c[p] * TURN_S[p];
            c[p] = next;
        }
    }

    let (pooled, each) = (translation.parameters(), rotation.parameters());
    for (i, found) in [pooled[0], each[0], each[1], each[2]].into_iter().enumerate() {
        let (inverse, sd) = found.expect("valid after ten seconds").inverse_with_sd();
        let name = if i == 0 { "mass in g" } else { "inertia in g m^2" };
        let truth = TRUTH[if i == 0 { 0 } else { 2 + i }];
        println!("{name} {:.3} sd {:.3}, true {:.3}", 1e3 * f64::from(inverse), 1e3 * f64::from(sd), 1e3 * truth);
    }
    let (a, b) = (translation.counters(), rotation.counters());
    println!(
        "missed {}, rejected {} and {}; worst error after 7 s: {worst:.4} of the amplitude",
        a.missed, a.rejected_measurements, b.rejected_inputs
    );
}
