//! How measurement noise reaches the state: `state_sd` against exact sums, the closed form and Monte Carlo.

use fsb_core::observer::{Gains, NoiseGain, ObserverDesign};
use fsb_core::{Estimator, EstimatorConfig, Tuning};
use fsb_sim_host::twin::TwinObserver;
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;
use rayon::prelude::*;

const TUNINGS: [(f64, f64, f64); 4] = [(10.0, 5.0, 1e-3), (2.0, 1.0, 0.02), (5.0, 10.0, 1e-2), (20.0, 4.0, 2e-3)];

/// An axis without input, its parameter given: the observer alone. The noise level is given, and nothing corrects it.
fn resting<const N: usize>(lambda: f64, q: f64, period: f64, sigma: f64) -> Estimator<N, 1> {
    Estimator::new(&EstimatorConfig {
        observer: Tuning { lambda, q },
        nominal: [Some(1.0)],
        noise_sd: Some(sigma),
        ..EstimatorConfig::new(period)
    })
    .unwrap()
}

/// Variances of ŷ and v̂ at sample n under unit noise: the squares of the responses to n + 1 unit impulses, in f64.
fn exact_gain(lambda: f64, q: f64, period: f64, n: usize) -> (f64, f64) {
    (0..=n).fold((0.0, 0.0), |sum, at| {
        let mut observer = TwinObserver::new(lambda, q, period, 1.0, 0.0);
        let (y, v) = (0..=n)
            .map(|i| observer.update(Some(if i == at { 1.0 } else { 0.0 }), 0.0, 0.0))
            .last()
            .flatten()
            .expect("from the second sample on");
        (sum.0 + y * y, sum.1 + v * v)
    })
}

/// Fading memory, n → ∞: var ŷ = (1-p)(1+4p+5p²)/(1+p)³, var v̂ = 2(1-p)³/((1+p)³ T²).
fn steady_gain(lambda: f64, period: f64) -> (f64, f64) {
    let (p, c) = ((-lambda * period).exp(), -(-lambda * period).exp_m1());
    let cube = (1.0 + p).powi(3);
    (c * (1.0 + 4.0 * p + 5.0 * p * p) / cube, 2.0 * c.powi(3) / (cube * period * period))
}

/// `state_sd` is that of the exact gains: at each of the first samples, later to 2 %, in the end the closed form to 2 %.
#[test]
fn the_state_sd_is_that_of_the_exact_gains() {
    let sigma = 0.01;
    for (lambda, q, period) in TUNINGS {
        let mut estimator = resting::<1>(lambda, q, period, sigma);
        let settled = (25.0 / (lambda.min(q) * period)) as usize;
        let (mut early, mut late) = (0.0_f64, 0.0_f64);
        for n in 0..=settled {
            estimator.measure(&[Some(3.0)]).unwrap();
            if n > 0 && (n <= 20 || n == 100 || n == 300) {
                let (found, exact) = (estimator.state_sd()[0].unwrap(), exact_gain(lambda, q, period, n));
                let worst = if n <= 20 { &mut early } else { &mut late };
                *worst = worst.max((f64::from(found.position) / (sigma * exact.0.sqrt()) - 1.0).abs());
                *worst = worst.max((f64::from(found.velocity) / (sigma * exact.1.sqrt()) - 1.0).abs());
            }
            estimator.apply(&[0.0]);
        }
        let (found, steady) = (estimator.state_sd()[0].unwrap(), steady_gain(lambda, period));
        let end = [
            f64::from(found.position) / (sigma * steady.0.sqrt()),
            f64::from(found.velocity) / (sigma * steady.1.sqrt()),
        ];
        println!(
            "λ {lambda}, q {q}, T {period} s: off by {early:.1e} up to n = 20, {late:.1e} at 100 and 300, in the end over the closed form {end:.4?}"
        );
        assert!(early < 1e-4 && late < 0.02 && end.iter().all(|r| (r - 1.0).abs() < 0.02));
    }
}

/// The closed form is that of the twin's own gains.
#[test]
fn the_closed_form_is_the_limit_of_the_exact_sums() {
    for (lambda, q, period) in [(10.0, 5.0, 0.01), (5.0, 10.0, 0.02)] {
        let (exact, steady) = (exact_gain(lambda, q, period, 600), steady_gain(lambda, period));
        assert!((exact.0 / steady.0 - 1.0).abs() < 1e-9 && (exact.1 / steady.1 - 1.0).abs() < 1e-9);
    }
}

/// Monte Carlo through the f32 observer: 8 axes × 800 runs, so a standard deviation is known to 0.9 %. Where the gains stay,
/// four of those; before, the observer holds its gains for some samples, which costs it up to a tenth.
#[test]
fn the_state_sd_is_the_spread() {
    let (sigma, samples) = (0.01, [1, 2, 5, 20, 100, 600]);
    for (lambda, q, period) in TUNINGS {
        let runs: Vec<Vec<[f64; 2]>> = (0..800_u64)
            .into_par_iter()
            .map(|seed| {
                let mut rng = Pcg64::seed_from_u64(seed);
                let mut estimator = resting::<8>(lambda, q, period, sigma);
                let mut squares = Vec::new();
                for n in 0..=600 {
                    let y = std::array::from_fn(|_| {
                        let noise: f64 = rng.sample(StandardNormal);
                        Some((3.0 + sigma * noise) as f32)
                    });
                    estimator.measure(&y).unwrap();
                    if samples.contains(&n) {
                        squares.push(estimator.states().iter().flatten().fold([0.0; 2], |sum, s| {
                            [sum[0] + (f64::from(s.position) - 3.0).powi(2), sum[1] + f64::from(s.velocity).powi(2)]
                        }));
                    }
                    estimator.apply(&[0.0; 8]);
                }
                squares
            })
            .collect();
        for (i, n) in samples.into_iter().enumerate() {
            let spread = |part: usize| (runs.iter().map(|r| r[i][part]).sum::<f64>() / 6400.0).sqrt();
            let mut estimator = resting::<1>(lambda, q, period, sigma);
            for k in 0..=n {
                estimator.measure(&[Some(3.0)]).unwrap();
                if k < n {
                    estimator.apply(&[0.0]);
                }
            }
            let sd = estimator.state_sd()[0].unwrap();
            let ratio = [f64::from(sd.position) / spread(0), f64::from(sd.velocity) / spread(1)];
            println!("λ {lambda}, q {q}, T {period} s, n = {n}: reported over spread {ratio:.3?}");
            let lowest = if n <= 2 || n == 600 { 0.964 } else { 0.88 };
            assert!(ratio.iter().all(|r| (lowest..1.036).contains(r)), "n = {n}: {ratio:?}");
        }
    }
}

/// The first sample is the measurement itself.
#[test]
fn noise_gain_of_the_first_sample() {
    let design = ObserverDesign::new(Tuning { lambda: 10.0, q: 5.0 }, 0.01).unwrap();
    let mut gain = NoiseGain::FIRST;
    assert_eq!((gain.position(), gain.velocity(&design)), (1.0, 0.0));
    gain.correct(&Gains::FIRST);
    assert_eq!((gain.position(), gain.velocity(&design)), (1.0, 0.0));
}

/// Through missed measurements the spread grows, whether they are missed after many or after a few: what is reported is the spread, known
/// to 1.4 % (one sd, 2560 values), to 10 %.
#[test]
fn the_state_sd_grows_while_measurements_are_missed() {
    let (lambda, q, period, sigma) = (10.0, 5.0, 0.01, 0.01);
    for (came, missed) in [(10, 20), (20, 40), (200, 50)] {
        let squares: Vec<[f64; 2]> = (0..320_u64)
            .into_par_iter()
            .map(|seed| {
                let mut rng = Pcg64::seed_from_u64(seed);
                let mut estimator = resting::<8>(lambda, q, period, sigma);
                for n in 0..came + missed {
                    let y = std::array::from_fn(|_| {
                        let noise: f64 = rng.sample(StandardNormal);
                        (n < came).then_some((3.0 + sigma * noise) as f32)
                    });
                    estimator.measure(&y).unwrap();
                    estimator.apply(&[0.0; 8]);
                }
                estimator.states().iter().flatten().fold([0.0; 2], |sum, s| {
                    [sum[0] + (f64::from(s.position) - 3.0).powi(2), sum[1] + f64::from(s.velocity).powi(2)]
                })
            })
            .collect();
        let spread = |part: usize| (squares.iter().map(|of| of[part]).sum::<f64>() / 2560.0).sqrt();
        let mut estimator = resting::<1>(lambda, q, period, sigma);
        for n in 0..came + missed {
            estimator.measure(&[(n < came).then_some(3.0)]).unwrap();
            estimator.apply(&[0.0]);
        }
        let sd = estimator.state_sd()[0].unwrap();
        let ratio = [f64::from(sd.position) / spread(0), f64::from(sd.velocity) / spread(1)];
        println!("{missed} missed after {came}, seeds 0 to 319: reported over spread {ratio:.3?}");
        assert!(ratio.iter().all(|r| (0.9..1.1).contains(r)), "{missed} after {came}: {ratio:?}");
    }
}

/// With measurements missing at random from the start on what is reported is no less than the spread, to 25 % (known to 8 %: 60 flights with
/// some independent values each), from the moment on at which something is reported: when 8/λ of them have come. (Before that the
/// spread is up to 3.5 times what was reported where half of them are missing, and 70 times with nine of ten.)
#[test]
fn gaps_at_the_start_leave_no_sd_that_is_too_small() {
    for (rate, lambda, missing) in
        [(100.0, 5.0, 0.7), (100.0, 5.0, 0.9), (100.0, 20.0, 0.7), (1000.0, 20.0, 0.5), (1000.0, 20.0, 0.9)]
    {
        let period = 1.0 / rate;
        let late = (8.0 * rate / lambda) as u32;
        let flights: Vec<[f64; 2]> = (0..60_u64)
            .into_par_iter()
            .map(|seed| {
                let mut rng = Pcg64::seed_from_u64(seed);
                let mut estimator = resting::<1>(lambda, 0.5 * lambda, period, 1e-3);
                let (mut came, mut squares, mut count) = (0, 0.0, 0.0);
                while came < 3 * late / 2 {
                    let noise: f64 = rng.sample(StandardNormal);
                    let comes = came == 0 || !rng.random_bool(missing);
                    came += u32::from(comes);
                    estimator.measure(&[comes.then_some((3.0 + 1e-3 * noise) as f32)]).unwrap();
                    let reported = estimator.state_sd()[0];
                    assert!(reported.is_some() || came <= late, "{came} came, nothing reported: seed {seed}");
                    if let Some((state, sd)) = estimator.states()[0].zip(reported) {
                        squares += f64::from(state.velocity / sd.velocity).powi(2);
                        count += 1.0;
                    }
                    estimator.apply(&[0.0]);
                }
                [squares, count]
            })
            .collect();
        let [squares, count] = flights.iter().fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]);
        let ratio = f64::sqrt(squares / count);
        println!("{rate} Hz, λ {lambda}, {missing} missing, seeds 0 to 59: spread over reported {ratio:.2}");
        assert!(ratio < 1.25, "{rate} Hz, λ {lambda}, {missing} missing: {ratio}");
    }
}

/// Where there is no state there is no sd of one.
#[test]
fn no_sd_of_a_state_that_is_none() {
    let mut estimator = resting::<2>(10.0, 5.0, 0.01, 0.01);
    for _ in 0..100 {
        estimator.measure(&[Some(3.0), None]).unwrap();
        estimator.apply(&[0.0; 2]);
    }
    assert!(estimator.states() == [None; 2] && estimator.state_sd() == [None; 2]);
    for _ in 0..100 {
        estimator.measure(&[Some(3.0); 2]).unwrap();
        estimator.apply(&[0.0; 2]);
    }
    assert!(estimator.states().iter().all(Option::is_some) && estimator.state_sd().iter().all(Option::is_some));
}
