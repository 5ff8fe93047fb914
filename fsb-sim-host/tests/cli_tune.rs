//! `fsb tune` as a process.

use rand::SeedableRng;
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn fsb(directory: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fsb")).current_dir(directory).arg("tune").args(args).output().unwrap()
}

fn json(directory: &Path, args: &[&str]) -> Value {
    let output = fsb(directory, &[args, &["--json"]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

const SENSOR: [&str; 4] = ["--noise-sd", "0.003", "--rate", "100"];

#[test]
fn wishes_are_met() {
    let here = tempfile::tempdir().unwrap();
    for (option, key) in [("--velocity-noise", "velocity_sd"), ("--bandwidth", "bandwidth_hz"), ("--delay", "delay_s")]
    {
        let json = json(here.path(), &[&SENSOR[..], &[option, "0.07"]].concat());
        assert!((number(&json[key]) / 0.07 - 1.0).abs() < 1e-6, "{json}");
        assert!((number(&json["observer"]["lambda"]) / number(&json["observer"]["q"]) - 2.0).abs() < 1e-12, "{json}");
    }
    // A stricter k takes longer.
    let settle = |percent: &str| {
        let args = [&SENSOR[..], &["--k-within", percent, "--gravity", "0", "--acceleration", "0.2"]].concat();
        number(&json(here.path(), &args)["identifier"]["settle_s"])
    };
    assert!(settle("1") > settle("10"));
}

/// A log of a known noise gives that noise.
#[test]
fn the_noise_of_a_log() {
    let here = tempfile::tempdir().unwrap();
    let (mut rng, noise) = (Pcg64::seed_from_u64(5), Normal::new(0.0, 0.004).unwrap());
    let mut log = String::from("t,x,z,fx,fz\n");
    for n in 0..2000 {
        let t = 0.01 * f64::from(n);
        let (x, z) = (-0.8 * (1.3 * t).cos() + 0.2 * (3.1 * t).sin(), 1.0 - 0.5 * (0.9 * t).sin());
        let ax = 0.8 * 1.69 * (1.3 * t).cos() - 0.2 * 9.61 * (3.1 * t).sin();
        let az = 0.5 * 0.81 * (0.9 * t).sin();
        let (x, z) = (x + noise.sample(&mut rng), z + noise.sample(&mut rng));
        log += &format!("{t},{x},{z},{},{}\n", 1.2 * ax, 1.2 * (az + 9.81));
    }
    std::fs::write(here.path().join("log.csv"), log).unwrap();
    let json = json(here.path(), &["--log", "log.csv"]);
    println!("seed 5: {json}");
    for axis in ["x", "z"] {
        assert!((number(&json["log_noise_sd"][axis]) / 0.004 - 1.0).abs() < 0.08, "{json}");
    }
    assert!((number(&json["rate_hz"]) - 100.0).abs() < 1e-6);
}

#[test]
fn the_report_is_written_whole() {
    let here = tempfile::tempdir().unwrap();
    let output = fsb(here.path(), &[&SENSOR[..], &["--out", "out"]].concat());
    assert!(output.status.success());
    let page = std::fs::read_to_string(here.path().join("out/report.html")).unwrap();
    for part in ["The observer's λ", "Time to k", "The first moments", "fsb tune --noise-sd 0.003 --rate 100"] {
        assert!(page.contains(&part.replace('\'', "&#39;")), "{part}");
    }
    assert!(String::from_utf8(output.stdout).unwrap().contains("Expected sd of k"));
}

#[test]
fn bad_input_is_named_and_nothing_is_written() {
    let here = tempfile::tempdir().unwrap();
    let cases: [(&[&str], &str); 10] = [
        (&["--velocity-noise", "5"], "--velocity-noise 5: with this sensor"),
        (&["--delay", "0.001"], "--delay 0.001: with this sensor"),
        (&["--bandwidth", "1e-9"], "--bandwidth 0.000000001: with this sensor"),
        (&["--k-within", "200"], "--k-within 200: must be at most 100 %"),
        (&["--frequency", "80"], "--frequency 80: must be at most half the rate, 50 Hz"),
        (&["--gravity", "0", "--acceleration", "0"], "--acceleration 0 with --gravity 0"),
        (&["--delay", "0.2", "--bandwidth", "1"], "cannot be used with"),
        (&["--noise-sd", "-1"], "--noise-sd"),
        (&["--gravity", "1e300"], "expected a number that is not negative, up to 1e6"),
        (&["--log", "none.csv"], "none.csv: no such file"),
    ];
    for (args, expected) in cases {
        let sensor = if args.contains(&"--noise-sd") { &SENSOR[2..] } else { &SENSOR[..] };
        let output = fsb(here.path(), &[sensor, args, &["--out", "out"]].concat());
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains(expected), "{expected}: {stderr}");
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{stderr}");
        assert!(!here.path().join("out").exists());
    }
    let still: String =
        (0..400).map(|n| format!("{},1.5,{}\n", 0.01 * f64::from(n), 9.81 + f64::from(n % 7))).collect();
    std::fs::write(here.path().join("still.csv"), format!("t,z,fz\n{still}")).unwrap();
    let still = fsb(here.path(), &["--log", "still.csv"]);
    assert!(String::from_utf8_lossy(&still.stderr).contains("still.csv: its noise cannot be measured"));
    assert_eq!((still.status.code(), still.stdout.len()), (Some(2), 0));
    let nothing = fsb(here.path(), &[]);
    assert_eq!(nothing.status.code(), Some(2));
    let help = String::from_utf8(fsb(here.path(), &["--help"]).stdout).unwrap();
    assert!(help.contains("3 there is no flight in the log") && help.contains("docs/tuning.md"));
}
