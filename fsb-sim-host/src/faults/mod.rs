//! What bad input and faults do to the estimator, bare and behind the gate.
//!
//! | file | what |
//! |---|---|
//! | `flight` | the flight that all of it happens in, exact, with noise |
//! | `subject` | who is tested: the estimator bare, or behind the gate |
//! | `recovery` | one bad value among good ones: how far off, for how long |
//! | `burst` | a second of each kind of fault, and what is left of it afterwards |
//! | `jitter` | sampling instants that are not where they should be |
//! | `sweep` | noise × dropout × outliers × jitter × a change of mass |
//!
//! All of it is repeatable: the same seed gives the same numbers.

// Units stand in brackets; they are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod burst;
mod flight;
pub mod jitter;
pub mod recovery;
mod subject;
pub mod sweep;

pub use flight::MASS;
pub use subject::Kind;
