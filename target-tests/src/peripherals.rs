//! Motors and a pin that do nothing but keep what they were told.

use core::convert::Infallible;
use embedded_hal::digital::{ErrorType as PinError, OutputPin};
use embedded_hal::pwm::{ErrorType as PwmError, SetDutyCycle};

/// A motor.
#[derive(Clone, Copy, Debug, Default)]
pub struct Motor(pub u16);

impl PwmError for Motor {
    type Error = Infallible;
}

impl SetDutyCycle for Motor {
    fn max_duty_cycle(&self) -> u16 {
        8400
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.0 = duty;
        Ok(())
    }
}

/// The marker pin.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pin(pub bool);

impl PinError for Pin {
    type Error = Infallible;
}

impl OutputPin for Pin {
    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0 = true;
        Ok(())
    }

    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0 = false;
        Ok(())
    }
}
