//! The page and the files of a replay.

use super::estimates::to_csv;
use super::figures::figures;
use super::options::ReplayOptions;
use super::overview::table;
use super::recording::Recording;
use super::result::ReplayResult;
use crate::report::chart::ChartError;
use crate::report::html::{Block, HowMade, Page, Section};

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
    let _ = options;
    let figures = figures(result, log);
    let mut files = vec![("estimates.csv".to_owned(), to_csv(result, log))];
    for (name, chart) in &figures {
        files.push((format!("{name}.svg"), chart.to_svg()?));
    }
    let mut sections = vec![Section::new("Result", vec![Block::Table(table(result))])];
    let (parameters, signals): (Vec<_>, Vec<_>) =
        figures.into_iter().partition(|(name, _)| matches!(*name, "mass" | "inertia"));
    let blocks = |part: Vec<(&str, _)>| part.into_iter().map(|(_, chart)| Block::Figure(chart)).collect();
    sections.push(Section::new("Parameters", blocks(parameters)));
    sections.push(Section::new("Signals", blocks(signals)));
    let page = Page { title: "A flight replayed".to_owned(), summary: summary(result), sections, how };
    files.push(("report.html".to_owned(), page.to_html()?));
    Ok(files)
}

/// The result in a sentence.
fn summary(result: &ReplayResult) -> String {
    let Some(mass) = &result.mass else {
        return "The moments of inertia that this log tells, from the f32 core.".to_owned();
    };
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
