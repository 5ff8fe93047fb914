//! The control loop as an RTIC 2 task: TIM2 ticks at 1 kHz and preempts the serial port, which brings the positions, and the
//! telemetry. The core clock is the 16 MHz the chip starts with; a vehicle sets up its PLL first.
#![no_std]
#![no_main]

#[path = "../../shared/board.rs"]
mod board;
#[cfg(feature = "emulator")]
mod emulator;
#[path = "../../shared/frame.rs"]
mod frame;

// On the emulator it is that of `semihosting`, which prints.
#[cfg(not(feature = "emulator"))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    cortex_m::asm::udf()
}

#[rtic::app(device = stm32f4::stm32f405, dispatchers = [EXTI0])]
mod app {
    use crate::board::{self, CLOCK, Marker, Motor};
    use crate::frame::Decoder;
    use fsb_core::control::Reference;
    use fsb_core::readout::Parameter;
    use fsb_firmware::{Allocation, ControlLoop, LoopConfig, Sample, TiltedHexarotor, attitude_from_angles};
    use stm32f4::stm32f405::TIM2;

    /// Control rate [Hz].
    const RATE: u32 = 1000;

    #[shared]
    struct Shared {
        /// The newest sample, taken by the tick.
        sample: Option<Sample>,
        /// 1/m, 1/Ix, 1/Iy, 1/Iz for the telemetry.
        parameters: [Option<Parameter>; 4],
        /// Overruns so far, likewise.
        late: u32,
        /// Axes that have a state, by bits, likewise. The others have the fallback input: a vehicle lands, or hands over.
        flying: u8,
    }

    #[local]
    struct Local {
        flight: ControlLoop<Motor, Marker>,
        timer: TIM2,
        decoder: Decoder,
        ticks: u32,
        /// Ticks that were still computing when the next one was due.
        overruns: u32,
    }

    #[init]
    fn init(context: init::Context) -> (Shared, Local) {
        let device = context.device;
        device.RCC.apb1enr().modify(|_, w| w.tim2en().enabled());
        // SAFETY: the register has 32 bits.
        device.TIM2.arr().write(|w| unsafe { w.bits(CLOCK / RATE - 1) });
        device.TIM2.dier().write(|w| w.uie().enabled());
        device.TIM2.cr1().write(|w| w.cen().enabled());
        let (motors, marker) = board::set_up();
        board::set_up_port(115_200);

        let geometry = TiltedHexarotor { arm: 0.25, tilt: 0.35, drag_ratio: 0.02 };
        let allocation = Allocation::new(&geometry.matrix(), 6.0).expect("a tilted hexarotor");
        let mut config = LoopConfig::new(1.0 / f64::from(RATE), 1.5, [0.015, 0.015, 0.03], allocation);
        // 443 frames a second at most: some ticks have none. Twenty that repeat are of a receiver that is stuck.
        config.translation_guard.frozen_after = 20;
        config.rotation_guard.frozen_after = 20;
        let flight = ControlLoop::new(&config, motors, marker).expect("a good configuration");
        (
            Shared { sample: None, parameters: [None; 4], late: 0, flying: 0 },
            Local { flight, timer: device.TIM2, decoder: Decoder::default(), ticks: 0, overruns: 0 },
        )
    }

    /// The control period. Nothing that it waits for can take long: the tasks below only copy under their lock.
    #[task(binds = TIM2, priority = 3, local = [flight, timer, ticks, overruns], shared = [sample, parameters, late, flying])]
    fn tick(mut context: tick::Context) {
        context.local.timer.sr().modify(|_, w| w.uif().clear());
        let sample = context.shared.sample.lock(Option::take);
        // From the first tick on the motors carry the weight: none before something was measured. A vehicle is armed besides.
        if *context.local.ticks == 0 && sample.is_none() {
            return;
        }
        let wanted = [Reference::default(); 6];
        let Ok(report) = context.local.flight.tick(sample.as_ref(), &wanted);
        let flying =
            report.states.iter().zip(0..).fold(0, |bits, (state, axis)| bits | u8::from(state.is_some()) << axis);
        *context.local.ticks = context.local.ticks.checked_add(1).unwrap_or(1);
        if context.local.timer.sr().read().uif().bit_is_set() {
            *context.local.overruns = context.local.overruns.saturating_add(1);
        }
        if context.local.ticks.is_multiple_of(RATE / 10) {
            let now = context.local.flight.parameters();
            context.shared.parameters.lock(|parameters| *parameters = now);
            let late = *context.local.overruns;
            context.shared.late.lock(|told| *told = late);
            context.shared.flying.lock(|told| *told = flying);
            // Refused where the last one is still being sent.
            let _ = telemetry::spawn();
        }
        // What was lost and why. A vehicle logs it.
        while let Some(_event) = context.local.flight.events().take() {
            #[cfg(feature = "emulator")]
            crate::emulator::tell(&_event);
        }
        #[cfg(feature = "emulator")]
        crate::emulator::judge(*context.local.ticks, flying);
    }

    #[task(binds = USART1, priority = 2, local = [decoder], shared = [sample])]
    fn receive(mut context: receive::Context) {
        let Some(byte) = board::received() else { return };
        if let Some([x, y, z, roll, pitch, yaw]) = context.local.decoder.push(byte) {
            let sample = Sample {
                position: [Some(x), Some(y), Some(z)],
                angles: [Some(roll), Some(pitch), Some(yaw)],
                attitude: attitude_from_angles([roll, pitch, yaw]),
            };
            context.shared.sample.lock(|newest| *newest = Some(sample));
        }
    }

    /// Ten times a second, when nothing else is to do: overruns, axes that have a state, and 1/m with its variance once it is known, over
    /// ITM port 0, if somebody listens.
    #[task(priority = 1, shared = [parameters, late, flying])]
    async fn telemetry(mut context: telemetry::Context) {
        let [mass, ..] = context.shared.parameters.lock(|parameters| *parameters);
        let late = context.shared.late.lock(|late| *late);
        let flying = context.shared.flying.lock(|flying| *flying);
        // SAFETY: the only user of the ITM.
        let itm = unsafe { &mut *cortex_m::peripheral::ITM::PTR };
        // The port is never ready where it is off.
        if itm.tcr.read() & 1 == 0 || itm.ter[0].read() & 1 == 0 {
            return;
        }
        let port = &mut itm.stim[0];
        let known = mass.map_or([f32::NAN; 2], |known| [known.value, known.variance]).map(f32::to_bits);
        for word in [late, u32::from(flying), known[0], known[1]] {
            while !port.is_fifo_ready() {}
            port.write_u32(word);
        }
    }
}
