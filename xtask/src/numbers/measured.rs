//! What the commands of `fsb` say.

use std::fs;

use anyhow::{Context, Result};
use serde_json::Value;

use super::figure;
use crate::command::output;

/// One run of each command.
pub struct Measured {
    pub paper: Value,
    pub efficiency: Value,
    pub exactness: Value,
    pub faults: Value,
    /// SVG
    pub figure: String,
}

impl Measured {
    /// Runs them.
    pub fn now() -> Result<Self> {
        let folder = std::env::temp_dir().join(format!("fsb-numbers-{}", std::process::id()));
        let paper = fsb(&["paper", "--json", "--out", &folder.to_string_lossy()])?;
        let figure = fs::read_to_string(folder.join(figure::NAME))
            .with_context(|| format!("fsb paper made no {}", figure::NAME))?;
        fs::remove_dir_all(&folder).with_context(|| format!("cannot remove {}", folder.display()))?;
        let (efficiency, exactness) = (fsb(&["efficiency", "--json"])?, fsb(&["exactness", "--json"])?);
        let faults = fsb(&["faults", "--json"])?;
        Ok(Self { paper, efficiency, exactness, faults, figure })
    }
}

/// The JSON that `fsb` prints, in the profile that the tests run in.
pub fn fsb(arguments: &[&str]) -> Result<Value> {
    let mut all = vec!["run", "--quiet", "--package", "fsb-sim-host", "--"];
    all.extend(arguments);
    serde_json::from_str(&output("cargo", &all)?).with_context(|| format!("fsb {}: not JSON", arguments.join(" ")))
}
