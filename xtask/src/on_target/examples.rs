//! The examples build for the target, and the RTIC task runs on the emulator until its receiver has died.

use anyhow::{Result, bail};

use super::emulator;
use super::programs::{EMBASSY, RTIC, TARGET};
use crate::command::{root, run as run_command};
use crate::setup;

/// Frames that the receiver sends before it dies.
const FRAMES: usize = 3000;

/// Builds each in release. The RTIC task is fed frames of a vehicle that stands still at the origin, then nothing: all six states
/// must have been there, and all must be lost in the end, which its exit status says.
///
/// The emulator has its timers and the port, but no ITM, for which the telemetry does not wait, and nobody looks at the motors' pulses. When a
/// byte comes is the host's: in which tick an event is, is not asked.
pub fn run() -> Result<()> {
    setup::rust_targets()?;
    for package in [RTIC, EMBASSY] {
        let arguments = package.build_arguments();
        run_command("cargo", &arguments.iter().map(String::as_str).collect::<Vec<_>>())?;
    }
    let mut arguments = RTIC.build_arguments();
    arguments.extend(["--features", "emulator"].map(String::from));
    run_command("cargo", &arguments.iter().map(String::as_str).collect::<Vec<_>>())?;
    let program = root()?.join(RTIC.target_folder()).join(TARGET).join("release/fsb-rtic-example");
    let lines = emulator::fed(&program, frames(FRAMES))?;
    lines.iter().for_each(|line| println!("  {line}"));
    let usable = lines.iter().filter(|line| line.contains("StateUsable")).count();
    let lost = lines.iter().filter(|line| line.contains("StateLost") && line.contains("Stale")).count();
    if usable < 6 || lost < 6 {
        bail!("{usable} states were usable and {lost} lost again, of 6");
    }
    Ok(())
}

/// As the receiver sends them: 0xA5, six numbers within 1e-4 of zero, the sum of their bytes.
fn frames(count: usize) -> Vec<u8> {
    let mut seed = 1_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        1e-4 * ((seed >> 8) as f32 / (1_u32 << 23) as f32 - 1.0)
    };
    let mut bytes = Vec::new();
    for _ in 0..count {
        let numbers: Vec<u8> = (0..6).flat_map(|_| noise().to_le_bytes()).collect();
        let sum = numbers.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
        bytes.push(0xA5);
        bytes.extend(numbers);
        bytes.push(sum);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_has_26_bytes() {
        let bytes = frames(2);
        assert_eq!((bytes.len(), bytes[0], bytes[26]), (52, 0xA5, 0xA5));
        assert_ne!(bytes[..26], bytes[26..]);
    }
}
