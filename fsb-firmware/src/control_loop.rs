//! One tick, and the pacing.

use crate::allocation::Allocation;
use crate::axes::Axes;
use crate::bearing::Bearing;
use crate::config::{LoopConfig, LoopConfigError};
use crate::events::{Event, Events};
use crate::sample::{Attitude, Report, Sample};
use core::fmt;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use fsb_core::control::{Reference, to_body};
use fsb_core::estimator::{Counters, StateStatus};
use fsb_core::guard::Rejections;
use fsb_core::readout::{Parameter, ParameterStatus};

#[cfg(test)]
mod tests;

/// A peripheral failed. The tick was completed all the same: every other motor has its duty, the estimators their input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LoopError<M, P> {
    /// The motor of this number took no duty.
    Motor(u8, M),
    /// The marker pin.
    Marker(P),
}

impl<M: fmt::Debug, P: fmt::Debug> fmt::Display for LoopError<M, P> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motor(motor, error) => write!(out, "motor {motor}: {error:?}"),
            Self::Marker(error) => write!(out, "marker pin: {error:?}"),
        }
    }
}

impl<M: fmt::Debug, P: fmt::Debug> core::error::Error for LoopError<M, P> {}

/// Six axes, six motors, a pin that is high while a tick computes.
#[derive(Debug)]
pub struct ControlLoop<M, P> {
    axes: Axes,
    allocation: Allocation,
    motors: [M; 6],
    marker: P,
    bearing: Bearing,
    saturated: u8,
    tick: u32,
    events: Events,
}

impl<M: SetDutyCycle, P: OutputPin> ControlLoop<M, P> {
    /// Validates `config`. No motor is touched before the first tick.
    ///
    /// # Errors
    /// [`LoopConfigError`] names the part at fault.
    pub fn new(config: &LoopConfig, motors: [M; 6], marker: P) -> Result<Self, LoopConfigError> {
        Ok(Self {
            axes: Axes::new(config)?,
            allocation: config.allocation,
            motors,
            marker,
            bearing: Bearing::of(config),
            saturated: 0,
            tick: 0,
            events: Events::default(),
        })
    }

    /// One control period, to be called by the timer tick. `sample` is what was measured just now, `None` between two
    /// measurement instants or where it did not come; `wanted` is where x, y, z, φ, θ, ψ shall be.
    ///
    /// # Errors
    /// [`LoopError`] for the first peripheral that failed.
    pub fn tick(
        &mut self,
        sample: Option<&Sample>,
        wanted: &[Reference; 6],
    ) -> Result<Report, LoopError<M::Error, P::Error>> {
        let raised = self.marker.set_high();
        let outcome = self.compute(sample, wanted);
        let lowered = self.marker.set_low();
        let report = outcome?;
        raised.and(lowered).map_err(LoopError::Marker)?;
        Ok(report)
    }

    fn compute(
        &mut self,
        sample: Option<&Sample>,
        wanted: &[Reference; 6],
    ) -> Result<Report, LoopError<M::Error, P::Error>> {
        let tick = self.tick;
        self.tick = tick.wrapping_add(1);
        let trusted = self.axes.measure(sample, tick, &mut self.events);
        self.bearing.update(sample.map(|sample| &sample.attitude), trusted, tick, &mut self.events);
        let pointed = self.bearing.is_known();
        self.axes.point(pointed);
        let attitude = *self.bearing.matrix();
        let states = self.axes.states(tick, &mut self.events);
        let [x, y, z, p, q, r] = self.axes.input(&states, wanted, pointed, tick, &mut self.events);
        let [x, y, z] = to_body(&attitude, &[x, y, z]);
        let wrench = [x, y, z, p, q, r];
        let mut thrusts = self.allocation.thrusts(&wrench);
        let saturated = self.allocation.beyond(&thrusts);
        if saturated != 0 {
            thrusts = self.allocation.bounded(&wrench);
        }
        let (duties, thrusts, outcome) = self.drive(&thrusts);
        let [x, y, z, p, q, r] = self.allocation.wrench(&thrusts);
        let [x, y, z] = to_world(&attitude, &[x, y, z]);
        let input = [x, y, z, p, q, r];
        self.axes.apply(&input);
        self.note_saturation(saturated, tick);
        self.axes.report(tick, &mut self.events);
        outcome.map(|()| Report { duties, saturated, input, states })
    }

    /// Sets the duties nearest to `wanted` \[N\], which the motors have; returns them, and the thrusts \[N\] they make.
    #[expect(clippy::type_complexity, reason = "one caller")]
    fn drive(&mut self, wanted: &[f32; 6]) -> ([u16; 6], [f32; 6], Result<(), LoopError<M::Error, P::Error>>) {
        let (mut duties, mut thrusts, mut outcome) = ([0; 6], [0.0; 6], Ok(()));
        let outs = duties.iter_mut().zip(&mut thrusts);
        for (index, ((motor, &wanted), (duty, thrust))) in self.motors.iter_mut().zip(wanted).zip(outs).enumerate() {
            let full = f32::from(motor.max_duty_cycle().max(1));
            let share = wanted / self.allocation.thrust_max();
            *duty = (share * full + 0.5) as u16;
            *thrust = f32::from(*duty) / full * self.allocation.thrust_max();
            if let Err(error) = motor.set_duty_cycle(*duty)
                && outcome.is_ok()
            {
                outcome = Err(LoopError::Motor(index as u8, error));
            }
        }
        (duties, thrusts, outcome)
    }

    fn note_saturation(&mut self, saturated: u8, tick: u32) {
        if saturated & !self.saturated != 0 {
            self.events.push(tick, Event::Saturated(saturated));
        } else if saturated == 0 && self.saturated != 0 {
            self.events.push(tick, Event::SaturationOver);
        }
        self.saturated = saturated;
    }

    /// Ticks without a timer: `source` brings sample and reference of a tick, or `None` to end; after each tick `delay`
    /// waits `pause_ns`. The period is the pause plus what the tick takes, so take a timer where it matters.
    ///
    /// # Errors
    /// As [`tick`](Self::tick), at the first failure.
    pub fn run(
        &mut self,
        delay: &mut impl DelayNs,
        pause_ns: u32,
        mut source: impl FnMut() -> Option<(Option<Sample>, [Reference; 6])>,
    ) -> Result<(), LoopError<M::Error, P::Error>> {
        while let Some((sample, wanted)) = source() {
            self.tick(sample.as_ref(), &wanted)?;
            delay.delay_ns(pause_ns);
        }
        Ok(())
    }

    /// Starts the estimators anew, after a crash, a pick-up, or a change of payload.
    pub fn reset(&mut self) {
        self.axes.reset();
        self.events.push(self.tick, Event::Reset);
    }

    /// 1/m \[1/kg\], 1/Ix, 1/Iy, 1/Iz \[1/(kg m²)\], where they may be used.
    pub fn parameters(&self) -> [Option<Parameter>; 4] {
        self.axes.parameters()
    }

    /// Why a parameter may be used or not.
    pub fn parameter_status(&self) -> [ParameterStatus; 4] {
        let ([mass], [x, y, z]) = (self.axes.translation.parameter_status(), self.axes.rotation.parameter_status());
        [mass, x, y, z]
    }

    /// Why a state may be used or not.
    pub fn state_status(&self) -> [StateStatus; 6] {
        let ([x, y, z], [p, q, r]) = (self.axes.translation.state_status(), self.axes.rotation.state_status());
        [x, y, z, p, q, r]
    }

    /// What the translation's and the rotation's gate turned away, by reason.
    pub const fn rejections(&self) -> [Rejections; 2] {
        [self.axes.translation.rejections(), self.axes.rotation.rejections()]
    }

    /// What the translation's and the rotation's estimator missed, what its gate turned away among it.
    pub fn counters(&self) -> [Counters; 2] {
        [self.axes.translation.counters(), self.axes.rotation.counters()]
    }

    /// The event ring.
    pub const fn events(&mut self) -> &mut Events {
        &mut self.events
    }

    /// Gives the peripherals back.
    pub fn release(self) -> ([M; 6], P) {
        (self.motors, self.marker)
    }
}

/// f = R F: a force in the body frame, expressed in the world frame.
fn to_world(attitude: &Attitude, &[x, y, z]: &[f32; 3]) -> [f32; 3] {
    attitude.map(|[of_x, of_y, of_z]| of_x * x + of_y * y + of_z * z)
}
