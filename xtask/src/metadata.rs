//! What `cargo metadata` says.

use anyhow::{Context, Result};
use serde_json::Value;

use crate::command::output;
use crate::on_target::programs::OUTSIDE;

/// The workspace's own packages.
pub fn members() -> Result<Vec<Value>> {
    packages(&["metadata", "--format-version", "1", "--no-deps"])
}

/// Every package of the dependency graph, for every platform, of the workspace and of what is outside of it.
pub fn everything() -> Result<Vec<Value>> {
    let mut all = packages(&["metadata", "--format-version", "1"])?;
    for package in OUTSIDE {
        let manifest = package.manifest();
        for found in packages(&["metadata", "--format-version", "1", "--locked", "--manifest-path", &manifest])? {
            if all.iter().all(|known| known["id"] != found["id"]) {
                all.push(found);
            }
        }
    }
    Ok(all)
}

/// Where cargo puts what it builds.
pub fn target_folder() -> Result<std::path::PathBuf> {
    let metadata: Value = serde_json::from_str(&output("cargo", &["metadata", "--format-version", "1", "--no-deps"])?)?;
    let folder = metadata["target_directory"].as_str().context("cargo metadata names no target folder")?;
    Ok(folder.into())
}

fn packages(arguments: &[&str]) -> Result<Vec<Value>> {
    let mut metadata: Value = serde_json::from_str(&output("cargo", arguments)?)?;
    match metadata["packages"].take() {
        Value::Array(packages) => Ok(packages),
        _ => None.context("cargo metadata lists no packages"),
    }
}
