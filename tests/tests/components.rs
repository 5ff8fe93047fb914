//! The parts of the core by themselves, put together by hand: an observer for a known k, and an identifier.

use fsb_core::Tuning;
use fsb_core::identifier::{Cascade, Coefficients, IdentifierDesign, UnitChain};
use fsb_core::moments::InputMoments;
use fsb_core::observer::{Gains, Model, NoiseGain, Observer, ObserverDesign};
use fsb_core::readout::{Ratio, Readout};
use fsb_core::window::Window;
use fsb_sim_host::plant::{RecordingConfig, record};

const PERIOD: f64 = 1e-3;

/// Dead-beat at the second sample whatever came before, then exact to rounding.
#[test]
fn an_observer_by_hand() {
    let plant = RecordingConfig { samples: 5000, ..Default::default() };
    let recorded = record(&plant);
    let design = ObserverDesign::new(Tuning::from_lambda(10.0), PERIOD).unwrap();
    let model = Model::new(plant.k as f32, plant.drift as f32, &design);
    let (mut observer, mut window, mut gains) = (Observer::default(), Window::START, Gains::FIRST);
    observer.start(recorded.positions[0] as f32);
    let mut worst = 0.0_f64;
    for n in 1..recorded.positions.len() {
        design.step(&mut window);
        let now = Gains::at(&window, &design);
        let f = recorded.forces[n - 1] as f32;
        let moments = InputMoments { j1: f, j2: 0.5 * f };
        observer.correct(recorded.positions[n] as f32, moments, &model, gains.m1(), now.t_l2());
        gains = now;
        if n % 16 == 0 {
            observer.fold();
        }
        if n == 1 {
            // A line through two samples, and the input's bend: good to the rounding of 3 m over T.
            assert!((f64::from(observer.velocity(&design)) - recorded.velocities[1]).abs() < 5e-4);
        }
        if n >= 100 {
            worst = worst.max((f64::from(observer.velocity(&design)) - recorded.velocities[n]).abs());
            assert!((f64::from(observer.position(0.0, &gains)) - recorded.positions[n]).abs() < 5e-7);
        }
    }
    println!("velocity off by {worst:.1e} m/s at most from 0.1 s on");
    assert!(worst <= 2e-6);
}

/// The covariance recursion, step by step, is what `at_sample` gives, and ends in the closed form.
#[test]
fn a_noise_gain_by_hand() {
    let tuning = Tuning::from_lambda(20.0);
    let design = ObserverDesign::new(tuning, PERIOD).unwrap();
    let (mut window, mut gain) = (Window::START, NoiseGain::FIRST);
    for n in 1..=2000_u32 {
        design.step(&mut window);
        gain.correct(&Gains::at(&window, &design));
        if [1, 2, 5, 20, 96, 200, 1000, 2000].contains(&n) {
            let quick = NoiseGain::at_sample(n, tuning, PERIOD);
            for (exact, quick) in [
                (gain.position(), quick.position()),
                (gain.velocity(&design), quick.velocity(&design)),
                (gain.position_after(20), quick.position_after(20)),
            ] {
                assert!((quick / exact - 1.0).abs() < if n <= 96 { 1e-4 } else { 0.03 }, "n {n}: {quick} for {exact}");
            }
        }
    }
    let p = (-20.0 * PERIOD).exp();
    let position = (1.0 - p) * (1.0 + 4.0 * p + 5.0 * p * p) / (1.0 + p).powi(3);
    let velocity = 2.0 * (1.0 - p).powi(3) / (1.0 + p).powi(3) / (PERIOD * PERIOD);
    assert!((f64::from(gain.position()) / position - 1.0).abs() < 1e-3);
    assert!((f64::from(gain.velocity(&design)) / velocity - 1.0).abs() < 1e-3);
}

/// The same for any tuning that is admitted: to 4 % of a variance, where the window opens before the filter forgets to 8 %.
#[test]
fn noise_gains_of_all_tunings() {
    for lambda in [1e-5, 3e-4, 1e-2, 0.3] {
        for q in [3e-6, 1e-4, 1e-3, 8e-3, 0.2, 1.0] {
            let tuning = Tuning { lambda, q };
            let design = ObserverDesign::new(tuning, 1.0).unwrap();
            let (mut window, mut gain) = (Window::START, NoiseGain::FIRST);
            for n in 1..=20_000_u32 {
                design.step(&mut window);
                gain.correct(&Gains::at(&window, &design));
                if [3, 96, 97, 150, 400, 1100, 3000, 8000, 20_000].contains(&n) {
                    let quick = NoiseGain::at_sample(n, tuning, 1.0);
                    let off = (quick.position() / gain.position() - 1.0).abs();
                    let off = off.max((quick.velocity(&design) / gain.velocity(&design) - 1.0).abs());
                    let most = if q > lambda { 0.08 } else { 0.04 };
                    assert!(off < most, "λT {lambda}, qT {q}, n {n}: off by {off}, {quick:?} for {gain:?}");
                }
            }
        }
    }
}

/// ẑ2 - c ẑu = k ẑ0 from the third sample on, and their quotient.
#[test]
fn an_identifier_by_hand() {
    let plant = RecordingConfig { samples: 3000, ..Default::default() };
    let recorded = record(&plant);
    let design = IdentifierDesign::new(Tuning::from_lambda(2.0), PERIOD).unwrap();
    let (mut window, mut cascade, mut unit, mut ratio) =
        (Window::START, Cascade::default(), UnitChain::default(), Ratio::EMPTY);
    for n in 0..recorded.positions.len() {
        let at = Coefficients::at(&window, &design);
        design.step(&mut window);
        let y = (recorded.positions[n] as f32) - (recorded.positions[0] as f32);
        // S/T² of held inputs: the mean of the last two.
        let s = if n < 2 { 0.0 } else { 0.5 * (recorded.forces[n - 1] + recorded.forces[n - 2]) as f32 };
        cascade.step(y, s, &design, &at);
        unit.step(&design, &at);
        if n % 16 == 0 {
            cascade.fold();
            ratio.fold();
        }
        if n >= 2 {
            ratio.add(Readout::LeastSquares, cascade.z2() - plant.drift as f32 * unit.zu(), cascade.z0(), 0.0);
        }
        if n >= 100 {
            let k = f64::from(ratio.quotient());
            let bound = if n >= 1000 { 1e-6 } else { 5e-6 };
            assert!((k / plant.k - 1.0).abs() <= bound, "sample {n}: {k}");
        }
    }
}

/// A position that stays after a step of 0.1 m: what is left of the innovation and the velocity ends at zero, not among the
/// subnormal numbers, on which some processors are slow.
#[test]
fn an_observer_comes_to_rest() {
    let design = ObserverDesign::new(Tuning::from_lambda(100.0), PERIOD).unwrap();
    let (mut observer, mut window, mut gains) = (Observer::default(), Window::START, Gains::FIRST);
    observer.start(1.0);
    for n in 1..4000 {
        design.step(&mut window);
        let now = Gains::at(&window, &design);
        let y = if n < 100 { 1.0 } else { 1.1 };
        observer.correct(y, InputMoments::ZERO, &Model::default(), gains.m1(), now.t_l2());
        gains = now;
        observer.fold();
        let (innovation, motion) = (observer.innovation(), observer.t_velocity());
        assert!(!innovation.is_subnormal() && !motion.is_subnormal(), "{n}: {innovation:e}, {motion:e}");
        if n == 110 {
            assert!(innovation.abs() > 1e-3 && motion.abs() > 1e-3, "{innovation:e}, {motion:e}");
        }
    }
    assert_eq!((observer.innovation(), observer.t_velocity()), (0.0, 0.0));
}

/// Dead-beat at n = 1; in the end l1 = 1 - p² and T l2 = (1 - p)².
#[test]
fn the_gains_begin_and_end_where_they_must() {
    let design = ObserverDesign::new(Tuning::from_lambda(20.0), PERIOD).unwrap();
    let (mut window, p) = (Window::START, (-20.0 * PERIOD).exp());
    for n in 1..=4000 {
        design.step(&mut window);
        let gains = Gains::at(&window, &design);
        if n == 1 {
            assert!((gains.l1() - 1.0).abs() < 1e-6 && (gains.t_l2() - 1.0).abs() < 1e-5, "{gains:?}");
        }
        if n == 4000 {
            assert!((f64::from(gains.l1()) / (1.0 - p * p) - 1.0).abs() < 1e-5, "{gains:?}");
            assert!((f64::from(gains.t_l2()) / (1.0 - p).powi(2) - 1.0).abs() < 1e-5, "{gains:?}");
        }
    }
}

/// Periods without a measurement: y + n T v, so that var y grows by 2 n cov(y, T v) + n² var T v.
#[test]
fn a_noise_gain_while_nothing_is_measured() {
    let tuning = Tuning::from_lambda(20.0);
    for samples in [1, 3, 40, 1000] {
        let gain = NoiseGain::at_sample(samples, tuning, PERIOD);
        let mut later = gain;
        for missed in 0..30_u16 {
            let quick = gain.position_after(missed);
            assert!((quick / later.position() - 1.0).abs() < 1e-5, "{samples}, {missed}: {quick} for {later:?}");
            later.predict();
        }
        // The line through the first two samples is at 3 y[1] - 2 y[0] two periods later.
        if samples == 1 {
            assert!((gain.position_after(2) - 13.0).abs() < 1e-3, "{}", gain.position_after(2));
        }
    }
}
