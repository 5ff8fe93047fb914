//! The hexarotor in six degrees of freedom, flown by the f32 core on what it estimates, and by the same law on the truth.
//!
//! | file | what |
//! |---|---|
//! | `scenario`, `settings`, `random` | a flight as data, checked; what of it is drawn from the seed |
//! | `load`, `error` | built-in scenarios, files, `--set`, and what is wrong with them |
//! | `path`, `reference` | where to fly: position and attitude with their derivatives |
//! | `bus` | bits that go wrong between sensor and estimator |
//! | `pilot` | the core in the loop, and the yardstick |
//! | `flight` | plant, sensors and a pilot, tick by tick |
//! | `record`, `outcome` | a flight recorded, and what is kept of it |
//! | `small_angle` | the paper's rotational model looking on |
//! | `many` | many flights on all cores |
//! | `able` | what the vehicle can do |
//! | `tables`, `figures`, `scene`, `page` | the report |

// Units stand in brackets; they are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod able;
pub mod bus;
pub mod error;
pub mod figures;
pub mod flight;
pub mod load;
pub mod many;
pub mod outcome;
pub mod page;
pub mod path;
pub mod pilot;
pub mod random;
pub mod record;
pub mod reference;
pub mod scenario;
mod scene;
pub mod settings;
pub mod small_angle;
pub mod tables;

pub use load::{list, load, parse};
pub use many::{Flights, fly_many};
pub use record::{Flight, Keep, record};
pub use scenario::Scenario;
