//! The report.
use super::many::Flights;
use super::scenario::Scenario;
pub use super::tables::tables;
use crate::report::chart::ChartError;

/// The folder of the report under `out`.
pub fn folder(scenario: &Scenario) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
    format!("fly-{}", scenario.name.chars().map(plain).collect::<String>())
}
/// files
pub fn files(_s: &Scenario, _seed: u64, _f: &Flights, _c: &str) -> Result<Vec<(String, String)>, ChartError> {
    Ok(vec![])
}
