//! `target_tests::parity`, on the host and on the microcontroller: both must print the same. The number of ulps by which to
//! change the first sample may be given as an argument on the host.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    target_tests::parity::run(0, &mut |line| semihosting::println!("{line}"));
    semihosting::process::exit(0)
}

#[cfg(not(target_os = "none"))]
fn main() {
    let change = std::env::args().nth(1).map_or(0, |ulps| ulps.parse().expect("a number of ulps"));
    target_tests::parity::run(change, &mut |line| println!("{line}"));
}
