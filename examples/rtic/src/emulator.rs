//! On the emulator: events are printed, and the run ends when the receiver has died and every state is lost.

use core::sync::atomic::{AtomicBool, Ordering};
use fsb_firmware::StampedEvent;
use semihosting::{println, process};

/// All six axes.
const ALL: u8 = 0b11_1111;
/// Ticks within which the receiver must have begun and died: ten minutes.
const LIMIT: u32 = 600_000;

static BEGUN: AtomicBool = AtomicBool::new(false);

/// Prints it.
pub fn tell(stamped: &StampedEvent) {
    println!("tick {}: {:?}", stamped.tick, stamped.event);
}

/// After each tick: `flying` are the axes that have a state, by bits.
pub fn judge(ticks: u32, flying: u8) {
    if flying == ALL {
        BEGUN.store(true, Ordering::Relaxed);
    } else if flying == 0 && BEGUN.load(Ordering::Relaxed) {
        println!("end");
        process::exit(0);
    }
    if ticks > LIMIT {
        println!("FAILED: all axes had a state: {}; have one now: {flying:06b}", BEGUN.load(Ordering::Relaxed));
        process::exit(1);
    }
}
