//! `fsb fly`: the hexarotor in six degrees of freedom.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use fsb_sim_host::fly::able::{self, Ability};
use fsb_sim_host::fly::many::{Flights, Spread};
use fsb_sim_host::fly::record::{Errors, Event, Flight, ParameterEnd, StateErrors, Tracking};
use fsb_sim_host::fly::{self, Scenario, fly_many, page};
use fsb_sim_host::progress::Progress;
use fsb_sim_host::report::write::{check_directory, write_files};
use serde::Serialize;

use super::shell::quoted;
use super::{Failure, print_json, print_text};

/// Fly the hexarotor in six degrees of freedom on what the f32 core estimates, and beside it on the truth.
///
/// Mass, moments of inertia, velocity and body rates are estimated from measured positions and attitudes and the commanded
/// thrusts; the controller flies on them. A yardstick flies the same scenario on the true parameters and the true state.
/// Prints parameters, errors, tracking and events, and writes report.html.
#[derive(Debug, Parser)]
#[command(allow_negative_numbers = true)]
pub struct Args {
    /// A built-in scenario (see --list) or a TOML file
    #[arg(long, value_name = "NAME|FILE", default_value = "spiral")]
    scenario: String,
    /// List the built-in scenarios
    #[arg(long)]
    list: bool,
    /// Seed of noise, gusts and draws of the first flight; the others have the numbers after it
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Number of flights, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    runs: u64,
    /// Directory of the report; made where it is missing [default: out/fly-NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overrides one entry of the scenario, as in plant.mass=3.1; may be given more than once
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Print one JSON object instead of tables
    #[arg(long)]
    json: bool,
}

impl Default for Args {
    fn default() -> Self {
        Self::parse_from(["fsb fly"])
    }
}

impl Args {
    /// The command that makes the same report again; the directory does not matter to it.
    fn command(&self) -> String {
        let scenario = quoted(&self.scenario);
        let mut command = format!("fsb fly --scenario {scenario} --seed {} --runs {}", self.seed, self.runs);
        for entry in &self.set {
            command.push_str(&format!(" --set {}", quoted(entry)));
        }
        command
    }
}

#[derive(Serialize)]
struct List {
    scenarios: Vec<Listed>,
}

#[derive(Serialize)]
struct Listed {
    name: String,
    description: String,
}

#[derive(Serialize)]
struct Json<'a> {
    scenario: &'a str,
    seed: u64,
    runs: usize,
    diverged: usize,
    parameters: Parameters,
    errors: &'a [Errors],
    tracking: Tracking,
    state: StateErrors,
    events: &'a [Event],
    vehicle: Option<Ability>,
    #[serde(skip_serializing_if = "Option::is_none")]
    small_angle: Option<&'a [Errors]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    distribution: Option<Distribution>,
    real_time_factor: f64,
    flights_per_second: f64,
}

#[derive(Serialize)]
struct Parameters {
    mass: ParameterEnd,
    ixx: ParameterEnd,
    iyy: ParameterEnd,
    izz: ParameterEnd,
}

#[derive(Serialize)]
struct Distribution {
    mass: Option<Spread>,
    ixx: Option<Spread>,
    iyy: Option<Spread>,
    izz: Option<Spread>,
    position_rms: Option<Spread>,
    attitude_rms: Option<Spread>,
    velocity_rms: Option<Spread>,
    diverged_seeds: Vec<u64>,
}

impl Distribution {
    fn of(flights: &Flights) -> Option<Self> {
        let runs = &flights.runs;
        (runs.len() > 1).then(|| Self {
            mass: flights.errors(0),
            ixx: flights.errors(1),
            iyy: flights.errors(2),
            izz: flights.errors(3),
            position_rms: Spread::of(runs.iter().map(|run| run.tracking[0])),
            attitude_rms: Spread::of(runs.iter().map(|run| run.tracking[1])),
            velocity_rms: Spread::of(runs.iter().map(|run| run.velocity)),
            diverged_seeds: runs.iter().filter(|run| run.diverged.is_some()).map(|run| run.seed).collect(),
        })
    }
}

impl<'a> Json<'a> {
    fn of(scenario: &'a Scenario, seed: u64, flights: &'a Flights) -> Self {
        let first: &Flight = &flights.first;
        let [mass, ixx, iyy, izz] = first.parameters;
        Self {
            scenario: &scenario.name,
            seed,
            runs: flights.runs.len(),
            diverged: flights.diverged(),
            parameters: Parameters { mass, ixx, iyy, izz },
            errors: &first.errors,
            tracking: first.tracking,
            state: first.state,
            events: &first.events,
            vehicle: able::of(scenario, seed),
            small_angle: first.small_angle.as_deref(),
            distribution: Distribution::of(flights),
            real_time_factor: flights.real_time_factor,
            flights_per_second: flights.flights_per_second,
        }
    }
}

/// Flies, prints, writes.
pub fn run(args: &Args) -> Result<ExitCode, Failure> {
    if args.list {
        return list(args.json);
    }
    let scenario = fly::load(&args.scenario, &args.set).map_err(|error| Failure::Usage(error.to_string()))?;
    let folder = args.out.clone().unwrap_or_else(|| PathBuf::from("out").join(page::folder(&scenario)));
    check_directory(&folder)?;
    let progress = Progress::new(&scenario.name, args.runs, false);
    let flights = fly_many(&scenario, args.seed, args.runs, || progress.step())
        .map_err(|error| Failure::Usage(format!("{}: {error}", args.scenario)))?;
    progress.finish();

    // Nothing is written before all is there.
    let files = page::files(&scenario, args.seed, &flights, &args.command())?;
    write_files(&folder, &files)?;
    let report = folder.join("report.html");
    if args.json {
        print_json(&Json::of(&scenario, args.seed, &flights))?;
        tell!("report: {}", report.display());
    } else {
        let text: String = page::tables(&scenario, &flights).iter().map(|table| table.to_text() + "\n").collect();
        let speed = format!("{:.0} × real time a core", flights.real_time_factor);
        print_text(&format!("{}\n\n{text}{speed}; report: {}", scenario.description, report.display()))?;
    }
    match flights.diverged() {
        0 => Ok(ExitCode::SUCCESS),
        diverged => {
            let seeds: Vec<String> =
                flights.runs.iter().filter(|r| r.diverged.is_some()).take(10).map(|r| r.seed.to_string()).collect();
            tell!("{diverged} of {} flights diverged, among them --seed {}", flights.runs.len(), seeds.join(", "));
            Ok(ExitCode::FAILURE)
        }
    }
}

fn list(json: bool) -> Result<ExitCode, Failure> {
    let all = fly::list();
    if json {
        let scenarios = all.into_iter().map(|(name, description)| Listed { name, description }).collect();
        print_json(&List { scenarios })?;
    } else {
        let text: String = all.iter().map(|(name, about)| format!("{name:<16}{about}\n")).collect();
        print_text(&text)?;
    }
    Ok(ExitCode::SUCCESS)
}
