//! The C interface: header, library, and programs in C on this machine and on the emulated microcontroller.

mod header;

use anyhow::Result;

use crate::command;

/// Whether `--write` was given: then the header is written before it is checked.
fn writing() -> bool {
    std::env::args().any(|argument| argument == "--write")
}

/// Everything about the C interface.
pub fn run() -> Result<()> {
    let root = command::root()?;
    if writing() {
        header::write(&root)?;
    }
    header::check(&root)?;
    Ok(())
}
