//! The sensors' faults against what they are configured to be. Statistical bounds hold with 99.9 % (3.29 standard errors) each,
//! for the fixed seeds.

use fsb_sim_host::hexarotor::Quaternion;
use fsb_sim_host::hexarotor::vector::{Vector, difference, norm, scaled};
use fsb_sim_host::sensors::{Measurement, Quantity, Sensor, SensorConfig};
use fsb_sim_host::statistics::Summary;

/// 1 kHz.
const TICK: f64 = 1e-3;
const Z: f64 = 3.29;

fn built<Q: Quantity>(config: &SensorConfig, seed: u64) -> Sensor<Q> {
    println!("seed {seed}, {config:?}");
    Sensor::new(config, TICK, seed).unwrap()
}

/// A motion along x at 2 m/s, so a position tells its time.
fn moving(tick: usize) -> Vector {
    [2.0 * tick as f64 * TICK, 1.0, -3.0]
}

fn arrivals(config: &SensorConfig, seed: u64, ticks: usize) -> Vec<Option<Measurement<Vector>>> {
    let mut sensor = built(config, seed);
    (0..ticks).map(|tick| sensor.tick(&moving(tick))).collect()
}

fn share_is(count: usize, of: usize, expected: f64) {
    let (share, error) = (count as f64 / of as f64, (expected * (1.0 - expected) / of as f64).sqrt());
    assert!((share - expected).abs() < Z * error, "{share} against {expected}");
}

fn is_normal(values: &[f64], sd: f64) {
    let (found, n) = (Summary::of(values), values.len() as f64);
    assert!(found.mean.abs() < Z * sd / n.sqrt(), "{found:?}");
    assert!((found.sd / sd - 1.0).abs() < Z * found.sd_relative_error(), "{found:?}");
    // The fourth moment of a normal is 3, with a variance of (105 - 9)/n; a uniform would have 1.8.
    let fourth = values.iter().map(|value| (value / sd).powi(4)).sum::<f64>() / n;
    assert!((fourth - 3.0).abs() < Z * (96.0 / n).sqrt(), "fourth moment {fourth}");
    let neighbours = values.windows(2).map(|two| two[0] * two[1]).sum::<f64>() / (n * sd * sd);
    assert!(neighbours.abs() < Z / n.sqrt(), "correlation of neighbours {neighbours}");
}

#[test]
fn without_faults_the_truth_arrives_at_once() {
    for (tick, arrived) in arrivals(&SensorConfig::default(), 1, 100).into_iter().enumerate() {
        let expected = Measurement {
            value: moving(tick),
            tick: tick as u64,
            age: 0,
            taken_at: tick as f64 * TICK,
            outlier: false,
        };
        assert_eq!(arrived, Some(expected));
    }
}

#[test]
fn position_noise_is_normal_and_independent() {
    let config = SensorConfig { noise_sd: 0.01, ..Default::default() };
    let mut sensor = built::<Vector>(&config, 2);
    let errors: Vec<Vector> =
        (0..50_000).map(|_| difference(sensor.tick(&[5.0; 3]).unwrap().value, [5.0; 3])).collect();
    for axis in 0..3 {
        is_normal(&errors.iter().map(|error| error[axis]).collect::<Vec<_>>(), 0.01);
        let next = (axis + 1) % 3;
        let cross = errors.iter().map(|error| error[axis] * error[next]).sum::<f64>() / (50_000.0 * 1e-4);
        assert!(cross.abs() < Z / 50_000_f64.sqrt(), "axes {axis} and {next}: {cross}");
    }
}

/// The noise of an attitude is a rotation about body axes, here at 1.2 rad of pitch where Euler angles would not do.
#[test]
fn attitude_noise_is_a_small_rotation() {
    let truth = Quaternion::from_euler([0.3, 1.2, -2.0]);
    let mut sensor = built::<Quaternion>(&SensorConfig { noise_sd: 0.005, ..Default::default() }, 3);
    let errors: Vec<Vector> = (0..50_000)
        .map(|_| {
            let value = sensor.tick(&truth).unwrap().value;
            assert!((value.0.iter().map(|part| part * part).sum::<f64>() - 1.0).abs() < 1e-14);
            // R_trueᵀ R_measured, its skew part is the rotation vector up to the third order.
            let m = truth.inverse().then_in_body(&value).matrix();
            scaled(0.5, [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]])
        })
        .collect();
    for axis in 0..3 {
        is_normal(&errors.iter().map(|error| error[axis]).collect::<Vec<_>>(), 0.005);
    }
}

#[test]
fn a_latency_is_met_to_the_tick() {
    for (latency, ticks) in [(0.0, 0), (0.001, 1), (0.08, 80), (0.0123, 12), (0.0127, 13)] {
        for rate in [None, Some(100.0)] {
            let config = SensorConfig { latency, rate, ..Default::default() };
            let every = if rate.is_some() { 10 } else { 1 };
            for (tick, arrived) in arrivals(&config, 4, 400).into_iter().enumerate() {
                let taken = tick.checked_sub(ticks).filter(|taken| taken % every == 0);
                assert_eq!(arrived.map(|m| m.value), taken.map(moving), "tick {tick}");
                if let (Some(m), Some(taken)) = (arrived, taken) {
                    assert_eq!((m.tick, m.age), (taken as u64, ticks as u64));
                }
            }
        }
    }
}

/// Uniform from 20 to 50 ms while samples are 100 ms apart: every one arrives, at ages of that mean and spread.
#[test]
fn the_jitter_of_the_latency_is_uniform() {
    let config = SensorConfig { rate: Some(10.0), latency: 0.02, latency_jitter: 0.03, ..Default::default() };
    let found = arrivals(&config, 5, 1_000_000);
    let ages: Vec<f64> = found.iter().flatten().map(|m| m.age as f64 * TICK).collect();
    assert_eq!(ages.len(), 10_000);
    assert!(ages.iter().all(|age| (0.0195..0.0505).contains(age)));
    let summary = Summary::of(&ages);
    // Rounding to ticks adds T²/12 to the variance of a uniform of 30 ms.
    let sd = ((0.03_f64.powi(2) + TICK * TICK) / 12.0).sqrt();
    assert!((summary.mean - 0.035).abs() < Z * sd / 100.0, "{summary:?}");
    // The relative standard error of the sd of a uniform: √((9/5 - 1)/4n).
    assert!((summary.sd / sd - 1.0).abs() < Z * (0.2 / 10_000_f64).sqrt(), "{summary:?}");
}

/// At 1 kHz with 10 ms of jitter samples overtake each other: what arrives is in order, no older than it can be.
#[test]
fn an_overtaken_sample_is_lost() {
    let config = SensorConfig { latency: 0.005, latency_jitter: 0.01, ..Default::default() };
    let found = arrivals(&config, 6, 20_000);
    let taken: Vec<u64> = found.iter().flatten().map(|m| m.tick).collect();
    assert!(taken.windows(2).all(|two| two[0] < two[1]));
    assert!(found.iter().flatten().all(|m| (5..=15).contains(&m.age) && m.value == moving(m.tick as usize)));
    assert!(taken.len() > 5_000 && taken.len() < 15_000, "{}", taken.len());
}

/// The position tells when it was really taken: up to 8 ms before its tick, uniformly, and `taken_at` says so.
#[test]
fn the_sampling_jitter_is_in_the_value_and_in_the_time() {
    let config = SensorConfig { rate: Some(100.0), sampling_jitter: 0.008, ..Default::default() };
    let found: Vec<_> = arrivals(&config, 7, 100_000).into_iter().flatten().collect();
    let mut early = Vec::new();
    for m in found.iter().skip(1) {
        assert!((m.value[0] / 2.0 - m.taken_at).abs() < 1e-12, "{m:?}");
        early.push(m.tick as f64 * TICK - m.taken_at);
    }
    assert_eq!((found.len(), found[0].value), (10_000, moving(0)));
    assert!(early.iter().all(|by| (-1e-12..0.008 + 1e-12).contains(by)));
    let (summary, sd) = (Summary::of(&early), 0.008 / 12_f64.sqrt());
    assert!((summary.mean - 0.004).abs() < Z * sd / 100.0, "{summary:?}");
    assert!((summary.sd / sd - 1.0).abs() < Z * (0.2 / 10_000_f64).sqrt(), "{summary:?}");
}

/// An attitude between two ticks lies on the rotation between them.
#[test]
fn an_attitude_is_interpolated_along_its_rotation() {
    let config = SensorConfig { sampling_jitter: TICK, ..Default::default() };
    let mut sensor = built::<Quaternion>(&config, 8);
    let rates = [0.3, -2.0, 4.0];
    for tick in 0..3000 {
        let at = |t: f64| Quaternion::from_rotation_vector(scaled(t, rates));
        let m = sensor.tick(&at(f64::from(tick) * TICK)).unwrap();
        assert!(norm(m.value.error_of(&at(m.taken_at))) < 1e-14, "{m:?}");
    }
}

#[test]
fn dropouts_have_their_share_and_are_independent() {
    let config = SensorConfig { rate: Some(200.0), dropout: 0.3, ..Default::default() };
    let found = arrivals(&config, 9, 200_000);
    assert!(found.iter().enumerate().all(|(tick, m)| tick % 5 == 0 || m.is_none()));
    let there: Vec<bool> = found.iter().step_by(5).map(Option::is_some).collect();
    share_is(there.iter().filter(|&&there| !there).count(), 40_000, 0.3);
    let pairs: Vec<_> = there.chunks(2).collect();
    share_is(pairs.iter().filter(|pair| ***pair == [false, false]).count(), pairs.len(), 0.09);
    assert!(arrivals(&SensorConfig { dropout: 1.0, ..config }, 9, 1000).iter().all(Option::is_none));
}

/// A gap is of samples taken: with a latency of 80 ms what is missing is missing 80 ms later.
#[test]
fn gaps_are_where_they_are_scheduled() {
    let gaps = vec![[1.0, 2.0], [3.0, 3.1], [4.0, f64::INFINITY]];
    let config = SensorConfig { gaps, latency: 0.08, ..Default::default() };
    for (tick, arrived) in arrivals(&config, 10, 6000).into_iter().enumerate() {
        let missing = tick < 80 || matches!(tick - 80, 1000..2000 | 3000..3100 | 4000..);
        assert_eq!(arrived.is_none(), missing, "tick {tick}");
    }
}

/// Outliers have their share and their size, in directions that average out, and all others are exact.
#[test]
fn outliers_have_their_share_size_and_directions() {
    let config = SensorConfig { outlier: 0.05, outlier_size: 3.0, ..Default::default() };
    let found: Vec<_> = arrivals(&config, 11, 60_000).into_iter().flatten().collect();
    let errors: Vec<Vector> = found.iter().map(|m| difference(m.value, moving(m.tick as usize))).collect();
    let off: Vec<Vector> = errors.iter().copied().filter(|&error| norm(error) > 0.0).collect();
    assert!(found.iter().zip(&errors).all(|(m, &error)| m.outlier == (norm(error) > 0.0)));
    assert!(off.iter().all(|&error| (norm(error) - 3.0).abs() < 1e-12));
    share_is(off.len(), 60_000, 0.05);
    for axis in 0..3 {
        // A component of a uniform direction is uniform in -1..1: variance 1/3.
        let summary = Summary::of(&off.iter().map(|error| error[axis] / 3.0).collect::<Vec<_>>());
        let n = off.len() as f64;
        assert!(summary.mean.abs() < Z / (3.0 * n).sqrt(), "{summary:?}");
        assert!((summary.sd * 3_f64.sqrt() - 1.0).abs() < Z * (0.2 / n).sqrt(), "{summary:?}");
    }
    let mut attitude = built::<Quaternion>(&SensorConfig { outlier: 1.0, outlier_size: 0.5, ..Default::default() }, 11);
    let truth = Quaternion::from_euler([0.1, 0.2, 0.3]);
    let angle = norm(truth.error_of(&attitude.tick(&truth).unwrap().value));
    assert!((angle - 0.5).abs() < 1e-12, "{angle}");
}

#[test]
fn quantisation_rounds_to_the_nearest_step() {
    let config = SensorConfig { resolution: 0.05, ..Default::default() };
    let value = built::<Vector>(&config, 12).tick(&[1.024, -0.026, 0.0]).unwrap().value;
    assert!(norm(difference(value, [1.0, -0.05, 0.0])) < 1e-15, "{value:?}");
    let attitude = Quaternion::from_euler([0.124, -0.376, 2.01]);
    let euler = built::<Quaternion>(&config, 12).tick(&attitude).unwrap().value.euler();
    assert!(norm(difference(euler, [0.1, -0.4, 2.0])) < 1e-14, "{euler:?}");
}

/// The faults have nothing to do with each other: of the half that is not dropped, sampling instants and latencies are uniform
/// as ever, a tenth are outliers, and the two kinds of jitter are not correlated.
#[test]
fn faults_are_independent_of_each_other() {
    let (rate, jitter) = (Some(10.0), 0.05);
    let config = SensorConfig {
        rate,
        dropout: 0.5,
        outlier: 0.1,
        outlier_size: 1.0,
        latency_jitter: jitter,
        sampling_jitter: jitter,
        ..Default::default()
    };
    let found: Vec<_> = arrivals(&config, 15, 2_000_000).into_iter().flatten().collect();
    let n = found.len() as f64;
    share_is(found.len(), 20_000, 0.5);
    share_is(found.iter().filter(|m| m.outlier).count(), found.len(), 0.1);
    let sd = jitter / 12_f64.sqrt();
    let early: Vec<f64> = found.iter().map(|m| m.tick as f64 * TICK - m.taken_at).collect();
    let late: Vec<f64> = found.iter().map(|m| m.age as f64 * TICK).collect();
    for values in [&early, &late] {
        let mean = Summary::of(values).mean;
        assert!((mean - jitter / 2.0).abs() < Z * sd / n.sqrt(), "{mean}");
    }
    let products = early.iter().zip(&late).map(|(e, l)| (e - jitter / 2.0) * (l - jitter / 2.0));
    let correlation = products.sum::<f64>() / (n * sd * sd);
    assert!(correlation.abs() < Z / n.sqrt(), "{correlation}");
}

/// All faults at once: the same seed the same, another another; and a fault more leaves the draws of the others alone.
#[test]
fn a_seed_gives_its_measurements() {
    let config = SensorConfig {
        rate: Some(200.0),
        noise_sd: 0.01,
        resolution: 0.001,
        latency: 0.02,
        latency_jitter: 0.01,
        sampling_jitter: 0.001,
        dropout: 0.2,
        gaps: vec![[0.5, 0.6]],
        outlier: 0.02,
        outlier_size: 1.0,
    };
    assert_eq!(arrivals(&config, 13, 3000), arrivals(&config, 13, 3000));
    assert_ne!(arrivals(&config, 13, 3000), arrivals(&config, 14, 3000));
    let noise = SensorConfig { noise_sd: 0.01, ..Default::default() };
    let more = SensorConfig { dropout: 0.5, outlier: 0.1, outlier_size: 5.0, ..noise.clone() };
    let (alone, with) = (arrivals(&noise, 13, 1000), arrivals(&more, 13, 1000));
    let both: Vec<_> = alone.iter().zip(&with).filter(|(_, with)| with.is_some_and(|m| !m.outlier)).collect();
    assert!(both.len() > 300 && both.iter().all(|(alone, with)| alone == with));
}

#[test]
fn refusals_name_the_parameter() {
    let good = SensorConfig::default;
    let cases = [
        (SensorConfig { rate: Some(0.0), ..good() }, "rate"),
        (SensorConfig { rate: Some(300.0), ..good() }, "rate"),
        (SensorConfig { rate: Some(2000.0), ..good() }, "rate"),
        (SensorConfig { rate: Some(f64::NAN), ..good() }, "rate"),
        (SensorConfig { noise_sd: -0.1, ..good() }, "noise_sd"),
        (SensorConfig { resolution: f64::NAN, ..good() }, "resolution"),
        (SensorConfig { latency: -0.1, ..good() }, "latency"),
        (SensorConfig { latency: 61.0, ..good() }, "latency"),
        (SensorConfig { latency_jitter: f64::INFINITY, ..good() }, "latency_jitter"),
        (SensorConfig { sampling_jitter: 0.002, ..good() }, "sampling_jitter"),
        (SensorConfig { dropout: 1.1, ..good() }, "dropout"),
        (SensorConfig { outlier: -0.1, ..good() }, "outlier"),
        (SensorConfig { outlier_size: f64::NAN, ..good() }, "outlier_size"),
        (SensorConfig { gaps: vec![[2.0, 1.0]], ..good() }, "gaps"),
        (SensorConfig { gaps: vec![[f64::NAN, 1.0]], ..good() }, "gaps"),
    ];
    for (config, name) in cases {
        assert_eq!(config.check(TICK).unwrap_err().name, name, "{config:?}");
    }
    assert_eq!(good().check(0.0).unwrap_err().name, "period");
    assert_eq!(good().check(TICK), Ok(()));
    let error = serde_json::from_str::<SensorConfig>(r#"{ "noise": 0.1 }"#).unwrap_err().to_string();
    assert!(error.contains("unknown field `noise`"), "{error}");
    let read: SensorConfig = serde_json::from_str(r#"{ "rate": 10, "gaps": [[1, 2]] }"#).unwrap();
    assert_eq!(read, SensorConfig { rate: Some(10.0), gaps: vec![[1.0, 2.0]], ..good() });
}
