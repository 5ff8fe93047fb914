//! The core and the control loop, built for the microcontroller with every feature combination.

use anyhow::{Context, Result};
use serde_json::Value;

use crate::command;
use crate::{metadata, setup};

/// The packages that must build without an operating system.
const BARE_METAL: &[&str] = &["fsb-core", "fsb-firmware"];

/// Builds each bare-metal package for each target: no feature, each alone, all together.
pub fn run() -> Result<()> {
    setup::rust_targets()?;
    let members = metadata::members()?;
    for name in BARE_METAL {
        let package = members.iter().find(|member| member["name"] == *name);
        let features = features(package.with_context(|| format!("no package {name}"))?);
        for target in setup::TARGETS {
            for combination in combinations(&features) {
                let mut arguments = vec!["build", "--release", "--lib", "--package", name, "--target", target];
                arguments.push("--no-default-features");
                if !combination.is_empty() {
                    arguments.extend(["--features", &combination]);
                }
                command::run("cargo", &arguments)?;
            }
        }
    }
    Ok(())
}

/// The features by name, without a `default` that stands for nothing.
fn features(package: &Value) -> Vec<String> {
    let Some(features) = package["features"].as_object() else { return Vec::new() };
    let empty = |list: &Value| list.as_array().is_some_and(Vec::is_empty);
    features.iter().filter(|(name, list)| *name != "default" || !empty(list)).map(|(name, _)| name.clone()).collect()
}

/// Comma-separated lists: none, each alone, all (where that is not one of those already).
fn combinations(features: &[String]) -> Vec<String> {
    let mut all = vec![String::new()];
    all.extend(features.iter().cloned());
    if features.len() > 1 {
        all.push(features.join(","));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combinations_cover_none_each_and_all() {
        let features = |names: &[&str]| names.iter().map(|name| name.to_string()).collect::<Vec<_>>();
        assert_eq!(combinations(&[]), [""]);
        assert_eq!(combinations(&features(&["a"])), ["", "a"]);
        assert_eq!(combinations(&features(&["a", "b", "c"])), ["", "a", "b", "c", "a,b,c"]);
    }

    #[test]
    fn an_empty_default_is_no_feature() {
        let package = |default: &[&str]| serde_json::json!({ "features": { "a": [], "default": default } });
        assert_eq!(features(&package(&[])), ["a"]);
        assert_eq!(features(&package(&["a"])), ["a", "default"]);
    }

    #[test]
    fn features_come_from_the_manifest() {
        let members = metadata::members().unwrap();
        let core = members.iter().find(|member| member["name"] == "fsb-core").unwrap();
        assert!(features(core).contains(&"defmt".to_string()));
    }
}
