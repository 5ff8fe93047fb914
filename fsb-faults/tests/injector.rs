//! Every fault does what it says, as often as it says.

use fsb_faults::{FaultConfig, FaultError, Injector};

const SAMPLES: usize = 100_000;

/// A slow ramp through the injector: (truth, what arrived).
fn run<const D: usize>(config: &FaultConfig, seed: u64) -> Vec<(f32, Option<f32>)> {
    println!("seed {seed}");
    let mut injector = Injector::<D>::new(config, seed).unwrap();
    (0..SAMPLES)
        .map(|n| {
            let truth = 1.0 + n as f32 * 1e-4;
            (truth, injector.pass(Some(truth)))
        })
        .collect()
}

/// A share of `p` of 1e5 samples, to four standard deviations.
fn as_often_as(count: usize, p: f64) -> bool {
    let (expected, sd) = (p * SAMPLES as f64, (p * (1.0 - p) * SAMPLES as f64).sqrt());
    println!("{count} of {expected}");
    (count as f64 - expected).abs() < 4.0 * sd
}

#[test]
fn without_faults_nothing_happens() {
    for (truth, got) in run::<1>(&FaultConfig::default(), 1) {
        assert_eq!(got.map(f32::to_bits), Some(truth.to_bits()));
    }
}

#[test]
fn drops() {
    let got = run::<1>(&FaultConfig { drop: 0.3, ..FaultConfig::default() }, 2);
    assert!(as_often_as(got.iter().filter(|(_, y)| y.is_none()).count(), 0.3));
    assert!(got.iter().all(|(truth, y)| y.is_none_or(|y| y == *truth)));
}

#[test]
fn not_numbers_of_every_kind() {
    let got = run::<1>(&FaultConfig { nan: 0.1, ..FaultConfig::default() }, 3);
    let bad: Vec<f32> = got.iter().filter_map(|(_, y)| *y).filter(|y| !y.is_finite()).collect();
    assert!(as_often_as(bad.len(), 0.1));
    for kind in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert!(bad.iter().any(|y| y.to_bits() == kind.to_bits()), "{kind}");
    }
}

#[test]
fn spikes_of_the_size_that_was_asked_for() {
    let got = run::<1>(&FaultConfig { spike: 0.05, spike_size: 3.0, ..FaultConfig::default() }, 4);
    let off: Vec<f32> = got.iter().map(|(truth, y)| y.unwrap() - truth).filter(|d| *d != 0.0).collect();
    assert!(as_often_as(off.len(), 0.05));
    let (low, high) = off.iter().fold((0.0_f32, 0.0_f32), |(low, high), d| (low.min(*d), high.max(*d)));
    assert!((-3.001..-2.9).contains(&low) && (2.9..3.001).contains(&high), "{low} to {high}");
}

#[test]
fn one_bit_flips_and_it_may_be_any() {
    let got = run::<1>(&FaultConfig { bit_flip: 0.1, ..FaultConfig::default() }, 5);
    let mut seen = [0_u32; 32];
    for (truth, y) in &got {
        let changed = y.unwrap().to_bits() ^ truth.to_bits();
        assert!(changed.count_ones() <= 1);
        if changed != 0 {
            seen[changed.trailing_zeros() as usize] += 1;
        }
    }
    assert!(as_often_as(seen.iter().sum::<u32>() as usize, 0.1));
    assert!(seen.iter().all(|count| *count > 200), "{seen:?}");
}

#[test]
fn freezes_for_as_long_as_it_shall() {
    let got = run::<1>(&FaultConfig { freeze: 1e-3, freeze_length: 40, ..FaultConfig::default() }, 6);
    let mut lengths = Vec::new();
    let mut length = 0;
    for pair in got.windows(2) {
        if pair[0].1 == pair[1].1 {
            length += 1;
        } else if length > 0 {
            lengths.push(length);
            length = 0;
        }
    }
    println!("{} freezes", lengths.len());
    assert!(lengths.len() > 60 && lengths.iter().all(|l| *l == 40), "{lengths:?}");
}

#[test]
fn comes_late_and_in_order() {
    let got = run::<5>(&FaultConfig { delay: 5, ..FaultConfig::default() }, 7);
    assert!(got[..5].iter().all(|(_, y)| y.is_none()));
    for n in 5..SAMPLES {
        assert_eq!(got[n].1, Some(got[n - 5].0));
    }
}

#[test]
fn jitter_is_a_share_of_the_step_and_quanta_are_quanta() {
    let got = run::<1>(&FaultConfig { jitter: 0.5, ..FaultConfig::default() }, 8);
    let worst = got.iter().map(|(truth, y)| (y.unwrap() - truth).abs()).fold(0.0, f32::max);
    assert!((4e-5..5.2e-5).contains(&worst), "{worst} of a step of 1e-4");
    for (truth, y) in run::<1>(&FaultConfig { quantum: 0.25, ..FaultConfig::default() }, 9) {
        let count = y.unwrap() / 0.25;
        assert!(count == count.round() && (y.unwrap() - truth).abs() <= 0.125);
    }
}

/// Switching one fault on leaves the others as they were.
#[test]
fn faults_do_not_know_of_each_other() {
    let alone = run::<1>(&FaultConfig { drop: 0.3, ..FaultConfig::default() }, 10);
    let both =
        run::<1>(&FaultConfig { drop: 0.3, spike: 0.5, spike_size: 1.0, nan: 0.1, ..FaultConfig::default() }, 10);
    assert!(alone.iter().zip(&both).all(|(a, b)| a.1.is_none() == b.1.is_none()));
}

#[test]
fn wrong_settings_are_named() {
    let refused = |config: FaultConfig| Injector::<4>::new(&config, 0).unwrap_err();
    let none = FaultConfig::default();
    assert_eq!(refused(FaultConfig { drop: 1.5, ..none }), FaultError::NotAShare("drop"));
    assert_eq!(refused(FaultConfig { nan: f32::NAN, ..none }), FaultError::NotAShare("nan"));
    assert_eq!(refused(FaultConfig { spike_size: -1.0, ..none }), FaultError::NotASize("spike_size"));
    assert_eq!(refused(FaultConfig { quantum: f32::INFINITY, ..none }).parameter(), "quantum");
    assert_eq!(refused(FaultConfig { delay: 5, ..none }).to_string(), "delay is longer than the injector's capacity");
}
