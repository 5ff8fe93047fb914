//! The emulated STM32F405.

use cortex_m_rt::{ExceptionFrame, exception};

/// Exit status of a fault; a panic gives 101.
const FAULT: i32 = 102;

/// Instructions executed so far, modulo 2^32: the counter of TIM2, which under `-icount shift=0` takes one step each.
#[inline(always)]
pub fn instructions() -> u32 {
    const TIM2_CNT: *const u32 = 0x4000_0024 as *const u32;
    // SAFETY: a readable register of the STM32F405; reading it has no effect.
    unsafe { TIM2_CNT.read_volatile() }
}

/// What two readings with nothing in between differ by.
pub fn overhead() -> u32 {
    let before = instructions();
    let after = instructions();
    after.wrapping_sub(before)
}

#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    semihosting::eprintln!("hard fault at {:#010x}", frame.pc());
    semihosting::process::exit(FAULT)
}
