//! A program, disassembled by `arm-none-eabi-objdump` (Debian: binutils-arm-none-eabi).

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::command::{on_path, output};

const OBJDUMP: &str = "arm-none-eabi-objdump";

/// One instruction.
#[derive(Clone, Debug, PartialEq)]
pub struct Instruction {
    /// Where it is.
    pub address: u32,
    /// `vadd.f32`
    pub mnemonic: String,
    /// `s0, s4, s2`
    pub operands: String,
    /// The source file it is from, inlined or not, where the line tables say so.
    pub source: Option<String>,
}

/// A function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Demangled.
    pub name: String,
    /// Bytes, literal pools included.
    pub size: u32,
    /// In order.
    pub instructions: Vec<Instruction>,
}

/// All functions by address.
#[derive(Clone, Debug, Default)]
pub struct Listing {
    /// By the address of the first instruction.
    pub functions: BTreeMap<u32, Function>,
}

impl Instruction {
    /// The address it goes to, for a direct branch or call.
    pub fn target(&self) -> Option<u32> {
        let branch =
            self.mnemonic.starts_with('b') && !self.mnemonic.starts_with("bf") && !self.mnemonic.starts_with("bi");
        if !(branch || self.mnemonic.starts_with("cb")) {
            return None;
        }
        // Names of generic functions have commas too.
        let target = self.operands.split('<').next()?.split(',').next_back()?.trim();
        u32::from_str_radix(target, 16).ok()
    }

    /// A call or a jump to an address in a register; returns and the tables of a `match` are none.
    pub fn is_indirect(&self) -> bool {
        let first = self.operands.split(',').next().unwrap_or_default().trim();
        match self.mnemonic.as_str() {
            "blx" => self.target().is_none(),
            "bx" => first != "lr",
            "mov" | "ldr" | "ldr.w" | "add" => first == "pc",
            _ => false,
        }
    }
}

impl Listing {
    /// Disassembles `program`.
    pub fn of(program: &Path) -> Result<Self> {
        if !on_path(OBJDUMP) {
            bail!("{OBJDUMP} is missing, and without it nothing can be said about the code: run `cargo xtask setup`");
        }
        let path = program.to_str().context("a path that is not UTF-8")?;
        let listing = Self::parse(&output(OBJDUMP, &["-d", "-l", "-C", "--no-show-raw-insn", path])?);
        if listing.functions.is_empty() {
            bail!("no functions in {path}");
        }
        Ok(listing)
    }

    fn parse(text: &str) -> Self {
        let mut listing = Self::default();
        let mut current = None;
        let mut source = None;
        for line in text.lines() {
            if let Some((address, name)) = header(line) {
                if let Some(before) = listing.functions.values_mut().next_back() {
                    close(before, address);
                }
                let function = Function { name: name.into(), size: 0, instructions: Vec::new() };
                listing.functions.insert(address, function);
                (current, source) = (Some(address), None);
            } else if let Some((at, rest)) = line.split_once(":\t") {
                let Ok(address) = u32::from_str_radix(at.trim(), 16) else { continue };
                let (mnemonic, operands) = rest.split_once('\t').unwrap_or((rest, ""));
                let operands = operands.split([';', '@']).next().unwrap_or_default().trim();
                let Some(function) = current.and_then(|start| listing.functions.get_mut(&start)) else { continue };
                function.instructions.push(Instruction {
                    address,
                    mnemonic: mnemonic.trim().into(),
                    operands: operands.into(),
                    source: source.clone(),
                });
            } else if let Some(file) = source_line(line) {
                source = Some(file.to_string());
            }
        }
        if let Some(last) = listing.functions.values_mut().next_back() {
            let end = last.instructions.last().map_or(0, |instruction| instruction.address + 4);
            close(last, end);
        }
        listing
    }

    /// The function of this name.
    pub fn named(&self, name: &str) -> Result<u32> {
        let found = self.functions.iter().find(|(_, function)| function.name == name);
        found.map(|(address, _)| *address).with_context(|| format!("no function {name} in the program"))
    }

    /// The function that holds `address`.
    pub fn holding(&self, address: u32) -> Option<u32> {
        let (start, function) = self.functions.range(..=address).next_back()?;
        (address < start + function.size).then_some(*start)
    }

    /// The functions that a function calls or jumps into.
    pub fn callees(&self, function: u32) -> Vec<u32> {
        let mut callees = Vec::new();
        let Some(body) = self.functions.get(&function) else { return callees };
        for instruction in &body.instructions {
            let Some(holder) = instruction.target().and_then(|target| self.holding(target)) else { continue };
            let call = instruction.mnemonic.starts_with("bl");
            let is_call = call
                && !matches!(instruction.mnemonic.as_str(), "blt.n" | "blt.w" | "ble.n" | "ble.w" | "bls.n" | "bls.w");
            if (holder != function || is_call) && !callees.contains(&holder) {
                callees.push(holder);
            }
        }
        callees
    }

    /// Everything that can be reached from the functions of these names, them included.
    pub fn reachable(&self, roots: &[&str]) -> Result<Vec<u32>> {
        let mut found = Vec::new();
        let mut open = roots.iter().map(|root| self.named(root)).collect::<Result<Vec<u32>>>()?;
        while let Some(function) = open.pop() {
            if !found.contains(&function) {
                found.push(function);
                open.extend(self.callees(function));
            }
        }
        found.sort_unstable();
        Ok(found)
    }
}

/// `08000458 <name>:`
fn header(line: &str) -> Option<(u32, &str)> {
    let (address, name) = line.split_once(" <")?;
    let name = name.strip_suffix(">:")?;
    Some((u32::from_str_radix(address, 16).ok()?, name))
}

/// `path:12` or `path:12 (discriminator 3)`
fn source_line(line: &str) -> Option<&str> {
    let line = line.split(" (discriminator").next()?;
    let (file, number) = line.rsplit_once(':')?;
    (!line.starts_with(' ') && number.parse::<u32>().is_ok()).then_some(file)
}

/// The size, now that the address behind the function is known.
fn close(function: &mut Function, end: u32) {
    // What the linker fills up with reads as a conditional branch, which no function ends with.
    if function.instructions.last().is_some_and(|last| last.mnemonic == "bmi.n") {
        function.instructions.pop();
    }
    if let Some(first) = function.instructions.first() {
        function.size = end - first.address;
    }
}

/// A listing for tests.
#[cfg(test)]
pub fn parsed(text: &str) -> Listing {
    Listing::parse(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "
08000100 <a>:
a():
/src/a.rs:12
 8000100:\tpush\t{r4, lr}
 8000102:\tbl\t8000110 <b::C<_,_>>
/src/lib.rs:7 (discriminator 2)
 8000106:\tldr.w\tr0, [r4, #1024]\t@ 0x400
 800010a:\tbne.n\t8000102 <a+0x2>
 800010c:\tpop\t{r4, pc}
 800010e:\tnop

08000110 <b::C<_,_>>:
 8000110:\tblx\tr3
 8000112:\tb.w\t8000110 <b::C<_,_>>
";

    #[test]
    fn functions_calls_and_sources() {
        let listing = parsed(TEXT);
        let a = &listing.functions[&0x0800_0100];
        assert_eq!((a.name.as_str(), a.size, a.instructions.len()), ("a", 16, 6));
        assert_eq!(a.instructions[0].source.as_deref(), Some("/src/a.rs"));
        assert_eq!(a.instructions[2].operands, "r0, [r4, #1024]");
        assert_eq!(a.instructions[2].source.as_deref(), Some("/src/lib.rs"));
        assert_eq!(listing.callees(0x0800_0100), [0x0800_0110]);
        assert_eq!(listing.holding(0x0800_010a), Some(0x0800_0100));
        assert_eq!(listing.reachable(&["a"]).unwrap(), [0x0800_0100, 0x0800_0110]);
        assert!(listing.named("c").is_err());
    }

    #[test]
    fn indirect_calls() {
        let indirect = |mnemonic: &str, operands: &str| {
            Instruction { address: 0, mnemonic: mnemonic.into(), operands: operands.into(), source: None }.is_indirect()
        };
        assert!(indirect("blx", "r3") && indirect("bx", "r0") && indirect("ldr.w", "pc, [r0]"));
        assert!(!indirect("bx", "lr") && !indirect("blx", "8000110 <a>") && !indirect("ldr", "r0, [pc, #4]"));
    }
}
