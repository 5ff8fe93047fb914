//! The microcontroller: the tick, the marker pin, the motors.
#![allow(unsafe_code, reason = "registers and exception handlers")]

use core::convert::Infallible;
use core::sync::atomic::{AtomicU16, AtomicU32, Ordering};
use cortex_m::peripheral::{SYST, syst::SystClkSource};
use cortex_m_rt::{ExceptionFrame, exception};
use embedded_hal::digital::{ErrorType as PinError, OutputPin};
use embedded_hal::pwm::{ErrorType as PwmError, SetDutyCycle};

use crate::plant::FULL_DUTY;

/// Core clock \[Hz\].
const CLOCK: u32 = 168_000_000;
/// Exit status of a fault; a panic gives 101, a failed check 1.
const FAULT: i32 = 102;

static TICKS: AtomicU32 = AtomicU32::new(0);
static DUTIES: [AtomicU16; 6] = [const { AtomicU16::new(0) }; 6];

#[exception]
fn SysTick() {
    TICKS.fetch_add(1, Ordering::Relaxed);
}

#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    semihosting::eprintln!("hard fault at {:#010x}", frame.pc());
    semihosting::process::exit(FAULT)
}

/// The timer tick: SysTick at a fixed rate.
pub struct Tick {
    seen: u32,
}

impl Tick {
    /// Starts the timer at `rate` \[Hz\].
    pub fn start(mut timer: SYST, rate: u32) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(CLOCK / rate - 1);
        timer.clear_current();
        timer.enable_interrupt();
        timer.enable_counter();
        Self { seen: 0 }
    }

    /// Sleeps until the next tick; returns how many were overrun.
    pub fn wait(&mut self) -> u32 {
        loop {
            let ticks = TICKS.load(Ordering::Relaxed);
            if ticks != self.seen {
                let overrun = ticks.wrapping_sub(self.seen) - 1;
                self.seen = ticks;
                return overrun;
            }
            // A tick between the look and the sleep would be slept through. With interrupts held off it ends the sleep all the same.
            cortex_m::interrupt::free(|_| {
                if TICKS.load(Ordering::Relaxed) == self.seen {
                    cortex_m::asm::wfi();
                }
            });
        }
    }
}

/// A motor as the plant sees it; on a vehicle this is a timer's compare channel.
pub struct Motor(pub u8);

impl PwmError for Motor {
    type Error = Infallible;
}

impl SetDutyCycle for Motor {
    fn max_duty_cycle(&self) -> u16 {
        FULL_DUTY
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        if let Some(slot) = DUTIES.get(usize::from(self.0)) {
            slot.store(duty, Ordering::Relaxed);
        }
        Ok(())
    }
}

/// What the motors turn at.
pub fn duties() -> [u16; 6] {
    core::array::from_fn(|motor| DUTIES.get(motor).map_or(0, |slot| slot.load(Ordering::Relaxed)))
}

/// PA0, for an oscilloscope.
pub struct Marker(());

impl Marker {
    const RCC_AHB1ENR: *mut u32 = 0x4002_3830 as *mut u32;
    const GPIOA_MODER: *mut u32 = 0x4002_0000 as *mut u32;
    const GPIOA_BSRR: *mut u32 = 0x4002_0018 as *mut u32;

    /// Clocks port A and makes PA0 an output.
    pub fn new() -> Self {
        // SAFETY: registers of the STM32F405 (RM0090), nobody else's here; single-threaded start-up.
        unsafe {
            Self::RCC_AHB1ENR.write_volatile(Self::RCC_AHB1ENR.read_volatile() | 1);
            Self::GPIOA_MODER.write_volatile((Self::GPIOA_MODER.read_volatile() & !0b11) | 0b01);
        }
        Self(())
    }

    fn write(&mut self, bits: u32) {
        // SAFETY: writing BSRR sets or clears the named bits atomically.
        unsafe { Self::GPIOA_BSRR.write_volatile(bits) }
    }
}

impl PinError for Marker {
    type Error = Infallible;
}

impl OutputPin for Marker {
    fn set_high(&mut self) -> Result<(), Infallible> {
        self.write(1);
        Ok(())
    }

    fn set_low(&mut self) -> Result<(), Infallible> {
        self.write(1 << 16);
        Ok(())
    }
}
