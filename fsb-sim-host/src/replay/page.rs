//! The page and the files of a replay.

use super::compare::velocity::{Velocities, compare};
use super::compare::whiteness::Whiteness;
use super::estimates::to_csv;
use super::figures::figures;
use super::figures_left as left;
use super::fit::rows;
use super::flight::ThrustUnit;
use super::log::Axis;
use super::options::ReplayOptions;
use super::overview::{table, terms};
use super::recording::Recording;
use super::result::ReplayResult;
use super::summary::Summary;
use crate::report::chart::{Chart, ChartError};
use crate::report::html::{Block, HowMade, Page, Section};
use crate::report::table::{Cell, Column, Table};

type Named = (&'static str, Chart);

/// Every file of `fsb replay --out`, by name: `estimates.csv`, the figures as SVG, and `report.html` that holds them all.
///
/// # Errors
/// [`ChartError`] of a figure that cannot be drawn.
pub fn files(
    result: &ReplayResult,
    recording: &Recording,
    options: &ReplayOptions,
    how: HowMade,
) -> Result<Vec<(String, String)>, ChartError> {
    let log = &recording.log;
    let whole = Summary::of(result, recording, options.gravity, true);
    let k = result.mass.as_ref().and_then(|mass| mass.last()).map(|k| f64::from(k.value));

    let (mut parameters, signals): (Vec<Named>, Vec<Named>) =
        figures(result, log).into_iter().partition(|(name, _)| matches!(*name, "mass" | "inertia"));
    if recording.unit == ThrustUnit::Normalised {
        parameters.retain(|(name, _)| *name != "mass");
        parameters.extend(left::hover(result, recording, options.gravity).map(|chart| ("hover_thrust", chart)));
    }
    let mut remains: Vec<Named> = Vec::new();
    if let Some(identified) = &result.identified {
        parameters.extend(left::terms(identified, log).map(|chart| ("terms", chart)));
        remains.push(("residuals", left::residuals(identified, log)));
    }
    let judged: Vec<(Axis, Whiteness)> = result
        .axes
        .iter()
        .filter_map(|axis| {
            Whiteness::of(&axis.trace.innovation, options.observer.lambda, log.period).map(|white| (axis.axis, white))
        })
        .collect();
    remains.extend(left::correlations(&judged, log.period).map(|chart| ("whiteness", chart)));
    let compared = compare(result, log, options.gravity, options.observer.lambda);
    let beside = left::velocities(&compared, result, log).map(|chart| ("other_velocities", chart));
    let filtered = rows(log, options.identifier, options.gravity);
    let excitation = k.and_then(|k| left::excitation(&filtered, k, log)).map(|chart| ("excitation", chart));

    let hovering = (recording.unit == ThrustUnit::Normalised).then_some(options.gravity);
    let mut first = vec![Block::Table(table(result, hovering))];
    if result.identified.is_some() {
        first.push(Block::Table(terms(&whole)));
    }
    first.extend(recording.notices.iter().map(|notice| Block::Text(notice.clone())));
    let verdicts = judged.iter().map(|(axis, white)| Block::Text(verdict(axis.name(), white)));
    let sections: Vec<(&str, Vec<Block>, Vec<Named>)> = vec![
        ("Result", first, Vec::new()),
        ("Parameters", Vec::new(), parameters),
        ("Signals", Vec::new(), signals),
        ("What is left", verdicts.collect(), remains),
        (
            "Velocities side by side",
            errors(&compared).into_iter().map(Block::Table).collect(),
            beside.into_iter().collect(),
        ),
        ("Excitation", Vec::new(), excitation.into_iter().collect()),
    ];
    let mut files = vec![("estimates.csv".to_owned(), to_csv(result, log, hovering))];
    let mut parts = Vec::new();
    for (heading, mut blocks, charts) in sections {
        for (name, chart) in charts {
            files.push((format!("{name}.svg"), chart.to_svg()?));
            blocks.push(Block::Figure(chart));
        }
        if !blocks.is_empty() {
            parts.push(Section::new(heading, blocks));
        }
    }
    let page = Page { title: "A flight replayed".to_owned(), summary: summary(result, &whole), sections: parts, how };
    files.push(("report.html".to_owned(), page.to_html()?));
    Ok(files)
}

/// Whether the innovations of an axis are noise, in a sentence.
fn verdict(name: &str, white: &Whiteness) -> String {
    let Whiteness { count, rms, statistic, limit, .. } = white;
    let word = if white.is_white() {
        "white: measurement noise can be all that is left"
    } else {
        "not white: the model lacks something, or the measurements are not independent of each other"
    };
    format!(
        "Innovations of {name}: {word}. {count} of them, {rms:.2e} rms; Ljung and Box's statistic {statistic:.0}, which \
         measurement noise alone exceeds {limit:.0} once in twenty times."
    )
}

/// The velocities' errors, where there is a reference.
fn errors(compared: &[Velocities]) -> Option<Table> {
    let columns = vec![
        Column::left("axis"),
        Column::right("noise of the position, sd [m]"),
        Column::right("observer on the way, rms [m/s]"),
        Column::right("observer that knows k, D, d, rms [m/s]"),
        Column::right("Kalman filter, rms [m/s]"),
        Column::right("differences, rms [m/s]"),
        Column::right("process noise of the filter [m²/s³]"),
    ];
    let mut table = Table::new("Errors against the reference of the log", columns);
    for of in compared {
        let errors = of.rms.unwrap_or([f64::NAN; 4]);
        let mut row = vec![Cell::text(of.axis.name()), Cell::significant(of.noise_sd, 2)];
        row.extend(errors.map(|error| Cell::significant(error, 3)));
        row.push(Cell::significant(of.filter.process, 2));
        table.push(row);
    }
    let note = "The Kalman filter knows the input, the k at the end of the flight and the noise of the position; its process noise is the one under \
                which the innovations of this very flight are most likely. The observer on the way had to find k, and with it D and d where asked for; the other one knows from the first sample on what the \
                flight tells. All at the same samples, from 10/λ of the observer on.";
    (!compared.is_empty()).then(|| table.with_note(note))
}

/// The result in a sentence.
fn summary(result: &ReplayResult, whole: &Summary) -> String {
    let Some(mass) = &result.mass else {
        return "The moments of inertia that this log tells, from the f32 core.".to_owned();
    };
    if let Some(hover) = &whole.hover_thrust
        && let (Some(value), Some(sd)) = (hover.value, hover.sd)
    {
        let own =
            hover.px4.map_or_else(String::new, |own| format!(" The flight controller's own estimate is {own:.4}."));
        return format!(
            "The vehicle hovers at {value:.4} of its full thrust, with a standard deviation of {sd:.1e} from measurement noise.{own}"
        );
    }
    match mass.last() {
        Some(k) => {
            let (value, sd) = k.inverse_with_sd();
            let digits = 4;
            let text = |x: f32| format!("{:.*}", digits_after_point(value, digits), x);
            format!("The mass is {} kg, with a standard deviation of {sd:.1e} kg from measurement noise.", text(value))
        }
        None => format!("No mass: the parameter is {} at the end of the log.", mass.status),
    }
}

/// Decimals that show `digits` significant ones of `value`.
fn digits_after_point(value: f32, digits: i32) -> usize {
    let exponent = if value > 0.0 { value.log10().floor() as i32 } else { 0 };
    usize::try_from(digits - 1 - exponent).unwrap_or(0)
}
