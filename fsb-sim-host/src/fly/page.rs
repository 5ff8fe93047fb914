//! The report: what is printed, figures, the vehicle in space, and how it was made.

use super::figures::figures;
use super::many::Flights;
use super::record::{Flight, NAMES};
use super::scenario::Scenario;
use super::scene::scene;
pub use super::tables::tables;
use crate::report::chart::ChartError;
use crate::report::html::{Block, HowMade, Page, Section};

/// The folder of the report under `out`.
pub fn folder(scenario: &Scenario) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
    format!("fly-{}", scenario.name.chars().map(plain).collect::<String>())
}

/// All files of the report: `report.html`, and the vehicle in space as `scene.svg`.
///
/// # Errors
/// [`ChartError`] of a figure that cannot be drawn.
pub fn files(
    scenario: &Scenario,
    seed: u64,
    flights: &Flights,
    command: &str,
) -> Result<Vec<(String, String)>, ChartError> {
    let scene = scene(scenario, &flights.first.samples);
    let drawing = scene.to_svg();
    let page = Page {
        title: format!("FSB: {}", scenario.name),
        summary: summary(scenario, flights),
        sections: vec![
            Section::new("The flight", vec![Block::Text(scenario.description.clone()), Block::Scene(scene)]),
            Section::new("Results", tables(scenario, flights).into_iter().map(Block::Table).collect()),
            Section::new("Figures", figures(flights).into_iter().map(Block::Figure).collect()),
        ],
        how: HowMade {
            command: command.to_owned(),
            version: concat!("fsb ", env!("CARGO_PKG_VERSION")).to_owned(),
            parameters: settings(scenario),
            seed: Some(seed),
        },
    };
    Ok(vec![("report.html".to_owned(), page.to_html()?), ("scene.svg".to_owned(), drawing)])
}

fn summary(scenario: &Scenario, flights: &Flights) -> String {
    let first: &Flight = &flights.first;
    let found = first.parameters.iter().zip(NAMES).filter_map(|(end, name)| {
        let error = 100.0 * (end.estimated? / end.real - 1.0);
        Some(format!("{name} to {:.3} %", error.abs()))
    });
    let found: Vec<String> = found.collect();
    let found = if found.is_empty() { "No parameter valid".to_owned() } else { found.join(", ") };
    let many = match flights.runs.len() {
        1 => String::new(),
        runs => format!(" {} of {runs} flights diverged.", flights.diverged()),
    };
    let diverged = first.diverged.map_or_else(String::new, |t| format!(" The first flight diverged at {t:.1} s."));
    format!("{}: {found} after {} s.{diverged}{many}", scenario.name, (1e3 * first.flown).round() / 1e3)
}

/// Every entry of the scenario, in the words of the file.
fn settings(scenario: &Scenario) -> Vec<(String, String)> {
    let mut entries = Vec::new();
    if let Ok(value) = serde_json::to_value(scenario) {
        flatten("", &value, &mut entries);
    }
    entries
}

fn flatten(name: &str, value: &serde_json::Value, to: &mut Vec<(String, String)>) {
    match value {
        serde_json::Value::Object(entries) => {
            for (key, value) in entries {
                flatten(&if name.is_empty() { key.clone() } else { format!("{name}.{key}") }, value, to);
            }
        }
        // What is not set, and what stands at the top of the page.
        serde_json::Value::Null => {}
        _ if name == "description" => {}
        serde_json::Value::String(text) => to.push((name.to_owned(), text.clone())),
        other => to.push((name.to_owned(), other.to_string())),
    }
}
