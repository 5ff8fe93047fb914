//! Where a recording comes from: the part of the command line that `replay` and `tune` share.

use super::Failure;
use super::shell::{quoted, quoted_file};
use fsb_sim_host::progress::Progress;
use fsb_sim_host::replay::flight::{Flight, FlightError, ThrustUnit};
use fsb_sim_host::replay::lag::{self, Lag};
use fsb_sim_host::replay::{AxisLog, Recording, ReplayOptions, pair, ulog};
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// The files of a recording.
#[derive(clap::Args, Debug, Clone)]
#[allow(rustdoc::broken_intra_doc_links, reason = "units in brackets; this is the help text")]
pub struct Files {
    /// The axis log (CSV), or a PX4 log (ULog).
    #[arg(value_name = "LOG.csv|LOG.ulg", required_unless_present = "motion", conflicts_with_all = ["motion", "input"])]
    log: Option<PathBuf>,
    /// Positions and attitudes (CSV): t [s]; x, y, z [m], world frame, z up; qw, qx, qy, qz, body to world; vx_ref, vy_ref,
    /// vz_ref [m/s], if there, are compared with.
    #[arg(long, value_name = "MOTION.csv", requires = "input")]
    motion: Option<PathBuf>,
    /// Inputs (CSV) on the same clock: t [s] and thrust_N [N] along body z, each held until the next; with an
    /// empty cell the last one stays.
    #[arg(long, value_name = "INPUT.csv", requires = "motion")]
    input: Option<PathBuf>,
    /// Take the names of the columns of both files from a TOML file: x = "pos_x", thrust = "T", and t in the tables
    /// [motion] and [input].
    #[arg(long, value_name = "FILE.toml", requires = "motion")]
    columns: Option<PathBuf>,
    /// The name of one column, such as thrust=T or motion.t=time: motion.t, x, y, z, qw, qx, qy, qz, vx_ref, vy_ref, vz_ref,
    /// input.t, thrust, or fx_body, fy_body, fz_body [N, body frame: forward, left, up] in place of thrust. May be repeated.
    #[arg(long, value_name = "ROLE=HEADER", requires = "motion")]
    column: Vec<String>,
    /// The thrust of INPUT.csv is a share of the full thrust: k is reported as the hover thrust g/k.
    #[arg(long, requires = "motion", conflicts_with = "full_thrust")]
    normalised: bool,
    /// Thrust [N] at a set-point of 1, where the log has it as a share: k is then 1/mass. Up to 1e6.
    #[arg(long, value_name = "N", value_parser = full_thrust)]
    full_thrust: Option<f64>,
    /// By how much the input acts later than its time stamps say [s], or auto: the value that leaves least of the
    /// accelerations unexplained, within 0.2 s.
    #[arg(long, value_name = "auto|SECONDS", default_value = "0", value_parser = parse_lag, allow_negative_numbers = true)]
    lag: Lag,
}

/// `--lag`.
fn parse_lag(text: &str) -> Result<Lag, String> {
    if text == "auto" {
        return Ok(Lag::Auto);
    }
    match text.parse::<f64>() {
        Ok(lag) if lag.abs() <= 10.0 => Ok(Lag::Given(lag)),
        _ => Err("expected auto, or seconds within -10 and 10".into()),
    }
}

/// `--full-thrust`.
fn full_thrust(text: &str) -> Result<f64, String> {
    let thrust = super::positive(text)?;
    if thrust <= 1e6 { Ok(thrust) } else { Err("must be at most 1e6 N".into()) }
}

/// What was read.
pub struct Source<'a> {
    args: &'a Files,
    pub content: Content,
}

/// As it was recorded.
pub enum Content {
    /// Uniform rows.
    Axis(AxisLog),
    /// Time stamps of their own.
    Flight(Box<Flight>),
}

impl Files {
    /// One log, its input taken as it is stamped.
    pub fn of(log: &Path) -> Self {
        Self {
            log: Some(log.to_owned()),
            motion: None,
            input: None,
            columns: None,
            column: Vec::new(),
            normalised: false,
            full_thrust: None,
            lag: Lag::default(),
        }
    }

    /// The file or files as given, for messages.
    pub fn name(&self) -> String {
        let path = self.log.as_ref().or(self.motion.as_ref());
        path.map_or_else(String::new, |path| path.display().to_string())
    }

    /// Whether an offset other than none was asked for.
    pub fn asks_for_lag(&self) -> bool {
        self.lag != Lag::default()
    }

    /// Reads the files.
    pub fn source(&self) -> Result<Source<'_>, Failure> {
        let content = match (&self.log, &self.motion, &self.input) {
            // Clap's `requires` says nothing where LOG rules --motion out.
            (Some(log), ..) if self.columns.is_some() || !self.column.is_empty() || self.normalised => {
                return Err(Failure::Usage(format!(
                    "--columns, --column and --normalised are for --motion and --input, not for {}",
                    log.display()
                )));
            }
            (Some(log), ..) if is_ulog(log) => {
                Content::Flight(Box::new(ulog::read(log, self.full_thrust).map_err(refuse)?))
            }
            (Some(log), ..) => {
                if self.full_thrust.is_some() {
                    return Err(Failure::Usage(format!("--full-thrust: {} is an axis log, in newtons", log.display())));
                }
                Content::Axis(AxisLog::read(log).map_err(|error| Failure::Usage(error.to_string()))?)
            }
            (None, Some(motion), Some(input)) => Content::Flight(Box::new(self.pair(motion, input).map_err(refuse)?)),
            _ => return Err(Failure::Usage("expected LOG, or --motion and --input".into())),
        };
        Ok(Source { args: self, content })
    }

    fn pair(&self, motion: &Path, input: &Path) -> Result<Flight, FlightError> {
        let mut columns = pair::Columns::default();
        if let Some(file) = &self.columns {
            columns.read(file)?;
        }
        for text in &self.column {
            columns.name_by("--column", text)?;
        }
        let unit = if self.normalised { ThrustUnit::Normalised } else { ThrustUnit::Newton };
        let mut flight = pair::read(motion, input, &columns, unit)?;
        if let Some(full) = self.full_thrust {
            flight.input.force.iter_mut().flatten().for_each(|f| *f *= full);
        }
        Ok(flight)
    }

    /// The files and how they are read, for the line that a page repeats: the names of files, not where they lie.
    pub fn command(&self) -> String {
        let name = |path: &Option<PathBuf>| {
            let name = path.as_deref().and_then(Path::file_name);
            name.map_or_else(String::new, |name| quoted_file(&name.to_string_lossy()))
        };
        let mut command = match &self.log {
            Some(_) => name(&self.log),
            None => format!("--motion {} --input {}", name(&self.motion), name(&self.input)),
        };
        if self.columns.is_some() {
            command.push_str(&format!(" --columns {}", name(&self.columns)));
        }
        for text in &self.column {
            command.push_str(&format!(" --column {}", quoted(text)));
        }
        if self.normalised {
            command.push_str(" --normalised");
        }
        if let Some(full) = self.full_thrust {
            command.push_str(&format!(" --full-thrust {full}"));
        }
        match self.lag {
            Lag::Auto => command.push_str(" --lag auto"),
            Lag::Given(lag) if lag != 0.0 => command.push_str(&format!(" --lag {lag}")),
            Lag::Given(_) => {}
        }
        command
    }

    /// The options that differ from their defaults, with units.
    pub fn parameters(&self) -> Vec<(&'static str, String)> {
        let mut all: Vec<(&'static str, String)> = Vec::new();
        let file = self.columns.as_deref().and_then(Path::file_name);
        all.extend(file.map(|file| ("--columns", file.to_string_lossy().into_owned())));
        all.extend(self.column.iter().map(|text| ("--column", text.clone())));
        all.extend(self.normalised.then(|| ("--normalised", String::new())));
        all.extend(self.full_thrust.map(|full| ("--full-thrust", format!("{full} N"))));
        match self.lag {
            Lag::Auto => all.push(("--lag", "auto".into())),
            Lag::Given(lag) if lag != 0.0 => all.push(("--lag", format!("{lag} s"))),
            Lag::Given(_) => {}
        }
        all
    }
}

impl Source<'_> {
    /// Ready for the core, its lag found where that was asked for.
    pub fn recording(self, options: &ReplayOptions) -> Result<Recording, Failure> {
        let lag = self.args.lag;
        let progress = Progress::new("trial offsets", lag::trials(), lag != Lag::Auto);
        let tried = || progress.step();
        let recording = match self.content {
            Content::Axis(log) => Recording::of_log(&self.args.name(), log, lag, options, tried).map_err(refuse)?,
            Content::Flight(flight) => {
                Recording::of_flight(&self.args.name(), *flight, lag, options, tried).map_err(refuse)?
            }
        };
        progress.finish();
        Ok(recording)
    }
}

fn refuse(error: FlightError) -> Failure {
    if error.is_no_flight() { Failure::NoFlight(error.to_string()) } else { Failure::Usage(error.to_string()) }
}

/// By its name, or by its first bytes; not those of a pipe, which could not be read again.
fn is_ulog(path: &Path) -> bool {
    let mut begin = [0; 4];
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("ulg"))
        || path.is_file()
            && std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut begin)).is_ok()
            && &begin == b"ULog"
}
