//! The flight: ten seconds of the course, with a vehicle that is heavier than configured.

use cortex_m_rt::entry;
#[cfg(feature = "defmt")]
use defmt_semihosting as _;
use fsb_firmware::{Allocation, ControlLoop, LoopConfig, attitude_from_angles};
// The standard output is defmt's then: `defmt-print -e ELF` reads it.
#[cfg(feature = "defmt")]
use semihosting::eprintln as println;
#[cfg(not(feature = "defmt"))]
use semihosting::println;
use semihosting::process;

use crate::board::{Marker, Motor, Tick, duties};
use crate::course;
use crate::plant::{GEOMETRY, THRUST_MAX, Vehicle};

/// Control rate \[Hz\].
const RATE: u32 = 1000;
const SECONDS: u32 = 10;
/// What the vehicle really is: mass \[kg\] and inertias \[kg m²\]. Configured are 1.5 kg and (0.015, 0.015, 0.03) kg m².
const TRUTH: [f64; 4] = [1.8, 0.03, 0.03, 0.06];

#[entry]
fn main() -> ! {
    match fly() {
        Ok(()) => process::exit(0),
        Err(what) => {
            println!("FAILED: {what}");
            process::exit(1)
        }
    }
}

fn fly() -> Result<(), &'static str> {
    let core = cortex_m::Peripherals::take().ok_or("the peripherals are taken")?;
    let [mass, inertia @ ..] = TRUTH;
    let mut vehicle = Vehicle::new(mass, inertia, [0.4, -0.3, 1.7, 0.1, -0.05, 0.2]);
    let allocation = Allocation::new(&GEOMETRY.matrix(), THRUST_MAX).map_err(|_| "allocation")?;
    let period = 1.0 / f64::from(RATE);
    let config = LoopConfig::new(period, 1.5, [0.015, 0.015, 0.03], allocation);
    let motors = [0, 1, 2, 3, 4, 5].map(Motor);
    let mut flight = ControlLoop::new(&config, motors, Marker::new()).map_err(|_| "configuration")?;

    let mut timer = Tick::start(core.SYST, RATE);
    let (mut overruns, mut worst) = (0, 0.0_f64);
    for tick in 0..SECONDS * RATE {
        overruns += timer.wait();
        let wanted = course::at(f64::from(tick) * period);
        let mut sample = vehicle.sample();
        sample.attitude = attitude_from_angles(sample.angles.map(Option::unwrap_or_default));
        let Ok(_) = flight.tick(Some(&sample), &wanted);
        let distance = |now: f64, wanted: f32| (now - f64::from(wanted)).abs();
        let off = vehicle.position.iter().zip(&wanted).map(|(&y, w)| distance(y, w.position)).fold(0.0, f64::max);
        if tick >= (SECONDS - 2) * RATE {
            worst = worst.max(off);
        }
        vehicle.step(&duties(), period);
        if (tick + 1) % RATE == 0 {
            print_second((tick + 1) / RATE, off, &mut flight);
        }
    }

    println!("off the course at most {worst:.4} m or rad in the last 2 s; {overruns} ticks overrun");
    for (name, (parameter, truth)) in ["mass", "Ix", "Iy", "Iz"].iter().zip(flight.parameters().iter().zip(TRUTH)) {
        let (value, sd) = parameter.ok_or("a parameter is not valid")?.inverse_with_sd();
        println!("{name:<4} {value:.6} +- {sd:.1e}, in truth {truth}");
        if (f64::from(value) / truth - 1.0).abs() > 0.01 {
            return Err("a parameter is off by more than 1 %");
        }
    }
    if worst > 0.02 {
        return Err("off the course by more than 2 cm or 0.02 rad");
    }
    if overruns > 0 {
        return Err("a tick took longer than its period");
    }
    println!("end");
    Ok(())
}

fn print_second(second: u32, off: f64, flight: &mut ControlLoop<Motor, Marker>) {
    let parameters = flight.parameters().map(|parameter| parameter.map_or(f32::NAN, |parameter| 1.0 / parameter.value));
    let [mass, x, y, z] = parameters;
    println!("{second:>2} s  mass {mass:.4}  Ix {x:.5}  Iy {y:.5}  Iz {z:.5}  off the course {off:.4}");
    while let Some(stamped) = flight.events().take() {
        println!("      tick {}: {:?}", stamped.tick, stamped.event);
    }
}
