//! Flies the control loop on an STM32F405 against the plant of `plant.rs`, prints a line a second, and exits with a status
//! that says whether mass, inertias and course came out right. `cargo run --release` in this folder runs it on QEMU.
//!
//! On a vehicle the plant goes, the motors become timer channels, and the sample comes from the sensors; the rest stays.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
mod course;
#[cfg(target_os = "none")]
mod flight;
#[cfg(target_os = "none")]
mod plant;

#[cfg(not(target_os = "none"))]
fn main() -> std::process::ExitCode {
    eprintln!("this is firmware: run it with `cargo run --release` in the folder fsb-firmware");
    std::process::ExitCode::from(2)
}
