//! What a tick costs on the target, from `budgets.toml`: the steps `cost`, `size` and `c` hold that file to what they measure.

use std::fs;

use anyhow::{Context, Result};
use toml::Table;

use crate::command::root;

/// What is shown, and under which name.
const ROWS: &[(&str, &str, &str, &str)] = &[
    ("six axes, blocks of 10, `measure` and `apply`: mean", "cost", "six_axes_blocks_of_10_mean", "instructions"),
    ("the same, worst tick", "cost", "six_axes_blocks_of_10_worst", "instructions"),
    ("six axes, every sample a block: mean", "cost", "six_axes_block_1_mean", "instructions"),
    ("the same, worst tick", "cost", "six_axes_block_1_worst", "instructions"),
    (
        "control tick without measurement, `states` and `apply`",
        "cost",
        "control_tick_without_measurement_mean",
        "instructions",
    ),
    ("one axis alone, every sample a block: mean", "cost", "one_axis_block_1_mean", "instructions"),
    ("six axes, blocks of 10: mean", "cycles", "six_axes_blocks_of_10_mean", "cycles at most, by the table"),
    ("state of six axes", "size", "bytes_of_state", "bytes"),
    ("constants of six axes", "size", "bytes_of_design", "bytes"),
    ("code that a tick can reach", "size", "bytes_of_code", "bytes"),
    ("stack of a tick", "size", "bytes_of_stack", "bytes"),
    ("`libfsb.a` in the C example", "c", "bytes_of_library", "bytes"),
];

/// The table.
pub fn table() -> Result<String> {
    let text = fs::read_to_string(root()?.join("budgets.toml")).context("cannot read budgets.toml")?;
    let file: Table = text.parse().context("budgets.toml is no TOML")?;
    let mut out = String::from("| | measured | goal | |\n|---|---|---|---|\n");
    for (what, group, name, unit) in ROWS {
        let entry = file.get(*group).and_then(|g| g.get(name)).with_context(|| format!("no [{group}.{name}]"))?;
        let number = |key: &str| entry.get(key).and_then(|v| v.as_float().or(v.as_integer().map(|i| i as f64)));
        let measured = number("measured").with_context(|| format!("{group}.{name} lacks `measured`"))?;
        let goal = number("goal").map_or(String::from("–"), |goal| format!("{goal:.0}"));
        out += &format!("| {what} | {measured:.0} | {goal} | {unit} |\n");
    }
    Ok(out)
}
