//! The `fsb` command.
fn main() {}
