//! The figure that the README shows.

use std::fs;

use anyhow::{Context, Result};

use super::compare::{Tolerance, same};
use crate::command::root;

/// Where it is kept.
const KEPT: &str = "docs/fig3.svg";

/// Which of the figures of `fsb paper` it is.
pub const NAME: &str = "fig3.svg";

/// Compares the kept figure with a fresh one, or replaces it where it differs.
pub fn update(fresh: &str, write: bool) -> Result<Option<String>> {
    let path = root()?.join(KEPT);
    let kept = fs::read_to_string(&path).unwrap_or_default();
    let Some(difference) = same(&kept, fresh, Tolerance::Drawing) else { return Ok(None) };
    if write {
        fs::write(&path, fresh).with_context(|| format!("cannot write {KEPT}"))?;
    }
    Ok(Some(format!("{KEPT}: {} lines differ", difference.lines().count())))
}
