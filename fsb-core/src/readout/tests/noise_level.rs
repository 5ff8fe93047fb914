//! The running means of the noise's variance.

use super::super::NoiseLevel;

/// A mean of all values up to the memory, from then on a fading one over so many.
#[test]
fn means_over_the_memory() {
    let mut level = NoiseLevel::default();
    for n in 1..=4_u8 {
        level.add(f32::from(n), 2.0 * f32::from(n), 0.0, 4);
    }
    // (1 + 2 + 3 + 4)/4, then a quarter of the way to 10.
    assert_eq!(level.variances(), [2.5, 5.0]);
    level.add(10.0, 20.0, 0.0, 4);
    assert_eq!(level.variances(), [4.375, 8.75]);
}

/// What was counts as long as it is remembered: the level is no less than the mean of all residuals.
#[test]
fn noise_that_was() {
    for (memory, expected) in
        [(u16::MAX, (300.0 * 9.0 + 700.0) / 1000.0), (256, 1.0 + 8.0 * (255.0_f64 / 256.0).powi(700))]
    {
        let mut level = NoiseLevel::default();
        for n in 0..1000 {
            let value = if n < 300 { 9.0 } else { 1.0 };
            level.add(value, value, 0.0, memory);
            assert!(n >= 300 || level.variance() == 9.0);
        }
        assert!((f64::from(level.variance()) / expected - 1.0).abs() < 1e-3, "{memory}: {level:?} for {expected}");
    }
}

/// The larger band counts, whichever it is; trusted from the eighth value on.
#[test]
fn the_larger_of_two() {
    for (fine, slow) in [(1.0, 3.0), (3.0, 1.0), (2.0, 2.0)] {
        let mut level = NoiseLevel::default();
        for n in 0..20 {
            assert_eq!(level.is_known(), n >= 8);
            level.add(fine, slow, 0.0, 256);
        }
        assert_eq!((level.variance(), level.measurement_variance()), (fine.max(slow), fine));
    }
}

/// The misfit remembers 32 values: it counts from 25 times the noise on, as a whole.
#[test]
fn the_misfit() {
    let mut level = NoiseLevel::default();
    level.add(1.0, 25.0, 7.0, 256);
    assert_eq!(level.misfit(0.0), (0.0, 7.0), "that may still be noise");
    level.add(1.0, 35.0, 9.0, 256);
    assert_eq!(level.misfit(0.0), (30.0, 8.0));
    // The 32 values: 30 more of 30 and 8, then one of 94 and 72 moves the means by a 32nd of the distance.
    for _ in 0..30 {
        level.add(1.0, 30.0, 8.0, 256);
    }
    level.add(1.0, 94.0, 72.0, 256);
    let (unexplained, signal) = level.misfit(0.0);
    assert!((unexplained - 32.0).abs() < 1e-4 && (signal - 10.0).abs() < 1e-4, "{unexplained}, {signal}");
    for _ in 0..1000 {
        level.add(1.0, 26.0, 1.0, 256);
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
