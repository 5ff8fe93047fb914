//! Recordings as they came: two files of different rates against the same flight resampled, and PX4 logs.
//!
//! The recordings are found through `FSB_FLIGHT_DATA`; where it is not set each test is reported as ignored.

use fsb_core::regression::Identify;
use fsb_sim_host::replay::flight::ThrustUnit;
use fsb_sim_host::replay::lag::Lag;
use fsb_sim_host::replay::summary::Summary;
use fsb_sim_host::replay::{AxisLog, Recording, ReplayOptions, pair, run, ulog};
use libtest_mimic::{Arguments, Failed, Trial};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const VARIABLE: &str = "FSB_FLIGHT_DATA";
/// PX4's own hover thrust in the middle of the simulated flight.
const PX4_HOVER: f64 = 0.490;

/// Test, and its name.
type Named = (&'static str, fn(&Path) -> Result<(), Failed>);

const TESTS: [Named; 6] = [
    ("raw_and_resampled_agree_on_the_mass", raw_and_resampled_agree),
    ("raw_and_resampled_agree_on_drag", raw_and_resampled_agree_on_drag),
    ("raw_and_resampled_agree_on_the_lag", agree_on_the_lag),
    ("velocities_are_twice_as_good_with_drag_and_disturbance", velocities_gain),
    ("px4_hover_thrust", px4_hover_thrust),
    ("px4_bench_log_has_no_flight", px4_bench_log),
];

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let folder = std::env::var_os(VARIABLE).filter(|v| !v.is_empty()).map(PathBuf::from);
    if folder.is_none() {
        eprintln!("{VARIABLE} is not set: the tests on recordings are ignored");
    }
    let trials = TESTS.map(|(name, test)| {
        let (folder, ignored) = (folder.clone(), folder.is_none());
        let kind = if ignored { "FSB_FLIGHT_DATA is not set" } else { "" };
        let run = move || test(&folder.ok_or_else(|| format!("{VARIABLE} is not set"))?);
        Trial::test(name, run).with_kind(kind).with_ignored_flag(ignored)
    });
    libtest_mimic::run(&arguments, trials.into()).exit_code()
}

fn options(identify: Identify) -> ReplayOptions {
    ReplayOptions { identify: Some(identify), ..ReplayOptions::default() }
}

fn raw(folder: &Path, lag: Lag) -> Result<Recording, Failed> {
    let file = |part: &str| folder.join(format!("raw/crazyflie_brushless_37.0g_{part}.csv"));
    let flight = pair::read(&file("mocap"), &file("ctrl"), &pair::Columns::default(), ThrustUnit::Newton)?;
    Ok(Recording::of_flight("raw", flight, lag, &ReplayOptions::default(), || {})?)
}

fn resampled(folder: &Path, lag: Lag) -> Result<Recording, Failed> {
    let log = AxisLog::read(&folder.join("flights/crazyflie_brushless_37.0g.csv"))?;
    Ok(Recording::of_log("resampled", log, lag, &ReplayOptions::default(), || {})?)
}

fn summary(recording: &Recording, identify: Identify) -> Result<Summary, Failed> {
    let options = options(identify);
    Ok(Summary::of(&run(&options, &recording.log)?, recording, options.gravity, true))
}

fn mass(summary: &Summary) -> Result<f64, Failed> {
    Ok(summary.mass.and_then(|mass| mass.value).map(f64::from).ok_or("the mass is not valid")?)
}

fn raw_and_resampled_agree(folder: &Path) -> Result<(), Failed> {
    for identify in [Identify::NOTHING_ELSE, Identify::BOTH] {
        let one = mass(&summary(&raw(folder, Lag::default())?, identify)?)?;
        let other = mass(&summary(&resampled(folder, Lag::default())?, identify)?)?;
        println!("{identify:?}: raw {one} kg, resampled {other} kg");
        check((one / other - 1.0).abs() <= 0.005, || format!("raw {one} kg, resampled {other} kg"))?;
    }
    Ok(())
}

fn raw_and_resampled_agree_on_drag(folder: &Path) -> Result<(), Failed> {
    let one = summary(&raw(folder, Lag::default())?, Identify::BOTH)?;
    let other = summary(&resampled(folder, Lag::default())?, Identify::BOTH)?;
    for axis in ["x", "y"] {
        let drag = |of: &Summary| of.axes.get(axis).and_then(|a| a.terms).and_then(|terms| terms.drag);
        let (one, other) = (drag(&one).ok_or("no D of the raw log")?, drag(&other).ok_or("no D of the resampled log")?);
        println!("D of {axis}: raw {one}, resampled {other}");
        check((one - other).abs() <= 0.05, || format!("D of {axis}: raw {one}, resampled {other}"))?;
    }
    Ok(())
}

/// The offset is one of a few milliseconds in either.
fn agree_on_the_lag(folder: &Path) -> Result<(), Failed> {
    let (one, other) = (raw(folder, Lag::Auto)?.lag, resampled(folder, Lag::Auto)?.lag);
    println!("lag: raw {one} s, resampled {other} s");
    check(one.abs() <= 0.01 && other.abs() <= 0.01, || format!("lag: raw {one} s, resampled {other} s"))
}

fn velocities_gain(folder: &Path) -> Result<(), Failed> {
    for name in ["crazyflie_brushless_37.0g", "crazyflie_brushed_34.7g"] {
        let log = AxisLog::read(&folder.join(format!("flights/{name}.csv")))?;
        let error = |identify, axis: &str| -> Result<f64, Failed> {
            let summary = Summary::from(&run(&options(identify), &log)?);
            Ok(summary.axes.get(axis).and_then(|a| a.velocity_rms_error).ok_or("no velocity error")?)
        };
        for axis in ["x", "y"] {
            let (with, without) = (error(Identify::BOTH, axis)?, error(Identify::NOTHING_ELSE, axis)?);
            println!("{name} {axis}: {with} m/s with D and d, {without} without");
            check(with <= 0.5 * without, || format!("{name} {axis}: {with} m/s with D and d, {without} without"))?;
        }
    }
    Ok(())
}

fn px4_hover_thrust(folder: &Path) -> Result<(), Failed> {
    let flight = ulog::read(&folder.join("ulog/sample_px4_events.ulg"), None)?;
    // Positions at 10 Hz: the default observer is too fast for them.
    let slow = ReplayOptions { observer: fsb_core::Tuning::from_lambda(5.0), ..options(Identify::NOTHING_ELSE) };
    let recording = Recording::of_flight("log", flight, Lag::default(), &slow, || {})?;
    let summary = Summary::of(&run(&slow, &recording.log)?, &recording, slow.gravity, true);
    let hover = summary.hover_thrust.ok_or("no hover thrust")?;
    println!("{hover:?}");
    let (value, px4) = (hover.value.ok_or("not valid")?, hover.px4.ok_or("none of PX4's own")?);
    check((px4 / PX4_HOVER - 1.0).abs() <= 0.005, || format!("PX4's own {px4}"))?;
    check((value / PX4_HOVER - 1.0).abs() <= 0.015, || format!("hover thrust {value}, PX4's own {px4}"))
}

fn px4_bench_log(folder: &Path) -> Result<(), Failed> {
    match ulog::read(&folder.join("ulog/sample.ulg"), None) {
        Err(error) if error.is_no_flight() && error.to_string().contains("no flight in this log") => Ok(()),
        other => Err(format!("{other:?}").into()),
    }
}

fn check(holds: bool, complaint: impl FnOnce() -> String) -> Result<(), Failed> {
    if holds { Ok(()) } else { Err(complaint().into()) }
}
