//! A flight whose receiver fails, against the exact plant. Every tick is checked: finite, within limits, the fallback where nothing
//! is known.

use std::convert::Infallible;

use crate::course;
use crate::plant::{FULL_DUTY, GEOMETRY, THRUST_MAX, Vehicle};
use embedded_hal::digital::{ErrorType as PinError, OutputPin};
use embedded_hal::pwm::{ErrorType, SetDutyCycle};
use fsb_core::control::Reference;
use fsb_core::estimator::StateStatus;
use fsb_firmware::{Allocation, ControlLoop, Event, LoopConfig, Report, Sample};

pub const PERIOD: f64 = 1e-3;
/// Ticks of a second.
pub const SECOND: u32 = 1000;
/// What the vehicle is.
pub const MASS: f64 = 1.5;
pub const INERTIA: [f64; 3] = [0.03, 0.03, 0.06];
/// Half the width of the noise, of positions [m] and angles [rad].
const NOISE: [f64; 2] = [4e-4, 4e-4];

/// A motor that takes any duty.
#[derive(Clone, Copy, Debug)]
pub struct Motor;

impl ErrorType for Motor {
    type Error = Infallible;
}

impl SetDutyCycle for Motor {
    fn max_duty_cycle(&self) -> u16 {
        FULL_DUTY
    }
    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        assert!(duty <= FULL_DUTY);
        Ok(())
    }
}

/// A pin that nobody looks at.
#[derive(Clone, Copy, Debug)]
pub struct Pin;

impl PinError for Pin {
    type Error = Infallible;
}

impl OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
    fn set_high(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// The configuration that is flown: the mass as it is, the inertias half of what they are.
pub fn config() -> LoopConfig {
    let allocation = Allocation::new(&GEOMETRY.matrix(), THRUST_MAX).unwrap();
    LoopConfig::new(PERIOD, MASS, [0.015, 0.015, 0.03], allocation)
}

/// A vehicle, its loop, and what was told.
pub struct Flight {
    pub vehicle: Vehicle,
    pub control: ControlLoop<Motor, Pin>,
    pub tick: u32,
    /// Not taken yet by the test, with their ticks.
    pub told: Vec<(u32, Event)>,
    pub last: Option<Report>,
    /// How far the states in use are from the truth, at most in the last tick, of positions [m, rad] and their rates; infinite where
    /// there is none.
    pub error: [f64; 2],
    /// Forces can be pointed, as told.
    pointed: bool,
    fallback: [f32; 6],
    /// Off the course at most, since it was last put to zero, of positions [m] and angles [rad].
    pub off: [f64; 2],
    seed: u32,
}

impl Flight {
    pub fn new(config: &LoopConfig) -> Self {
        let seed = 20_260;
        println!("seed {seed}");
        let start = course::at(0.0).map(|reference| f64::from(reference.position));
        Self {
            vehicle: Vehicle::new(MASS, INERTIA, start),
            control: ControlLoop::new(config, [Motor; 6], Pin).unwrap(),
            tick: 0,
            told: Vec::new(),
            last: None,
            error: [f64::INFINITY; 2],
            pointed: false,
            fallback: config.fallback,
            off: [0.0; 2],
            seed,
        }
    }

    /// Ten seconds in which nothing is wrong; what is told then is thrown away.
    pub fn under_way(config: &LoopConfig) -> Self {
        let mut flight = Self::new(config);
        flight.fly(10 * SECOND, Some);
        flight.told.clear();
        flight
    }

    /// So many ticks on the course, `spoil` being between sensors and loop.
    pub fn fly(&mut self, ticks: u32, mut spoil: impl FnMut(Sample) -> Option<Sample>) {
        self.off = [0.0; 2];
        for _ in 0..ticks {
            let sample = spoil(self.sample());
            let wanted = course::at(f64::from(self.tick) * PERIOD);
            self.step(sample.as_ref(), &wanted);
        }
    }

    pub fn step(&mut self, sample: Option<&Sample>, wanted: &[Reference; 6]) {
        let report = self.control.tick(sample, wanted).unwrap();
        for (axis, (now, wanted)) in self.vehicle.position.iter().zip(wanted).enumerate() {
            let off = &mut self.off[axis / 3];
            *off = off.max((now - f64::from(wanted.position)).abs());
        }
        while let Some(stamped) = self.control.events().take() {
            assert_eq!(stamped.tick, self.tick);
            match stamped.event {
                Event::AttitudeUsable => self.pointed = true,
                Event::AttitudeLost => self.pointed = false,
                _ => {}
            }
            self.told.push((stamped.tick, stamped.event));
        }
        assert_eq!(self.control.events().dropped(), 0);
        self.check(&report);
        self.error = self.error_of(&report);
        self.vehicle.step(&report.duties, PERIOD);
        self.last = Some(report);
        self.tick += 1;
    }

    fn check(&self, report: &Report) {
        let most = 6.0 * THRUST_MAX as f32;
        assert!(report.input.iter().all(|input| input.abs() <= most), "{report:?}");
        let sane = |state: &fsb_core::estimator::AxisState| state.position.is_finite() && state.velocity.is_finite();
        assert!(report.states.iter().flatten().all(sane), "{report:?}");
        // Where there is nothing to fly on it is the fallback, to what a duty is rounded to.
        for (axis, state) in report.states.iter().enumerate() {
            let controlled = state.is_some() && (self.pointed || axis > 2);
            if !controlled && report.saturated == 0 {
                assert!((report.input[axis] - self.fallback[axis]).abs() < 5e-3, "{} {axis} {report:?}", self.tick);
            }
        }
    }

    /// Flies on with nothing wrong: after so many seconds the vehicle is on its course to 2 cm and 1 mrad again, its states are right, and
    /// everything is identified.
    pub fn recovers(&mut self, seconds: u32) {
        self.fly(seconds * SECOND, Some);
        self.fly(2 * SECOND, Some);
        println!("off {:?}, states off {:?}", self.off, self.error);
        assert!(self.off[0] < 0.02 && self.off[1] < 1e-3, "{:?}", self.off);
        assert!(self.error[0] < 5e-4 && self.error[1] < 5e-3, "{:?}", self.error);
        assert_eq!(self.control.state_status(), [StateStatus::Identified; 6]);
        let [mass, x, y, z] = self.control.parameters().map(|k| 1.0 / f64::from(k.unwrap().value));
        for (now, truth) in [(mass, MASS), (x, INERTIA[0]), (y, INERTIA[1]), (z, INERTIA[2])] {
            assert!((now / truth - 1.0).abs() < 5e-3, "{now} {truth}");
        }
    }

    /// What was told and not taken yet, without the motors' saturation, which any way back may bring.
    pub fn events(&mut self) -> Vec<(u32, Event)> {
        let other = |(_, event): &(u32, Event)| !matches!(event, Event::Saturated(_) | Event::SaturationOver);
        self.told.drain(..).filter(other).collect()
    }

    fn sample(&mut self) -> Sample {
        let mut sample = self.vehicle.sample();
        let [of_positions, of_angles] = NOISE;
        for y in sample.position.iter_mut().flatten() {
            *y += (of_positions * self.uniform()) as f32;
        }
        for y in sample.angles.iter_mut().flatten() {
            *y += (of_angles * self.uniform()) as f32;
        }
        sample
    }

    /// Within -1 and 1.
    fn uniform(&mut self) -> f64 {
        self.seed = self.seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.seed >> 8) / f64::from(1_u32 << 23) - 1.0
    }

    fn error_of(&self, report: &Report) -> [f64; 2] {
        let mut worst = [0.0_f64; 2];
        let truth = self.vehicle.position.iter().zip(&self.vehicle.velocity);
        for (state, (position, velocity)) in report.states.iter().zip(truth) {
            let Some(state) = state else { return [f64::INFINITY; 2] };
            worst[0] = worst[0].max((f64::from(state.position) - position).abs());
            worst[1] = worst[1].max((f64::from(state.velocity) - velocity).abs());
        }
        worst
    }
}
