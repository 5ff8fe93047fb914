//! The parts of the regression by themselves: ẑv, the model with drag, the observer on it.

use fsb_core::Tuning;
use fsb_core::identifier::IdentifierDesign;
use fsb_core::moments::InputMoments;
use fsb_core::observer::{Gains, Model, Observer, ObserverDesign};
use fsb_core::regression::{
    DragConfig, DragEstimator, DragModel, DragObserver, VelocityCascade, VelocityDesign, VelocityWeights,
};
use fsb_core::window::Window;
use fsb_tests::drag_flight::{DRIFT, DragAxis, DragFlight, FLIGHT, Flyer};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Without drag and disturbance: the bits of the plain observer.
#[test]
fn the_plain_observer_where_there_is_no_drag() {
    let mut rng = Pcg64::seed_from_u64(1);
    for period in [1e-3, 0.02] {
        let design = ObserverDesign::new(Tuning::from_lambda(10.0), period).unwrap();
        let (plain_model, model) = (Model::new(0.7, -9.81, &design), DragModel::new(0.7, 0.0, -9.81, &design));
        let (mut plain, mut observer) = (Observer::default(), DragObserver::default());
        let (mut window, mut gains) = (Window::START, Gains::FIRST);
        plain.start(3.0);
        observer.start(3.0);
        for _ in 0..10_000 {
            let y = 3.0 + rng.random_range(-0.1..0.1_f32);
            let f = rng.random_range(-20.0..20.0_f32);
            let (m1, moments) = (gains.m1(), InputMoments { j1: f, j2: 0.4 * f });
            design.step(&mut window);
            gains = Gains::at(&window, &design);
            assert_eq!(
                observer.predict(moments, &model, m1).to_bits(),
                plain.predict(moments, &plain_model, m1).to_bits()
            );
            plain.correct(y, moments, &plain_model, m1, gains.t_l2());
            observer.correct(y, moments, &model, m1, gains.t_l2());
            plain.fold();
            observer.fold();
            let same = |a: f32, b: f32| assert_eq!(a.to_bits(), b.to_bits());
            same(observer.state().position(0.0, &gains), plain.position(0.0, &gains));
            same(observer.state().velocity(&design), plain.velocity(&design));
            same(observer.state().innovation(), plain.innovation());
        }
    }
}

/// With the true D and d: the velocity of a braked axis to rounding.
#[test]
fn exact_with_drag() {
    for (period, drag) in [(1e-3, 1.0), (0.02, 1.0), (0.02, -0.5), (0.1, 1.0)] {
        let design = ObserverDesign::new(Tuning::from_lambda(5.0), period).unwrap();
        let (k, a) = (1.0 / 1.3, -9.81 + 0.3);
        let model = DragModel::new(k as f32, drag as f32, a as f32, &design);
        let mut axis = DragAxis { position: 3.0, velocity: -1.0, k, drag, acceleration: a };
        let mut observer = DragObserver::default();
        let (mut window, mut gains) = (Window::START, Gains::FIRST);
        observer.start(axis.position as f32);
        let (mut worst, mut wrong_model) = (0.0_f64, 0.0_f64);
        let mut plain = Observer::default();
        plain.start(axis.position as f32);
        let plain_model = Model::new(k as f32, a as f32, &design);
        for n in 1..(20.0 / period) as usize {
            let t = n as f64 * period;
            let wanted = 6.0 * (3.0 + (1.3 * t).sin() - axis.position) - 5.0 * axis.velocity;
            let f = ((wanted - a + drag * axis.velocity) / k) as f32;
            axis.step(f64::from(f), period);
            let m1 = gains.m1();
            design.step(&mut window);
            gains = Gains::at(&window, &design);
            let moments = InputMoments { j1: f, j2: 0.5 * f };
            observer.correct(axis.position as f32, moments, &model, m1, gains.t_l2());
            observer.fold();
            plain.correct(axis.position as f32, moments, &plain_model, m1, gains.t_l2());
            plain.fold();
            if t > 8.0 {
                worst = worst.max((f64::from(observer.state().velocity(&design)) - axis.velocity).abs());
                wrong_model = wrong_model.max((f64::from(plain.velocity(&design)) - axis.velocity).abs());
            }
        }
        // (D T)⁴/24 of the motion is left out; at 10 Hz that is 4e-6 of the acceleration's share, 1e-5 m/s.
        let limit = 2e-6 + (drag * period).powi(4) / 24.0 * 20.0;
        println!("T {period} s, D {drag}: velocity to {worst:.1e} m/s, without drag {wrong_model:.1e}");
        assert!(worst < limit && wrong_model > 100.0 * worst);
    }
}

/// ẑv against its definition in f64, g₋ (y\[n\] - y\[n-2\])/(2T) through three stages.
#[test]
fn filtered_velocity() {
    for (period, tuning) in [(1e-3, Tuning::from_lambda(2.0)), (0.02, Tuning { lambda: 2.0, q: 5.0 })] {
        let identifier = IdentifierDesign::new(tuning, period).unwrap();
        let design = VelocityDesign::new(tuning, period).unwrap();
        let (mut window, mut cascade) = (Window::START, VelocityCascade::default());
        let c = -(-tuning.lambda * period).exp_m1();
        let (mut past, mut stages, mut worst) = ([0.0; 2], [0.0; 3], 0.0_f64);
        for n in 0..(20.0 / period) as i32 {
            let t = f64::from(n) * period;
            let y = 0.5 * ((2.0 * t).sin() + (5.0 * t).cos()) as f32 as f64;
            cascade.step(y as f32, &design, &VelocityWeights::at(&window, &design));
            cascade.fold();
            identifier.step(&mut window);
            let h = |m: i32| -(-tuning.q * period * f64::from(m)).exp_m1();
            let mut u = if n < 2 { 0.0 } else { h(n - 1) * h(n) * (y - past[1]) / (2.0 * period) };
            past = [y, past[0]];
            for stage in &mut stages {
                *stage += c * (u - *stage);
                u = *stage;
            }
            worst = worst.max((f64::from(cascade.zv() / design.scale()) - stages[2]).abs());
        }
        println!("T {period} s: ẑv to {worst:.1e} m/s");
        assert!(worst < 1e-6);
    }
}

/// Once the window is open a position that stays leaves nothing, to the last bit, whatever its digits.
#[test]
fn standing_still_leaves_nothing() {
    let mut rng = Pcg64::seed_from_u64(2);
    for period in [1e-3, 0.01, 0.02] {
        let tuning = Tuning { lambda: 4.0, q: 8.0 };
        let identifier = IdentifierDesign::new(tuning, period).unwrap();
        let design = VelocityDesign::new(tuning, period).unwrap();
        for _ in 0..10 {
            let y = rng.random_range(-10.0..10.0_f32);
            let (mut window, mut cascade) = (Window::START, VelocityCascade::default());
            for _ in 0..(20.0 / period) as usize {
                cascade.step(y, &design, &VelocityWeights::at(&window, &design));
                cascade.fold();
                identifier.step(&mut window);
            }
            let zv = cascade.zv() / design.scale();
            assert!(zv.abs() < 1e-20, "{y} m, {period} s: {zv} m/s");
        }
    }
}

/// Nine measurements of ten missing, and an observer that follows each: what came together over a gap is no velocity of one period.
#[test]
fn a_quick_observer_is_not_thrown_off_by_gaps() {
    let flight = DragFlight { period: 0.02, noise: 1e-3, ..FLIGHT };
    for of_period in [0.5, 0.9] {
        let observer = Tuning::from_lambda(of_period / flight.period);
        let config = DragConfig { drift: DRIFT, observer, nominal: Some(flight.k), ..DragConfig::new(flight.period) };
        let (mut worst, mut squares, mut count) = (0.0_f64, 0.0, 0.0);
        for seed in 0..20 {
            let mut estimator = DragEstimator::new(&config).expect("a valid configuration");
            let mut rng = Pcg64::seed_from_u64(seed);
            let mut flyer = Flyer::new(&flight);
            for n in 0..1500 {
                let instant = flyer.step(&flight, &mut rng);
                let positions = instant.measured.map(|y| (n == 0 || rng.random_bool(0.1)).then_some(y));
                estimator.measure(&positions).expect("in step");
                for (state, truth) in estimator.states().into_iter().zip(instant.velocity) {
                    if let Some(state) = state.filter(|_| instant.t > 5.0) {
                        let off = f64::from(state.velocity) - truth;
                        worst = worst.max(off.abs());
                        (squares, count) = (squares + off * off, count + 1.0);
                    }
                }
                estimator.apply(&instant.force);
            }
        }
        let rms = (squares / count).sqrt();
        println!("λT {of_period}, seeds 0 to 19: velocity off by {rms} m/s rms, {worst} at most");
        assert!(count > 7e4 && rms < 0.5 && worst < 10.0);
    }
}
