//! What a tick costs: instructions, counted by the emulator over a minute; cycles, by the published table over the traced
//! first second and a half; what the instructions are for; and the instructions of the crates that others would use.

use std::path::Path;

use anyhow::{Context, Result, bail};

use super::budgets::{self, Measured};
use super::listing::Listing;
use super::programs::{PEERS, TARGET_TESTS};
use super::{emulator, trace};

/// A traced run.
struct Trace {
    /// Of the program.
    argument: &'static str,
    /// What is measured.
    name: &'static str,
    /// What counts; the first begins a tick.
    roots: &'static [&'static str],
    /// What does not.
    others: &'static [&'static str],
}

const SIX: &[&str] = &["six_measure", "six_apply"];
const READ: &[&str] = &["six_states", "six_parameters"];
const TRACES: &[Trace] = &[
    Trace { argument: "trace-blocks", name: "six_axes_blocks_of_10", roots: SIX, others: READ },
    Trace { argument: "trace-singles", name: "six_axes_block_1", roots: SIX, others: READ },
    Trace {
        argument: "trace-between",
        name: "control_tick_without_measurement",
        roots: &["six_states", "six_apply"],
        others: &["six_measure", "six_parameters"],
    },
    Trace { argument: "trace-one", name: "one_axis_block_1", roots: &["one_measure", "one_apply"], others: &[] },
];

/// Counts, sums, compares with `budgets.toml`.
pub fn run() -> Result<()> {
    let program = TARGET_TESTS.build("tick")?;
    let mut counted = parse(&emulator::output(&program, Some("count"))?)?;
    counted.extend(parse(&emulator::output(&TARGET_TESTS.build("vehicle")?, Some("count"))?)?);
    println!(
        "instructions a tick over a minute (vehicle and drag: half of one); a tick is measure and apply, states and parameters are read beside it"
    );
    let instructions = budgets::check("cost", &counted);
    let (cycles, kinds) = traced(&program)?;
    let cycles = budgets::check("cycles", &cycles);
    println!("what the instructions are for, the mean over the first 1.5 s");
    let kinds = budgets::check("kinds", &kinds);
    peers()?;
    instructions.and(cycles).and(kinds)
}

/// `name mean 12.34 worst 20 tick 7`
fn parse(lines: &[String]) -> Result<Measured> {
    let mut measured = Vec::new();
    for line in lines {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [name, "mean", mean, "worst", worst, "tick", tick] = words[..] else { bail!("not understood: {line}") };
        let number = |text: &str| text.parse::<f64>().with_context(|| format!("no number in: {line}"));
        println!("  {name}: worst at tick {tick}");
        measured.push((format!("{name}_mean"), number(mean)?));
        measured.push((format!("{name}_worst"), number(worst)?));
    }
    Ok(measured)
}

/// Cycles, and what the instructions are for.
fn traced(program: &Path) -> Result<(Measured, Measured)> {
    let listing = Listing::of(program)?;
    let (mut cycles, mut kinds) = (Measured::new(), Measured::new());
    println!("cycles by the table (ARM 100166): the fewest it allows, and the most, which have the budget");
    for Trace { argument, name, roots, others } in TRACES {
        let ticks = trace::ticks(program, &listing, argument, roots, others)?;
        let mean = |each: &dyn Fn(&trace::Tick) -> u32| {
            let sum: u64 = ticks.iter().map(|tick| u64::from(each(tick))).sum();
            (sum as f64 / ticks.len() as f64 * 10.0).round() / 10.0
        };
        let worst = ticks.iter().max_by_key(|tick| tick.cycles.most).context("no ticks")?;
        println!(
            "  {name}: {} ticks, mean {} instructions, {} to {} cycles; worst {} instructions, {} to {} cycles",
            ticks.len(),
            mean(&|tick| tick.instructions),
            mean(&|tick| tick.cycles.fewest),
            mean(&|tick| tick.cycles.most),
            worst.instructions,
            worst.cycles.fewest,
            worst.cycles.most,
        );
        cycles.push((format!("{name}_mean"), mean(&|tick| tick.cycles.most)));
        cycles.push((format!("{name}_worst"), f64::from(worst.cycles.most)));
        kinds.push((format!("{name}_arithmetic"), mean(&|tick| tick.kinds.arithmetic)));
        kinds.push((format!("{name}_loads"), mean(&|tick| tick.kinds.loads)));
        kinds.push((format!("{name}_stores"), mean(&|tick| tick.kinds.stores)));
        kinds.push((format!("{name}_rest"), mean(&|tick| tick.kinds.rest)));
    }
    Ok((cycles, kinds))
}

/// For comparison only: no budget.
fn peers() -> Result<()> {
    println!(
        "six axes of a two-state Kalman filter and a scalar recursive least squares from crates.io, instructions:"
    );
    for line in emulator::output(&PEERS.build("peers")?, None)? {
        println!("  {line}");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_program() {
        let measured = parse(&["a mean 12.50 worst 20 tick 7".into()]).unwrap();
        assert_eq!(measured, [("a_mean".to_string(), 12.5), ("a_worst".to_string(), 20.0)]);
        assert!(parse(&["a mean x worst 20 tick 7".into()]).is_err());
        assert!(parse(&["a panicked".into()]).is_err());
    }
}
