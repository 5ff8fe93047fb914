//! The memory layout, `memory.x`, is in the root; in a project of your own it lies beside this file.

fn main() {
    let folder = std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    println!("cargo::rustc-link-search={folder}/../..");
    println!("cargo::rerun-if-changed={folder}/../../memory.x");
}
