//! Functions that do what a tick must not, each to be caught by the step `disassembly`. Never run.
#![no_std]
#![no_main]

use core::alloc::{GlobalAlloc, Layout};
use core::hint::black_box;

use cortex_m_rt::entry;
use semihosting as _;

extern crate alloc;

struct NoMemory;

// SAFETY: it never hands out memory.
unsafe impl GlobalAlloc for NoMemory {
    unsafe fn alloc(&self, _: Layout) -> *mut u8 {
        black_box(core::ptr::null_mut())
    }

    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

#[global_allocator]
static MEMORY: NoMemory = NoMemory;

#[unsafe(no_mangle)]
#[inline(never)]
fn culprit_expf(x: f32) -> f32 {
    libm::expf(x)
}

#[unsafe(no_mangle)]
#[inline(never)]
fn culprit_f64(x: f32) -> f32 {
    (f64::from(x) * 0.1) as f32
}

#[unsafe(no_mangle)]
#[inline(never)]
fn culprit_allocates(x: f32) -> f32 {
    *black_box(alloc::boxed::Box::new(x))
}

#[unsafe(no_mangle)]
#[inline(never)]
fn culprit_recursive(n: u32) -> u32 {
    if n < 2 { n } else { black_box(culprit_recursive(n - 1)) ^ black_box(culprit_recursive(n - 2)) }
}

#[unsafe(no_mangle)]
#[inline(never)]
fn culprit_indirect(call: fn(f32) -> f32) -> f32 {
    call(1.0) + 1.0
}

#[unsafe(no_mangle)]
#[inline(never)]
fn culprit_panics(index: usize) -> f32 {
    black_box([1.0, 2.0])[index]
}

#[entry]
fn main() -> ! {
    loop {
        black_box(culprit_expf(black_box(1.0)));
        black_box(culprit_f64(black_box(1.0)));
        black_box(culprit_allocates(black_box(1.0)));
        black_box(culprit_recursive(black_box(9)));
        black_box(culprit_indirect(black_box(culprit_f64)));
        black_box(culprit_panics(black_box(9)));
    }
}
