//! With defmt the linker needs its section layout too. Only for the firmware: a library leaves that to its user.

fn main() {
    println!("cargo::rerun-if-env-changed=CARGO_FEATURE_DEFMT");
    let is_set = |name: &str, value: &str| std::env::var(name).is_ok_and(|v| v == value);
    if is_set("CARGO_CFG_TARGET_OS", "none") && std::env::var_os("CARGO_FEATURE_DEFMT").is_some() {
        println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
    }
}
