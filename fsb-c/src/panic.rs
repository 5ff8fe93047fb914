//! The panic handler. No panic is reachable from the interface (the gate links it with `panic-never` to prove that), so
//! that the linker drops this one from a firmware.

#[cfg(feature = "panic-never")]
use panic_never as _;

/// Traps: the firmware's fault handler reports the place and does what it does after a fault.
#[cfg(not(feature = "panic-never"))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        // SAFETY: an undefined instruction touches no memory and no register; it raises the fault that is wanted here.
        unsafe { core::arch::asm!("udf #0") }
    }
}

/// What the check for reachable panics must find: built by `cargo xtask c` alone, to show that the check can fail.
///
/// cbindgen:ignore
#[cfg(reachable_panic)]
#[unsafe(no_mangle)]
extern "C" fn fsb_reachable_panic(index: usize) -> u8 {
    b"fsb"[index]
}
