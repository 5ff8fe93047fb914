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
        "control tick without measurement, `states` and `apply`, worst",
        "cost",
        "control_tick_without_measurement_worst",
        "instructions",
    ),
    ("one axis alone, every sample a block: mean", "cost", "one_axis_block_1_mean", "instructions"),
    ("the same, worst tick", "cost", "one_axis_block_1_worst", "instructions"),
    ("six axes, blocks of 10: mean", "cycles", "six_axes_blocks_of_10_mean", "cycles at most, by the table"),
    ("state of six axes", "size", "bytes_of_state", "bytes"),
    ("constants of six axes", "size", "bytes_of_design", "bytes"),
    ("code that a tick can reach", "size", "bytes_of_code", "bytes"),
    ("stack of a tick", "size", "bytes_of_stack", "bytes"),
    ("`libfsb.a` in the C example", "c", "bytes_of_library", "bytes"),
];

/// The table.
pub fn table() -> Result<String> {
    let file = read()?;
    let mut out = String::from("| | measured | goal | |\n|---|---|---|---|\n");
    for (what, group, name, unit) in ROWS {
        let measured = number(&file, group, name, "measured")?;
        let goal = number(&file, group, name, "goal").map_or(String::from("–"), |goal| format!("{goal:.0}"));
        out += &format!("| {what} | {measured:.0} | {goal} | {unit} |\n");
    }
    Ok(out)
}

/// What the instructions of a tick are for.
pub fn kinds() -> Result<String> {
    let file = read()?;
    let mut out = String::from(
        "| a tick, mean | arithmetic | loads | stores | together | comparisons, branches, integers |\n|---|---|---|---|---|---|\n",
    );
    for (what, name) in [
        ("six axes, blocks of 10", "six_axes_blocks_of_10"),
        ("six axes, every sample a block", "six_axes_block_1"),
        ("control tick without measurement", "control_tick_without_measurement"),
        ("one axis, every sample a block", "one_axis_block_1"),
    ] {
        let mean = |kind: &str| number(&file, "kinds", &format!("{name}_{kind}"), "measured");
        let (arithmetic, loads, stores) = (mean("arithmetic")?, mean("loads")?, mean("stores")?);
        let (together, rest) = (arithmetic + loads + stores, mean("rest")?);
        out += &format!("| {what} | {arithmetic:.0} | {loads:.0} | {stores:.0} | {together:.0} | {rest:.0} |\n");
    }
    Ok(out)
}

fn read() -> Result<Table> {
    let text = fs::read_to_string(root()?.join("budgets.toml")).context("cannot read budgets.toml")?;
    text.parse().context("budgets.toml is no TOML")
}

fn number(file: &Table, group: &str, name: &str, key: &str) -> Result<f64> {
    file.get(group)
        .and_then(|entries| entries.get(name))
        .and_then(|entry| entry.get(key))
        .and_then(|value| value.as_float().or(value.as_integer().map(|integer| integer as f64)))
        .with_context(|| format!("no `{key}` in [{group}.{name}]"))
}
