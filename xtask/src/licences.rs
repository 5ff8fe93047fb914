//! The licences of the dependencies.

use anyhow::{Result, bail};
use serde_json::Value;

use crate::{metadata, spdx};

/// Licences that ask of a user no more than a notice.
const ALLOWED: &[&str] = &[
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Programs that only work on this repository, and whose own files nobody changes here: nothing of them is in what a user
/// gets. MPL-2.0 asks for nothing then.
const TOOLS: &[(&str, &str)] = &[("cbindgen", "MPL-2.0")];

/// Every package of the graph, ours included, on every platform.
pub fn run() -> Result<()> {
    let packages = metadata::everything()?;
    let complaints: Vec<String> = packages.iter().filter_map(complaint).collect();
    if !complaints.is_empty() {
        bail!("not under a licence of the list in xtask/src/licences.rs:\n  {}", complaints.join("\n  "));
    }
    println!("{} packages, each under a licence of the list", packages.len());
    Ok(())
}

fn complaint(package: &Value) -> Option<String> {
    let tool = |(name, licence): &(&str, &str)| package["name"] == *name && package["license"] == *licence;
    if TOOLS.iter().any(tool) {
        return None;
    }
    let found = match package["license"].as_str() {
        Some(licence) => match spdx::satisfied(licence, ALLOWED) {
            Ok(true) => return None,
            Ok(false) => licence.to_string(),
            Err(error) => error.to_string(),
        },
        None => "no `license` field".to_string(),
    };
    Some(format!("{} {}: {found}", package["name"], package["version"]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_missing_or_foreign_licence_is_named() {
        let of = |licence: Value| complaint(&json!({ "name": "a", "version": "1.2.3", "license": licence }));
        assert_eq!(of(json!("MIT OR Apache-2.0")), None);
        assert!(of(json!("AGPL-3.0-only")).unwrap().contains("AGPL-3.0-only"));
        assert!(of(json!("MPL-2.0")).is_some());
        let tool = json!({ "name": "cbindgen", "version": "1.2.3", "license": "MPL-2.0" });
        assert_eq!(complaint(&tool), None);
        assert!(of(Value::Null).unwrap().contains("no `license`"));
        assert!(of(json!("MIT or so")).unwrap().contains("not a licence expression"));
    }
}
