//! k, drag and disturbance from recorded flights of small multirotors, through the f32 core.
//!
//! The recordings are found through `FSB_FLIGHT_DATA`; where it is not set each test is reported as ignored. The figures to
//! compare with are those of an f64 batch fit to every sample.

use fsb_core::Tuning;
use fsb_core::moments::InputMoments;
use fsb_core::observer::{Gains, ObserverDesign};
use fsb_core::regression::{AxisTerms, DragConfig, DragEstimator, DragModel, DragObserver, Identify, Term};
use fsb_core::window::Window;
use fsb_sim_host::replay::AxisLog;
use fsb_sim_host::replay::log::AxisColumn;
use libtest_mimic::{Arguments, Failed, Trial};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const VARIABLE: &str = "FSB_FLIGHT_DATA";

/// What an f64 fit says of a flight.
#[derive(Clone, Copy)]
struct Expected {
    log: &'static str,
    /// Residual rms [m/s²] of k alone, of k and D, of k, D and d.
    residual: Option<[f64; 3]>,
    /// From k, D and d [kg].
    mass: f64,
    /// D of x and y [1/s], where the flight tells.
    drag: [Option<f64>; 2],
}

const FLIGHTS: [Expected; 4] = [
    Expected {
        log: "crazyflie_brushless_37.0g",
        residual: Some([0.068, 0.048, 0.014]),
        mass: 0.0383,
        drag: [Some(0.37), Some(0.37)],
    },
    Expected {
        log: "crazyflie_brushed_34.7g",
        residual: Some([0.109, 0.076, 0.016]),
        mass: 0.0340,
        drag: [Some(0.48), Some(0.48)],
    },
    Expected {
        log: "nanobench_lissajous_fast",
        residual: Some([0.130, 0.092, 0.046]),
        mass: 0.0450,
        drag: [Some(0.41), Some(0.41)],
    },
    // Hardly moves along y: nothing can be said of that axis.
    Expected { log: "crazyflie_payload_44.4g", residual: None, mass: 0.0450, drag: [Some(0.32), None] },
];

/// At λ = 10 the velocity error of x and y is to be at most this share of that without D and d, from `SETTLED` (s) on.
const SHARE: f64 = 0.5;
const SETTLED: f64 = 1.0;
const OBSERVER: Tuning = Tuning::from_lambda(10.0);
const DRIFT: [f64; 3] = [0.0, 0.0, -9.81];

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let folder = std::env::var_os(VARIABLE).filter(|v| !v.is_empty()).map(PathBuf::from);
    if folder.is_none() {
        eprintln!("{VARIABLE} is not set: the tests on recorded flights are ignored");
    }
    let mut trials = Vec::new();
    for expected in FLIGHTS {
        let name = expected.log;
        trials.push(trial(format!("terms_of_{name}"), &folder, move |folder| has_terms(folder, &expected)));
        if expected.residual.is_some() {
            trials.push(trial(format!("residual_of_{name}"), &folder, move |folder| has_residual(folder, &expected)));
        }
    }
    for name in ["crazyflie_brushless_37.0g", "crazyflie_brushed_34.7g"] {
        trials.push(trial(format!("velocity_of_{name}"), &folder, move |folder| has_better_velocity(folder, name)));
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

/// What the core said at the end of a flight.
struct Outcome {
    k: f32,
    terms: [AxisTerms; 3],
    /// Over the three axes [m/s²].
    residual: f64,
}

fn read(folder: &Path, name: &str) -> Result<(AxisLog, [AxisColumn; 3]), Failed> {
    let log = AxisLog::read(&folder.join("flights").join(format!("{name}.csv")))?;
    let axes = log.axes.clone().try_into().map_err(|_| "three axes expected")?;
    Ok((log, axes))
}

fn fly(folder: &Path, name: &str, identify: [Identify; 3]) -> Result<Outcome, Failed> {
    let (log, axes) = read(folder, name)?;
    let mut estimator = DragEstimator::new(&DragConfig { drift: DRIFT, identify, ..DragConfig::new(log.period) })?;
    for n in 0..log.len() {
        estimator.measure(&axes.each_ref().map(|a| a.position[n].map(|y| y as f32)))?;
        estimator.apply(&axes.each_ref().map(|a| a.input[n] as f32));
    }
    let k = estimator.parameter().ok_or("k is not valid")?;
    let squares: Option<f32> = estimator.residual_variance().into_iter().sum();
    let residual = (f64::from(squares.ok_or("no residual")?) / 3.0).sqrt();
    println!("{name}: {:?} kg, residual {residual} m/s²", k.inverse_with_sd());
    for terms in estimator.terms() {
        println!("    {terms:?}");
    }
    Ok(Outcome { k: k.value, terms: estimator.terms(), residual })
}

/// rms error of an axis's velocity [m/s] by an observer that predicts with what was identified.
fn velocity_error(log: &AxisLog, axis: &AxisColumn, k: f32, terms: AxisTerms, drift: f64) -> Result<f64, Failed> {
    let design = ObserverDesign::new(OBSERVER, log.period)?;
    let of = |term: Term| term.value().unwrap_or(0.0);
    let model = DragModel::new(k, of(terms.drag), drift as f32 + of(terms.disturbance), &design);
    let (mut observer, mut window, mut gains) = (DragObserver::default(), Window::START, Gains::FIRST);
    let position = |n: usize| axis.position[n].map(|y| y as f32).ok_or("a measurement is missing");
    observer.start(position(0)?);
    let (mut squares, mut count) = (0.0, 0_u32);
    for n in 1..log.len() {
        let (m1, f) = (gains.m1(), axis.input[n - 1] as f32);
        design.step(&mut window);
        gains = Gains::at(&window, &design);
        observer.correct(position(n)?, InputMoments { j1: f, j2: 0.5 * f }, &model, m1, gains.t_l2());
        observer.fold();
        let reference = axis.velocity_reference.as_ref().and_then(|v| v[n]).ok_or("no velocity to compare with")?;
        if log.time(n) - log.start >= SETTLED {
            squares += (f64::from(observer.state().velocity(&design)) - reference).powi(2);
            count += 1;
        }
    }
    Ok((squares / f64::from(count)).sqrt())
}

fn has_terms(folder: PathBuf, expected: &Expected) -> Result<(), Failed> {
    let outcome = fly(&folder, expected.log, [Identify::BOTH; 3])?;
    let mass = f64::from(1.0 / outcome.k);
    check((mass - expected.mass).abs() <= 0.0003, || format!("mass {mass} kg"))?;
    for (terms, drag) in outcome.terms.iter().zip(expected.drag) {
        match (terms.drag, drag) {
            (Term::Known { value, sd }, Some(drag)) => {
                check((f64::from(value) - drag).abs() <= 0.05, || format!("D {value} 1/s, expected {drag}"))?;
                check(sd > 0.0 && sd < 0.2, || format!("sd of D {sd} 1/s"))?;
            }
            (Term::NotObservable, None) => {}
            (term, drag) => return Err(format!("{term:?}, expected {drag:?}").into()),
        }
    }
    Ok(())
}

fn has_residual(folder: PathBuf, expected: &Expected) -> Result<(), Failed> {
    let drag = Identify { drag: true, disturbance: false };
    let asked = [Identify::NOTHING_ELSE, drag, Identify::BOTH];
    for (identify, rms) in asked.into_iter().zip(expected.residual.into_iter().flatten()) {
        let residual = fly(&folder, expected.log, [identify; 3])?.residual;
        check((residual / rms - 1.0).abs() <= 0.1, || format!("residual {residual} m/s², f64 {rms}"))?;
    }
    Ok(())
}

fn has_better_velocity(folder: PathBuf, name: &str) -> Result<(), Failed> {
    let (log, axes) = read(&folder, name)?;
    let plain = fly(&folder, name, [Identify::NOTHING_ELSE; 3])?;
    let with = fly(&folder, name, [Identify::BOTH; 3])?;
    for (i, axis) in axes.iter().enumerate().take(2) {
        let without = velocity_error(&log, axis, plain.k, plain.terms[i], DRIFT[i])?;
        let with = velocity_error(&log, axis, with.k, with.terms[i], DRIFT[i])?;
        println!("{name} {:?}: {with} m/s with D and d, {without} without", axis.axis);
        check(with <= SHARE * without, || format!("{:?}: {with} m/s, without D and d {without}", axis.axis))?;
    }
    Ok(())
}

fn check(holds: bool, complaint: impl FnOnce() -> String) -> Result<(), Failed> {
    if holds { Ok(()) } else { Err(complaint().into()) }
}
