//! The running means of the noise's variance.

use super::super::NoiseLevel;

/// Nothing is forgotten.
const FOREVER: (u16, f32) = (256, 0.0);

/// A mean of all values up to the memory, from then on a fading one over so many.
#[test]
fn means_over_the_memory() {
    let mut level = NoiseLevel::default();
    for n in 1..=4_u8 {
        level.add(f32::from(n), 2.0 * f32::from(n), 0.0, 1.0, (4, 0.0));
    }
    // (1 + 2 + 3 + 4)/4, then a quarter of the way to 10.
    assert_eq!(level.variances(), [2.5, 5.0]);
    level.add(10.0, 20.0, 0.0, 1.0, (4, 0.0));
    assert_eq!(level.variances(), [4.375, 8.75]);
}

/// What was counts as much as it is remembered: the level is no less than the mean of all values, each weighed as it went into k.
#[test]
fn noise_that_was() {
    for (quiet, forgetting, remembered) in [
        (1.0, 0.0, (300.0 * 9.0 + 700.0) / 1000.0),
        // At rest from then on.
        (1e-4, 0.0, 1.0 + 8.0 * 300.0 / 300.07),
        (0.0, 0.0, 9.0),
        // (1 - φ)^700 of 300 values is left beside 700 new ones of a ten-thousandth each; and beside as many of the same weight
        // it is less than the level of the moment, a mean over 256.
        (1e-4, 1.0 / 512.0, 1.0 + 8.0 / (1.0 + 1e-4 * (1.0 - 0.254) / (0.254 * (1.0 - 0.556)))),
        (1.0, 1.0 / 128.0, 1.0 + 8.0 * (255.0_f64 / 256.0).powi(700)),
    ] {
        let mut level = NoiseLevel::default();
        for n in 0..1000 {
            let (value, weight) = if n < 300 { (9.0, 1.0) } else { (1.0, quiet) };
            level.add(1.0, value, 0.0, weight, (256, forgetting));
            assert!(n >= 300 || level.variance() == 9.0);
        }
        let variance = f64::from(level.variance());
        assert!((variance / remembered - 1.0).abs() < 1e-3, "{quiet}, {forgetting}: {level:?} for {remembered}");
        assert_eq!(level.measured(), 1.0);
    }
}

/// A value that weighs more than all before it together does not make the level by itself.
#[test]
fn a_heavy_value() {
    let mut level = NoiseLevel::default();
    for n in 0..100 {
        level.add(1.0, 1.0, 0.0, 1.5_f32.powi(n), FOREVER);
    }
    level.add(10.0, 20.0, 0.0, 1e30, FOREVER);
    assert!((level.variance() - (1.0 + 19.0 / 101.0)).abs() < 1e-4, "{level:?}");
    assert!((level.measured() - (1.0 + 9.0 / 101.0)).abs() < 1e-4, "{level:?}");
}

/// So is the noise of measurements: a mean of late where k learned, whatever it has fallen to.
#[test]
fn measurement_noise_that_was() {
    let mut level = NoiseLevel::default();
    for n in 0..2000 {
        let (value, weight) = if n < 300 { (4.0, 1.0) } else { (0.01, 1e-6) };
        level.add(value, 0.0, 0.0, weight, FOREVER);
    }
    let [fine, _] = level.variances();
    assert!((level.measured() / 4.0 - 1.0).abs() < 1e-3 && level.variance() == level.measured(), "{level:?}");
    assert!(fine == level.measurement_variance() && fine < 0.05, "{level:?}");
}

/// Weights over all that f32 can tell apart, for a long time: the mean stays one, and no number becomes too small.
#[test]
fn weights_of_any_size() {
    let remembers = (NoiseLevel::memory(0.0), 0.0);
    let mut level = NoiseLevel::default();
    for n in 0..3_000_000_u32 {
        let weight = [1e-30, 1e-12, 1.0, 1e24][(n / 1000 % 4) as usize];
        level.add(2.0, if n % 2 == 0 { 1.0 } else { 5.0 }, 0.0, weight, remembers);
        assert!(n < 100 || (2.9..3.1).contains(&level.variance()), "{n}: {level:?}");
    }
    // One size only: means over a million values neither stall nor drift.
    let mut level = NoiseLevel::expected(1.0);
    for n in 0..4_000_000_u32 {
        level.add(0.0, if n % 10 == 0 { 20.0 } else { 0.0 }, 0.0, 1.0, remembers);
    }
    assert!((1.9..2.1).contains(&level.variance()), "{level:?}");
}

/// The larger band counts, whichever it is; trusted from the eighth value on.
#[test]
fn the_larger_of_two() {
    for (fine, slow) in [(1.0, 3.0), (3.0, 1.0), (2.0, 2.0)] {
        let mut level = NoiseLevel::default();
        for n in 0..20 {
            assert_eq!(level.is_known(), n >= 8);
            level.add(fine, slow, 0.0, 1.0, FOREVER);
        }
        assert_eq!((level.variance(), level.measurement_variance()), (fine.max(slow), fine));
    }
}

/// The misfit remembers 32 values: it counts from 25 times the noise on, as a whole.
#[test]
fn the_misfit() {
    let mut level = NoiseLevel::default();
    level.add(1.0, 25.0, 7.0, 1.0, FOREVER);
    assert_eq!(level.misfit(0.0), (0.0, 7.0), "that may still be noise");
    level.add(1.0, 35.0, 9.0, 1.0, FOREVER);
    assert_eq!(level.misfit(0.0), (30.0, 8.0));
    // The 32 values: 30 more of 30 and 8, then one of 94 and 72 moves the means by a 32nd of the distance.
    for _ in 0..30 {
        level.add(1.0, 30.0, 8.0, 1.0, FOREVER);
    }
    level.add(1.0, 94.0, 72.0, 1.0, FOREVER);
    let (unexplained, signal) = level.misfit(0.0);
    assert!((unexplained - 32.0).abs() < 1e-4 && (signal - 10.0).abs() < 1e-4, "{unexplained}, {signal}");
    for _ in 0..1000 {
        level.add(1.0, 26.0, 1.0, 1.0, FOREVER);
    }
    let (unexplained, signal) = level.misfit(0.0);
    assert!((unexplained - 26.0).abs() < 1e-3 && (signal - 1.0).abs() < 1e-3, "{unexplained}, {signal}");
}

/// The noise counts once where nothing is missing, twice where every other measurement is, three times at most; and what was missing is
/// forgotten.
#[test]
fn what_was_missing() {
    for (missing, times) in [(0.0_f32, 1.0), (0.5, 2.0), (0.6, 2.5), (0.9, 3.0)] {
        let (mut level, mut due, mut stretch) = (NoiseLevel::expected(1.0), 0.0, 1.0);
        for _ in 0..4000 {
            due += missing;
            if due >= 1.0 {
                due -= 1.0;
                level.miss(0.01);
            } else if level.has_gaps() {
                stretch = level.stretch(0.01, 1.0);
            }
        }
        assert!((stretch - times).abs() < 0.03 * times, "{missing}: {stretch}");
        for _ in 0..1000 {
            stretch = level.stretch(0.01, 1.0);
        }
        assert!(!level.has_gaps() && stretch < 1.002, "{missing}: {stretch}");
    }
}

/// What predictions were found to be off by counts beside the noise, as the mean square of white noise with the same sum: gaps of two that
/// end 6 off, every tenth measurement, are (3 + 3)² a tenth of the time.
#[test]
fn what_predictions_were_off_by() {
    let (mut level, mut stretch) = (NoiseLevel::expected(0.5), 0.0);
    for n in 0..1000 {
        if n % 10 == 0 {
            level.come_back(2.0, 2.0, 6.0, 0.01);
        }
        stretch = level.stretch(0.01, 1.0);
    }
    assert!((stretch * stretch / (1.0 + 3.6 / 0.5) - 1.0).abs() < 0.1, "{stretch}");
    level.forget_gaps();
    assert!(!level.has_gaps());
    // From one to the most there is: √(1 + gaps/σ²).
    for n in 0..4000_u16 {
        let square = libm::powf(10.0, 8.0 * f32::from(n) / 4000.0);
        let mut level = NoiseLevel::expected(1.0);
        level.come_back(4.0, 1.0, libm::sqrtf(square), 1.0);
        let off = level.stretch(0.0, 1.0) / libm::sqrtf(1.0 + square) - 1.0;
        assert!((-1e-6..1.1e-3).contains(&off), "{square}: {off}");
    }
    // Whatever comes, it is a number.
    let mut level = NoiseLevel::UNKNOWN;
    level.come_back(65_535.0, 65_535.0, 1e6, 0.01);
    assert!((1.0..=1.002e4).contains(&level.stretch(0.01, 1.0)));
}
