//! One tick, and the pacing.

use crate::allocation::Allocation;
use crate::axes::Axes;
use crate::config::{LoopConfig, LoopConfigError};
use crate::events::{Event, Events};
use crate::sample::{Attitude, Report, Sample};
use core::fmt;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use fsb_core::control::{Reference, to_body};
use fsb_core::estimator::{Counters, StateStatus};
use fsb_core::readout::{Parameter, ParameterStatus};

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
    attitude: Attitude,
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
            attitude: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
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
        if let Some(sample) = sample {
            if self.axes.measure(sample).is_err() {
                self.events.push(tick, Event::SampleEarly);
            }
            if sample.attitude.iter().flatten().all(|entry| entry.is_finite()) {
                self.attitude = sample.attitude;
            } else {
                self.events.push(tick, Event::AttitudeRejected);
            }
        }
        let states = self.axes.states();
        let [x, y, z, p, q, r] = self.axes.input(&states, wanted, tick, &mut self.events);
        let [x, y, z] = to_body(&self.attitude, &[x, y, z]);
        let (duties, saturated, thrusts, outcome) = self.drive(&self.allocation.thrusts(&[x, y, z, p, q, r]));
        let [x, y, z, p, q, r] = self.allocation.wrench(&thrusts);
        let [x, y, z] = to_world(&self.attitude, &[x, y, z]);
        let input = [x, y, z, p, q, r];
        self.axes.apply(&input);
        self.note_saturation(saturated, tick);
        self.axes.report(tick, &mut self.events);
        outcome.map(|()| Report { duties, saturated, input, states })
    }

    /// Sets the duties nearest to `wanted` \[N\]; returns them, the motors that saturate, and the thrusts \[N\] they make.
    #[expect(clippy::type_complexity, reason = "one caller")]
    fn drive(&mut self, wanted: &[f32; 6]) -> ([u16; 6], u8, [f32; 6], Result<(), LoopError<M::Error, P::Error>>) {
        let (mut duties, mut thrusts, mut saturated, mut outcome) = ([0; 6], [0.0; 6], 0, Ok(()));
        let outs = duties.iter_mut().zip(&mut thrusts);
        for (index, ((motor, &wanted), (duty, thrust))) in self.motors.iter_mut().zip(wanted).zip(outs).enumerate() {
            let full = f32::from(motor.max_duty_cycle().max(1));
            let share = wanted / self.allocation.thrust_max();
            if !(0.0..=1.0).contains(&share) {
                saturated |= 1 << index;
            }
            let bounded = if share > 1.0 { 1.0 } else { share };
            // `as` takes what is negative to 0, and what is NaN.
            *duty = (bounded * full + 0.5) as u16;
            *thrust = f32::from(*duty) / full * self.allocation.thrust_max();
            if let Err(error) = motor.set_duty_cycle(*duty)
                && outcome.is_ok()
            {
                outcome = Err(LoopError::Motor(index as u8, error));
            }
        }
        (duties, saturated, thrusts, outcome)
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

    /// What the translation's and the rotation's estimator missed or rejected.
    pub const fn counters(&self) -> [Counters; 2] {
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
