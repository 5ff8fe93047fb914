//! `fsb replay`: the parameters and velocities that a recorded flight tells.

use super::source::{self, Content};
use super::{Failure, print_json, print_text};
use clap::{Parser, ValueEnum};
use fsb_core::Tuning;
use fsb_core::readout::{Memory, Readout};
use fsb_core::regression::Identify;
use fsb_sim_host::progress::Progress;
use fsb_sim_host::replay::{
    Recording, ReplayOptions, ReplayResult, Watch, overview, page, passes, run_watched, summary::Summary,
};
use fsb_sim_host::report::{
    html::HowMade,
    write::{check_directory, write_files},
};
use std::path::PathBuf;

/// Run a recorded flight through the f32 core: mass, moments of inertia, positions and velocities.
///
/// LOG.csv is an axis log: a header; t [s], uniform; for each axis present among x, y, z, roll, pitch, yaw a position
/// column of that name [m or rad, world frame, z up] and an input column fx, fy, fz [N, world frame] or taux, tauy, tauz
/// [N m]: the mean input from this row to the next. A position that is empty or nan is a missed measurement, an input has to
/// be there in every row. Columns vx_ref, vy_ref, ... vyaw_ref [m/s or rad/s] are compared with; other columns are ignored.
/// Columns are separated by commas, semicolons or tabs.
///
/// LOG.ulg is a PX4 log: position, attitude and thrust set-point are found by themselves, and only what flies is used. Its
/// thrust is a share of the full one, so k is reported as the hover thrust g/k, unless --full-thrust tells the newtons.
///
/// --motion and --input read two files of different rates on one clock: positions and attitude quaternions at irregular
/// times, and thrust along body z, held from each of its own times to the next.
///
/// The axes x, y, z are pooled into one parameter, k = 1/m; roll, pitch and yaw each have their own, k = 1/I. There is no
/// first guess: states are handed out from the moment k is valid, and k is valid once its standard deviation is known
/// (some 0.75/λ) and at most 5 % of k (10 % once valid), for k within 1e-6..1e9. Nothing
/// is held back longer: on recorded flights the first pooled k that passes is as good as the one of half a second later.
/// The standard deviation is that of measurement noise; what the model lacks, such as drag, comes on top of it.
///
/// Each axis group starts at the first row that has a position of all its axes. At a high rate, where λ (or q) times the time
/// step is below 1.3e-3, the identifier works on means of several samples.
///
/// A log in which nothing becomes valid is replayed like any other, with exit status 0: the reason is told, and the JSON
/// has null values with "valid": false. A ULog in which nothing flies, or an INPUT.csv that is zero throughout, ends with
/// exit status 3.
#[derive(Parser, Debug, Clone)]
#[command(verbatim_doc_comment)]
#[allow(rustdoc::broken_intra_doc_links, reason = "units in brackets; this is the help text")]
pub struct Args {
    #[command(flatten)]
    source: source::Files,
    /// λ of the identifier [1/s]; λT must be within 1e-6 and 1, T being the time step of the log, or of the means of several
    /// samples that the identifier works on.
    #[arg(long, value_name = "L", default_value_t = 2.0, allow_negative_numbers = true)]
    lambda: f64,
    /// q of the identifier [1/s], within the same range [default: λ/2].
    #[arg(long, value_name = "Q", allow_negative_numbers = true)]
    q: Option<f64>,
    /// λ of the observer [1/s], within the same range [default: 10]; 0.5/T where positions at their own times come slower.
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    observer_lambda: Option<f64>,
    /// q of the observer [1/s], within the same range [default: half its λ].
    #[arg(long, value_name = "Q", allow_negative_numbers = true)]
    observer_q: Option<f64>,
    /// g [m/s²]; z points up.
    #[arg(long, value_name = "G", default_value_t = 9.81, allow_negative_numbers = true)]
    gravity: f64,
    /// How k is read out.
    #[arg(long, value_enum, default_value_t = ReadoutArg::Ls)]
    readout: ReadoutArg,
    /// Let the read-out forget with the time constant TAU [s] [default: it forgets nothing].
    #[arg(long, value_name = "TAU", allow_negative_numbers = true)]
    fade: Option<f64>,
    /// What is identified on x, y and z: k, and with it linear drag and a constant disturbance per axis, as far as the data
    /// tell [default: k].
    #[arg(long, value_name = "k[,drag][,disturbance]", value_parser = identify)]
    identify: Option<Identify>,
    /// Write estimates.csv, the figures as SVG and report.html into DIR, all or nothing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object and nothing else to stdout.
    #[arg(long)]
    json: bool,
}

/// `--readout`.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
enum ReadoutArg {
    /// Least squares: k = Σ ẑ2 ẑ0 / Σ ẑ0².
    Ls,
    /// The paper's absolute ratio (44): k = Σ|ẑ2| / Σ|ẑ0|.
    Abs,
}

/// `--identify`.
fn identify(text: &str) -> Result<Identify, String> {
    let (mut k, mut identify) = (false, Identify::NOTHING_ELSE);
    for part in text.split(',') {
        match part.trim() {
            "k" => k = true,
            "drag" => identify.drag = true,
            "disturbance" => identify.disturbance = true,
            other => return Err(format!("found `{other}`, expected k, drag or disturbance, separated by commas")),
        }
    }
    if k { Ok(identify) } else { Err("k is always identified: expected k, k,drag or k,drag,disturbance".into()) }
}

/// Observers slower than this cannot keep up with λ = 10; the product of λ and the time step is kept below it.
const LARGEST_STEP: f64 = 0.5;

/// Replays and reports.
///
/// # Errors
/// Bad input, named by file, line, column or option; a file that cannot be written. Nothing has been written then.
pub fn run(args: &Args) -> Result<(), Failure> {
    if args.readout == ReadoutArg::Abs && args.identify.is_some_and(|identify| identify != Identify::NOTHING_ELSE) {
        return Err(Failure::Usage("--readout abs: drag and disturbance are identified by least squares".into()));
    }
    let source = args.source.source()?;
    let mut options = args.options();
    let mut remarks = Vec::new();
    if !matches!(source.content, Content::Axis(_)) {
        options.identify.get_or_insert(Identify::NOTHING_ELSE);
    }
    args.out.as_deref().map_or(Ok(()), check_directory)?;
    let recording = source.recording(&options)?;
    let log = &recording.log;
    let slowest = LARGEST_STEP / log.period;
    if recording.at_own_stamps && args.observer_lambda.is_none() && slowest < options.observer.lambda {
        options.observer = args.tuning(slowest, args.observer_q);
        remarks.push(format!("positions come every {} s: the observer's λ is {slowest:.3} 1/s", log.period));
    }
    let progress = Progress::new("samples", passes(&options, log) * log.len() as u64, log.len() < 100_000);
    let result = run_watched(&options, log, Watch(&|samples| progress.advance(samples))).map_err(|error| {
        let file = if error.concerns_log() { format!("{}: ", args.source.name()) } else { String::new() };
        Failure::Usage(format!("{file}{error}"))
    })?;
    progress.finish();
    if let Some(directory) = &args.out {
        let files = page::files(&result, &recording, &options, args.how_made(&options))?;
        for path in write_files(directory, &files)? {
            tell!("wrote {}", path.display());
        }
    }
    remarks.extend(told(&result, &recording));
    for line in remarks {
        tell!("fsb: {line}");
    }
    let tell_lag = recording.at_own_stamps || args.identify.is_some() || args.source.asks_for_lag();
    let mut summary = Summary::of(&result, &recording, options.gravity, tell_lag);
    if args.identify.is_some() {
        summary = summary.as_asked();
    }
    if args.json { print_json(&summary) } else { print_text(&overview::text(&result, &summary, options.gravity)) }
}

/// What a reader should know and the result itself does not say.
fn told(result: &ReplayResult, recording: &Recording) -> Vec<String> {
    let mut all = recording.notices.clone();
    all.extend(recording.log.unpaired.iter().map(|column| format!("column {column} is alone and was not read")));
    if result.rejected > 0 {
        all.push(format!("{} values beyond 1e6 in magnitude were not used", result.rejected));
    }
    all.extend(overview::invalid(result, recording.unit));
    all
}

impl Args {
    fn tuning(&self, lambda: f64, q: Option<f64>) -> Tuning {
        match q {
            Some(q) => Tuning { lambda, q },
            None => Tuning::from_lambda(lambda),
        }
    }

    fn options(&self) -> ReplayOptions {
        ReplayOptions {
            identifier: self.tuning(self.lambda, self.q),
            observer: self.tuning(self.observer_lambda.unwrap_or(10.0), self.observer_q),
            gravity: self.gravity,
            readout: match self.readout {
                ReadoutArg::Ls => Readout::LeastSquares,
                ReadoutArg::Abs => Readout::AbsoluteRatio,
            },
            memory: self.fade.map_or(Memory::Infinite, |tau| Memory::Fading { tau }),
            identify: self.identify,
        }
    }

    /// The page tells the log's name and not where it lies: the same log gives the same page.
    fn how_made(&self, options: &ReplayOptions) -> HowMade {
        let readout = self.readout.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned());
        let mut parameters = vec![
            ("--lambda", format!("{} 1/s", options.identifier.lambda)),
            ("--q", format!("{} 1/s", options.identifier.q)),
            ("--observer-lambda", format!("{} 1/s", options.observer.lambda)),
            ("--observer-q", format!("{} 1/s", options.observer.q)),
            ("--gravity", format!("{} m/s²", options.gravity)),
            ("--readout", readout),
        ];
        parameters.extend(self.fade.map(|tau| ("--fade", format!("{tau} s"))));
        parameters.extend(self.identify.map(|identify| {
            let drag = if identify.drag { ",drag" } else { "" };
            ("--identify", format!("k{drag}{}", if identify.disturbance { ",disturbance" } else { "" }))
        }));
        let mut command = format!("fsb replay {}", self.source.command());
        for (flag, value) in &parameters {
            let number = value.split(' ').next().unwrap_or_default();
            command.push_str(&format!(" {flag} {number}"));
        }
        parameters.extend(self.source.parameters());
        HowMade {
            command,
            version: format!("fsb {}", env!("CARGO_PKG_VERSION")),
            parameters: parameters.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
            seed: None,
        }
    }
}
