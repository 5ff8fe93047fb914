//! Sensors and their faults, seeded: what reaches the flight controller of a true position or attitude.
//!
//! A [`Sensor`] is shown the truth once per control tick and gives a measurement or nothing. On its way a sample passes, in
//! this order: rate, jitter of the sampling instant, noise, outlier, quantisation, dropout, latency.
//!
//! | file | what |
//! |---|---|
//! | `config` | the faults as data, checked |
//! | `quantity` | what noise, an outlier and a quantisation step are for a position and for an attitude |
//! | `faults` | the random draws, each fault from its own generator |
//! | `sensor` | the pipeline |

// Units stand in brackets; they are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod config;
mod faults;
pub mod quantity;
pub mod sensor;

pub use config::SensorConfig;
pub use quantity::Quantity;
pub use sensor::{Measurement, Sensor};
