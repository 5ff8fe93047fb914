//! Recorded flights of small multirotors through the f32 core, by `fsb replay`'s own path.
//!
//! The recordings are found through `FSB_FLIGHT_DATA`; where it is not set each test is reported as ignored.
//! The masses are what a correct estimator reads with k alone, the thrust curve of each vehicle being off by a few percent.

use fsb_core::Tuning;
use fsb_sim_host::replay::summary::Summary;
use fsb_sim_host::replay::{AxisLog, ReplayOptions, run};
use libtest_mimic::{Arguments, Failed, Trial};
use std::path::PathBuf;
use std::process::ExitCode;

const VARIABLE: &str = "FSB_FLIGHT_DATA";

/// Log, mass [kg]
const MASSES: [(&str, f32); 4] = [
    ("crazyflie_brushless_37.0g", 0.0385),
    ("crazyflie_brushed_34.7g", 0.0349),
    ("crazyflie_payload_44.4g", 0.0450),
    ("nanobench_lissajous_fast", 0.0452),
];
const MASS_TOLERANCE: f32 = 0.0003;

/// Log, λ of the observer [1/s], rms error of x and y velocity [m/s]: measured with an f64 observer that predicts with k
/// alone, drag being what remains.
const VELOCITIES: [(&str, f64, [f64; 2]); 3] = [
    ("crazyflie_brushed_34.7g", 5.0, [0.122, 0.108]),
    ("crazyflie_brushless_37.0g", 10.0, [0.058, 0.051]),
    ("nanobench_lissajous_fast", 20.0, [0.032, 0.026]),
];
const VELOCITY_TOLERANCE: f64 = 0.1;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let folder = std::env::var_os(VARIABLE).filter(|v| !v.is_empty()).map(PathBuf::from);
    if folder.is_none() {
        eprintln!("{VARIABLE} is not set: the tests on recorded flights are ignored");
    }
    let mut trials = Vec::new();
    for (name, mass) in MASSES {
        trials.push(trial(format!("mass_of_{name}"), &folder, move |folder| has_mass(folder, name, mass)));
        trials.push(trial(format!("velocity_of_{name}_is_sane"), &folder, move |folder| is_sane(folder, name)));
    }
    for (name, lambda, expected) in VELOCITIES {
        let title = format!("velocity_of_{name}_agrees_with_f64");
        trials.push(trial(title, &folder, move |folder| has_velocity(folder, name, lambda, expected)));
    }
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn trial(
    name: String,
    folder: &Option<PathBuf>,
    test: impl FnOnce(PathBuf) -> Result<(), Failed> + Send + 'static,
) -> Trial {
    let folder = folder.clone();
    let ignored = folder.is_none();
    let kind = if ignored { "FSB_FLIGHT_DATA is not set" } else { "" };
    let run = move || test(folder.ok_or_else(|| format!("{VARIABLE} is not set"))?);
    Trial::test(name.replace('.', "_"), run).with_kind(kind).with_ignored_flag(ignored)
}

fn replay(folder: PathBuf, name: &str, options: &ReplayOptions) -> Result<Summary, Failed> {
    let log = AxisLog::read(&folder.join("flights").join(format!("{name}.csv")))?;
    Ok(Summary::from(&run(options, &log)?))
}

fn has_mass(folder: PathBuf, name: &str, expected: f32) -> Result<(), Failed> {
    let summary = replay(folder, name, &ReplayOptions::default())?;
    let mass = summary.mass.ok_or("no mass")?;
    let value = mass.value.ok_or("the mass is not valid")?;
    let along_z = summary.axes.get("z").and_then(|z| z.k).ok_or("k of z is not valid")?;
    println!("{name}: {value} kg (expected {expected}), sd {:?}, z alone {}", mass.sd, 1.0 / along_z);
    check(mass.valid && (value - expected).abs() <= MASS_TOLERANCE, || format!("mass {value} kg"))?;
    check(mass.sd.is_some_and(|sd| sd > 0.0 && sd < 0.05 * value), || format!("sd {:?}", mass.sd))?;
    check((1.0 / along_z - expected).abs() <= 2.0 * MASS_TOLERANCE, || format!("z alone {} kg", 1.0 / along_z))
}

/// At the default λ = 10, drag not modelled; the slowest of the flights reaches 1 m/s along x.
fn is_sane(folder: PathBuf, name: &str) -> Result<(), Failed> {
    let summary = replay(folder, name, &ReplayOptions::default())?;
    for (axis, limit) in [("x", 0.1), ("y", 0.1), ("z", 0.04)] {
        let error = summary.axes.get(axis).and_then(|a| a.velocity_rms_error).ok_or("no velocity error")?;
        println!("{name} {axis}: velocity rms error {error} m/s");
        check(error < limit, || format!("{axis}: velocity rms error {error} m/s, limit {limit}"))?;
    }
    Ok(())
}

fn has_velocity(folder: PathBuf, name: &str, lambda: f64, expected: [f64; 2]) -> Result<(), Failed> {
    let options = ReplayOptions { observer: Tuning::from_lambda(lambda), ..ReplayOptions::default() };
    let summary = replay(folder, name, &options)?;
    for (axis, expected) in ["x", "y"].into_iter().zip(expected) {
        let error = summary.axes.get(axis).and_then(|a| a.velocity_rms_error).ok_or("no velocity error")?;
        println!("{name} {axis}: velocity rms error {error} m/s at λ = {lambda} (f64: {expected})");
        check((error / expected - 1.0).abs() <= VELOCITY_TOLERANCE, || format!("{axis}: {error} m/s, f64 {expected}"))?;
    }
    Ok(())
}

fn check(holds: bool, complaint: impl FnOnce() -> String) -> Result<(), Failed> {
    if holds { Ok(()) } else { Err(complaint().into()) }
}
