//! `fsb tune`: λ, q and ε from what a user knows and wants.

use super::source::Files;
use super::{Failure, positive, print_json, print_text};
use clap::Parser;
use fsb_sim_host::replay::ReplayOptions;
use fsb_sim_host::report::table::{Cell, Column, Table};
use fsb_sim_host::report::{html::HowMade, write::write_files};
use fsb_sim_host::tune::from_log::{LogSensor, sensor};
use fsb_sim_host::tune::identifier::Excitation;
use fsb_sim_host::tune::{Proposal, Sensor, Wish, page, propose};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;

/// Propose λ, q and ε for the observer and the identifier, and draw what they trade.
///
/// From the noise of the position sensor and its rate, and one wish for the velocity: its noise, or the bandwidth or the delay for
/// what the model does not know (what the input does is predicted, and never late). The formulas are in docs/tuning.md.
///
/// k is told by the input: gravity that the thrust holds, and accelerations on top of it, as a sine of one frequency on one axis that
/// begins at its crest.
#[derive(Debug, Parser)]
#[command(allow_negative_numbers = true)]
#[allow(rustdoc::broken_intra_doc_links, reason = "units in brackets; this is the help text")]
pub struct Args {
    /// Standard deviation of a position [m, or rad]; with --log it is measured
    #[arg(long, value_name = "S", value_parser = positive, required_unless_present = "log")]
    noise_sd: Option<f64>,
    /// Positions a second [Hz]; with --log it is that of the log
    #[arg(long, value_name = "HZ", value_parser = positive, required_unless_present = "log")]
    rate: Option<f64>,
    /// Wanted standard deviation of the velocity [m/s]
    #[arg(long, value_name = "V", value_parser = positive, group = "wish")]
    velocity_noise: Option<f64>,
    /// Wanted bandwidth of the velocity [Hz], for what the model does not know
    #[arg(long, value_name = "HZ", value_parser = positive, group = "wish")]
    bandwidth: Option<f64>,
    /// Wanted delay of the velocity [s], for what the model does not know
    #[arg(long, value_name = "S", value_parser = positive, group = "wish")]
    delay: Option<f64>,
    /// λ of the observer itself [1/s]; 10 without any wish, or 0.5 over the time step where that is less
    #[arg(long, value_name = "L", value_parser = positive, group = "wish")]
    observer_lambda: Option<f64>,
    /// What two standard deviations of k are to be [% of k]
    #[arg(long, value_name = "PERCENT", default_value_t = 5.0, value_parser = positive)]
    k_within: f64,
    /// Acceleration that the input causes [m/s², or rad/s²], rms
    #[arg(long, value_name = "A", default_value_t = 1.0, value_parser = not_negative)]
    acceleration: f64,
    /// Its frequency [Hz]
    #[arg(long, value_name = "HZ", default_value_t = 0.5, value_parser = positive)]
    frequency: f64,
    /// Gravity that the input holds [m/s²]; 0 on an axis that carries no weight, such as a rotational one
    #[arg(long, value_name = "G", default_value_t = 9.81, value_parser = not_negative)]
    gravity: f64,
    /// Measure noise and rate from a log: an axis log (CSV) or a ULog
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// Write the figures as SVG and report.html into DIR, all or nothing
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
}

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=1e6).contains(&value) => Ok(value),
        _ => Err("expected a number that is not negative, up to 1e6".into()),
    }
}

#[derive(Serialize)]
struct Json {
    noise_sd: f64,
    rate_hz: f64,
    observer: JsonTuning,
    identifier: JsonTuning,
    velocity_sd: f64,
    position_sd: f64,
    bandwidth_hz: f64,
    delay_s: f64,
    k_within_percent: f64,
    k_sd: Vec<JsonSpread>,
    log_noise_sd: Option<std::collections::BTreeMap<&'static str, f64>>,
}

#[derive(Serialize)]
struct JsonTuning {
    lambda: f64,
    q: f64,
    settle_s: Option<f64>,
}

#[derive(Serialize)]
struct JsonSpread {
    t: f64,
    percent: f64,
}

/// Times at which the spread of k is printed [s].
const TIMES: [f64; 7] = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 60.0];

/// Proposes and prints.
pub fn run(args: &Args) -> Result<ExitCode, Failure> {
    let measured = args.log.as_ref().map(|path| from_log(path, args)).transpose()?;
    let known = measured.as_ref().map(|log| log.sensor);
    let (Some(noise_sd), Some(period)) = (
        args.noise_sd.or(known.map(|known| known.noise_sd)),
        args.rate.map(|rate| 1.0 / rate).or(known.map(|known| known.period)),
    ) else {
        return Err(Failure::Usage("expected --noise-sd and --rate, or --log".into()));
    };
    if !(1e-6..=1e3).contains(&period) {
        return Err(Failure::Usage(format!("--rate {}: must be between 0.001 and 1000000 Hz", 1.0 / period)));
    }
    if args.k_within > 100.0 {
        return Err(Failure::Usage(format!("--k-within {}: must be at most 100 %", args.k_within)));
    }
    let sensor = Sensor { noise_sd, period };
    let excitation = Excitation { gravity: args.gravity, acceleration: args.acceleration, frequency: args.frequency };
    if args.acceleration > 0.0 && args.frequency * period > 0.5 {
        let rate = 1.0 / period;
        return Err(Failure::Usage(format!(
            "--frequency {}: must be at most half the rate, {} Hz",
            args.frequency,
            rate / 2.0
        )));
    }
    let proposal = propose(sensor, args.wish(period), excitation, args.k_within / 100.0)
        .map_err(|error| Failure::Usage(error.to_string()))?;
    if let Some(directory) = &args.out {
        for path in write_files(directory, &page::files(&proposal, args.how_made(&proposal))?)? {
            tell!("wrote {}", path.display());
        }
    }
    if args.json {
        print_json(&json(&proposal, measured.as_ref()))?;
    } else {
        print_text(&text(&proposal, measured.as_ref()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn from_log(path: &std::path::Path, args: &Args) -> Result<LogSensor, Failure> {
    let options = ReplayOptions { gravity: args.gravity, ..ReplayOptions::default() };
    let files = Files::of(path);
    let recording = files.source()?.recording(&options)?;
    sensor(&recording, args.gravity).ok_or_else(|| {
        Failure::Usage(format!(
            "{}: its noise cannot be measured: too few positions in a row, none in them, or no k in it",
            path.display()
        ))
    })
}

fn json(of: &Proposal, measured: Option<&LogSensor>) -> Json {
    Json {
        noise_sd: of.sensor.noise_sd,
        rate_hz: 1.0 / of.sensor.period,
        observer: JsonTuning { lambda: of.observer.lambda, q: of.observer.q, settle_s: Some(of.state_settle) },
        identifier: JsonTuning { lambda: of.identifier.lambda, q: of.identifier.q, settle_s: of.parameter_settle },
        velocity_sd: of.velocity_sd,
        position_sd: of.position_sd,
        bandwidth_hz: of.bandwidth,
        delay_s: of.delay,
        k_within_percent: 100.0 * of.k_within,
        k_sd: of
            .spread(of.identifier, &TIMES)
            .into_iter()
            .map(|(t, sd)| JsonSpread { t, percent: 100.0 * sd })
            .collect(),
        log_noise_sd: measured.map(|log| log.axes.iter().map(|(axis, sd)| (axis.name(), *sd)).collect()),
    }
}

fn text(of: &Proposal, measured: Option<&LogSensor>) -> String {
    let mut spread = Table::new("Expected sd of k", vec![Column::right("t [s]"), Column::right("sd [% of k]")]);
    for (t, sd) in of.spread(of.identifier, &TIMES) {
        spread.push(vec![Cell::fixed(t, 1), Cell::significant(100.0 * sd, 2)]);
    }
    let noise = measured.map_or_else(String::new, |log| {
        let axes: Vec<String> = log.axes.iter().map(|(axis, sd)| format!("{} {sd:.2e} m", axis.name())).collect();
        format!("noise of the log: {}\n", axes.join(", "))
    });
    format!("{}\n{}\n{noise}", page::table(of).to_text(), spread.to_text())
}

impl Args {
    fn wish(&self, period: f64) -> Wish {
        if let Some(sd) = self.velocity_noise {
            Wish::VelocityNoise(sd)
        } else if let Some(hz) = self.bandwidth {
            Wish::Bandwidth(hz)
        } else if let Some(delay) = self.delay {
            Wish::Delay(delay)
        } else {
            Wish::Lambda(self.observer_lambda.unwrap_or(10f64.min(0.5 / period)))
        }
    }

    fn how_made(&self, of: &Proposal) -> HowMade {
        let mut parameters = vec![
            ("--noise-sd", format!("{} m", of.sensor.noise_sd)),
            ("--rate", format!("{} Hz", 1.0 / of.sensor.period)),
            ("--k-within", format!("{} %", self.k_within)),
            ("--acceleration", format!("{} m/s²", self.acceleration)),
            ("--frequency", format!("{} Hz", self.frequency)),
            ("--gravity", format!("{} m/s²", self.gravity)),
        ];
        parameters.extend(self.velocity_noise.map(|v| ("--velocity-noise", format!("{v} m/s"))));
        parameters.extend(self.bandwidth.map(|hz| ("--bandwidth", format!("{hz} Hz"))));
        parameters.extend(self.delay.map(|s| ("--delay", format!("{s} s"))));
        parameters.extend(self.observer_lambda.map(|l| ("--observer-lambda", format!("{l} 1/s"))));
        let mut command = String::from("fsb tune");
        for (flag, value) in &parameters {
            command.push_str(&format!(" {flag} {}", value.split(' ').next().unwrap_or_default()));
        }
        HowMade {
            command,
            version: format!("fsb {}", env!("CARGO_PKG_VERSION")),
            parameters: parameters.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
            seed: None,
        }
    }
}
