//! Slow, late, missing and wrong measurements, and wind: every run stays in the air, and how far off it is.

use fsb_tests::fly::{fly, worst};

/// Bounds of the distance from the reference (m, rms and largest) and of the mass (%, from 6 s on), each about twice the most
/// of seeds 1 to 5.
#[test]
fn every_run_is_stable() {
    for (name, rms, largest, mass) in [
        ("slow-position", 0.008, 0.016, 0.02),
        ("latency", 0.0035, 0.009, 0.015),
        ("dropouts", 0.011, 0.052, 0.07),
        ("outliers", 0.022, 0.06, 0.13),
        ("bit-faults", 0.18, 0.55, 0.56),
        ("wind", 0.41, 0.6, 1.9),
        ("hover", 0.0012, 0.0025, 0.003),
    ] {
        for seed in 1..=5 {
            let flight = fly(name, &[], seed);
            let off = worst(&flight.errors, 0, 6.0, 20.0);
            println!("  mass within {off:.4} % from 6 s on");
            let of = flight.tracking;
            assert!(of.position_rms <= rms && of.position_error_max <= largest && off <= mass, "{name}, {off}");
        }
    }
}

/// 80 ms of latency: the velocity's error is at most 1.3 times that without.
#[test]
fn late_positions_cost_little() {
    for seed in 1..=5 {
        let late = fly("latency", &[], seed).state;
        let prompt = fly("latency", &["sensors.position.latency=0"], seed).state;
        let ratio = late.velocity_rms / prompt.velocity_rms;
        println!("velocity {:.4} m/s late, {:.4} m/s prompt: {ratio:.3}", late.velocity_rms, prompt.velocity_rms);
        assert!(ratio <= 1.3, "{ratio}");
    }
}

/// An estimator that does not know of the latency is worse by far: the latency of this scenario matters.
#[test]
fn latency_not_made_up_for_would_show() {
    let known = fly("latency", &[], 1).state;
    let unknown = fly("latency", &["estimator.translation.latency=0"], 1).state;
    assert!(unknown.velocity_rms > 5.0 * known.velocity_rms, "{unknown:?}, {known:?}");
}

/// Through a second without any position the vehicle is carried by the prediction, and it is back afterwards.
#[test]
fn a_gap_is_flown_through() {
    let flight = fly("dropouts", &[], 1);
    let largest = |from: f64, to: f64| {
        let inside = flight.samples.iter().filter(|s| (from..to).contains(&s.moment.t));
        inside.map(|s| fsb_sim_host::hexarotor::vector::norm(s.moment.position_error())).fold(0.0, f64::max)
    };
    let (within, after) = (largest(10.0, 12.0), largest(13.0, 20.0));
    println!("largest distance {within:.4} m in the gap, {after:.4} m later");
    assert!(within < 0.1 && after < 0.02, "{within}, {after}");
}
