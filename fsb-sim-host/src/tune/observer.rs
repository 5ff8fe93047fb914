//! The observer in steady state, p = e^(-λT).
//!
//! What the input does is predicted and passes without delay or loss, whatever λ is. Bandwidth and delay are those for what
//! the model does not know: drag, gusts, an error of k.

use super::Sensor;

/// Standard deviation of the velocity \[m/s\]: σ √(2 (1-p)³/(1+p)³)/T.
#[must_use]
pub fn velocity_sd(sensor: &Sensor, lambda: f64) -> f64 {
    sensor.noise_sd * (2.0 * share(lambda * sensor.period).powi(3)).sqrt() / sensor.period
}

/// Standard deviation of the position \[m\]: σ √((1-p)(1+4p+5p²)/(1+p)³).
#[must_use]
pub fn position_sd(sensor: &Sensor, lambda: f64) -> f64 {
    let p = (-lambda * sensor.period).exp();
    let closed = -(-lambda * sensor.period).exp_m1();
    sensor.noise_sd * (closed * (1.0 + p * (4.0 + 5.0 * p)) / (1.0 + p).powi(3)).sqrt()
}

/// How late a slow change of the velocity that the model does not know is seen \[s\]: T/2 + 2 T p/(1-p), 2/λ where λT is small.
#[must_use]
pub fn delay(sensor: &Sensor, lambda: f64) -> f64 {
    let x = lambda * sensor.period;
    sensor.period * (0.5 + 2.0 / x.exp_m1())
}

/// The frequency \[Hz\] at which 0.71 is left of a velocity that the model does not know; 0.102 λ where λT is small.
#[must_use]
pub fn bandwidth(sensor: &Sensor, lambda: f64) -> f64 {
    // |H| = ((1-p)/|1 - p e^(-jωT)|)² sin(ωT/2)/(ωT/2) falls from 1; at half the sampling rate it is below 0.64.
    let (mut low, mut high) = (0.0, std::f64::consts::PI / sensor.period);
    for _ in 0..100 {
        let middle = f64::midpoint(low, high);
        if response(sensor, lambda, middle) > std::f64::consts::FRAC_1_SQRT_2 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low / std::f64::consts::TAU
}

fn response(sensor: &Sensor, lambda: f64, omega: f64) -> f64 {
    let (t, p) = (sensor.period, (-lambda * sensor.period).exp());
    let half = omega * t / 2.0;
    // |1 - p e^(-jωT)|² = (1-p)² + 4 p sin²(ωT/2)
    let closed = (-lambda * t).exp_m1().powi(2);
    closed / (closed + 4.0 * p * half.sin().powi(2)) * half.sin() / half
}

/// The λ \[1/s\] at which the velocity has this standard deviation: (1-p)/(1+p) = (v T/σ)^⅔ 2^(-⅓).
#[must_use]
pub fn lambda_for_velocity_sd(sensor: &Sensor, sd: f64) -> f64 {
    let x = (sd * sensor.period / sensor.noise_sd).powf(2.0 / 3.0) / 2f64.cbrt();
    // p = (1-x)/(1+x), -ln p = 2 artanh x
    if x < 1.0 { 2.0 * x.atanh() / sensor.period } else { f64::INFINITY }
}

/// The λ \[1/s\] at which the delay is this \[s\].
#[must_use]
pub fn lambda_for_delay(sensor: &Sensor, delay: f64) -> f64 {
    let beyond = delay / sensor.period - 0.5;
    if beyond > 0.0 { (2.0 / beyond).ln_1p() / sensor.period } else { f64::INFINITY }
}

/// The λ \[1/s\] at which the bandwidth is this \[Hz\], within what the core accepts; 0 or infinity beyond.
#[must_use]
pub fn lambda_for_bandwidth(sensor: &Sensor, wanted: f64) -> f64 {
    let (mut low, mut high) = sensor.lambdas();
    if bandwidth(sensor, high) < wanted {
        return f64::INFINITY;
    }
    if bandwidth(sensor, low) > wanted * (1.0 + 1e-9) {
        return 0.0;
    }
    for _ in 0..200 {
        let middle = (low * high).sqrt();
        if bandwidth(sensor, middle) < wanted { low = middle } else { high = middle }
    }
    high
}

/// (1-p)/(1+p) = tanh(λT/2)
fn share(x: f64) -> f64 {
    (x / 2.0).tanh()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SENSOR: Sensor = Sensor { noise_sd: 0.003, period: 0.01 };

    #[test]
    fn each_wish_is_met_by_its_lambda() {
        for lambda in [0.3, 2.0, 10.0, 80.0] {
            let near = |found: f64| assert!((found / lambda - 1.0).abs() < 1e-9, "{found} is not {lambda}");
            near(lambda_for_velocity_sd(&SENSOR, velocity_sd(&SENSOR, lambda)));
            near(lambda_for_delay(&SENSOR, delay(&SENSOR, lambda)));
            near(lambda_for_bandwidth(&SENSOR, bandwidth(&SENSOR, lambda)));
        }
    }

    /// The continuous observer λ²/(s+λ)²: half power at ω = λ √(√2 - 1), delay 2/λ.
    #[test]
    fn at_a_high_rate_it_is_the_continuous_one() {
        let fast = Sensor { noise_sd: 1.0, period: 1e-5 };
        let expected = 10.0 * (2f64.sqrt() - 1.0).sqrt() / std::f64::consts::TAU;
        assert!((bandwidth(&fast, 10.0) / expected - 1.0).abs() < 1e-3);
        assert!((delay(&fast, 10.0) - 0.2).abs() < 1e-4);
    }
}
