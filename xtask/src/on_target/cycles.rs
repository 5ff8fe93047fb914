//! Cycles of an instruction by the tables of the Cortex-M4 Technical Reference Manual (ARM 100166, earlier DDI 0439: 3.3.1 and 7.2.3).
//!
//! The tables leave two things open: a load or store of one word takes 2 cycles, 1 where it is pipelined, and a taken branch
//! refills the pipeline in 1 to 3. Hence two sums: the fewest and the most that the tables allow. No wait states.

use super::listing::Instruction;

/// The fewest and the most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cycles {
    /// Every load pipelined, refills of 1.
    pub fewest: u32,
    /// No load pipelined, refills of 3.
    pub most: u32,
}

const fn exactly(cycles: u32) -> Cycles {
    Cycles { fewest: cycles, most: cycles }
}

const fn between(fewest: u32, most: u32) -> Cycles {
    Cycles { fewest, most }
}

impl Cycles {
    const fn plus(self, other: Self) -> Self {
        between(self.fewest + other.fewest, self.most + other.most)
    }
}

impl std::ops::AddAssign for Cycles {
    fn add_assign(&mut self, other: Self) {
        *self = self.plus(other);
    }
}

const REFILL: Cycles = between(1, 3);

/// `instruction`, where `jumped` says whether it went elsewhere and `next` what was executed after it.
pub fn of(instruction: &Instruction, jumped: bool, next: Option<&Instruction>) -> Cycles {
    let refill = if jumped { REFILL } else { exactly(0) };
    base(instruction).plus(refill).plus(exactly(u32::from(next.is_some_and(|next| stalls(instruction, next)))))
}

fn base(instruction: &Instruction) -> Cycles {
    let mnemonic = instruction.mnemonic.split('.').next().unwrap_or_default();
    let operands = instruction.operands.as_str();
    if mnemonic.starts_with("it") {
        return between(0, 1);
    }
    if mnemonic.starts_with('v') {
        return floating_point(mnemonic, operands);
    }
    match mnemonic {
        "push" | "pop" | "ldmia" | "ldm" | "stmia" | "stm" | "ldmdb" | "stmdb" => exactly(1 + registers(operands)),
        "ldrd" | "strd" => exactly(3),
        "msr" | "mrs" => exactly(2),
        "udiv" | "sdiv" => between(2, 12),
        "tbb" | "tbh" => exactly(2),
        _ if mnemonic.starts_with("ldr") || mnemonic.starts_with("str") => between(1, 2),
        _ => exactly(1),
    }
}

fn floating_point(mnemonic: &str, operands: &str) -> Cycles {
    let double = operands.trim_start().starts_with('d');
    match mnemonic {
        "vldr" | "vstr" if double => between(2, 3),
        "vldr" | "vstr" => between(1, 2),
        "vpush" | "vpop" | "vldmia" | "vstmia" | "vldmdb" | "vstmdb" => exactly(1 + registers(operands)),
        _ if mnemonic.starts_with("vdiv") || mnemonic.starts_with("vsqrt") => exactly(14),
        _ if accumulates(mnemonic) => exactly(3),
        "vmov" if operands.split(',').count() == 3 => exactly(2),
        _ => exactly(1),
    }
}

fn accumulates(mnemonic: &str) -> bool {
    ["vmla", "vmls", "vnmla", "vnmls", "vfma", "vfms", "vfnma", "vfnms"].iter().any(|name| mnemonic.starts_with(name))
}

/// 32-bit registers in `{r4, r5, d8-d10}`.
fn registers(operands: &str) -> u32 {
    let list = operands.split(['{', '}']).nth(1).unwrap_or_default();
    let number = |name: &str| name.trim().trim_start_matches(['r', 's', 'd']).parse::<u32>().unwrap_or(0);
    list.split(',')
        .map(|item| {
            let words = if item.trim().starts_with('d') { 2 } else { 1 };
            let count = item.split_once('-').map_or(1, |(first, last)| number(last) + 1 - number(first));
            words * count
        })
        .sum()
}

/// Whether `next` consumes the result of a floating-point operation right before it, which costs one more cycle.
fn stalls(instruction: &Instruction, next: &Instruction) -> bool {
    const ARITHMETIC: &[&str] = &["vadd", "vsub", "vmul", "vnmul", "vdiv", "vsqrt", "vcvt"];
    let arithmetic = ARITHMETIC.iter().any(|name| instruction.mnemonic.starts_with(name));
    if !arithmetic && !accumulates(&instruction.mnemonic) {
        return false;
    }
    let result = instruction.operands.split(',').next().unwrap_or_default().trim();
    let reads_first = ["vcmp", "vstr", "vpush"].iter().any(|name| next.mnemonic.starts_with(name));
    let skipped = usize::from(!reads_first && !accumulates(&next.mnemonic));
    next.mnemonic.starts_with('v') && next.operands.split(',').skip(skipped).any(|operand| operand.trim() == result)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn instruction(text: &str) -> Instruction {
        let (mnemonic, operands) = text.split_once(' ').unwrap_or((text, ""));
        Instruction { address: 0, mnemonic: mnemonic.into(), operands: operands.into(), source: None }
    }

    /// Values of the manual.
    #[test]
    fn table() {
        let cycles = |text: &str, jumped: bool| of(&instruction(text), jumped, None);
        assert_eq!(cycles("vadd.f32 s0, s1, s2", false), exactly(1));
        assert_eq!(cycles("vdiv.f32 s0, s1, s2", false), exactly(14));
        assert_eq!(cycles("vfma.f32 s0, s1, s2", false), exactly(3));
        assert_eq!(cycles("vldr s0, [r0, #4]", false), between(1, 2));
        assert_eq!(cycles("vldr d0, [r0, #4]", false), between(2, 3));
        assert_eq!(cycles("vpush {d8-d13}", false), exactly(13));
        assert_eq!(cycles("push {r4, r5, r6, r7, lr}", false), exactly(6));
        assert_eq!(cycles("pop {r4, pc}", true), between(4, 6));
        assert_eq!(cycles("bne.n 8000100 <a>", false), exactly(1));
        assert_eq!(cycles("bne.n 8000100 <a>", true), between(2, 4));
        assert_eq!(cycles("ldr.w r0, [r1, #4]", false), between(1, 2));
        assert_eq!(cycles("strd r0, r1, [r2]", false), exactly(3));
        assert_eq!(cycles("udiv r0, r1, r2", false), between(2, 12));
        assert_eq!(cycles("adds r0, #1", false), exactly(1));
    }

    #[test]
    fn a_result_that_is_used_at_once_costs_one_more() {
        let after = |first: &str, next: &str| of(&instruction(first), false, Some(&instruction(next))).most;
        assert_eq!(after("vadd.f32 s0, s1, s2", "vmul.f32 s3, s4, s0"), 2);
        assert_eq!(after("vadd.f32 s0, s1, s2", "vmul.f32 s0, s4, s3"), 1);
        assert_eq!(after("vadd.f32 s0, s1, s2", "vmla.f32 s0, s4, s3"), 2);
        assert_eq!(after("vmul.f32 s0, s1, s2", "vstr s0, [r0]"), 2);
        assert_eq!(after("vmov.f32 s0, s1", "vstr s0, [r0]"), 1);
        assert_eq!(after("vmul.f32 s1, s1, s2", "vadd.f32 s3, s10, s11"), 1);
    }
}
