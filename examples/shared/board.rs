//! The STM32F405's pins (RM0090): six motors as 20 kHz PWM on PA6, PA7, PB0, PB1 (TIM3) and PB6, PB7 (TIM4), the marker on
//! PA0, the position receiver on PA10 (USART1). All at the 16 MHz that the chip starts with.

use core::convert::Infallible;
use embedded_hal::digital::{ErrorType as PinError, OutputPin};
use embedded_hal::pwm::{ErrorType as PwmError, SetDutyCycle};

/// Core and timer clock [Hz].
pub const CLOCK: u32 = 16_000_000;
/// Counts of a PWM period.
const FULL: u16 = (CLOCK / 20_000) as u16;

const RCC: u32 = 0x4002_3800;
const GPIOA: u32 = 0x4002_0000;
const GPIOB: u32 = 0x4002_0400;
const TIM3: u32 = 0x4000_0400;
const TIM4: u32 = 0x4000_0800;
const USART1: u32 = 0x4001_1000;

/// Puts `bits` where `mask` is.
fn set(register: u32, mask: u32, bits: u32) {
    let register = register as *mut u32;
    // SAFETY: a register of a peripheral that only this file sets up, before any interrupt is enabled.
    unsafe { register.write_volatile((register.read_volatile() & !mask) | bits) };
}

/// Clocks and pins. To be called once, before the motors and the marker are used.
pub fn set_up() -> ([Motor; 6], Marker) {
    set(RCC + 0x30, 0b11, 0b11); // GPIOA, GPIOB
    set(RCC + 0x40, 0b110, 0b110); // TIM3, TIM4
    set(GPIOA, 0b11 | 0xF000, 0b01 | 0xA000); // PA0 output, PA6 and PA7 alternate
    set(GPIOA + 0x20, 0xFF00_0000, 0x2200_0000); // TIM3
    set(GPIOB, 0xF00F, 0xA00A); // PB0, PB1, PB6, PB7 alternate
    set(GPIOB + 0x20, 0xFF00_00FF, 0x2200_0022); // TIM3, TIM4
    for timer in [TIM3, TIM4] {
        set(timer + 0x18, 0xFFFF, 0x6868); // PWM mode 1, preloaded
        set(timer + 0x1C, 0xFFFF, 0x6868);
        set(timer + 0x20, 0xFFFF, 0x1111); // outputs on
        set(timer + 0x2C, 0xFFFF, u32::from(FULL) - 1);
        set(timer, 0xFFFF, 0x81); // on, period preloaded
    }
    let motors = [TIM3 + 0x34, TIM3 + 0x38, TIM3 + 0x3C, TIM3 + 0x40, TIM4 + 0x34, TIM4 + 0x38].map(Motor);
    (motors, Marker(()))
}

/// The receiver's port.
pub fn set_up_port(baud: u32) {
    set(RCC + 0x44, 1 << 4, 1 << 4); // USART1
    set(GPIOA, 0b11 << 20, 0b10 << 20); // PA10 alternate
    set(GPIOA + 0x24, 0xF00, 0x700); // USART1
    set(USART1 + 0x08, 0xFFFF, (CLOCK + baud / 2) / baud);
    set(USART1 + 0x0C, 0xFFFF, (1 << 13) | (1 << 5) | (1 << 2)); // on, receive, interrupt
}

/// The byte that has come, if one has. To be called by the interrupt, or as often as bytes come.
pub fn received() -> Option<u8> {
    const CAME: u32 = 1 << 5;
    /// Another one came before it was taken: it calls the interrupt too, until the data register is read.
    const OVERRUN: u32 = 1 << 3;
    let (status, data) = (USART1 as *const u32, (USART1 + 4) as *const u32);
    // SAFETY: reading the two in this order takes the byte, and ends an overrun; nobody else reads them.
    unsafe {
        let status = status.read_volatile();
        let byte = (status & (CAME | OVERRUN) != 0).then(|| data.read_volatile() as u8);
        byte.filter(|_| status & CAME != 0)
    }
}

/// A motor: the address of its compare register.
pub struct Motor(u32);

impl PwmError for Motor {
    type Error = Infallible;
}

impl SetDutyCycle for Motor {
    fn max_duty_cycle(&self) -> u16 {
        FULL
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        // SAFETY: a compare register that only this motor writes.
        unsafe { (self.0 as *mut u32).write_volatile(u32::from(duty)) };
        Ok(())
    }
}

/// PA0: high while a tick computes.
pub struct Marker(());

impl Marker {
    fn write(&mut self, bits: u32) {
        // SAFETY: BSRR sets and clears single bits.
        unsafe { ((GPIOA + 0x18) as *mut u32).write_volatile(bits) };
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
