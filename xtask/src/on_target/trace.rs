//! Ticks instruction by instruction: how many of them, and how many cycles by the published table.

use std::collections::HashMap;
use std::path::Path;

use anyhow::{Context, Result, bail};

use super::cycles::{self, Cycles};
use super::emulator;
use super::listing::{Instruction, Listing};

/// What one tick took.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tick {
    /// Instructions.
    pub instructions: u32,
    /// By the table.
    pub cycles: Cycles,
    /// What the instructions are for.
    pub kinds: Kinds,
}

/// Instructions by what they are for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kinds {
    /// From memory into registers.
    pub loads: u32,
    /// From registers into memory.
    pub stores: u32,
    /// Of floating point: sums, products, quotients, magnitudes.
    pub arithmetic: u32,
    /// Comparisons, branches, calls, integers.
    pub rest: u32,
}

impl Kinds {
    fn count(&mut self, mnemonic: &str) {
        let starts = |names: &[&str]| names.iter().any(|name| mnemonic.starts_with(name));
        let counter = if starts(&["ldr", "ldm", "vldr", "vldm", "pop", "vpop"]) {
            &mut self.loads
        } else if starts(&["str", "stm", "vstr", "vstm", "push", "vpush"]) {
            &mut self.stores
        } else if starts(&["vadd", "vsub", "vmul", "vnmul", "vdiv", "vabs", "vneg", "vsqrt"]) {
            &mut self.arithmetic
        } else {
            &mut self.rest
        };
        *counter += 1;
    }
}

/// Runs `program` with `argument` and follows it through the functions reachable from `roots`. A tick is what is between
/// two entries of the first of `roots`; what runs in or is called from `roots` counts, and from `others` does not.
pub fn ticks(program: &Path, listing: &Listing, argument: &str, roots: &[&str], others: &[&str]) -> Result<Vec<Tick>> {
    let reachable = listing.reachable(&[roots, others].concat())?;
    let mut code: HashMap<u32, (&Instruction, Option<u32>)> = HashMap::new();
    let mut ranges = Vec::new();
    for function in &reachable {
        let body = listing.functions.get(function).context("a function without a body")?;
        ranges.push(format!("{function:#x}+{:#x}", body.size));
        for (index, instruction) in body.instructions.iter().enumerate() {
            let after = body.instructions.get(index + 1).map(|next| next.address);
            code.insert(instruction.address, (instruction, after));
        }
    }
    let entries = roots.iter().map(|root| listing.named(root)).collect::<Result<Vec<u32>>>()?;
    let excluded = others.iter().map(|other| listing.named(other)).collect::<Result<Vec<u32>>>()?;
    let mut ticks: Vec<Tick> = Vec::new();
    let mut counting = false;
    let mut before: Option<u32> = None;
    let mut account = |at: u32, next: Option<u32>, ticks: &mut Vec<Tick>| -> Result<()> {
        let (instruction, after) =
            code.get(&at).with_context(|| format!("executed {at:#x}, which is no instruction"))?;
        if at == entries[0] {
            ticks.push(Tick::default());
        }
        if entries.contains(&at) || excluded.contains(&at) {
            counting = entries.contains(&at);
        }
        let Some(tick) = ticks.last_mut().filter(|_| counting) else { return Ok(()) };
        // The next one logged is in another call where this one returned to the caller.
        let left = next.is_none_or(|next| entries.contains(&next) || excluded.contains(&next));
        let following = next.filter(|_| !left).and_then(|next| code.get(&next)).map(|(instruction, _)| *instruction);
        tick.instructions += 1;
        tick.kinds.count(&instruction.mnemonic);
        tick.cycles += cycles::of(instruction, left || next != *after, following);
        Ok(())
    };
    emulator::traced(program, argument, &ranges.join(","), |line| {
        // The instruction logged last was put off for an interrupt of the emulator's own; it will be logged again.
        if line.starts_with("Stopped execution of TB chain") {
            before = None;
            return Ok(());
        }
        let Some(at) = address(line) else { bail!("the emulator says: {line}") };
        if let Some(before) = before {
            account(before, Some(at), &mut ticks)?;
        }
        before = Some(at);
        Ok(())
    })?;
    if let Some(before) = before {
        account(before, None, &mut ticks)?;
    }
    if ticks.is_empty() {
        bail!("the emulator logged no tick");
    }
    Ok(ticks)
}

/// `Trace 0: 0x7f845422de00 [00800400/080150c4/00000010/ff020201] name`
fn address(line: &str) -> Option<u32> {
    let rest = line.strip_prefix("Trace ")?;
    u32::from_str_radix(rest.split('/').nth(1)?, 16).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_instructions() {
        let mut kinds = Kinds::default();
        for mnemonic in
            ["vldr", "ldrb.w", "pop", "vstr", "strd", "vadd.f32", "vdiv.f32", "vcmp.f32", "bl", "adds", "vmov.f32"]
        {
            kinds.count(mnemonic);
        }
        assert_eq!(kinds, Kinds { loads: 3, stores: 2, arithmetic: 2, rest: 4 });
    }

    #[test]
    fn log_lines() {
        let line = "Trace 0: 0x7f845422de00 [00800400/080150c4/00000010/ff020201] six_measure";
        assert_eq!(address(line), Some(0x0801_50c4));
        assert_eq!(address("qemu: something else"), None);
    }
}
