//! What is run, counted and proved on the (emulated) microcontroller.
//!
//! | file | what |
//! |---|---|
//! | `programs` | builds the programs of `target-tests` |
//! | `emulator` | runs them |
//! | `budgets` | `budgets.toml`: what a tick may cost |
//! | `listing` | a disassembled program |
//! | `cycles` | the published cycle counts of the Cortex-M4 |
//! | `trace` | ticks instruction by instruction |
//! | `parity`, `cost`, `size`, `panics`, `disassembly`, `firmware`, `examples` | the steps |

pub mod budgets;
mod cycles;
mod emulator;
mod listing;
mod trace;

pub mod cost;
pub mod disassembly;
pub mod examples;
pub mod firmware;
pub mod panics;
pub mod parity;
pub mod programs;
pub mod size;
