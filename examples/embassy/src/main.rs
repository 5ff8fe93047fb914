//! The control loop as an Embassy task: SysTick signals the tick at 1 kHz, another task puts the bytes of the serial port
//! together. Both run on the executor of thread mode; a vehicle with more to do gives the loop an interrupt executor.
//!
//! No HAL is needed for that. With embassy-stm32 the motors are its `SimplePwm` channels, which implement `SetDutyCycle`, and
//! the tick is `embassy_time::Ticker`.
#![no_std]
#![no_main]

#[path = "../../shared/board.rs"]
mod board;
#[path = "../../shared/frame.rs"]
mod frame;

use board::{CLOCK, Marker, Motor};
use core::panic::PanicInfo;
use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;
use embassy_executor::Spawner;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use embassy_sync::signal::Signal;
use frame::Decoder;
use fsb_core::control::Reference;
use fsb_firmware::{Allocation, ControlLoop, LoopConfig, Sample, TiltedHexarotor, attitude_from_angles};

/// Control rate [Hz].
const RATE: u32 = 1000;

static TICK: Signal<CriticalSectionRawMutex, ()> = Signal::new();
/// Ticks that were due while the one before had not been taken up: lost. For telemetry, or a debugger.
static OVERRUNS: AtomicU32 = AtomicU32::new(0);
/// Axes that have a state, by bits: likewise. The others have the fallback input: a vehicle lands, or hands over.
static FLYING: AtomicU32 = AtomicU32::new(0);
static SAMPLE: Signal<CriticalSectionRawMutex, Sample> = Signal::new();
/// Bytes of the receiver.
static BYTES: Channel<CriticalSectionRawMutex, u8, 64> = Channel::new();

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    cortex_m::asm::udf()
}

#[exception]
fn SysTick() {
    if TICK.signaled() {
        OVERRUNS.fetch_add(1, Ordering::Relaxed);
    }
    TICK.signal(());
    // At 9600 baud no more than one byte comes in a tick.
    if let Some(byte) = board::received() {
        // Full: the byte is lost, and the frame with it.
        let _ = BYTES.try_send(byte);
    }
}

#[embassy_executor::main]
async fn main(spawner: Spawner) {
    let geometry = TiltedHexarotor { arm: 0.25, tilt: 0.35, drag_ratio: 0.02 };
    let allocation = Allocation::new(&geometry.matrix(), 6.0).expect("a tilted hexarotor");
    let mut config = LoopConfig::new(1.0 / f64::from(RATE), 1.5, [0.015, 0.015, 0.03], allocation);
    // 36 frames a second: most ticks have none, which is nothing to tell. Four that repeat are of a receiver that is stuck.
    config.missing_after = 0.1;
    config.translation_guard.frozen_after = 4;
    config.rotation_guard.frozen_after = 4;
    let (motors, marker) = board::set_up();
    board::set_up_port(9600);
    let flight = ControlLoop::new(&config, motors, marker).expect("a good configuration");
    spawner.spawn(control(flight).expect("the first of its kind"));
    spawner.spawn(receive().expect("the first of its kind"));

    let mut timer = cortex_m::Peripherals::take().expect("the first to take them").SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(CLOCK / RATE - 1);
    timer.clear_current();
    timer.enable_interrupt();
    timer.enable_counter();
}

/// The control period.
#[embassy_executor::task]
async fn control(mut flight: ControlLoop<Motor, Marker>) {
    // From the first tick on the motors carry the weight: none before something was measured. A vehicle is armed besides.
    let mut sample = Some(SAMPLE.wait().await);
    // Of the ticks before none was to be taken up.
    TICK.reset();
    OVERRUNS.store(0, Ordering::Relaxed);
    loop {
        TICK.wait().await;
        sample = SAMPLE.try_take().or(sample);
        let Ok(report) = flight.tick(sample.take().as_ref(), &[Reference::default(); 6]);
        let flying =
            report.states.iter().zip(0..).fold(0, |bits, (state, axis)| bits | u32::from(state.is_some()) << axis);
        FLYING.store(flying, Ordering::Relaxed);
        // What was lost and why: a vehicle logs it, as defmt does with the feature of that name.
        while flight.events().take().is_some() {}
    }
}

/// Positions and attitude.
#[embassy_executor::task]
async fn receive() {
    let mut decoder = Decoder::default();
    loop {
        if let Some([x, y, z, roll, pitch, yaw]) = decoder.push(BYTES.receive().await) {
            SAMPLE.signal(Sample {
                position: [Some(x), Some(y), Some(z)],
                angles: [Some(roll), Some(pitch), Some(yaw)],
                attitude: attitude_from_angles([roll, pitch, yaw]),
            });
        }
    }
}
