//! `aggressive`: mass and moments of inertia at large angles, and the paper's small-angle model on the same flight.

use fsb_sim_host::fly::record::NAMES;
use fsb_tests::fly::{fly, worst};

const NOISE: [&str; 3] =
    ["rate=200", "sensors.position.noise_sd=0.01", "sensors.attitude.noise_sd=0.005235987755982988"];

/// Without noise, at three rates: inertias within 1 % at 1.2 s and 0.2 % from 3 s on, mass within 0.05 % from 1.2 s on.
#[test]
fn without_noise() {
    for rate in [200, 500, 1000] {
        let flight = fly("aggressive", &[&format!("rate={rate}")], 1);
        let of = |index, from, to| worst(&flight.errors, index, from, to);
        println!("{rate} Hz, mass from 1.2 s on: {:.5} %", of(0, 1.2, 12.0));
        assert!(of(0, 1.2, 12.0) <= 0.05, "mass");
        for (i, name) in NAMES.iter().enumerate().skip(1) {
            let (early, late) = (of(i, 1.2, 1.2), of(i, 3.0, 12.0));
            println!("{rate} Hz, {name}: {early:.3} % at 1.2 s, {late:.4} % from 3 s on");
            assert!(early <= 1.0 && late <= 0.2, "{name} at {rate} Hz: {early}, {late}");
        }
    }
}

/// With 0.3° and 10 mm at 200 Hz: all within 1 % from 3 s on, on every one of 20 seeds.
#[test]
fn with_noise() {
    let mut all = [0.0_f64; 4];
    for seed in 1..=20 {
        let flight = fly("aggressive", &NOISE, seed);
        for (i, largest) in all.iter_mut().enumerate() {
            *largest = largest.max(worst(&flight.errors, i, 3.0, 12.0));
        }
    }
    println!("largest errors from 3 s on over seeds 1 to 20: {all:.3?} %");
    assert!(all.iter().all(|&error| error <= 1.0), "{all:?}");
}

/// The reported standard deviation is one: of 40 noisy flights twice of it holds the truth in at least 80 %, of the moments
/// of inertia and of the mass at 3 s. Later on the mass is so well known that the noise of the attitude counts, which turns the
/// force and is not in its standard deviation: at 12 s two thirds.
#[test]
fn reported_deviations_hold_the_truth() {
    let mut held = [[0; 4]; 2];
    let flights = 40;
    for seed in 100..100 + flights {
        let flight = fly("aggressive", &NOISE, seed);
        for (held, t) in held.iter_mut().zip([3.0, 12.0]) {
            let sample = flight.samples.iter().rfind(|sample| sample.moment.t <= t + 1e-6).unwrap();
            let truths = fsb_sim_host::fly::record::truths(&sample.moment);
            for i in 0..4 {
                let estimate = sample.belief.parameters[i].unwrap();
                let off = (f64::from(estimate.value) - truths[i]).abs();
                held[i] += u64::from(off <= 2.0 * f64::from(estimate.sd()));
            }
        }
    }
    println!("2 sd held the truth in {held:?} of {flights} flights, at 3 s and 12 s");
    for (i, least) in [(0, 0.66), (1, 0.8), (2, 0.8), (3, 0.8)] {
        let shares = held.map(|held| held[i] as f64 / flights as f64);
        assert!(shares[0] >= 0.8 && shares[1] >= least, "parameter {i}: {shares:?}");
    }
}

/// The paper's model on the same noise-free flight: off by several per cent for ever, as the body angles are not.
#[test]
fn small_angles_are_not_enough() {
    let flight = fly("aggressive", &[], 1);
    let small = flight.small_angle.as_deref().unwrap();
    for (i, name) in NAMES.iter().enumerate().skip(1) {
        let (theirs, ours) = (worst(small, i, 6.0, 12.0), worst(&flight.errors, i, 6.0, 12.0));
        println!("{name} from 6 s on: small angles {theirs:.2} %, body angles {ours:.4} %");
        assert!(theirs > 1.0 && theirs > 20.0 * ours, "{name}: {theirs}, {ours}");
    }
}
