//! The stack that a call uses.

/// Words painted below the stack pointer.
const PAINTED: usize = 1024;
const PAINT: u32 = 0xC0FF_EE11;

/// Bytes below the caller's frame that `run` and what it calls have written to.
#[inline(always)]
pub fn stack_of(run: impl FnOnce()) -> usize {
    let top: usize;
    // SAFETY: reads the stack pointer.
    unsafe { core::arch::asm!("mov {}, sp", out(reg) top) };
    let bottom = top - 4 * PAINTED;
    for word in 0..PAINTED {
        // SAFETY: below the stack pointer is RAM that nobody uses: no interrupt is enabled, and the stack has 128 KiB.
        unsafe { ((bottom + 4 * word) as *mut u32).write_volatile(PAINT) };
    }
    run();
    let mut clean = 0;
    // SAFETY: as above.
    while clean < PAINTED && unsafe { ((bottom + 4 * clean) as *const u32).read_volatile() } == PAINT {
        clean += 1;
    }
    4 * (PAINTED - clean)
}
