//! Whether what is left is noise: the innovations' autocorrelation against that of white measurement noise.
//!
//! An observer's innovations are not white even where the model is right: steady, white noise n arrives in them as
//! ((1 - z⁻¹)/(1 - p z⁻¹))² n, p = e^(-λT). The autocorrelation expected of that is taken away, and of the rest the statistic of
//! Ljung and Box, Q = N (N+2) Σ (r_j - ρ_j)²/(N-j) over m lags, is compared with the value that a χ² variable of m degrees exceeds
//! once in twenty times.

/// The innovations of one axis, judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Whiteness {
    /// How many there are.
    pub count: usize,
    /// Root mean square \[m\].
    pub rms: f64,
    /// Autocorrelation at lags 1, 2, ….
    pub correlation: Vec<f64>,
    /// What white measurement noise would give.
    pub expected: Vec<f64>,
    /// Q.
    pub statistic: f64,
    /// What Q exceeds once in twenty times where measurement noise is all there is.
    pub limit: f64,
}

/// Lags that are looked at.
const LAGS: usize = 40;
/// Innovations of the first 3/λ are those of a window that opens.
const OPENING: f64 = 3.0;

impl Whiteness {
    /// Judges innovations \[m\] `period` \[s\] apart, of an observer with `lambda` \[1/s\]. `None` where there are too few.
    #[must_use]
    pub fn of(innovations: &[Option<f32>], lambda: f64, period: f64) -> Option<Self> {
        let first = innovations.iter().position(Option::is_some)?;
        let skip = first + (OPENING / (lambda * period)).ceil() as usize;
        let x: Vec<Option<f64>> = innovations.iter().skip(skip).map(|x| x.map(f64::from)).collect();
        let count = x.iter().flatten().count();
        let lags = LAGS.min(count / 4);
        let power = x.iter().flatten().map(|x| x * x).sum::<f64>();
        if lags == 0 || power <= 0.0 {
            return None;
        }
        let correlation: Vec<f64> = (1..=lags)
            .map(|lag| {
                let products = x.iter().zip(x.iter().skip(lag)).filter_map(|(a, b)| a.zip(*b));
                products.map(|(a, b)| a * b).sum::<f64>() / power
            })
            .collect();
        let expected = of_white_noise((-lambda * period).exp(), lags);
        let n = count as f64;
        let statistic = correlation
            .iter()
            .zip(&expected)
            .enumerate()
            .map(|(i, (r, rho))| n * (n + 2.0) * (r - rho).powi(2) / (n - i as f64 - 1.0))
            .sum();
        Some(Self { count, rms: (power / n).sqrt(), correlation, expected, statistic, limit: chi_squared(lags) })
    }

    /// Whether measurement noise can be all there is.
    #[must_use]
    pub fn is_white(&self) -> bool {
        self.statistic <= self.limit
    }
}

/// Autocorrelation of ((1 - z⁻¹)/(1 - p z⁻¹))² of white noise.
fn of_white_noise(p: f64, lags: usize) -> Vec<f64> {
    let length = lags + (40.0 / (1.0 - p).max(1e-6)).min(1e6) as usize;
    let (mut first, mut second, mut held) = (0.0, 0.0, (0.0, 0.0));
    let response: Vec<f64> = (0..length)
        .map(|n| {
            let input = if n == 0 { 1.0 } else { 0.0 };
            first = p * first + input - held.0;
            second = p * second + first - held.1;
            held = (input, first);
            second
        })
        .collect();
    let product = |lag: usize| response.iter().zip(response.iter().skip(lag)).map(|(a, b)| a * b).sum::<f64>();
    let power = product(0);
    (1..=lags).map(|lag| product(lag) / power).collect()
}

/// What a χ² variable of `degrees` exceeds once in twenty times, by the cube-root rule of Wilson and Hilferty.
fn chi_squared(degrees: usize) -> f64 {
    let (m, normal) = (degrees as f64, 1.644_853_627);
    m * (1.0 - 2.0 / (9.0 * m) + normal * (2.0 / (9.0 * m)).sqrt()).powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    #[test]
    fn known_values() {
        // Tables: 18.307 for 10 degrees, 55.758 for 40.
        assert!((chi_squared(10) - 18.307).abs() < 0.05 && (chi_squared(40) - 55.758).abs() < 0.05);
        // p = 0: the second difference of noise, 1, -4/6, 1/6, 0.
        let rho = of_white_noise(0.0, 3);
        assert!((rho[0] + 4.0 / 6.0).abs() < 1e-12 && (rho[1] - 1.0 / 6.0).abs() < 1e-12 && rho[2].abs() < 1e-12);
    }

    /// Noise through the observer's own filter is told as white nearly always, with a slow wave never.
    #[test]
    fn noise_is_white_and_a_wave_is_not() {
        let (lambda, period) = (10.0, 0.01);
        let p = f64::exp(-lambda * period);
        let (mut white, mut wavy) = (0, 0);
        for seed in 0..100 {
            let mut rng = Pcg64::seed_from_u64(seed);
            let (mut first, mut second, mut held) = (0.0, 0.0, (0.0, 0.0));
            let noise: Vec<f64> = (0..1000)
                .map(|_| {
                    let input = (0..12).map(|_| rng.random_range(-0.5..0.5)).sum::<f64>();
                    first = p * first + input - held.0;
                    second = p * second + first - held.1;
                    held = (input, first);
                    second
                })
                .collect();
            let told = |x: &[f64]| {
                let innovations: Vec<Option<f32>> = x.iter().map(|&x| Some(x as f32)).collect();
                Whiteness::of(&innovations, lambda, period).is_some_and(|w| w.is_white())
            };
            white += i32::from(told(&noise));
            let wave: Vec<f64> = noise.iter().enumerate().map(|(n, x)| x + 0.6 * (0.03 * n as f64).sin()).collect();
            wavy += i32::from(told(&wave));
        }
        assert!(white >= 85 && wavy <= 5, "{white} and {wavy} of 100 (seeds 0 to 99)");
    }
}
