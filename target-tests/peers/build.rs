//! The memory layout is the one of the firmware, in the root.

fn main() {
    let folder = std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    println!("cargo::rustc-link-search={folder}/../..");
    println!("cargo::rerun-if-changed={folder}/../../memory.x");
}
